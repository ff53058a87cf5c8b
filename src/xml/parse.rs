//! From text to tree.

use std::ops::Range;
use std::sync::Arc;

use quick_xml::XmlVersion;
use quick_xml::errors::{Error as XmlError, IllFormedError, SyntaxError};
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::attributes::AttrError;
use quick_xml::events::{BytesRef, BytesStart, Event};
use quick_xml::reader::Reader;

use super::{Attribute, Element, Fault, Faults, Located, Place, SourceFile};

/// Files of ours nest four deep; a file that nests deeper than this is none of ours.
const DEEPEST: usize = 32;
/// Longer files are refused: the largest plant we know of takes some 30 kB.
const LONGEST_BYTES: usize = 16 << 20;

/// Reads the document `text` of the file called `name` and gives its root.
///
/// What breaks the document's structure ends the reading; of all else that is wrong, every case is told.
pub fn parse(name: &str, text: &str) -> Result<Element, Faults> {
    // The reader passes over a byte order mark without counting it.
    let file = SourceFile::new(name, text.strip_prefix('\u{feff}').unwrap_or(text));
    if file.text().len() > LONGEST_BYTES {
        let place = Place::new(&file, 0..0);
        return Err(place.fault("the file is longer than 16 MiB", "expected a file of a reasonable size").into());
    }
    let mut tree = Tree { file: &file, open: Vec::new(), root: None, faults: Faults::default() };
    if let Err(fatal) = tree.read() {
        tree.faults.append(fatal);
    }
    match tree.root {
        Some(root) if tree.faults.is_empty() => Ok(root),
        _ => Err(tree.faults),
    }
}

struct Tree<'a> {
    file: &'a Arc<SourceFile>,
    /// The elements whose end tag is still to come, the outermost first.
    open: Vec<Element>,
    root: Option<Element>,
    faults: Faults,
}

