//! Machines that are our own engine with an effect added.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use std::time::Duration;

use kinetwin::gap::Recording;
use kinetwin::plant::Plant;
use kinetwin::run::{self, Connect, RecordTo, Speed};
use kinetwin::trace::Reader;

/// An effect on a device.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub device: &'static str,
    pub place: &'static str,
    pub effect: &'static str,
    pub component: &'static str,
    pub parameter: &'static str,
    pub value: f64,
    /// The effect's other parameters.
    pub beside: &'static [(&'static str, f64)],
}

pub const fn case(
    device: &'static str,
    (place, effect, component): (&'static str, &'static str, &'static str),
    parameter: &'static str,
    value: f64,
) -> Case {
    Case { device, place, effect, component, parameter, value, beside: &[] }
}

impl Case {
    fn xml(&self) -> String {
        let Case { place, effect, component, .. } = self;
        let parameters = std::iter::once((self.parameter, self.value)).chain(self.beside.iter().copied());
        let parameters: String =
            parameters.map(|(name, value)| format!(r#"<parameter name="{name}" value="{value}"/>"#)).collect();
        let component = if component.is_empty() { String::new() } else { format!(" component=\"{component}\"") };
        format!(r#"<effect place="{place}" kind="{effect}"{component}>{parameters}</effect>"#)
    }
}

/// A model of ours with effects on its devices, under its automation for some seconds.
pub fn record<'a>(base: &str, plant: &Plant, cases: impl IntoIterator<Item = &'a Case>, seconds: u64) -> Recording {
    let folder = tempfile::tempdir().expect("a folder");
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join(base).join("plant.xml");
    let mut text = std::fs::read_to_string(base).expect("the model's plant");
    for case in cases {
        let begin = format!("<instance name=\"{}\"", case.device);
        let (before, after) = text.split_once(&begin).expect("the instance");
        let after = after.replacen("</instance>", &format!("{}</instance>", case.xml()), 1);
        text = format!("{before}{begin}{after}");
    }
    let model = folder.path().join("plant.xml");
    std::fs::write(&model, text).expect("a plant");
    let path = folder.path().join("machine.cps.jsonl");
    let options = run::Options {
        connect: Some(Connect::Embedded),
        seed: 5,
        speed: Speed::Max,
        duration: Some(Duration::from_secs(seconds)),
        record: Some(RecordTo { path: path.clone(), replace: false }),
        ..run::Options::new(model.to_str().expect("a path"))
    };
    run::start(&options).expect("the run starts").finish().expect("the run ends");
    let reader = Reader::new("machine", BufReader::new(File::open(&path).expect("it opens"))).expect("a trace");
    Recording::read(plant, "machine", reader, &[]).expect("a recording of it")
}
