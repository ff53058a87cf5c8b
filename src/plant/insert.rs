//! Effects put into the text of a plant's file. Everything else in it, comments and layout included, stays as it stands.

use std::ops::Range;

use super::effects_file::Addition;
use crate::xml::{Element, Faults, escape, parse};

/// What is written deeper than the element it stands in.
const DEEPER: &str = "  ";

/// A plant's file after an edit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edited {
    pub text: String,
    /// The instances that the file did not have: they are those of its base.
    pub of_base: Vec<String>,
}

/// Puts `effects` into `text`, the plant's file called `file`; `base`, where it is given, becomes the path of its base. An
/// effect stands behind all else in its instance; an instance that the file does not have is added at its end, to change
/// the base's.
///
/// # Errors
/// The file is no XML.
pub fn insert(file: &str, text: &str, effects: &[Addition], base: Option<&str>) -> Result<Edited, Faults> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let root = parse(file, text)?;
    let mut edits: Vec<(Range<usize>, String)> = Vec::new();
    if let (Some(base), Some(attribute)) = (base, root.attribute("base")) {
        edits.push((attribute.place.span(), escape(base)));
    }
    let mut of_base: Vec<(String, Vec<&Addition>)> = Vec::new();
    let mut of_own: Vec<(&Element, Vec<&Addition>)> = Vec::new();
    for addition in effects {
        let name = &addition.instance.value;
        let has_name = |child: &&Element| child.attribute("name").is_some_and(|known| known.value == *name);
        match root.children_named("instance").find(has_name) {
            Some(instance) => match of_own.iter_mut().find(|(known, _)| std::ptr::eq(*known, instance)) {
                Some((_, additions)) => additions.push(addition),
                None => of_own.push((instance, vec![addition])),
            },
            None => match of_base.iter_mut().find(|(known, _)| known == name) {
                Some((_, additions)) => additions.push(addition),
                None => of_base.push((name.clone(), vec![addition])),
            },
        }
    }
    for (instance, additions) in of_own {
        let indent = format!("{}{DEEPER}", indent_of(text, instance));
        let lines: String = additions.iter().map(|addition| format!("\n{}", placed(addition, &indent))).collect();
        edits.push(at_end_of(text, instance, &lines));
    }
    let mut lines = String::new();
    for (name, additions) in &of_base {
        let deeper = format!("{DEEPER}{DEEPER}");
        lines.push_str(&format!("\n\n{DEEPER}<instance name=\"{}\">", escape(name)));
        lines.extend(additions.iter().map(|addition| format!("\n{}", placed(addition, &deeper))));
        lines.push_str(&format!("\n{DEEPER}</instance>"));
    }
    if !lines.is_empty() {
        edits.push(at_end_of(text, &root, &lines));
    }
    // From the last to the first, so that none moves another.
    edits.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
    let mut edited = text.to_owned();
    edits.into_iter().for_each(|(span, new)| edited.replace_range(span, &new));
    Ok(Edited { text: edited, of_base: of_base.into_iter().map(|(name, _)| name).collect() })
}

/// An effect's text as it stands in its own file, its lines moved to `indent`.
fn placed(addition: &Addition, indent: &str) -> String {
    let text = addition.place.text();
    let lines = || text.lines().skip(1).filter(|line| !line.trim().is_empty());
    // The last line is that of the end tag, which stands as deep as the start tag.
    let own = lines().last().map_or(0, |line| line.len() - line.trim_start().len());
    let mut out = format!("{indent}{}", text.lines().next().unwrap_or_default().trim_end());
    for line in lines() {
        // Blanks may be wider than a byte; then they are not counted off one by one.
        let blanks = line.len() - line.trim_start().len();
        let deeper = line.get(own.min(blanks)..).unwrap_or_else(|| line.trim_start());
        out.push_str(&format!("\n{indent}{}", deeper.trim_end()));
    }
    out
}

/// The blanks before an element on its line.
fn indent_of<'a>(text: &'a str, element: &Element) -> &'a str {
    let before = &text[..element.extent.span().start];
    let line = &before[before.rfind('\n').map_or(0, |at| at + 1)..];
    &line[..line.len() - line.trim_start().len()]
}

