//! Models held in memory with one prototype that has a shape of its own: for the tests of structures and of builders.

use std::collections::BTreeMap;

use crate::device::KINDS;
use crate::plant::{Plant, load};
use crate::prototype::source::Memory;

/// A `prototype.xml` of a pusher called `name`, with `inside` between its properties and its law, whose stroke is `stroke`.
pub fn pusher(name: &str, inside: &str, stroke: &str) -> String {
    format!(
        "<prototype uuid=\"4ff5367a-4b69-48fb-9b2a-71e77d075c70\" name=\"{name}\" version=\"1\">\n  \
         <property name=\"displayName\" value=\"{name}\" type=\"string\"/>\n  \
         <property name=\"vendor\" value=\"test\" type=\"string\"/>\n{inside}\n  \
         <parameter name=\"speed\" type=\"double\" value=\"0.5\" unit=\"m/s\"/>\n  \
         <logics type=\"kinetwin.Pusher\">\n    <param name=\"stroke\" type=\"double\">{stroke}</param>\n    \
         <param name=\"extendSpeed\" type=\"double\">${{speed}}</param>\n  </logics>\n</prototype>"
    )
}

/// The plant of `plant.xml` and of the files of its prototype `name`; the later of two files of one name counts.
pub fn model(plant: &str, name: &str, files: &[(&str, &str)]) -> Result<Plant, String> {
    let mut all = BTreeMap::from([("m/plant.xml".to_owned(), plant.to_owned())]);
    all.extend(files.iter().map(|(file, text)| (format!("m/prototypes/{name}/{file}"), (*text).to_owned())));
    load(&Memory(all), "m", KINDS).map_err(|error| error.to_string())
}
