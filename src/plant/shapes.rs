//! The shapes that prototypes' files give their instances: built once for all that are alike.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde_json::{Value, json};

use super::ParameterValue;
use crate::prototype::Prototype;
use crate::prototype::builder::{self, Script};
use crate::prototype::source::Source;
use crate::prototype::structure::{self, Meshes, Structure};
use crate::script::ScriptError;
use crate::xml::{Fault, Faults, Place, SourceFile};

/// What was built so far. Instances of one prototype are alike where all parameters that affect the geometry are.
pub(super) struct Shapes<'a> {
    meshes: Meshes<'a>,
    built: BTreeMap<Key, Option<Arc<Structure>>>,
}

/// A prototype's folder, and the parameters that affect its geometry.
type Key = (String, BTreeMap<String, String>);

impl<'a> Shapes<'a> {
    /// Nothing yet; meshes are read from `source`.
    pub fn new(source: &'a dyn Source) -> Shapes<'a> {
        Shapes { meshes: Meshes::new(source), built: BTreeMap::new() }
    }

    /// The shape of an instance of `prototype`; `None` where its files give none, or a wrong one, which is told once.
    pub fn of(
        &mut self,
        prototype: &Prototype,
        geometry: BTreeMap<String, String>,
        shape: &BTreeMap<String, ParameterValue>,
        faults: &mut Faults,
    ) -> Option<Arc<Structure>> {
        if prototype.structure.is_none() && prototype.builder.is_none() {
            return None;
        }
        let key = (prototype.folder.clone(), geometry);
        if let Some(built) = self.built.get(&key) {
            return built.clone();
        }
        let structure = match (&prototype.structure, &prototype.builder) {
            (Some(root), _) => structure::read(root, &prototype.folder, &key.1, &mut self.meshes, faults),
            (None, Some(script)) => {
                let known = shape.iter().filter(|(name, _)| key.1.contains_key(*name));
                let parameters = known.map(|(name, value)| (name.clone(), json(value))).collect();
                match builder::build(script, &Value::Object(parameters), &mut self.meshes) {
                    Ok(structure) => Some(structure),
                    Err(error) => {
                        faults.push(of_script(script, &error));
                        None
                    }
                }
            }
            (None, None) => None,
        };
        let structure = structure.map(Arc::new);
        self.built.insert(key, structure.clone());
        structure
    }
}

/// A parameter's value for a script: in SI units, lists as arrays.
pub(super) fn json(value: &ParameterValue) -> Value {
    match value {
        ParameterValue::Number(number) => json!(number),
        ParameterValue::Integer(number) => json!(number),
        ParameterValue::Boolean(value) => json!(value),
        ParameterValue::Text(text) => json!(text),
        ParameterValue::Numbers(numbers) => json!(numbers),
    }
}

/// What is wrong with a script, as a fault in its file.
pub(super) fn of_script(script: &Script, error: &ScriptError) -> Fault {
    let file = SourceFile::new(&script.path, &script.text);
    let line = error.line.unwrap_or(1);
    let start: usize = script.text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let length = script.text[start.min(script.text.len())..].lines().next().map_or(0, str::len);
    Place::new(&file, start..start + length).fault(error.message.clone(), "expected a script that does its work")
}
