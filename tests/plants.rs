//! What a plant's file and its prototypes mean, rule by rule, on files held in memory.

use kinetwin::device::KINDS;
use kinetwin::plant::embedded::Embedded;
use kinetwin::plant::{EffectPlace, ModelError, Parameter, ParameterValue, PartKind, Plant, load};
use kinetwin::prototype::source::{Layered, Memory, Source};
use kinetwin::signal_map::{Kind, RateClass, SignalMap};
use proptest::prelude::*;

const UUID: &str = "5f0d1f0e-65a1-4b0e-9d60-3a2f6b6f0a01";

/// A prototype called Gate, by the insides of its two files.
struct Gate {
    meta: &'static str,
    avatar: &'static str,
}

/// Files of a model in the folder `mine`, with the catalogue behind them.
fn files(plant: &str, gate: Option<Gate>, others: &[(&str, &str)]) -> Layered<Memory, Embedded> {
    let mut files = Memory::default();
    files.0.insert("mine/plant.xml".to_owned(), plant.to_owned());
    if let Some(Gate { meta, avatar }) = gate {
        let head = "<property name=\"displayName\" value=\"Gate\" type=\"string\"/>\
                    <property name=\"vendor\" value=\"test\" type=\"string\"/>";
        let meta = format!("<prototype uuid=\"{UUID}\" name=\"Gate\" version=\"1\">{head}{meta}</prototype>");
        let avatar = format!("<prototype uuid=\"{UUID}\" name=\"Gate\">{avatar}</prototype>");
        files.0.insert("mine/prototypes/Gate/prototype.xml".to_owned(), meta);
        files.0.insert("mine/prototypes/Gate/avatar.xml".to_owned(), avatar);
    }
    for (path, text) in others {
        files.0.insert((*path).to_owned(), (*text).to_owned());
    }
    Layered(files, Embedded)
}

#[track_caller]
fn plant(source: &Layered<Memory, Embedded>, model: &str) -> Plant {
    load(source, model, KINDS).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn parameter<'a>(plant: &'a Plant, instance: &str, name: &str) -> &'a Parameter {
    let found = plant.instances.iter().find(|found| found.name == instance).expect(instance);
    found.tasks.iter().find_map(|task| task.parameters.0.get(name)).expect(name)
}

#[track_caller]
fn number(plant: &Plant, instance: &str, name: &str) -> f64 {
    match parameter(plant, instance, name).value {
        ParameterValue::Number(number) => number,
        ref other => panic!("{name} is {other:?}"),
    }
}

fn signals(map: &SignalMap) -> Vec<&str> {
    map.signals().iter().map(|signal| signal.name.as_str()).collect()
}

#[test]
fn a_value_is_the_instances_else_the_prototypes_else_the_kinds() {
    let gate = Gate {
        meta: "",
        avatar: "<property name=\"travel\" type=\"double\" defaultValue=\"300\" unit=\"mm\">\
                   <map task=\"Plate\" property=\"stroke\"/></property>\
                 <task name=\"Plate\" type=\"kinetwin.Pusher\">\
                   <property name=\"extendSpeed\" type=\"double\" defaultValue=\"200 mm/s\"/></task>",
    };
    let text = "<plant name=\"p\"><instance name=\"A\" prototype=\"Gate\"/>\
                <instance name=\"B\" prototype=\"Gate\"><property name=\"travel\" value=\"700\"/></instance>\
                <instance name=\"C\" prototype=\"Gate\"><property name=\"travel\" value=\"0.2 m\"/></instance></plant>";
    let plant = plant(&files(text, Some(gate), &[]), "mine");
    let check = |instance: &str, name: &str, expect: f64| assert_eq!(number(&plant, instance, name), expect, "{name}");
    check("A", "stroke", 0.3);
    check("B", "stroke", 0.7);
    check("C", "stroke", 0.2);
    check("A", "extendSpeed", 0.2);
    check("A", "retractSpeed", 0.5);
}

