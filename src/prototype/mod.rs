//! Prototypes: the XML of `prototype.xml` and `avatar.xml` becomes a typed description of a device, checked against the
//! table of device kinds; errors name file, line and column.
//!
//! A prototype stands in a folder of its name. `prototype.xml` (see [`meta`]) says what it is and what can be set about its
//! shape; `avatar.xml` (see [`avatar`]) which signals it exchanges and which devices bring it to life. A prototype that
//! exchanges nothing needs no avatar: its law stands as `<logics>` in `prototype.xml`.

pub mod avatar;
pub mod basic;
pub mod builder;
mod check;
pub mod kind;
pub mod meta;
pub mod packed;
pub mod quantity;
pub mod setting;
pub mod source;
pub mod structure;
mod substitute;
pub mod words;

use self::avatar::{Avatar, Property, SignalDeclaration};
use self::builder::Script;
use self::kind::KindDescriptor;
use self::meta::{MetaDescriptor, Parameter};
use self::setting::Setting;
use self::source::{Source, SourceError, join};
use crate::xml::{Element, Faults, Located, nearest, parse};

pub use self::substitute::substitute;

/// A prototype, checked: what it names is there, and of the type that it has to be.
#[derive(Clone, Debug)]
pub struct Prototype {
    pub meta: MetaDescriptor,
    /// In the order of the avatar's file.
    pub signals: Vec<Signal>,
    /// What can be set about an instance, beside the parameters of `meta`.
    pub properties: Vec<Property>,
    pub tasks: Vec<Task>,
    /// The folder that its files are in.
    pub folder: String,
    /// The root of `structure.xml`, where there is one; its references are replaced for each instance.
    pub structure: Option<Element>,
    /// The script that builds its shape, which its meta-descriptor names as generator.
    pub builder: Option<Script>,
    /// The script that gives values to parameters which an instance leaves alone: `customizer.js`, where there is one.
    pub customizer: Option<Script>,
}

/// A signal and where it leads.
#[derive(Clone, Debug)]
pub struct Signal {
    pub declaration: SignalDeclaration,
    /// The ports it is bound to: the task's place in the prototype, the port's in its kind.
    pub bindings: Vec<(usize, usize)>,
}

/// A task of the prototype.
#[derive(Clone, Debug)]
pub struct Task {
    pub name: Located<String>,
    pub kind: &'static KindDescriptor,
    /// The kind's parameters that the prototype sets, by their place in the kind; the others keep the kind's default.
    pub assignments: Vec<(usize, Assignment)>,
}

/// Where a task's parameter has its value from.
#[derive(Clone, Debug)]
pub enum Assignment {
    /// From the task itself.
    Own(Setting),
    /// From the prototype's property at this place.
    Property(usize),
}

impl Prototype {
    /// What can be set about an instance: the meta-descriptor's parameters and the avatar's properties, each name once.
    pub fn settings(&self) -> impl Iterator<Item = &Setting> {
        let parameters = self.meta.parameters.iter().map(|parameter: &Parameter| &parameter.setting);
        let own = |setting: &&Setting| !self.meta.parameters.iter().any(|p| p.setting.name.value == setting.name.value);
        parameters.chain(self.properties.iter().map(|property| &property.setting).filter(own))
    }
}

