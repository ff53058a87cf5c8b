//! An XML text becomes a tree in which every word knows its place, so that whoever reads meaning into it can say where
//! something is wrong. The only module that knows the XML crate.
//!
//! Of XML it takes elements, attributes, text and comments. Document types and entities of one's own are refused: no
//! file of ours needs them, and they are how XML bombs are built.

mod fault;
mod fields;
mod parse;

pub use fault::{Fault, Faults, Located, Place, SourceFile};
pub use fields::{nearest, one_of};
pub use parse::parse;

/// An attribute of an element.
#[derive(Clone, Debug)]
pub struct Attribute {
    pub name: Located<String>,
    /// Its value without the quotes, references resolved.
    pub value: Located<String>,
}

/// An element with all that stands in it.
#[derive(Clone, Debug)]
pub struct Element {
    /// Its name, at the name's place in the start tag.
    pub name: Located<String>,
    /// In the order of the file, each name once.
    pub attributes: Vec<Attribute>,
    /// In the order of the file.
    pub children: Vec<Element>,
    /// The text between its tags, without that of its children, trimmed; at the first piece's place.
    pub text: Located<String>,
    /// All of it, from the `<` of its start tag to the `>` of its end tag.
    pub extent: Place,
}

/// Writes `text` as it may stand between the quotes of an attribute, or between tags.
pub fn escape(text: &str) -> String {
    quick_xml::escape::escape(text).into_owned()
}