#[test]
fn a_parameter_reaches_the_law_through_its_reference_with_unit_and_tolerance() {
    let gate = Gate {
        meta: "<parameter name=\"travel\" type=\"double\" value=\"300\" unit=\"mm\"/>\
               <parameter name=\"depth\" type=\"double\" value=\"20\" unit=\"mm\"/>",
        avatar: "<property name=\"travel\" type=\"double\" defaultValue=\"${travel}\">\
                   <map task=\"Plate\" property=\"stroke\"/></property>\
                 <task name=\"Plate\" type=\"kinetwin.Pusher\">\
                   <property name=\"plateSize\" type=\"double[]\" defaultValue=\"${depth};0.5 m;200 mm\"/></task>",
    };
    let text = "<plant name=\"p\"><instance name=\"A\" prototype=\"Gate\">\
                <property name=\"travel\" value=\"700\" tolerance=\"0.2\"/></instance></plant>";
    let plant = plant(&files(text, Some(gate), &[]), "mine");
    assert_eq!(number(&plant, "A", "stroke"), 0.7);
    assert_eq!(parameter(&plant, "A", "stroke").tolerance, 0.2);
    assert_eq!(parameter(&plant, "A", "plateSize").value, ParameterValue::Numbers(vec![0.02, 0.5, 0.2]));
}

#[test]
fn logics_are_a_law_without_signals() {
    let plant = plant(&Layered(Memory::default(), Embedded), "rig");
    let feed = plant.instances.iter().find(|instance| instance.name == "Feed").expect("Feed");
    assert_eq!((feed.tasks.len(), feed.tasks[0].kind.name), (1, "kinetwin.LoadingBay"));
    assert!(plant.signal_map.signals().iter().all(|signal| signal.instance != "Feed"));
}

#[test]
fn a_tolerance_is_the_instances_else_the_plants_else_the_prototypes_else_one_per_cent() {
    let check = |plant_says: &str, instance_says: &str, expect: [f64; 2]| {
        let gate = Gate {
            meta: "",
            avatar: "<property name=\"travel\" type=\"double\" defaultValue=\"0.3\" tolerance=\"5 %\">\
                       <map task=\"Plate\" property=\"stroke\"/></property>\
                     <task name=\"Plate\" type=\"kinetwin.Pusher\"/>",
        };
        let text = format!(
            "<plant name=\"p\" {plant_says}><instance name=\"A\" prototype=\"Gate\">\
             <property name=\"travel\" value=\"0.4\" {instance_says}/></instance></plant>"
        );
        let plant = plant(&files(&text, Some(gate), &[]), "mine");
        let found = ["stroke", "extendSpeed"].map(|name| parameter(&plant, "A", name).tolerance);
        assert_eq!(found, expect, "{plant_says} {instance_says}");
    };
    check("", "", [0.05, 0.01]);
    check("tolerance=\"0\"", "", [0.0, 0.0]);
    check("tolerance=\"0\"", "tolerance=\"0.5\"", [0.5, 0.0]);
}

#[test]
fn a_signal_takes_from_its_port_what_it_does_not_say() {
    let gate = Gate {
        meta: "",
        avatar: "<input name=\"a\" type=\"SINT\"><map task=\"Plate\" property=\"command\"/></input>\
                 <output name=\"b\" type=\"BOOL\" rate=\"lf\" kind=\"level\">\
                   <map task=\"Plate\" property=\"isRunning\"/></output>\
                 <input name=\"c\" type=\"DINT\" min=\"1\" max=\"2\"><map task=\"Other\" property=\"command\"/></input>\
                 <output name=\"d\" type=\"LREAL[4]\" unit=\"mm\"/>\
                 <task name=\"Plate\" type=\"kinetwin.Pusher\"/><task name=\"Other\" type=\"kinetwin.Pusher\"/>",
    };
    let source = files("<plant name=\"p\"><instance name=\"L1.G\" prototype=\"Gate\"/></plant>", Some(gate), &[]);
    let plant = plant(&source, "mine");
    assert_eq!(signals(&plant.signal_map), ["L1.G.a", "L1.G.b", "L1.G.c", "L1.G.d"]);
    let [a, b, c, d] = plant.signal_map.signals() else { panic!("four signals") };
    assert_eq!((a.kind, a.rate, a.unit.symbol), (Kind::Edge, RateClass::HighFrequency, "1"));
    assert_eq!((a.min, a.max), (Some(0.0), Some(2.0)));
    assert_eq!((b.kind, b.rate, b.min), (Kind::Level, RateClass::LowFrequency, None));
    assert_eq!((c.min, c.max), (Some(1.0), Some(2.0)));
    // Nothing takes or gives it: the automation has it all the same.
    assert_eq!((d.kind, d.unit.symbol, d.task.as_str()), (Kind::Level, "mm", ""));
    assert_eq!(plant.remarks(), ["L1.G.d leads nowhere: it has no <map> in its avatar"]);
    let ports = |task: usize| plant.instances[0].tasks[task].ports.iter().flatten().map(|id| id.0).collect::<Vec<_>>();
    assert_eq!((ports(0), ports(1)), (vec![0, 1], vec![2]));
}

