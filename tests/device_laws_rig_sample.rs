//! The nominal laws against recordings of a rig that is not ours: an independent simulation of the same table and rules,
//! sampled, quantised and jittered as a PLC would, with no effect added.
//!
//! Each device runs alone, its commands applied at their recorded instants. A level may differ by noise and quantisation
//! from what the model was within the timing of the sample; a boolean by one report cycle. The recordings are not part
//! of the project: where they do not lie beside it, the test says so and passes.

use std::path::Path;

use kinetwin::device::{Device, KINDS, Role, Surroundings, build};
use kinetwin::plant::{Parameter, ParameterValue, Parameters};
use kinetwin::prototype::kind::{KindDescriptor, ParameterType, PortDescriptor, PortType};
use kinetwin::signal_map::Direction;

const RECORDINGS: &str = "../shared/data/rig-sample";

/// The rig's devices. Their defaults are the rig's parameters, but for the part that is always sealed.
const DEVICES: [(&str, &str); 6] = [
    ("Belt", "kinetwin.StraightConveyor"),
    ("Pusher", "kinetwin.Pusher"),
    ("Robot", "kinetwin.CartesianRobot"),
    ("Gripper", "kinetwin.SuctionCapGripper"),
    ("Axis", "kinetwin.ServoAxis"),
    ("Motor", "kinetwin.EncoderMotor"),
];

/// Quantisation of each level, and RMS of its noise where the recording's noise is 1: both found at standstill.
const LEVELS: [(&str, f64, f64); 10] = [
    ("velocityActual", 1e-3, 1.0e-3),
    ("actualPosX", 5e-5, 2.2e-5),
    ("actualPosY", 5e-5, 2.2e-5),
    ("actualPosZ", 5e-5, 2.2e-5),
    ("actualPosR", 5e-5, 3.4e-5),
    ("position", 1e-5, 1.6e-5),
    ("velocity", 1e-3, 1.5e-3),
    ("force", 0.5, 1.5),
    ("encoder", 1.0, 0.0),
    ("speedActual", 1e-2, 3.1e-2),
];

/// How far an encoder wanders off when its commands' stamps are late, counts for each second: it adds up, at every change
/// of speed, the way gone in the meantime.
const WANDER: f64 = 1500.0;

/// The other simulation steps by 0.1 ms, so that what it samples is up to a step old; the stamps are rounded.
const SAMPLING_S: f64 = 110e-6;

/// A recording's message: commands or reports, by signal.
struct Line {
    seconds: f64,
    command: bool,
    values: Vec<(String, f64)>,
}

fn read(path: &Path) -> Vec<Line> {
    let file = std::fs::File::open(path).expect("the recording opens");
    let text = String::from_utf8(zstd::decode_all(file).expect("it is compressed")).expect("it is text");
    let line = |line: &str| {
        let message: serde_json::Value = serde_json::from_str(line).expect("a line is a JSON object");
        let value = |entry: &serde_json::Value| {
            let number = entry["value"].as_bool().map_or_else(|| entry["value"].as_f64(), |flag| Some(f64::from(flag)));
            (entry["name"].as_str().expect("a name").to_owned(), number.expect("a value"))
        };
        Line {
            seconds: message["t"].as_f64().expect("a time"),
            command: message["from"] == "automation",
            values: message["SendValue"].as_array().expect("values").iter().map(value).collect(),
        }
    };
    text.lines().skip(1).map(line).collect()
}

/// The boxes on the rig's belt: 0.30 m long, one put at 0.15 m at 1.0 s and every 6.0 s after if there is room.
#[derive(Default)]
struct Boxes(Vec<f64>);

impl Boxes {
    fn put(&mut self) {
        if self.0.iter().all(|centre| (centre - 0.15).abs() >= 0.3) {
            self.0.push(0.15);
        }
    }

    fn carry(&mut self, way: f64) {
        self.0.iter_mut().for_each(|centre| *centre += way);
        self.0.retain(|centre| (0.0..=2.0).contains(centre));
    }

    fn cut(&self, beam: f64) -> bool {
        self.0.iter().any(|centre| centre - 0.15 < beam && beam < centre + 0.15)
    }
}

