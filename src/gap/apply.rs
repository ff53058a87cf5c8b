//! Effects written into a copy of a model: the same engine then runs with them, live and in replay.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use crate::device;
use crate::effect::{self, EffectError};
use crate::plant::effects_file::{Addition, EffectsFile};
use crate::plant::{Instance, ModelError, Plant, insert, load, locate};
use crate::prototype::source::{Layered, Memory, Source, SourceError, folder, join};
use crate::xml::{Faults, nearest, one_of};

/// A model with effects, not yet written.
#[derive(Clone, Debug)]
pub struct Applied {
    /// The path of its plant's file.
    pub path: String,
    /// Its files' texts, by their paths: the plant's, and prototypes that would not be found from there.
    pub files: BTreeMap<String, String>,
    pub plant: Plant,
    /// What may not be meant, one line each.
    pub remarks: Vec<String>,
}

/// Puts the effects of `file` into a copy of `model`, to be written at `output`: a plant's file where it ends with `.xml`,
/// else a folder that will hold a `plant.xml`. The plant's file keeps its comments and its layout; the path of its base is
/// set anew as seen from there. Relative paths are seen from the folder `here`, whose path is absolute.
///
/// # Errors
/// The model cannot be loaded; an effect is of an instance that the model does not have, does not fit its device, or is
/// there already. Each is told with its line in the file of effects.
pub fn apply(
    source: &dyn Source,
    model: &str,
    file: &EffectsFile,
    output: &str,
    here: &str,
) -> Result<Applied, ModelError> {
    let watched = Watched { source, read: RefCell::default() };
    let (own, text) = locate(&watched, model)?;
    let plant = load(&watched, model, device::KINDS)?;
    refuse_misfits(&plant, &file.effects)?;
    let path = if output.ends_with(".xml") { join("", output) } else { join(output, "plant.xml") };
    let (home, new_home) = (folder(&own), folder(&path));
    let base = base_of(&own, &text)?.map(|base| relative(&join(here, new_home), &join(here, &join(home, &base))));
    let edited = insert(&own, &text, &file.effects, base.as_deref())?;
    let mut files = moved_prototypes(home, new_home, &watched.read.borrow());
    files.insert(path.clone(), edited.text);
    let plant_of = file.plant.as_ref().map(|plant| plant.value.as_str());
    let other = plant_of.filter(|name| *name != plant.name);
    let remarks = other.map(|name| format!("the effects are of the plant {name:?}, this one is {:?}", plant.name));
    let plant = load(&Layered(Memory(files.clone()), source), &path, device::KINDS)?;
    Ok(Applied { path, files, plant, remarks: remarks.into_iter().collect() })
}

