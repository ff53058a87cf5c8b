//! From a model's name to its plant: the plant's file and its bases are read and laid over each other, its prototypes
//! loaded, and the whole assembled.

use std::fmt;

use miette::GraphicalTheme;

use super::Plant;
use super::assemble::assemble;
use super::file::{self, AdapterDeclaration, InstanceDeclaration, PlantFile};
use crate::prototype::kind::KindDescriptor;
use crate::prototype::source::{Source, SourceError, folder, join};
use crate::xml::{Faults, Located, nearest, one_of, parse};

/// Bases of bases end here.
const MOST_BASES: usize = 8;

/// Why a model gives no plant.
#[derive(Clone, Debug)]
pub enum ModelError {
    /// No file is where a model of this name would have its plant.
    NotFound {
        model: String,
        /// The places that were looked at.
        tried: Vec<String>,
    },
    /// The plant's file is there and cannot be read.
    Unreadable(SourceError),
    /// The files of the model are wrong: everything that is.
    Faulty(Faults),
}

impl ModelError {
    /// Writes it for people, faults with the lines of their files; no wider than `width` columns.
    pub fn render(&self, theme: GraphicalTheme, width: usize) -> String {
        match self {
            ModelError::Faulty(faults) => faults.render(theme, width),
            other => format!("{other}\n"),
        }
    }
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ModelError::NotFound { model, tried } => {
                write!(f, "there is no model {model:?}: expected a plant's file at {}", one_of(tried))
            }
            ModelError::Unreadable(error) => error.fmt(f),
            ModelError::Faulty(faults) => faults.fmt(f),
        }
    }
}

impl std::error::Error for ModelError {}

impl From<Faults> for ModelError {
    fn from(faults: Faults) -> ModelError {
        ModelError::Faulty(faults)
    }
}

/// Where the file of a model's plant may be: `model` itself if it names a file, else `plant.xml` in the folder `model`,
/// else in the folder of that name below `models`.
fn places(model: &str) -> Vec<String> {
    if model.ends_with(".xml") {
        return vec![join("", model)];
    }
    let mut places = vec![join(model, "plant.xml")];
    if !model.contains('/') {
        places.push(join("models", &join(model, "plant.xml")));
    }
    places
}

/// Loads `model` (`models/rig`, `rig`, or the path of a plant's file) from `source`, with the device kinds `kinds`.
///
/// Prototypes are looked for in the folder `prototypes` beside the plant's file, in the folder `catalogue` beside the
/// plant's folder, and in the catalogue `models/catalogue`, in this order.
pub fn load(source: &dyn Source, model: &str, kinds: &[&'static KindDescriptor]) -> Result<Plant, ModelError> {
    let (path, text) = locate(source, model)?;
    let mut faults = Faults::default();
    let plant = read(source, &path, &text, 0, &mut faults);
    let plant = plant.and_then(|file| assemble(source, file, kinds, &mut faults));
    match plant {
        Some(plant) if faults.is_empty() => Ok(plant),
        _ => {
            faults.sort();
            Err(ModelError::Faulty(faults))
        }
    }
}

/// The path of the file of `model`'s plant, and its text.
pub fn locate(source: &dyn Source, model: &str) -> Result<(String, String), ModelError> {
    let tried = places(model);
    for path in &tried {
        match source.read(path) {
            Ok(text) => return Ok((path.clone(), text)),
            Err(SourceError::NotFound { .. }) => {}
            Err(error) => return Err(ModelError::Unreadable(error)),
        }
    }
    Err(ModelError::NotFound { model: model.to_owned(), tried })
}

/// Reads a plant's file and lays it over its base.
fn read(source: &dyn Source, path: &str, text: &str, depth: usize, faults: &mut Faults) -> Option<PlantFile> {
    let root = match parse(path, text) {
        Ok(root) => root,
        Err(malformed) => {
            faults.append(malformed);
            return None;
        }
    };
    let home = folder(path);
    let own = file::read(&root, home, faults)?;
    let Some(base) = own.base.clone() else { return Some(own) };
    if depth >= MOST_BASES {
        faults.push(base.fault("bases of bases without end", format!("expected at most {MOST_BASES}")));
        return None;
    }
    let base_path = join(home, &base.value);
    match source.read(&base_path) {
        Ok(text) => Some(lay_over(read(source, &base_path, &text, depth + 1, faults)?, own, &base, faults)),
        Err(error) => {
            let fault =
                base.fault(error.to_string(), "expected the path of a plant's file, seen from this one's folder");
            faults.push(fault);
            None
        }
    }
}

/// `over` laid over `base`: what it says counts, what it does not say stays.
fn lay_over(mut base: PlantFile, over: PlantFile, place: &Located<String>, faults: &mut Faults) -> PlantFile {
    base.name = over.name;
    base.base = None;
    base.tolerance = over.tolerance.or(base.tolerance);
    base.adapter = AdapterDeclaration {
        host: over.adapter.host.or(base.adapter.host),
        port: over.adapter.port.or(base.adapter.port),
        timeout: over.adapter.timeout.or(base.adapter.timeout),
        // A signals map is of one plant.
        signals_map: over.adapter.signals_map,
        hf: over.adapter.hf.or(base.adapter.hf),
        lf: over.adapter.lf.or(base.adapter.lf),
    };
    base.parts.extend(over.parts);
    for instance in over.instances {
        match base.instances.iter_mut().find(|known| known.name.value == instance.name.value) {
            Some(known) => change(known, instance, faults),
            None => {
                if instance.prototype.is_none() {
                    let names = base.instances.iter().map(|known| known.name.value.as_str());
                    let found =
                        format!("the base has no instance {:?}, and this one has no prototype", instance.name.value);
                    let fault = instance.name.fault(found, "expected an instance of the base, or prototype=\"…\"");
                    let near = nearest(&instance.name.value, names);
                    faults.push(fault.beside(&place.place, "the base").did_you_mean(near));
                    continue;
                }
                base.instances.push(instance);
            }
        }
    }
    base
}

fn change(known: &mut InstanceDeclaration, over: InstanceDeclaration, faults: &mut Faults) {
    if let (Some(first), Some(second)) = (&known.prototype, &over.prototype)
        && first.value != second.value
    {
        let found = format!("{:?} is an instance of {} in the base", known.name.value, first.value);
        faults.push(
            second.fault(found, format!("expected {}, or nothing", first.value)).beside(&first.place, "the base"),
        );
    }
    known.pose = over.pose.or(known.pose);
    known.effects.extend(over.effects);
    for property in over.properties {
        known.properties.retain(|kept| kept.name.value != property.name.value);
        known.properties.push(property);
    }
}