/// One device of the rig, and the time it has reached.
struct Alone {
    name: &'static str,
    kind: &'static KindDescriptor,
    device: Box<dyn Device>,
    seconds: f64,
    boxes: Boxes,
    next_box: f64,
}

impl Alone {
    fn new(name: &'static str, kind: &str) -> Alone {
        let kind = KINDS.iter().find(|descriptor| descriptor.name == kind).expect(kind);
        let parameters = kind.parameters.iter().map(|parameter| {
            let text = if parameter.name == "alwaysSealed" { "true" } else { parameter.default };
            let value = match parameter.ty {
                ParameterType::Number { .. } => ParameterValue::Number(text.parse().expect(text)),
                ParameterType::Integer { .. } => ParameterValue::Integer(text.parse().expect(text)),
                ParameterType::Boolean => ParameterValue::Boolean(text.parse().expect(text)),
                ParameterType::Numbers { .. } => {
                    ParameterValue::Numbers(text.split(';').map(|number| number.parse().expect(text)).collect())
                }
                _ => ParameterValue::Text(text.to_owned()),
            };
            (parameter.name, Parameter { value, tolerance: 0.0 })
        });
        let device = build(kind, &Parameters(parameters.collect()), name, 0).expect(name);
        Alone { name, kind, device, seconds: 0.0, boxes: Boxes::default(), next_box: 1.0 }
    }

    /// Moves to an instant; earlier ones are where it is already.
    fn reach(&mut self, seconds: f64) {
        while self.next_box <= seconds {
            self.step(self.next_box);
            self.boxes.put();
            self.next_box += 6.0;
        }
        self.step(seconds);
        let [barrier_a, barrier_b] = [0.30, 1.70].map(|beam| self.boxes.cut(beam));
        self.device.sense(&Surroundings { barrier_a, barrier_b, ..Surroundings::default() });
    }

    fn step(&mut self, seconds: f64) {
        if seconds > self.seconds {
            self.device.advance(seconds - self.seconds);
            self.seconds = seconds;
            if let Role::Carries(belt) = self.device.role() {
                self.boxes.carry(belt.displacement);
            }
        }
    }

    fn command(&mut self, line: &Line) {
        for (port, value) in ports_of(line, self.name) {
            self.device.command(self.kind.port(port).expect(port), value);
        }
    }

    fn reports(&mut self) -> Vec<f64> {
        let mut reports = vec![0.0; self.kind.ports.len()];
        self.device.report(&mut reports);
        reports
    }
}

fn ports_of<'a>(line: &'a Line, device: &str) -> impl Iterator<Item = (&'a str, f64)> {
    let prefix = format!("{device}.");
    line.values.iter().filter_map(move |(name, value)| Some((name.strip_prefix(&prefix)?, *value)))
}

/// What one port recorded and what the model was meanwhile, sample by sample.
#[derive(Default)]
struct Samples {
    recorded: Vec<f64>,
    /// The least and the greatest the model was within the sample's timing.
    least: Vec<f64>,
    greatest: Vec<f64>,
}

