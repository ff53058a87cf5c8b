//! A plant from its declarations: prototypes are loaded, every instance gets its parameters and signals, and what names
//! something else is looked up.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::file::{AdapterDeclaration, InstanceDeclaration, PartDeclaration, PlantFile};
use super::instance::build;
use super::shapes::Shapes;
use super::{AdapterSettings, EMBEDDED_HOST, InitialPart, Instance, Places, Plant};
use crate::prototype::kind::KindDescriptor;
use crate::prototype::source::{Source, join};
use crate::prototype::{self, Prototype};
use crate::signal_map::{Signal, SignalMap};
use crate::xml::{Faults, Located, nearest, one_of};

/// How far a real device may lie from its model where nobody says: one per cent, as real drums differ.
const DEFAULT_TOLERANCE: f64 = 0.01;

/// Where a host is named without a port: the one that runtimes of the standard listen on.
const DEFAULT_PORT: u16 = 61499;
const DEFAULT_TIMEOUT: Duration = Duration::from_secs(5);
const DEFAULT_HF: Duration = Duration::from_millis(20);
const DEFAULT_LF: Duration = Duration::from_millis(500);

/// How far an instance's parameters may be off: what the plant says for all, and what holds where nobody says.
#[derive(Clone, Copy)]
pub(super) struct Tolerances {
    pub plant: Option<f64>,
    pub default: f64,
}

/// Assembles the plant of `file`.
pub(super) fn assemble(
    source: &dyn Source,
    file: PlantFile,
    kinds: &[&'static KindDescriptor],
    faults: &mut Faults,
) -> Option<Plant> {
    if file.instances.is_empty() && faults.is_empty() {
        let fault =
            file.name.fault("the plant is empty", "expected at least one <instance name=\"…\" prototype=\"…\">");
        faults.push(fault);
        return None;
    }
    let prototypes = load_prototypes(source, &file.instances, kinds, faults);
    let tolerances = Tolerances { plant: file.tolerance, default: DEFAULT_TOLERANCE };
    let (mut instances, mut signals, mut references) = (Vec::new(), Vec::new(), Vec::new());
    let mut places = Places::default();
    let mut shapes = Shapes::new(source);
    for declaration in &file.instances {
        let Some(prototype) = prototypes.get(&key(declaration)).and_then(Option::as_ref) else { continue };
        let built = build(declaration, prototype, tolerances, &mut signals, faults);
        let name = &built.instance.name;
        places.instances.insert(name.clone(), declaration.name.place.clone());
        let effects = declaration.effects.iter().map(|effect| effect.places.clone()).collect();
        places.effects.insert(name.clone(), effects);
        places.parameters.extend(built.set.into_iter().map(|(parameter, place)| ((name.clone(), parameter), place)));
        let structure = shapes.of(prototype, built.geometry, &built.instance.shape, faults);
        instances.push(Instance { structure, ..built.instance });
        references.extend(built.references);
    }
    // The names alone suffice: an instance whose prototype is wrong is there all the same.
    let names: Vec<&str> = file.instances.iter().map(|instance| instance.name.value.as_str()).collect();
    references.iter().for_each(|reference| look_up(reference, &names, faults));
    places.parts = file.parts.iter().map(|part| part.place.clone()).collect();
    let parts = file.parts.iter().map(|part| initial_part(part, &names, faults)).collect();
    let name = file.name.value.clone();
    let signal_map = signal_map(&file.name, signals, faults)?;
    Some(Plant { name, adapter: adapter(file.adapter), instances, parts, signal_map: Arc::new(signal_map), places })
}

/// What an instance's prototype is found by: the folder it is looked for from, and its name.
fn key(instance: &InstanceDeclaration) -> (String, String) {
    let name = instance.prototype.as_ref().map(|name| name.value.clone()).unwrap_or_default();
    (instance.home.clone(), name)
}

type Prototypes = BTreeMap<(String, String), Option<Prototype>>;

fn load_prototypes(
    source: &dyn Source,
    instances: &[InstanceDeclaration],
    kinds: &[&'static KindDescriptor],
    faults: &mut Faults,
) -> Prototypes {
    let mut prototypes = Prototypes::new();
    for instance in instances {
        let Some(name) = &instance.prototype else { continue };
        if let Some(loaded) = prototypes.get(&key(instance)) {
            // Told at its first instance; a prototype that is not there is told at each.
            if loaded.is_none() {
                prototype::load(source, &folders(&instance.home), name, kinds, faults);
            }
            continue;
        }
        let loaded = prototype::load(source, &folders(&instance.home), name, kinds, faults);
        if let Some(loaded) = &loaded {
            refuse_double_uuid(loaded, &prototypes, faults);
        }
        prototypes.insert(key(instance), loaded);
    }
    prototypes
}

fn folders(home: &str) -> Vec<String> {
    let mut folders = vec![join(home, "prototypes"), join(home, "../catalogue"), "models/catalogue".to_owned()];
    folders.dedup();
    folders
}

fn refuse_double_uuid(prototype: &Prototype, others: &Prototypes, faults: &mut Faults) {
    let uuid = &prototype.meta.uuid;
    let same = |other: &&Prototype| other.meta.uuid.value == uuid.value && other.meta.uuid.place != uuid.place;
    if let Some(other) = others.values().flatten().find(same) {
        let found = format!("the uuid of {} is {}'s as well", prototype.meta.name.value, other.meta.name.value);
        let fault = uuid.fault(found, "expected a uuid of its own").beside(&other.meta.uuid.place, "the other");
        faults.push(fault.help("`uuidgen` prints a new one"));
    }
}

fn look_up(reference: &Located<String>, names: &[&str], faults: &mut Faults) {
    if !names.contains(&reference.value.as_str()) {
        let found = format!("there is no instance {:?}", reference.value);
        let fault = reference.fault(found, format!("expected {}", one_of(names)));
        faults.push(fault.did_you_mean(nearest(&reference.value, names.iter().copied())));
    }
}

fn initial_part(part: &PartDeclaration, names: &[&str], faults: &mut Faults) -> InitialPart {
    if let Some(at) = &part.at {
        look_up(at, names, faults);
    }
    InitialPart { kind: part.kind, size: part.size, pose: part.pose, on: part.at.as_ref().map(|at| at.value.clone()) }
}

/// The map of all signals, which come with the place that declares each.
fn signal_map(plant: &Located<String>, signals: Vec<Located<Signal>>, faults: &mut Faults) -> Option<SignalMap> {
    let mut first_by_name = BTreeMap::new();
    for signal in &signals {
        if let Some(first) = first_by_name.insert(signal.value.name.clone(), signal.place.clone()) {
            let found = format!("two signals are called {:?}", signal.value.name);
            faults.push(signal.fault(found, "expected each name once").beside(&first, "the first"));
        }
    }
    let signals = signals.into_iter().map(|signal| signal.value).collect();
    SignalMap::new(plant.value.clone(), signals).ok()
}

fn adapter(declared: AdapterDeclaration) -> AdapterSettings {
    AdapterSettings {
        host: declared.host.unwrap_or_else(|| EMBEDDED_HOST.to_owned()),
        port: declared.port.unwrap_or(DEFAULT_PORT),
        timeout: declared.timeout.unwrap_or(DEFAULT_TIMEOUT),
        signals_map: declared.signals_map,
        high_frequency: declared.hf.unwrap_or(DEFAULT_HF),
        low_frequency: declared.lf.unwrap_or(DEFAULT_LF),
    }
}