impl Tree<'_> {
    fn place(&self, span: Range<usize>) -> Place {
        Place::new(self.file, span)
    }

    fn read(&mut self) -> Result<(), Faults> {
        let file = Arc::clone(self.file);
        let mut reader = Reader::from_str(file.text());
        // Others, editors and schema checkers among them, refuse what XML does not allow in a comment.
        reader.config_mut().check_comments = true;
        loop {
            let start = reader.buffer_position() as usize;
            let event = match reader.read_event() {
                Ok(event) => event,
                Err(error) => return Err(self.malformed(&error, reader.error_position() as usize).into()),
            };
            let span = start..reader.buffer_position() as usize;
            match event {
                Event::Start(tag) => self.start(&tag, span)?,
                Event::Empty(tag) => {
                    self.start(&tag, span.clone())?;
                    self.end(span.end);
                }
                Event::End(_) => self.end(span.end),
                Event::Text(text) => self.text(&text.xml10_content(), span),
                Event::CData(text) => self.text(&text.xml10_content(), span),
                Event::GeneralRef(reference) => self.reference(&reference, span),
                Event::DocType(_) => {
                    let fault =
                        self.place(span).fault("a document type stands here", "expected elements and comments only");
                    return Err(fault.help("remove <!DOCTYPE …>: the files of a model need none").into());
                }
                Event::Comment(_) | Event::Decl(_) | Event::PI(_) => {}
                Event::Eof => return self.eof(),
            }
        }
    }

    fn eof(&self) -> Result<(), Faults> {
        let end = self.file.text().len();
        if let Some(open) = self.open.last() {
            let name = &open.name.value;
            let expected = format!("expected </{name}> before the file's end");
            return Err(open.name.fault(format!("<{name}> is not closed"), expected).into());
        }
        match self.root {
            Some(_) => Ok(()),
            None => Err(self.place(end..end).fault("the file holds no element", "expected a root element").into()),
        }
    }

    fn start(&mut self, tag: &BytesStart<'_>, span: Range<usize>) -> Result<(), Faults> {
        // The tag's name follows its `<`.
        let origin = span.start + 1;
        let name = tag.name().as_ref().to_owned();
        let place = self.place(origin..origin + name.len());
        if self.open.is_empty() && self.root.is_some() {
            return Err(place.fault(format!("a second root element <{name}>"), "expected the file's end").into());
        }
        if self.open.len() >= DEEPEST {
            return Err(place.fault(format!("elements nest deeper than {DEEPEST}"), "expected a model's file").into());
        }
        let attributes = self.attributes(tag, origin);
        let text = Located::new(String::new(), &place);
        // It ends where its end tag does.
        let extent = self.place(span);
        self.open.push(Element { name: Located::new(name, &place), attributes, children: Vec::new(), text, extent });
        Ok(())
    }

    fn attributes(&mut self, tag: &BytesStart<'_>, origin: usize) -> Vec<Attribute> {
        let content = tag.name().as_ref().as_ptr() as usize;
        // Keys and values are slices of the tag's content, which starts with the name.
        let locate = |slice: &str| {
            let start = origin + (slice.as_ptr() as usize).saturating_sub(content);
            start..start + slice.len()
        };
        let mut attributes: Vec<Attribute> = Vec::new();
        // Doubles are looked for here: the iterator stumbles over what follows one.
        for attribute in tag.attributes().with_checks(false) {
            let attribute = match attribute {
                Ok(attribute) => attribute,
                Err(error) => {
                    let fault = self.bad_attribute(&error, origin);
                    self.faults.push(fault);
                    continue;
                }
            };
            let name = Located::new(attribute.key.as_ref().to_owned(), &self.place(locate(attribute.key.as_ref())));
            let place = self.place(locate(&attribute.value));
            if let Some(first) = attributes.iter().find(|known| known.name.value == name.value) {
                let found = format!("the attribute {:?} stands twice", name.value);
                let fault = name.fault(found, "expected each attribute once");
                self.faults.push(fault.beside(&first.name.place, "the first"));
            }
            if attribute.value.contains('<') {
                let found = format!("the value of {:?} holds a <", name.value);
                let fault = place.fault(found, "expected a closing quote before it");
                self.faults.push(fault.help("close the value with a quote, or write &lt; for a < in it"));
            }
            match attribute.normalized_value(XmlVersion::Implicit1_0) {
                Ok(value) => attributes.push(Attribute { name, value: Located::new(value.into_owned(), &place) }),
                Err(_) => self.faults.push(bad_reference(&place, &attribute.value)),
            }
        }
        attributes
    }

    fn bad_attribute(&self, error: &AttrError, origin: usize) -> Fault {
        let word = |at: usize| {
            let start = origin + at;
            let rest = self.file.text().get(start..).unwrap_or_default();
            let length = rest.find(|c: char| c.is_whitespace() || "=/>\"'".contains(c)).unwrap_or(rest.len());
            self.place(start..start + length)
        };
        match *error {
            AttrError::ExpectedEq(at) => {
                word(at).fault("an attribute without a value", "expected =\"…\" after the name")
            }
            AttrError::ExpectedValue(at) => {
                word(at).fault("an attribute without a value", "expected a value in quotes")
            }
            AttrError::UnquotedValue(at) => word(at).fault("a value without quotes", "expected a value in quotes"),
            AttrError::ExpectedQuote(at, quote) => {
                word(at).fault("a value without its closing quote", format!("expected a closing {}", quote as char))
            }
            AttrError::Duplicated(at, _) => word(at).fault("an attribute stands twice", "expected each attribute once"),
        }
    }

    fn end(&mut self, end: usize) {
        let Some(mut element) = self.open.pop() else { return };
        element.extent = self.place(element.extent.span().start..end);
        element.text.value = element.text.value.trim().to_owned();
        match self.open.last_mut() {
            Some(parent) => parent.children.push(element),
            None => self.root = Some(element),
        }
    }

    fn text(&mut self, text: &str, span: Range<usize>) {
        let blank = text.trim().is_empty();
        let place = self.place(span.start + (text.len() - text.trim_start().len())..span.end);
        match self.open.last_mut() {
            Some(element) => {
                if element.text.value.trim().is_empty() && !blank {
                    element.text.place = place;
                }
                element.text.value.push_str(text);
            }
            None if !blank => {
                self.faults
                    .push(place.fault("text outside of the root element", "expected elements and comments only"));
            }
            None => {}
        }
    }

    fn reference(&mut self, reference: &BytesRef<'_>, span: Range<usize>) {
        let name = reference.xml10_content();
        let text = match reference.resolve_char_ref() {
            Ok(Some(character)) => Some(character.to_string()),
            Ok(None) => resolve_predefined_entity(&name).map(str::to_owned),
            Err(_) => None,
        };
        match text {
            Some(text) => self.text(&text, span),
            None => self.faults.push(bad_reference(&self.place(span), &format!("&{name};"))),
        }
    }

    /// The fault for what the XML crate refused at byte `at`.
    fn malformed(&self, error: &XmlError, at: usize) -> Fault {
        let rest = self.file.text().get(at..).unwrap_or_default();
        let line_end = rest.find('\n').unwrap_or(rest.len());
        let place = self.place(at..at + line_end.max(1));
        match error {
            XmlError::IllFormed(IllFormedError::MismatchedEndTag { expected, found }) => {
                let fault = place.fault(format!("</{found}> closes nothing"), format!("expected </{expected}>"));
                match self.open.last() {
                    Some(open) => fault.beside(&open.name.place, "the element that is open here"),
                    None => fault,
                }
            }
            XmlError::IllFormed(IllFormedError::UnmatchedEndTag(found)) => {
                place.fault(format!("</{found}> closes nothing"), "expected no end tag here")
            }
            XmlError::IllFormed(IllFormedError::DoubleHyphenInComment) => {
                place.fault("a comment with -- in it", "expected a comment without: XML forbids it")
            }
            XmlError::IllFormed(IllFormedError::UnclosedReference) => {
                place.fault("an & that starts no reference", "expected &amp; for an & in a text")
            }
            XmlError::Syntax(SyntaxError::UnclosedTag) => {
                place.fault("a tag that is not closed", "expected a > or /> after it")
            }
            XmlError::Syntax(
                SyntaxError::UnclosedDoubleQuotedAttributeValue | SyntaxError::UnclosedSingleQuotedAttributeValue,
            ) => place.fault("a tag with a value that is not closed", "expected a closing quote in it"),
            XmlError::Syntax(SyntaxError::UnclosedComment) => {
                place.fault("a comment that is not closed", "expected --> after it")
            }
            other => place.fault(format!("malformed XML: {other}"), "expected well-formed XML"),
        }
    }
}