/// Runs a device along a recording whose stamps are off by up to `timing` seconds.
fn run(lines: &[Line], name: &'static str, kind: &str, timing: f64) -> Vec<(&'static PortDescriptor, Samples)> {
    let mut alone = Alone::new(name, kind);
    let count = alone.kind.ports.len();
    let mut held = vec![f64::NAN; count];
    let mut samples: Vec<Samples> = (0..count).map(|_| Samples::default()).collect();
    // Instants at which to look at the model for each report: a few within its timing.
    const LOOKS: u32 = 8;
    let mut looks: Vec<(f64, usize)> = Vec::new();
    for (index, line) in lines.iter().enumerate() {
        if line.command {
            looks.push((line.seconds, index));
        } else {
            let look = |k| line.seconds + timing * (2.0 * f64::from(k) / f64::from(LOOKS) - 1.0);
            looks.extend((0..=LOOKS).map(|k| (look(k), index)));
        }
    }
    looks.sort_by(|a, b| a.0.total_cmp(&b.0).then(lines[b.1].command.cmp(&lines[a.1].command)));
    let mut seen = vec![(f64::INFINITY, f64::NEG_INFINITY); count];
    let mut left = LOOKS + 1;
    for (seconds, index) in looks {
        alone.reach(seconds);
        let line = &lines[index];
        if line.command {
            alone.command(line);
            continue;
        }
        for (seen, report) in seen.iter_mut().zip(alone.reports()) {
            *seen = (seen.0.min(report), seen.1.max(report));
        }
        left -= 1;
        if left == 0 {
            for (port, value) in ports_of(line, name) {
                held[alone.kind.port(port).expect(port)] = value;
            }
            for ((samples, held), (least, greatest)) in samples.iter_mut().zip(&held).zip(&seen) {
                samples.recorded.push(*held);
                samples.least.push(*least);
                samples.greatest.push(*greatest);
            }
            seen.fill((f64::INFINITY, f64::NEG_INFINITY));
            left = LOOKS + 1;
        }
    }
    alone.kind.ports.iter().zip(samples).filter(|(port, _)| port.direction == Direction::Report).collect()
}

/// A level: beside what the model was, only noise and quantisation.
fn check_level(place: &str, port: &PortDescriptor, samples: &Samples, noise: f64, jitter: f64) {
    let (_, step, unit) = *LEVELS.iter().find(|level| level.0 == port.name).expect(port.name);
    let noise = if port.name == "encoder" { WANDER * jitter } else { unit * noise };
    let (mut square, mut largest) = (0.0, 0.0_f64);
    for ((recorded, least), greatest) in samples.recorded.iter().zip(&samples.least).zip(&samples.greatest) {
        let error = (recorded - greatest).max(least - recorded).max(0.0);
        square += error * error;
        largest = largest.max(error);
    }
    let rms = (square / samples.recorded.len() as f64).sqrt();
    let floor = (noise * noise + step * step / 12.0).sqrt();
    assert!(rms <= 1.1 * floor, "{place}: RMS {rms:e}, where noise and quantisation give {floor:e}");
    let most = 0.5001 * step + 5.0 * noise;
    assert!(largest <= most, "{place}: {largest:e} at most, where noise and quantisation give {most:e}");
}

/// A boolean or a code: never wrong for longer than the report at which it changed.
fn check_edges(place: &str, samples: &Samples) {
    let fits = |recorded: f64, at: usize| {
        samples.least.get(at).is_some_and(|least| *least <= recorded && recorded <= samples.greatest[at])
    };
    for (at, recorded) in samples.recorded.iter().enumerate() {
        let near = [at.wrapping_sub(1), at, at + 1];
        assert!(near.into_iter().any(|at| fits(*recorded, at)), "{place}: report {at} says {recorded}");
    }
}

/// All devices of a recording with this noise and this jitter (s), but for the signals that an effect was added to.
fn check(case: &str, noise: f64, jitter: f64, altered: &[&str]) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(RECORDINGS).join(case);
    if !folder.is_dir() {
        eprintln!("skipped: no recordings at {}", folder.display());
        return;
    }
    for file in ["train", "holdout"] {
        let lines = read(&folder.join(format!("{file}.cps.jsonl.zst")));
        for (name, kind) in DEVICES {
            for (port, samples) in run(&lines, name, kind, SAMPLING_S + 4.0 * jitter) {
                if altered.contains(&port.name) {
                    continue;
                }
                let place = format!("{case} {file} {name}.{}", port.name);
                if port.ty == PortType::Real || port.name == "encoder" {
                    check_level(&place, port, &samples, noise, jitter);
                } else {
                    check_edges(&place, &samples);
                }
            }
        }
    }
}

#[test]
fn a_recording_with_little_noise_and_jitter() {
    check("case-01", 0.3, 0.001, &[]);
}

#[test]
fn a_recording_with_noise_and_no_jitter() {
    check("case-02", 1.0, 0.0, &[]);
}

#[test]
fn a_recording_without_noise_or_jitter() {
    check("case-05", 0.0, 0.0, &["actualPosY", "cartesianArrived"]);
}
