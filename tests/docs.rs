//! The walks of README.md and docs/, walked: every command of a `console` block is run, in the order of the page, and prints
//! what the page says it prints.
//!
//! A page's blocks, as this test reads them:
//! - a fence ```` ```console ````: lines that begin with `$ ` are commands, the lines after one are what it prints on standard
//!   output and standard error together. `…` stands for any text within a line; a line that is only `…` for any lines.
//!   A command that ends with `&` runs on until the page ends; the next one waits for its first line. A command that ends in
//!   `  # exit N` must exit with N, others with 0.
//! - a fence ```` ```xml path/to/file.xml ```` (any language, then a path): the block is written to that file.
//!
//! Pages are walked in a folder of their own that holds a copy of `models/` and `signals-maps/`.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// A step of a walk.
#[derive(Debug)]
enum Step {
    Write { path: String, text: String },
    Run { line: usize, command: String, exit: i32, prints: Vec<String> },
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The steps of a page.
fn steps(text: &str) -> Vec<Step> {
    let mut steps = Vec::new();
    let mut lines = text.lines().enumerate();
    while let Some((_, line)) = lines.next() {
        let Some(info) = line.strip_prefix("```") else { continue };
        let block: Vec<(usize, &str)> = lines.by_ref().take_while(|(_, line)| !line.starts_with("```")).collect();
        match info.split_once(' ') {
            None if info == "console" => steps.extend(commands(&block)),
            Some((_, path)) => {
                let text = block.iter().map(|(_, line)| format!("{line}\n")).collect();
                steps.push(Step::Write { path: path.to_owned(), text });
            }
            _ => {}
        }
    }
    steps
}

fn commands(block: &[(usize, &str)]) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    for (at, line) in block {
        if let Some(command) = line.strip_prefix("$ ") {
            let (command, exit) = match command.split_once("  # exit ") {
                Some((command, code)) => (command, code.trim().parse().expect("an exit code")),
                None => (command, 0),
            };
            steps.push(Step::Run { line: at + 1, command: command.to_owned(), exit, prints: Vec::new() });
        } else if let Some(Step::Run { prints, .. }) = steps.last_mut() {
            prints.push((*line).to_owned());
        }
    }
    steps
}

/// Whether `found` is what a page's `pattern` line allows.
fn line_fits(pattern: &str, found: &str) -> bool {
    let mut pieces = pattern.split('…');
    let first = pieces.next().unwrap_or_default();
    let Some(mut rest) = found.strip_prefix(first) else { return false };
    let mut pieces: Vec<&str> = pieces.collect();
    let Some(last) = pieces.pop() else { return rest.is_empty() };
    for piece in pieces {
        match rest.find(piece) {
            Some(at) => rest = &rest[at + piece.len()..],
            None => return false,
        }
    }
    rest.ends_with(last)
}

fn fits(pattern: &[String], found: &[&str]) -> bool {
    match pattern.split_first() {
        None => found.is_empty(),
        Some((first, rest)) if first == "…" => (0..=found.len()).any(|skip| fits(rest, &found[skip..])),
        Some((first, rest)) => {
            found.split_first().is_some_and(|(line, others)| line_fits(first, line) && fits(rest, others))
        }
    }
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder for the copy");
    for entry in fs::read_dir(from).expect("a folder to copy") {
        let path = entry.expect("an entry").path();
        let target = to.join(path.file_name().expect("a name"));
        if path.is_dir() {
            copy(&path, &target);
        } else {
            fs::copy(&path, &target).expect("a copied file");
        }
    }
}

/// Commands left running behind a page's back are ended with it.
struct Background(Vec<Child>);