#[test]
fn a_range_is_told_in_the_signals_unit() {
    let gate = Gate {
        meta: "",
        avatar: "<input name=\"x\" type=\"REAL\" unit=\"mm\" min=\"-500\" max=\"1500\">\
                   <map task=\"R\" property=\"XTarget\"/></input><task name=\"R\" type=\"kinetwin.CartesianRobot\"/>",
    };
    let plant =
        plant(&files("<plant name=\"p\"><instance name=\"G\" prototype=\"Gate\"/></plant>", Some(gate), &[]), "mine");
    let x = &plant.signal_map.signals()[0];
    assert_eq!((x.unit.symbol, x.min, x.max), ("mm", Some(-500.0), Some(1500.0)));
}

#[test]
fn an_input_may_go_to_several_tasks() {
    let gate = Gate {
        meta: "",
        avatar: "<input name=\"a\" type=\"DINT\"><map task=\"P\" property=\"command\"/>\
                 <map task=\"Q\" property=\"command\"/></input>\
                 <task name=\"P\" type=\"kinetwin.Pusher\"/><task name=\"Q\" type=\"kinetwin.Pusher\"/>",
    };
    let plant =
        plant(&files("<plant name=\"p\"><instance name=\"G\" prototype=\"Gate\"/></plant>", Some(gate), &[]), "mine");
    let bound = plant.instances[0].tasks.iter().map(|task| task.ports[0].map(|id| id.0));
    assert_eq!(bound.collect::<Vec<_>>(), [Some(0), Some(0)]);
}

#[test]
fn a_condition_decides_which_signals_an_instance_has() {
    let axis = |properties: &str| {
        let text =
            format!("<plant name=\"p\"><instance name=\"A\" prototype=\"ServoAxis\">{properties}</instance></plant>");
        let plant = plant(&files(&text, None, &[]), "mine");
        let inputs = plant.signal_map.signals().iter().take_while(|signal| signal.property != "position");
        inputs.map(|signal| signal.property.clone()).collect::<Vec<_>>()
    };
    assert_eq!(axis(""), ["positionTarget"]);
    assert_eq!(axis("<property name=\"mode\" value=\"force\"/>"), ["forceTarget"]);
    let both = "<property name=\"mode\" value=\"velocity\"/><property name=\"torqueInput\" value=\"1\"/>";
    assert_eq!(axis(both), ["velocityTarget", "torqueEnabled"]);
}

#[test]
fn poses_parts_effects_and_the_adapter_are_read() {
    let text = "<plant name=\"p\"><adapter host=\"plc.local\" port=\"4000\" timeout=\"2s\" hf=\"10ms\"/>\
                <instance name=\"A\" prototype=\"StraightConveyor\"><pose x=\"500 mm\" rz=\"90deg\"/>\
                <effect kind=\"belt-slip\" place=\"transmission\" component=\"belt\">\
                <parameter name=\"ratio\" value=\"6 %\"/><parameter name=\"with\" value=\"load\"/></effect></instance>\
                <part kind=\"pallet\" at=\"A\" x=\"0.5\" size=\"1200;800;144 mm\"/></plant>";
    let plant = plant(&files(text, None, &[]), "mine");
    assert_eq!((plant.adapter.host.as_str(), plant.adapter.port), ("plc.local", 4000));
    assert_eq!(plant.adapter.timeout.as_millis(), 2000);
    assert_eq!((plant.adapter.high_frequency.as_millis(), plant.adapter.low_frequency.as_millis()), (10, 500));
    let belt = &plant.instances[0];
    assert_eq!((belt.pose.x, belt.pose.y, belt.pose.rz), (0.5, 0.0, std::f64::consts::FRAC_PI_2));
    let [slip] = belt.effects.as_slice() else { panic!("one effect") };
    assert_eq!(
        (slip.place, slip.kind.as_str(), slip.component.as_deref()),
        (EffectPlace::Transmission, "belt-slip", Some("belt"))
    );
    assert_eq!(slip.parameters["ratio"], ParameterValue::Number(0.06));
    assert_eq!(slip.parameters["with"], ParameterValue::Text("load".to_owned()));
    let [part] = plant.parts.as_slice() else { panic!("one part") };
    assert_eq!((part.kind, part.size, part.on.as_deref()), (PartKind::Pallet, [1.2, 0.8, 0.144], Some("A")));
}