/// Loads the prototype called `name` from the first of `folders` that has one, and checks it against `kinds`.
///
/// What is wrong is added to `faults`; a prototype that is there and wrong gives `None` like one that is nowhere.
pub fn load(
    source: &dyn Source,
    folders: &[String],
    name: &Located<String>,
    kinds: &[&'static KindDescriptor],
    faults: &mut Faults,
) -> Option<Prototype> {
    for folder in folders {
        let folder = join(folder, &name.value);
        match source.read(&join(&folder, "prototype.xml")) {
            Ok(text) => return read_folder(source, &folder, &text, name, kinds, faults),
            Err(SourceError::NotFound { .. }) => {}
            Err(error) => {
                faults.push(name.fault(error.to_string(), "expected a prototype that can be read"));
                return None;
            }
        }
    }
    let places: Vec<String> = folders.iter().map(|folder| format!("{folder}/{}", name.value)).collect();
    let found = format!("there is no prototype {:?}", name.value);
    let fault = name.fault(found, format!("expected a prototype.xml in {}", crate::xml::one_of(places)));
    let shipped = kinds.iter().filter_map(|kind| kind.name.rsplit('.').next());
    faults.push(fault.did_you_mean(nearest(&name.value, shipped)));
    None
}

fn read_folder(
    source: &dyn Source,
    folder: &str,
    meta_text: &str,
    name: &Located<String>,
    kinds: &[&'static KindDescriptor],
    faults: &mut Faults,
) -> Option<Prototype> {
    let mut own = Faults::default();
    let meta = read_xml(&join(folder, "prototype.xml"), meta_text, &mut own, meta::read);
    let avatar_path = join(folder, "avatar.xml");
    let avatar = match source.read(&avatar_path) {
        Ok(text) => read_xml(&avatar_path, &text, &mut own, avatar::read),
        Err(SourceError::NotFound { .. }) => None,
        Err(error) => {
            own.push(name.fault(error.to_string(), "expected an avatar that can be read"));
            None
        }
    };
    if let Some(meta) = &meta
        && meta.name.value != name.value
    {
        let found = format!("the prototype is called {:?}", meta.name.value);
        let fault = meta.name.fault(found, format!("expected {:?}, the name of its folder", name.value));
        own.push(fault.beside(&name.place, "asked for"));
    }
    let structure_path = join(folder, "structure.xml");
    let structure = match source.read(&structure_path) {
        Ok(text) => read_xml(&structure_path, &text, &mut own, |root, _| Some(root.clone())),
        Err(SourceError::NotFound { .. }) => None,
        Err(error) => {
            own.push(name.fault(error.to_string(), "expected a structure that can be read"));
            None
        }
    };
    let prototype = meta.and_then(|meta| combine(meta, avatar, kinds, &mut own));
    let prototype = prototype.map(|prototype| {
        let script = |file: &str| {
            let path = join(folder, file);
            source.read(&path).map(|text| Script { path, text })
        };
        let customizer = script("customizer.js").ok();
        let builder = prototype.meta.generator.as_ref().and_then(|file| match script(&file.value) {
            Ok(script) => Some(script),
            Err(error) => {
                own.push(file.fault(error.to_string(), "expected a script in the prototype's folder"));
                None
            }
        });
        Prototype { folder: folder.to_owned(), structure, builder, customizer, ..prototype }
    });
    let sound = own.is_empty();
    faults.append(own);
    prototype.filter(|_| sound)
}

fn read_xml<T>(path: &str, text: &str, faults: &mut Faults, read: fn(&Element, &mut Faults) -> Option<T>) -> Option<T> {
    match parse(path, text) {
        Ok(root) => read(&root, faults),
        Err(malformed) => {
            faults.append(malformed);
            None
        }
    }
}

/// Joins the two files of a prototype.
fn combine(
    meta: MetaDescriptor,
    avatar: Option<Avatar>,
    kinds: &[&'static KindDescriptor],
    faults: &mut Faults,
) -> Option<Prototype> {
    if let Some(avatar) = &avatar {
        same_identity(&meta, avatar, faults);
    }
    let (signals, properties, tasks) = match avatar {
        Some(avatar) => (avatar.signals, avatar.properties, avatar.tasks),
        None => (Vec::new(), Vec::new(), Vec::new()),
    };
    check::settings(&meta, &properties, &tasks, faults);
    let tasks = check::tasks(&meta, &properties, tasks, kinds, faults)?;
    check::properties_are_used(&signals, &properties, faults);
    let signals = signals
        .into_iter()
        .map(|declaration| {
            check::condition(&declaration, &meta, &properties, &tasks, faults);
            Signal { bindings: check::bindings(&declaration, &tasks, faults), declaration }
        })
        .collect();
    Some(Prototype {
        meta,
        signals,
        properties,
        tasks,
        folder: String::new(),
        structure: None,
        builder: None,
        customizer: None,
    })
}

fn same_identity(meta: &MetaDescriptor, avatar: &Avatar, faults: &mut Faults) {
    if meta.name.value != avatar.name.value {
        let found = format!("the avatar is called {:?}", avatar.name.value);
        let fault = avatar.name.fault(found, format!("expected {:?}, its prototype's name", meta.name.value));
        faults.push(fault.beside(&meta.name.place, "the prototype's name"));
    }
    if meta.uuid.value != avatar.uuid.value {
        let found = format!("the avatar has the uuid {}", avatar.uuid.value);
        let fault = avatar.uuid.fault(found, format!("expected {}, its prototype's", meta.uuid.value));
        faults.push(fault.beside(&meta.uuid.place, "the prototype's uuid"));
    }
}

/// Faults for names that stand twice; `what` is their plural.
pub(crate) fn refuse_doubles<'a>(names: impl Iterator<Item = &'a Located<String>>, what: &str, faults: &mut Faults) {
    let mut seen: Vec<&Located<String>> = Vec::new();
    for name in names {
        match seen.iter().find(|known| known.value == name.value) {
            Some(first) => {
                let found = format!("two {what} are called {:?}", name.value);
                faults.push(name.fault(found, "expected each name once").beside(&first.place, "the first"));
            }
            None => seen.push(name),
        }
    }
}