fn bad_reference(place: &Place, found: &str) -> Fault {
    place
        .fault(format!("{found:?} holds a reference that means nothing"), "expected &amp; for an & in a text")
        .help("the references known are &lt; &gt; &amp; &quot; &apos; and &#…;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn refused(text: &str, expect: &str) {
        let faults = parse("f.xml", text).expect_err(text).to_string();
        assert!(faults.contains(expect), "{text}: {faults}");
    }

    #[test]
    fn every_word_knows_its_place() {
        let text =
            "<?xml version=\"1.0\"?>\n<!-- ü --><a\n  b = 'ö &lt; &#65;'  >\n  <c d=\"1\"/> text &amp; more\n</a>\n";
        let root = parse("f.xml", text).expect("well-formed");
        let at = |place: &Place| place.to_string();
        assert_eq!((root.name.value.as_str(), at(&root.name.place).as_str()), ("a", "f.xml:2:12"));
        let value = root.attribute("b").expect("b");
        assert_eq!((value.value.as_str(), at(&value.place).as_str()), ("ö < A", "f.xml:3:8"));
        assert_eq!(at(&root.attributes[0].name.place), "f.xml:3:3");
        let child = &root.children[0];
        assert_eq!(at(&child.name.place), "f.xml:4:4");
        assert_eq!(at(&child.attribute("d").expect("d").place), "f.xml:4:9");
        assert_eq!((root.text.value.as_str(), at(&root.text.place).as_str()), ("text & more", "f.xml:4:14"));
        assert_eq!(child.extent.text(), "<c d=\"1\"/>");
        assert!(root.extent.text().starts_with("<a\n") && root.extent.text().ends_with("more\n</a>"));
    }

    #[test]
    fn a_byte_order_mark_moves_nothing() {
        let root = parse("f.xml", "\u{feff}<a b=\"1\"/>").expect("well-formed");
        assert_eq!(root.attribute("b").expect("b").place.to_string(), "f.xml:1:7");
    }

    #[test]
    fn what_is_not_well_formed_is_refused_with_its_place() {
        refused("", "f.xml:1:1: the file holds no element");
        refused("<!-- a -->", "the file holds no element");
        refused("<a>", "f.xml:1:2: <a> is not closed: expected </a>");
        refused("<a></b>", "f.xml:1:4: </b> closes nothing: expected </a>");
        refused("<a/></b>", "f.xml:1:5: </b> closes nothing: expected no end tag here");
        refused("<a/><b/>", "f.xml:1:6: a second root element <b>");
        refused("<a/>b", "f.xml:1:5: text outside of the root element");
        refused("<a b/>", "an attribute without a value");
        refused("<a b=c/>", "f.xml:1:6: a value without quotes");
        refused("<a b=\"1\" b=\"2\"/>", "f.xml:1:10: the attribute \"b\" stands twice");
        refused("<a b=\"<c d=\"/>", "the value of \"b\" holds a <");
        refused("<a b=\"&x;\"/>", "f.xml:1:7: \"&x;\" holds a reference that means nothing");
        refused("<a>&x;</a>", "f.xml:1:4: \"&x;\" holds a reference that means nothing");
        refused("<a>\n<!-- -- -->\n</a>", "f.xml:2:6: a comment with -- in it");
        refused("<a", "a tag that is not closed");
    }

    #[test]
    fn what_makes_xml_dangerous_is_refused() {
        refused("<!DOCTYPE a [<!ENTITY b \"cc\">]><a>&b;</a>", "f.xml:1:1: a document type stands here");
        refused(&"<a>".repeat(100_000), "elements nest deeper than 32");
        refused(&" ".repeat(LONGEST_BYTES + 1), "the file is longer than 16 MiB");
    }

    proptest::proptest! {
        #[test]
        fn no_text_brings_it_down(text in "[<>/=\"'& ;!\\-\\[\\]?#a-cü\n]{0,60}") {
            let _ = parse("f.xml", &text);
        }

        #[test]
        fn what_was_escaped_reads_back(value in "[ -~ü]{0,20}") {
            let text = format!("<a b=\"{}\"/>", crate::xml::escape(&value));
            let root = parse("f.xml", &text).expect("well-formed");
            proptest::prop_assert_eq!(&root.attribute("b").expect("b").value, &value);
        }
    }
}