const BASE: &str = "<plant name=\"base\" tolerance=\"0\"><adapter port=\"4000\" hf=\"10ms\" signals-map=\"m.xml\"/>\
                    <instance name=\"A\" prototype=\"StraightConveyor\"><pose x=\"1\"/>\
                    <property name=\"length\" value=\"3\"/><property name=\"width\" value=\"0.8\"/></instance></plant>";

#[test]
fn a_plant_laid_over_a_base_changes_what_it_says_and_keeps_the_rest() {
    let text = "<plant name=\"over\" base=\"../base/plant.xml\"><adapter hf=\"5ms\"/>\
                <instance name=\"A\"><property name=\"length\" value=\"4\"/>\
                <effect kind=\"belt-slip\" place=\"transmission\"/></instance>\
                <instance name=\"B\" prototype=\"Pusher\"/></plant>";
    let plant = plant(&files(text, None, &[("base/plant.xml", BASE)]), "mine");
    assert_eq!((plant.name.as_str(), plant.signal_map.plant()), ("over", "over"));
    assert_eq!((plant.adapter.port, plant.adapter.high_frequency.as_millis()), (4000, 5));
    assert_eq!(plant.adapter.signals_map, None, "a signals map is of one plant");
    assert_eq!((number(&plant, "A", "length"), number(&plant, "A", "width")), (4.0, 0.8));
    assert_eq!((plant.instances[0].pose.x, plant.instances[0].effects.len()), (1.0, 1));
    assert_eq!(parameter(&plant, "B", "stroke").tolerance, 0.0);
    assert_eq!(plant.instances.iter().map(|instance| instance.name.as_str()).collect::<Vec<_>>(), ["A", "B"]);
}

#[track_caller]
fn refused(text: &str, expect: &str) {
    let source = files(text, None, &[("base/plant.xml", BASE)]);
    let error = load(&source, "mine", KINDS).err().unwrap_or_else(|| panic!("{text} is a plant")).to_string();
    assert!(error.contains(expect), "{text}: {error}");
}

#[test]
fn what_does_not_fit_a_base_is_refused() {
    let over = |inside: &str| format!("<plant name=\"over\" base=\"../base/plant.xml\">{inside}</plant>");
    refused(&over("<instance name=\"B\"/>"), "the base has no instance \"B\", and this one has no prototype");
    refused(
        &over("<instance name=\"A\" prototype=\"Pusher\"/>"),
        "\"A\" is an instance of StraightConveyor in the base",
    );
    refused("<plant name=\"over\" base=\"plant.xml\"/>", "bases of bases without end");
    refused("<plant name=\"p\"><instance name=\"B\"/></plant>", "<instance> has no attribute \"prototype\"");
}

#[test]
fn a_model_is_a_file_a_folder_or_a_name_below_models() {
    let source = files(BASE, None, &[("mine/other.xml", BASE), ("models/near/plant.xml", BASE)]);
    for model in ["mine", "mine/", "./mine", "mine/plant.xml", "mine/other.xml", "near", "models/near"] {
        assert_eq!(plant(&source, model).name, "base", "{model}");
    }
    let error = load(&source, "far", KINDS).expect_err("no such model");
    assert!(matches!(error, ModelError::NotFound { .. }));
    let expect = "there is no model \"far\": expected a plant's file at far/plant.xml or models/far/plant.xml";
    assert_eq!(error.to_string(), expect);
}

#[test]
fn a_plants_own_prototype_comes_before_the_catalogues() {
    let pusher = |vendor: &str| {
        format!(
            "<prototype uuid=\"{UUID}\" name=\"Pusher\" version=\"2\"><property name=\"displayName\" value=\"P\" \
             type=\"string\"/><property name=\"vendor\" value=\"{vendor}\" type=\"string\"/></prototype>"
        )
    };
    let text = "<plant name=\"p\"><instance name=\"A\" prototype=\"Pusher\"/></plant>";
    let own = pusher("own");
    let plant = plant(&files(text, None, &[("mine/prototypes/Pusher/prototype.xml", own.as_str())]), "mine");
    // It has neither logics nor an avatar: scenery.
    assert!(plant.instances[0].tasks.is_empty() && plant.signal_map.signals().is_empty());
}

