//! Reading meaning into an element: its attributes by name, and a fault for each that is unknown, missing or double.

use super::{Element, Faults, Located};

/// The word of `known` that `word` was probably meant for; `None` if none is near.
///
/// Near is at most one edit (insert, delete, replace, swap) in three letters, and one in any word; capitals aside.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let plain = word.to_lowercase();
    let distance = |candidate: &str| strsim::damerau_levenshtein(&plain, &candidate.to_lowercase());
    let near =
        known.into_iter().map(|candidate| (distance(candidate), candidate)).min_by_key(|(distance, _)| *distance);
    near.filter(|(distance, _)| *distance <= (plain.chars().count() / 3).max(1)).map(|(_, candidate)| candidate)
}

/// The words as an English list: `a, b or c`; `none` where there are none.
pub fn one_of<W: AsRef<str>>(words: impl IntoIterator<Item = W>) -> String {
    let words: Vec<W> = words.into_iter().collect();
    match words.as_slice() {
        [] => "none".to_owned(),
        [only] => only.as_ref().to_owned(),
        [first @ .., last] => {
            let first: Vec<&str> = first.iter().map(AsRef::as_ref).collect();
            format!("{} or {}", first.join(", "), last.as_ref())
        }
    }
}

impl Element {
    /// The value of the attribute called `name`.
    pub fn attribute(&self, name: &str) -> Option<&Located<String>> {
        self.attributes.iter().find(|attribute| attribute.name.value == name).map(|attribute| &attribute.value)
    }

    /// The value of the attribute called `name`, which has to be there and not to be empty; a fault otherwise.
    pub fn required(&self, name: &str, faults: &mut Faults) -> Option<&Located<String>> {
        let element = &self.name.value;
        let Some(value) = self.attribute(name) else {
            let found = format!("<{element}> has no attribute {name:?}");
            faults.push(self.name.fault(found, format!("expected {name}=\"…\" in this element")));
            return None;
        };
        if value.value.trim().is_empty() {
            let found = format!("the attribute {name:?} of <{element}> is empty");
            faults.push(value.fault(found, format!("expected a {name}")));
            return None;
        }
        Some(value)
    }

    /// The value of the attribute called `name` as one of some words; a fault if it is another, `None` without one.
    pub fn choice<T: Copy>(&self, name: &str, words: &[(&str, T)], faults: &mut Faults) -> Option<T> {
        let value = self.attribute(name)?;
        let chosen = words.iter().find(|(word, _)| *word == value.value).map(|(_, chosen)| *chosen);
        if chosen.is_none() {
            let known = words.iter().map(|(word, _)| *word);
            let found = format!("{:?} is no {name} known here", value.value);
            let fault = value.fault(found, format!("expected {}", one_of(known.clone())));
            faults.push(fault.did_you_mean(nearest(&value.value, known)));
        }
        chosen
    }

    /// As [`choice`](Element::choice), of an attribute that has to be there.
    pub fn required_choice<T: Copy>(&self, name: &str, words: &[(&str, T)], faults: &mut Faults) -> Option<T> {
        self.required(name, faults)?;
        self.choice(name, words, faults)
    }

    /// Faults for all attributes other than `known`. Those of a namespace, which schema editors add, are passed over.
    pub fn allow_attributes(&self, known: &[&str], faults: &mut Faults) {
        for attribute in &self.attributes {
            let name = attribute.name.value.as_str();
            if known.contains(&name) || name == "xmlns" || name.contains(':') {
                continue;
            }
            let found = format!("<{}> takes no attribute {name:?}", self.name.value);
            let fault = attribute.name.fault(found, format!("expected {}", one_of(known)));
            faults.push(fault.did_you_mean(nearest(name, known.iter().copied())));
        }
    }

    /// Faults for all children other than `known`, and for text.
    pub fn allow_children(&self, known: &[&str], faults: &mut Faults) {
        self.allow_no_text(faults);
        for child in &self.children {
            let name = child.name.value.as_str();
            if known.contains(&name) {
                continue;
            }
            let found = format!("<{}> takes no element <{name}>", self.name.value);
            let expected = match known {
                [] => "expected no element in here".to_owned(),
                _ => format!("expected {}", one_of(known.iter().map(|name| format!("<{name}>")))),
            };
            let fault = child.name.fault(found, expected);
            faults.push(fault.did_you_mean(nearest(name, known.iter().copied())));
        }
    }

    fn allow_no_text(&self, faults: &mut Faults) {
        if !self.text.value.is_empty() {
            let found = format!("<{}> takes no text", self.name.value);
            faults.push(self.text.fault(found, "expected elements and comments only"));
        }
    }

    /// The children called `name`.
    pub fn children_named<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Element> {
        self.children.iter().filter(move |child| child.name.value == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_word_is_the_one_that_was_meant_or_none() {
        let known = ["length", "width", "acceleration", "barrierA", "barrierB", "hf", "lf"];
        let check = |word: &str, expect: Option<&str>| assert_eq!(nearest(word, known), expect, "{word}");
        check("lenght", Some("length"));
        check("Width", Some("width"));
        check("barierA", Some("barrierA"));
        check("hff", Some("hf"));
        check("speed", None);
        check("", None);
    }

    #[test]
    fn words_are_listed_in_english() {
        assert_eq!(one_of(["a", "b", "c"]), "a, b or c");
        assert_eq!(one_of(["a"]), "a");
        assert_eq!(one_of::<&str>([]), "none");
    }
}