impl Drop for Background {
    fn drop(&mut self) {
        for child in &mut self.0 {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

fn shell(command: &str, folder: &Path) -> Command {
    let programs = Path::new(env!("CARGO_BIN_EXE_kinetwin")).parent().expect("the programs' folder");
    let path = format!("{}:{}", programs.display(), std::env::var("PATH").unwrap_or_default());
    let mut shell = Command::new("bash");
    shell.args(["-c", &format!("exec 2>&1; {command}")]).current_dir(folder).env("PATH", path);
    shell.env("NO_COLOR", "1").env("COLUMNS", "100").stdin(Stdio::null()).stdout(Stdio::piped());
    shell
}

fn start(command: &str, folder: &Path, place: &str) -> Child {
    // `exec` makes the child the program itself, so that ending the child ends the program.
    let mut child = shell(&format!("exec {command}"), folder).spawn().expect("bash");
    let mut first = String::new();
    let mut out = BufReader::new(child.stdout.take().expect("a pipe"));
    out.read_line(&mut first).expect("a readable pipe");
    assert!(!first.is_empty(), "{place}: {command:?} ended without a word");
    // What it prints later must not block it.
    std::thread::spawn(move || {
        let _ = std::io::copy(&mut out, &mut std::io::sink());
    });
    child
}

fn walk(page: &Path) {
    let text = fs::read_to_string(page).expect("a page");
    let mock = Path::new(env!("CARGO_BIN_EXE_kinetwin")).with_file_name("nxt-mock");
    assert!(mock.exists(), "the walks need all programs built: run tools/test, or cargo build --workspace first");
    let folder = tempfile::tempdir().expect("a folder for the walk");
    for part in ["models", "signals-maps"] {
        copy(&root().join(part), &folder.path().join(part));
    }
    let mut background = Background(Vec::new());
    for step in steps(&text) {
        match step {
            Step::Write { path, text } => {
                let target = folder.path().join(&path);
                assert!(Path::new(&path).is_relative() && !path.contains(".."), "{path}: outside the walk");
                fs::create_dir_all(target.parent().expect("a folder")).expect("a folder");
                fs::write(target, text).expect("a written file");
            }
            Step::Run { line, command, exit, prints } => {
                let place = format!("{}:{line}", page.file_name().unwrap_or_default().to_string_lossy());
                if let Some(command) = command.strip_suffix('&') {
                    background.0.push(start(command.trim(), folder.path(), &place));
                    continue;
                }
                let mut child = shell(&command, folder.path()).spawn().expect("bash");
                let mut out = String::new();
                child.stdout.take().expect("a pipe").read_to_string(&mut out).expect("UTF-8 output");
                let code = child.wait().expect("an ended command").code();
                assert_eq!(code, Some(exit), "{place}: {command}\n{out}");
                let found: Vec<&str> = out.lines().map(str::trim_end).collect();
                assert!(
                    prints.is_empty() || fits(&prints, &found),
                    "{place}: {command}\nthe page says:\n{}\nit printed:\n{out}",
                    prints.join("\n")
                );
            }
        }
    }
}

fn page(name: &str) -> PathBuf {
    root().join(name)
}

#[test]
fn write_a_prototype() {
    walk(&page("docs/write-a-prototype.md"));
}

#[test]
fn assemble_a_plant() {
    walk(&page("docs/assemble-a-plant.md"));
}

#[test]
fn connect_your_automation() {
    walk(&page("docs/connect-your-automation.md"));
}

#[test]
fn record_and_replay() {
    walk(&page("docs/record-and-replay.md"));
}

#[test]
fn diagnose_a_gap() {
    walk(&page("docs/diagnose-a-gap.md"));
}

#[test]
fn the_packaging_line() {
    walk(&page("docs/packaging.md"));
}

#[test]
fn every_page_that_shows_commands_is_walked() {
    let this = include_str!("docs.rs");
    for entry in fs::read_dir(root().join("docs")).expect("docs") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let text = fs::read_to_string(&path).unwrap_or_default();
        let walked = this.contains(&format!("walk(&page(\"docs/{name}\"))"));
        assert!(walked || !text.contains("```console"), "docs/{name} shows commands that nobody walks");
    }
}

#[test]
fn the_patterns_of_pages_mean_what_they_say() {
    assert!(line_fits("a … c", "a bbb c") && line_fits("…", "") && line_fits("x…", "xyz") && line_fits("a", "a"));
    assert!(!line_fits("a … c", "a bbb d") && !line_fits("a", "ab") && !line_fits("… b …", "a c"));
    let pattern: Vec<String> = ["one", "…", "four"].map(str::to_owned).to_vec();
    assert!(fits(&pattern, &["one", "two", "three", "four"]) && fits(&pattern, &["one", "four"]));
    assert!(!fits(&pattern, &["one", "two"]));
}
