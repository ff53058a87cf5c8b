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
                    self.start(&tag, span)?;
                    self.end();
                }
                Event::End(_) => self.end(),
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
        self.open.push(Element { name: Located::new(name, &place), attributes, children: Vec::new(), text });
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
        for attribute in tag.attributes() {
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
            AttrError::Duplicated(at, first) => word(at)
                .fault("an attribute stands twice", "expected each attribute once")
                .beside(&word(first), "the first"),
        }
    }

    fn end(&mut self) {
        let Some(mut element) = self.open.pop() else { return };
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
