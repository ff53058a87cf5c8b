//! The house's rows, kept: which module may name which, what each row may not touch, and that every path our prose names
//! exists. The table is the one of ARCHITECTURE.md; change both together.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Every module of `src/` with its row. A module may name modules of smaller rows, and itself.
///
/// Rows that hold two modules in order ("`device`, then `effect`") have a half step between them.
const ROWS: &[(&str, f64)] = &[
    ("value", 0.0),
    ("time", 0.0),
    // Text with places, no meaning: maps, prototypes and plants read theirs from it.
    ("xml", 0.0),
    // Poses and shapes name nobody; meshes are made of them, and prototypes have both.
    ("kinematics", 0.5),
    ("mesh", 0.75),
    ("script", 0.75),
    ("prototype", 1.0),
    // Prototypes declare their signals in the map's words, so the map stands half a row above them.
    ("signal_map", 0.5),
    ("wire", 1.0),
    ("bank", 2.0),
    ("plant", 2.0),
    ("session", 2.0),
    // The plant's shape: made of plants and poses.
    ("scene", 2.5),
    ("collision", 2.75),
    ("device", 3.0),
    ("effect", 3.5),
    ("engine", 4.0),
    ("trace", 5.0),
    ("replay", 6.0),
    ("gap", 6.5),
    // Reports beside the truth.
    ("exam", 6.75),
    // Both ends of a connection make theirs secure in the same way.
    ("security", 7.0),
    ("adapter", 7.25),
    ("automation", 7.25),
    ("pace", 7.5),
    ("run", 8.0),
    ("view", 9.0),
    ("integration", 9.0),
    ("bench", 9.0),
    ("cli", 10.0),
    ("main", 10.5),
];