/// Everything about the effects that does not fit the plant.
fn refuse_misfits(plant: &Plant, additions: &[Addition]) -> Result<(), Faults> {
    let mut faults = Faults::default();
    let names: Vec<&str> = plant.instances.iter().map(|instance| instance.name.as_str()).collect();
    for (at, addition) in additions.iter().enumerate() {
        let name = &addition.instance;
        let Some(instance) = plant.instances.iter().find(|instance| instance.name == name.value) else {
            let found = format!("the plant {} has no instance {:?}", plant.name, name.value);
            let fault = name.fault(found, format!("expected {}", one_of(&names)));
            faults.push(fault.did_you_mean(nearest(&name.value, names.iter().copied())));
            continue;
        };
        let earlier = additions[..at].iter().filter(|known| known.instance.value == name.value);
        let known = instance.effects.iter().chain(earlier.map(|known| &known.effect));
        let is_same = |known: &crate::plant::EffectSpec| {
            let place = |spec: &crate::plant::EffectSpec| (spec.kind.clone(), spec.place, spec.component.clone());
            place(known) == place(&addition.effect)
        };
        if known.into_iter().any(is_same) {
            let found = format!("{} has the effect {} there already", name.value, addition.effect.kind);
            faults.push(addition.place.fault(found, "expected each effect once: take the model that was diagnosed"));
        } else if let Err(error) = fits(instance, addition) {
            faults.push(addition.place.fault(error.to_string(), "expected an effect that this device can have"));
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}

/// Whether one of the instance's devices can be built with the effect, those it has already included.
fn fits(instance: &Instance, addition: &Addition) -> Result<(), EffectError> {
    effect::resolve(&addition.effect)?;
    let tasks: Vec<&str> = instance.tasks.iter().map(|task| task.name.as_str()).collect();
    let mut effects = instance.effects.clone();
    effects.push(addition.effect.clone());
    for task in &instance.tasks {
        let effects = effect::of_task(&effects, &task.name, &tasks);
        // What is random about a device has no say in whether it can be built.
        effect::build(task.kind, &task.parameters, &instance.name, &effects, 0)?;
    }
    Ok(())
}

/// The base that a plant's file names, as it names it.
fn base_of(path: &str, text: &str) -> Result<Option<String>, Faults> {
    let root = crate::xml::parse(path, text)?;
    Ok(root.attribute("base").map(|base| base.value.clone()))
}

/// The way from `folder` to `path`, both absolute, through the folders that both lie in.
fn relative(folder: &str, path: &str) -> String {
    let parts = |path: &str| path.split('/').filter(|part| !part.is_empty()).map(str::to_owned).collect::<Vec<_>>();
    let (from, to) = (parts(folder), parts(path));
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let up = std::iter::repeat_n("..".to_owned(), from.len() - shared);
    up.chain(to[shared..].iter().cloned()).collect::<Vec<_>>().join("/")
}

/// Files of prototypes that were found beside the plant's file or its folder, and would not be found from the new folder:
/// their texts by their paths there.
fn moved_prototypes(home: &str, new_home: &str, read: &BTreeMap<String, String>) -> BTreeMap<String, String> {
    let beside: BTreeSet<String> = [join(home, "prototypes"), join(home, "../catalogue")].into();
    let reached = [join(new_home, "prototypes"), join(new_home, "../catalogue"), "models/catalogue".to_owned()];
    let moved = read.iter().filter_map(|(path, text)| {
        let from = beside.iter().find(|folder| path.starts_with(&format!("{folder}/")))?;
        let rest = &path[from.len() + 1..];
        (!reached.contains(from)).then(|| (join(&reached[0], rest), text.clone()))
    });
    moved.collect()
}

/// A source that remembers what was read from it.
struct Watched<'a> {
    source: &'a dyn Source,
    read: RefCell<BTreeMap<String, String>>,
}

impl Source for Watched<'_> {
    fn read(&self, path: &str) -> Result<String, SourceError> {
        let text = self.source.read(path)?;
        self.read.borrow_mut().insert(path.to_owned(), text.clone());
        Ok(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::effects_file::read;
    use crate::plant::embedded::Embedded;

    fn effects(text: &str) -> EffectsFile {
        read("effects.xml", &format!("<effects>\n{text}\n</effects>")).expect("a file of effects")
    }

    fn refused(text: &str, words: &str) {
        let error = apply(&Embedded, "models/rig", &effects(text), "out", "/h").expect_err(text).to_string();
        assert!(error.starts_with("effects.xml:") && error.contains(words), "{error}");
    }

    const BACKLASH: &str = r#"<instance name="Axis"><effect kind="backlash" place="transmission">
        <parameter name="gap" value="2 mm"/></effect></instance>"#;

    #[test]
    fn the_copy_has_the_effect_and_all_else_as_it_was() {
        let applied = apply(&Embedded, "models/rig", &effects(BACKLASH), "./out", "/h").expect("a model");
        assert_eq!((applied.path.as_str(), applied.files.len()), ("out/plant.xml", 1));
        let axis = |plant: &Plant| plant.instances.iter().find(|instance| instance.name == "Axis").cloned();
        assert_eq!(axis(&applied.plant).expect("the axis").effects[0].kind, "backlash");
        let was = Embedded.read("models/rig/plant.xml").expect("the rig");
        let is = &applied.files["out/plant.xml"];
        let lost: Vec<&str> = was.lines().filter(|line| !is.lines().any(|kept| kept == *line)).collect();
        assert!(lost.is_empty(), "{lost:?}");
        assert_eq!(is.lines().count(), was.lines().count() + 2);
    }

    #[test]
    fn a_plant_with_a_base_still_finds_it() {
        let check = |output: &str, path: &str, base: &str| {
            let applied = apply(&Embedded, "models/rig-toleranced", &effects(BACKLASH), output, "/h").expect("a model");
            assert_eq!(applied.path, path);
            let text = &applied.files[path];
            assert!(text.contains(&format!("base=\"{base}\"")) && text.contains("1 %"), "{text}");
            assert!(applied.plant.instances.iter().any(|instance| !instance.effects.is_empty()));
        };
        check("models/mine", "models/mine/plant.xml", "../rig/plant.xml");
        check("a/b/mine.xml", "a/b/mine.xml", "../../models/rig/plant.xml");
    }

    #[test]
    fn prototypes_beside_the_plant_come_along() {
        let prototype =
            |part: &str| Embedded.read(&format!("models/catalogue/EncoderMotor/{part}.xml")).expect("a file");
        let plant = r#"<plant name="mine"><instance name="M" prototype="Motor2"/></plant>"#;
        let mut files = BTreeMap::from([("x/mine/plant.xml".to_owned(), plant.to_owned())]);
        for part in ["prototype", "avatar"] {
            let text = prototype(part).replace("name=\"EncoderMotor\"", "name=\"Motor2\"");
            files.insert(format!("x/catalogue/Motor2/{part}.xml"), text);
        }
        let memory = Memory(files);
        load(&memory, "x/mine", device::KINDS).expect("the plant as it was");
        let lag = r#"<instance name="M"><effect kind="gain-error" place="actuator"><parameter name="gain" value="0.9"/></effect></instance>"#;
        let applied = apply(&memory, "x/mine", &effects(lag), "y/new", "/h").expect("a model");
        let paths: Vec<&String> = applied.files.keys().collect();
        assert_eq!(
            paths,
            ["y/new/plant.xml", "y/new/prototypes/Motor2/avatar.xml", "y/new/prototypes/Motor2/prototype.xml"]
        );
        assert_eq!(apply(&memory, "x/mine", &effects(lag), "x/new", "/h").expect("a model").files.len(), 1);
    }

    #[test]
    fn what_does_not_fit_is_told_with_its_line() {
        let effect =
            |device: &str, rest: &str| format!("<instance name=\"{device}\">\n<effect {rest}</effect></instance>");
        refused(&effect("Axes", "kind=\"drift\" place=\"sensor\">"), "did you mean \"Axis\"?");
        refused(
            &effect("Axis", "kind=\"backlach\" place=\"transmission\">"),
            "effects.xml:3:1: there is no effect \"backlach\"; did you mean \"backlash\"?",
        );
        refused(&effect("Axis", "kind=\"backlash\" place=\"sensor\">"), "it may stand at transmission");
        refused(&effect("Axis", "kind=\"backlash\" place=\"transmission\">"), "needs its parameter gap");
        let gap = |value: &str| {
            format!("kind=\"backlash\" place=\"transmission\"><parameter name=\"gap\" value=\"{value}\"/>")
        };
        refused(&effect("Axis", &gap("-1")), "expected a number from 0");
        refused(&effect("Gripper", &gap("0.001")), "it is not for a SuctionCapGripper");
        refused(&format!("{BACKLASH}{BACKLASH}"), "there already");
    }

    #[test]
    fn ways_from_folder_to_folder() {
        let check = |folder: &str, path: &str, way: &str| assert_eq!(relative(folder, path), way, "{folder}, {path}");
        check("/models/mine", "/models/rig/plant.xml", "../rig/plant.xml");
        check("/", "/models/rig/plant.xml", "models/rig/plant.xml");
        check("/a/b", "/c/plant.xml", "../../c/plant.xml");
        check("/a/b", "/a/b/plant.xml", "plant.xml");
    }
}