/// The edit that puts `lines`, each of which begins with a line break, behind all that stands in an element.
fn at_end_of(text: &str, element: &Element, lines: &str) -> (Range<usize>, String) {
    let span = element.extent.span();
    let whole = &text[span.clone()];
    let indent = indent_of(text, element);
    let name = &element.name.value;
    let end_tag = format!("\n{indent}</{name}>");
    if let Some(open) = whole.strip_suffix("/>") {
        let tag = open.trim_end().len();
        return (span.start + tag..span.end, format!(">{lines}{end_tag}"));
    }
    let inside = whole[..whole.rfind("</").unwrap_or(whole.len())].trim_end().len();
    (span.start + inside..span.end, format!("{lines}{end_tag}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::effects_file::read;

    const EFFECTS: &str = "<effects>
  <instance name=\"A\">
    <effect kind=\"backlash\" place=\"transmission\">
      <!-- from flank to flank -->
      <parameter name=\"gap\" value=\"2\" unit=\"mm\"/>
    </effect>
    <effect kind=\"inverted\" place=\"command-link\"/>
  </instance>
</effects>";

    fn check(text: &str, expected: &str) {
        let effects = read("effects.xml", EFFECTS).expect("effects").effects;
        let edited = insert("plant.xml", text, &effects, None).expect("an edit");
        assert_eq!(edited.text, expected);
    }

    #[test]
    fn comments_and_layout_stay() {
        check(
            "<!-- head -->\n<plant name=\"p\">\n\t<!-- A's -->\n\t<instance name=\"A\"   prototype=\"X\">\n\t\t<pose/> <!-- here -->\n\t</instance>\n  <part/>\n</plant>\n",
            "<!-- head -->\n<plant name=\"p\">\n\t<!-- A's -->\n\t<instance name=\"A\"   prototype=\"X\">\n\t\t<pose/> <!-- here -->\n\t  <effect kind=\"backlash\" place=\"transmission\">\n\t    <!-- from flank to flank -->\n\t    <parameter name=\"gap\" value=\"2\" unit=\"mm\"/>\n\t  </effect>\n\t  <effect kind=\"inverted\" place=\"command-link\"/>\n\t</instance>\n  <part/>\n</plant>\n",
        );
    }

    #[test]
    fn an_empty_instance_and_one_on_a_line_are_opened() {
        let effects = "\n    <effect kind=\"backlash\" place=\"transmission\">\n      <!-- from flank to flank -->\n      <parameter name=\"gap\" value=\"2\" unit=\"mm\"/>\n    </effect>\n    <effect kind=\"inverted\" place=\"command-link\"/>\n  </instance>";
        check(
            "<plant>\n  <instance name=\"A\" />\n</plant>",
            &format!("<plant>\n  <instance name=\"A\">{effects}\n</plant>"),
        );
        check(
            "<plant>\n  <instance name=\"A\"><pose/></instance >\n</plant>",
            &format!("<plant>\n  <instance name=\"A\"><pose/>{effects}\n</plant>"),
        );
    }

    proptest::proptest! {
        #[test]
        fn whatever_the_layout_the_effect_is_in_it(
            blanks in "[ \t\n\u{a0}\u{2003}]{0,4}",
            inside in "([ \n]|<pose/>|<!-- ä -->){0,4}",
            own in "[ \u{a0}\t]{0,3}",
        ) {
            let effects = EFFECTS.replace("    <effect", &format!("{own}<effect")).replace("      <", &format!("{own} <"));
            let effects = read("effects.xml", &effects).expect("effects").effects;
            let name = "name=\"A\"";
            for text in [
                format!("<plant>{blanks}<instance {name}>{inside}</instance>{blanks}</plant>"),
                format!("<plant>{blanks}<instance {name}/>{blanks}</plant>"),
                format!("<plant>{inside}{blanks}</plant>"),
                "<plant/>".to_owned(),
            ] {
                let Ok(edited) = insert("plant.xml", &text, &effects, None) else { continue };
                let root = parse("plant.xml", &edited.text).expect("well-formed");
                let instance = root.children_named("instance").next().expect("the instance");
                proptest::prop_assert_eq!(instance.children_named("effect").count(), 2, "{}", edited.text);
            }
        }
    }

    #[test]
    fn an_instance_of_the_base_is_changed_at_the_end() {
        let effects = read("effects.xml", EFFECTS).expect("effects").effects;
        let text = "<plant name=\"p\" base=\"../a.xml\">\n  <!-- last -->\n</plant>\n";
        let edited = insert("plant.xml", text, &effects[1..], Some("../b & c.xml")).expect("an edit");
        assert_eq!(
            edited.text,
            "<plant name=\"p\" base=\"../b &amp; c.xml\">\n  <!-- last -->\n\n  <instance name=\"A\">\n    <effect kind=\"inverted\" place=\"command-link\"/>\n  </instance>\n</plant>\n"
        );
        assert_eq!(edited.of_base, ["A"]);
    }
}