/// What only rows 7 and up may name: files, sockets, threads, and the wall clock.
const OUTSIDE_WORLD: &[&str] = &[
    "std::fs",
    "std::net",
    "std::thread",
    "std::time::Instant",
    "std::time::SystemTime",
    "SystemTime::now",
    "std::process",
    "std::env",
    "tokio::",
    "tokio_tungstenite",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files below `folder` whose name ends with one of `endings`, sorted.
fn files(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut found = Vec::new();
    for entry in entries {
        let path = entry.expect("a readable folder").path();
        if path.is_dir() {
            found.extend(files(&path, endings));
        } else if endings.iter().any(|ending| path.to_string_lossy().ends_with(ending)) {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn relative(path: &Path) -> String {
    path.strip_prefix(root()).unwrap_or(path).to_string_lossy().into_owned()
}

/// The module a file of `src/` belongs to; `None` for `lib.rs`, which is only the map.
fn module_of(path: &Path) -> Option<String> {
    let inside = path.strip_prefix(root().join("src")).ok()?;
    let first = inside.components().next()?.as_os_str().to_string_lossy().into_owned();
    let name = first.strip_suffix(".rs").unwrap_or(&first);
    (name != "lib").then(|| name.to_owned())
}

/// The code of a file: comments and what follows them on a line cut off.
fn code(text: &str) -> String {
    let uncommented = |line: &str| match line.find("//") {
        // A `://` is part of an address, not a comment.
        Some(at) if !line[..at].ends_with(':') => line[..at].to_owned(),
        _ => line.to_owned(),
    };
    text.lines().map(uncommented).collect::<Vec<_>>().join("\n")
}

/// The names that directly follow `prefix` (`crate::`) in `code`, groups in braces included.
fn named_after(code: &str, prefix: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for (at, _) in code.match_indices(prefix) {
        let rest = &code[at + prefix.len()..];
        let identifier = |text: &str| -> String {
            text.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
        };
        let Some(group) = rest.strip_prefix('{') else {
            names.insert(identifier(rest));
            continue;
        };
        let mut depth = 1;
        let mut item = String::new();
        for c in group.chars() {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 1 => {
                    names.insert(identifier(&item));
                    item.clear();
                    continue;
                }
                _ => {}
            }
            if depth == 0 {
                break;
            }
            item.push(c);
        }
        names.insert(identifier(&item));
    }
    names.remove("");
    names
}

fn row(module: &str) -> Option<f64> {
    ROWS.iter().find(|(name, _)| *name == module).map(|(_, row)| *row)
}

#[test]
fn every_module_has_a_row() {
    for path in files(&root().join("src"), &[".rs"]) {
        if let Some(module) = module_of(&path) {
            assert!(row(&module).is_some(), "{}: module {module:?} has no row in the table", relative(&path));
        }
    }
}

#[test]
fn a_module_names_only_rows_above_its_own() {
    let mut knots = Vec::new();
    for path in files(&root().join("src"), &[".rs"]) {
        let Some(module) = module_of(&path) else { continue };
        let own = row(&module).unwrap_or(0.0);
        let text = code(&fs::read_to_string(&path).expect("a source file"));
        let prefixes: &[&str] = if module == "main" { &["kinetwin::"] } else { &["crate::"] };
        for named in prefixes.iter().flat_map(|prefix| named_after(&text, prefix)) {
            let Some(other) = row(&named) else { continue };
            if named != module && other >= own {
                knots.push(format!("{}: {module} (row {own}) names {named} (row {other})", relative(&path)));
            }
        }
    }
    assert!(knots.is_empty(), "a module may name only rows above its own:\n{}", knots.join("\n"));
}

#[test]
fn below_row_seven_there_is_no_file_no_socket_no_thread_and_no_clock() {
    let mut touched = Vec::new();
    for path in files(&root().join("src"), &[".rs"]) {
        let Some(module) = module_of(&path) else { continue };
        if row(&module).unwrap_or(0.0) >= 7.0 {
            continue;
        }
        let text = code(&fs::read_to_string(&path).expect("a source file"));
        // What a module's tests do (two threads on a bank, say) is their own business.
        let text = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
        let is_test_file = path.file_stem().is_some_and(|stem| stem.to_string_lossy().contains("test"));
        for word in OUTSIDE_WORLD {
            if !is_test_file && text.contains(word) {
                touched.push(format!("{}: {word}", relative(&path)));
            }
        }
    }
    assert!(touched.is_empty(), "only rows 7 and up may touch the outside world:\n{}", touched.join("\n"));
}

#[test]
fn one_module_knows_the_xml_crate() {
    for path in files(&root().join("src"), &[".rs"]) {
        let text = code(&fs::read_to_string(&path).expect("a source file"));
        let module = module_of(&path).unwrap_or_default();
        let allowed = module == "xml";
        assert!(allowed || !text.contains("quick_xml"), "{}: XML is read by `xml`", relative(&path));
    }
}

#[test]
fn no_source_file_has_grown_past_seven_hundred_lines() {
    for folder in ["src", "tools", "tests", "benches"] {
        for path in files(&root().join(folder), &[".rs"]) {
            let lines = fs::read_to_string(&path).expect("a source file").lines().count();
            assert!(lines <= 700, "{}: {lines} lines; split it by subject", relative(&path));
        }
    }
}

#[test]
fn the_automation_knows_the_plant_by_its_signals_alone() {
    let allowed = ["automation", "value", "time", "signal_map", "wire", "session", "trace", "security"];
    for path in files(&root().join("src/automation"), &[".rs"]) {
        let text = code(&fs::read_to_string(&path).expect("a source file"));
        for named in named_after(&text, "crate::") {
            assert!(allowed.contains(&named.as_str()), "{}: names {named}", relative(&path));
        }
    }
}

#[test]
fn the_withheld_plant_shares_nothing_with_the_diagnosis() {
    let allowed = ["value", "time", "wire", "session", "trace"];
    let sources = files(&root().join("tools/withheld-plant"), &[".rs"]);
    assert!(!sources.is_empty(), "the crate has moved: what does this test look at now?");
    let mut named_at_all = BTreeSet::new();
    for path in sources {
        let text = code(&fs::read_to_string(&path).expect("a source file"));
        for named in named_after(&text, "kinetwin::") {
            assert!(allowed.contains(&named.as_str()), "{}: names kinetwin::{named}", relative(&path));
            named_at_all.insert(named);
        }
        // Another name for the library, a macro or a file of it would be ways round the list.
        let ways_round = ["use kinetwin;", "kinetwin as", "extern crate", "include!", "#[path", "../src"];
        for way in ways_round {
            assert!(!text.contains(way), "{}: {way}", relative(&path));
        }
    }
    assert!(named_at_all.contains("trace"), "it writes traces: the names were not found");
    let manifest = fs::read_to_string(root().join("tools/withheld-plant/Cargo.toml")).expect("its manifest");
    assert!(!manifest.contains("package ="), "the library under another name");
}

/// A text in backquotes that is a path of the project: it starts with one of our folders and names no placeholder.
fn looks_like_our_path(text: &str) -> bool {
    let folders =
        ["src/", "view/", "models/", "signals-maps/", "tests/", "benches/", "tools/", "docs/", "fuzz/", ".ci/"];
    folders.iter().any(|folder| text.starts_with(folder))
        && !text.contains(|c: char| c.is_whitespace() || "<>*{}$…".contains(c))
        && !text.contains("NAME")
}

#[test]
fn every_path_named_in_prose_exists() {
    let mut lost = Vec::new();
    let mut pages: Vec<PathBuf> = ["README.md", "ARCHITECTURE.md"].map(|name| root().join(name)).to_vec();
    pages.extend(files(&root().join("docs"), &[".md"]));
    pages.extend(files(&root().join("models"), &[".md"]));
    for page in pages {
        let text = fs::read_to_string(&page).unwrap_or_else(|error| panic!("{}: {error}", page.display()));
        for quoted in text.split('`').skip(1).step_by(2) {
            let path = quoted.trim_end_matches('/').split('#').next().unwrap_or_default();
            if looks_like_our_path(quoted) && !root().join(path).exists() {
                lost.push(format!("{}: `{quoted}`", relative(&page)));
            }
        }
        // Links to files beside the page.
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let file = link.split('#').next().unwrap_or_default();
            let outside = file.contains("://") || file.is_empty() || file.contains(char::is_whitespace);
            if !outside && !page.parent().unwrap_or(root()).join(file).exists() {
                lost.push(format!("{}: link to {link}", relative(&page)));
            }
        }
    }
    assert!(lost.is_empty(), "paths named in prose that do not exist:\n{}", lost.join("\n"));
}

#[test]
fn the_scanner_sees_what_it_should() {
    let check = |text: &str, names: &[&str]| {
        assert_eq!(named_after(text, "crate::"), names.iter().map(|name| (*name).to_owned()).collect(), "{text}");
    };
    check("use crate::bank::Side;", &["bank"]);
    check("use crate::{bank::{Side, Ring}, value::Value};", &["bank", "value"]);
    check("fn f(x: crate::value::Value) -> crate::time::Instant {}", &["value", "time"]);
    assert_eq!(code("let url = \"ws://x\"; // crate::run"), "let url = \"ws://x\"; // crate::run");
    assert_eq!(code("let a = 1; // crate::run"), "let a = 1; ");
    assert!(looks_like_our_path("src/bank/") && !looks_like_our_path("models/NAME/plant.xml"));
}