#[test]
fn a_prototype_that_nothing_fits_is_refused() {
    let check = |meta: &'static str, avatar: &'static str, expect: &str| {
        let text = "<plant name=\"p\"><instance name=\"G\" prototype=\"Gate\"/></plant>";
        let source = files(text, Some(Gate { meta, avatar }), &[]);
        let error = load(&source, "mine", KINDS).err().unwrap_or_else(|| panic!("{avatar} is read")).to_string();
        assert!(error.contains(expect), "{avatar}: {error}");
    };
    let narrow = "<output name=\"d\" type=\"USINT\"><map task=\"C\" property=\"directionalActual\"/></output>\
                  <task name=\"C\" type=\"kinetwin.StraightConveyor\"/>";
    check("", narrow, "USINT holds 0 to 255: expected a type that holds -1 to 1");
    let unit = "<input name=\"v\" type=\"REAL\" unit=\"rad/s\"><map task=\"C\" property=\"velocityTarget\"/></input>\
                <task name=\"C\" type=\"kinetwin.StraightConveyor\"/>";
    check("", unit, "\"v\" is declared in rad/s: expected m/s, mm/s or m/min");
    let rotary = "<input name=\"t\" type=\"REAL\" unit=\"mm\"><map task=\"A\" property=\"positionTarget\"/></input>\
                  <task name=\"A\" type=\"kinetwin.ServoAxis\">\
                  <property name=\"motion\" type=\"string\" defaultValue=\"rotary\"/></task>";
    check("", rotary, "\"t\" of G is declared in mm: expected rad, mrad or deg");
    let condition = "<input name=\"c\" type=\"INT\" when=\"mod=x\"><map task=\"Plate\" property=\"command\"/></input>\
                     <task name=\"Plate\" type=\"kinetwin.Pusher\"/>";
    check("", condition, "a condition on a property \"mod\", which is not there");
    let never = "<input name=\"t\" type=\"REAL\" when=\"mode=forse\"><map task=\"A\" property=\"forceTarget\"/></input>\
                 <property name=\"mode\" type=\"string\" defaultValue=\"force\"><map task=\"A\" property=\"mode\"/></property>\
                 <task name=\"A\" type=\"kinetwin.ServoAxis\"/>";
    check("", never, "\"mode\" is never \"forse\"");
    let both = "<task name=\"Plate\" type=\"kinetwin.Pusher\"/>";
    check("<logics type=\"kinetwin.LoadingBay\"/>", both, "a law as logics, and tasks: expected either, not both");
    let hidden = "<property name=\"travel\" type=\"double\" defaultValue=\"1\">\
                  <map task=\"Plate\" property=\"stroke\"/></property><task name=\"Plate\" type=\"kinetwin.Pusher\"/>";
    let parameter = "<parameter name=\"travel\" type=\"double\" value=\"1\"/>";
    check(parameter, hidden, "a parameter and a property are called \"travel\": expected \"${travel}\"");
    let twice = "<property name=\"a\" type=\"double\" defaultValue=\"1\"><map task=\"Plate\" property=\"stroke\"/></property>\
                 <task name=\"Plate\" type=\"kinetwin.Pusher\">\
                 <property name=\"stroke\" type=\"double\" defaultValue=\"2\"/></task>";
    check("", twice, "\"stroke\" of the task \"Plate\" is set twice");
}

proptest! {
    /// Whatever somebody does to a file, what comes back is a plant or an error that names the file.
    #[test]
    fn no_edit_of_a_file_brings_the_loader_down(
        path in prop::sample::select(vec![
            "models/rig/plant.xml",
            "models/catalogue/ServoAxis/avatar.xml",
            "models/catalogue/LoadingBay/prototype.xml",
        ]),
        at in 0usize..6000, remove in 0usize..40, insert in "[ -~]{0,6}",
    ) {
        let text = Embedded.read(path).expect("a file of ours");
        let characters: Vec<char> = text.chars().collect();
        let (start, end) = (at % characters.len(), (at % characters.len() + remove).min(characters.len()));
        let edited: String =
            characters[..start].iter().copied().chain(insert.chars()).chain(characters[end..].iter().copied()).collect();
        let source = Layered(Memory([(path.to_owned(), edited)].into()), Embedded);
        if let Err(error) = load(&source, "models/rig", KINDS) {
            prop_assert!(error.to_string().contains(".xml:"), "{}", error);
        }
    }
}
