//! What holds of every effect of the registry, at every place, on every kind of device that it fits.

use std::collections::BTreeSet;
use std::slice::from_ref;

use super::bench::spec;
use super::*;
use crate::device::bench::Bench;
use crate::device::{Device, Role, Surroundings};
use crate::plant::Parameters;
use crate::prototype::kind::{KindDescriptor, PortType};
use crate::signal_map::{Direction, Kind};

/// A device in a day's work that shows every effect there is on it.
struct Site {
    kind: &'static str,
    set: &'static [(&'static str, &'static str)],
    /// What inside effects stand at, where it has several components.
    component: Option<&'static str>,
    day: &'static [(f64, Act)],
}

/// What happens to a device at an instant.
enum Act {
    Command(&'static [(&'static str, f64)]),
    /// Barrier A and B cut, sealed, parts, parts held back.
    World([bool; 3], u32, u32),
    /// So many others on the supply move.
    Share(u32),
    /// A staircase of a command: port, first value, step of every 10 ms, and how many.
    Stairs(&'static str, f64, f64, u32),
}

use Act::{Command, Share, Stairs, World};

const BELT: &[(f64, Act)] = &[
    (0.05, Command(&[("velocityTarget", 0.5), ("motorDirection", 1.0)])),
    (0.21, World([true, false, false], 1, 0)),
    (0.73, World([false, false, false], 2, 1)),
    (0.81, Share(2)),
    (1.13, World([false, true, false], 1, 0)),
    (1.52, Command(&[("velocityTarget", 0.2)])),
    (1.91, Share(0)),
    (2.02, Command(&[("motorDirection", 0.0)])),
    (2.63, World([false, false, false], 0, 0)),
    (2.74, Command(&[("motorDirection", -1.0), ("velocityTarget", 0.6)])),
    (2.77, Command(&[("motorDirection", 0.0)])),
    (3.16, Command(&[("motorDirection", -1.0)])),
    (4.11, Command(&[("velocityTarget", 0.005)])),
];

const PUSHER: &[(f64, Act)] = &[
    (0.05, Command(&[("command", 1.0)])),
    (0.33, Command(&[("command", 0.0)])),
    (0.52, Command(&[("command", 1.0)])),
    (0.61, World([true, false, false], 1, 0)),
    (0.74, Share(1)),
    (2.03, Command(&[("command", 2.0)])),
    (2.51, World([false, true, false], 0, 0)),
    (2.82, Share(0)),
    (2.95, Command(&[("command", 1.0)])),
    (3.04, World([false, false, false], 0, 0)),
    (3.21, Command(&[("command", 2.0)])),
];

const ROBOT: &[(f64, Act)] = &[
    (0.05, Command(&[("XTarget", 0.7), ("YTarget", 0.7), ("ZTarget", -0.2), ("RTarget", 0.5), ("grip", 1.0)])),
    (0.23, Share(1)),
    (1.62, Command(&[("XTarget", 0.709), ("YTarget", 0.6)])),
    (2.04, World([false; 3], 1, 0)),
    (2.13, Command(&[("XTarget", -0.6), ("grip", 0.0)])),
    (2.71, Share(0)),
    (4.02, Command(&[("XTarget", 0.1)])),
];

const GRIPPER: &[(f64, Act)] = &[
    (0.05, World([false, false, true], 1, 0)),
    (0.11, Command(&[("suctionOn", 1.0)])),
    (1.74, Command(&[("suctionOn", 0.0)])),
    (2.03, Command(&[("suctionOn", 1.0)])),
    (2.52, Command(&[("suctionOn", 0.0)])),
    (2.81, Command(&[("suctionOn", 1.0)])),
    (3.33, Command(&[("blowOn", 1.0)])),
    (3.42, Command(&[("blowOn", 0.0), ("suctionOn", 0.0)])),
];

const POSITIONS: &[(f64, Act)] = &[
    (0.05, Command(&[("positionTarget", 0.1)])),
    (0.62, Stairs("positionTarget", 0.1, 0.003, 30)),
    (0.71, Share(1)),
    (1.13, World([false; 3], 1, 0)),
    (1.24, Command(&[("positionTarget", 0.0)])),
    (1.92, Stairs("positionTarget", 0.0, 0.0004, 40)),
    (2.81, Command(&[("torqueEnabled", 0.0)])),
    (2.93, Command(&[("positionTarget", -0.3)])),
    (3.04, Command(&[("torqueEnabled", 1.0)])),
    (3.75, Share(0)),
];

const FORCES: &[(f64, Act)] = &[
    (0.05, Command(&[("forceTarget", 120.0)])),
    (0.72, Share(1)),
    (0.93, World([false; 3], 1, 0)),
    (1.24, Command(&[("forceTarget", -150.0)])),
    (2.81, Command(&[("torqueEnabled", 0.0)])),
    (3.04, Command(&[("torqueEnabled", 1.0), ("forceTarget", 20.0)])),
];

const SPEEDS: &[(f64, Act)] = &[
    (0.05, Command(&[("velocityTarget", 0.6)])),
    (0.72, Share(1)),
    (0.93, World([false; 3], 1, 0)),
    (1.24, Command(&[("velocityTarget", -0.3)])),
    (2.02, Command(&[("velocityTarget", 0.005)])),
    (2.81, Command(&[("torqueEnabled", 0.0)])),
    (3.04, Command(&[("torqueEnabled", 1.0), ("velocityTarget", 0.2)])),
];

const MOTOR: &[(f64, Act)] = &[
    (0.05, Command(&[("speedTarget", 8.0), ("enable", 1.0)])),
    (0.72, Share(1)),
    (1.31, Command(&[("speedTarget", 3.0)])),
    (1.92, Command(&[("enable", 0.0)])),
    (2.43, Command(&[("enable", 1.0), ("speedTarget", -9.0)])),
    (3.72, Command(&[("speedTarget", 0.005)])),
];

const SITES: &[Site] = &[
    Site { kind: "StraightConveyor", set: &[], component: None, day: BELT },
    Site { kind: "StraightConveyor", set: &[("coast", "true"), ("readyDelay", "0.07")], component: None, day: BELT },
    Site { kind: "ConveyorCurve", set: &[], component: None, day: BELT },
    Site { kind: "Pusher", set: &[("barrierA", "0.1"), ("barrierB", "0.3")], component: None, day: PUSHER },
    Site { kind: "CartesianRobot", set: &[], component: Some("X"), day: ROBOT },
    Site { kind: "SuctionCapGripper", set: &[], component: None, day: GRIPPER },
    Site { kind: "LoadingBay", set: &[("belt", "Belt"), ("interval", "0.7")], component: None, day: &[] },
    Site { kind: "ServoAxis", set: &[("load", "30")], component: None, day: POSITIONS },
    Site { kind: "ServoAxis", set: &[("mode", "ideal")], component: None, day: POSITIONS },
    Site { kind: "ServoAxis", set: &[("mode", "force")], component: None, day: FORCES },
    Site { kind: "ServoAxis", set: &[("mode", "velocity")], component: None, day: SPEEDS },
    Site {
        kind: "ServoAxis",
        set: &[
            ("motion", "rotary"),
            ("loop", "proportional"),
            ("velocityGain", "60"),
            ("M", "0.5"),
            ("Fv", "4"),
            ("pendulumMass", "2"),
            ("pendulumLength", "0.3"),
        ],
        component: None,
        day: POSITIONS,
    },
    Site { kind: "EncoderMotor", set: &[], component: None, day: MOTOR },
];

/// From one look at a device to the next, s.
const LOOK_S: f64 = 0.02;
const LOOKS: u32 = 250;
/// How long after something happens a device is looked at, s.
const AFTER_S: f64 = 0.000_25;
/// How far beside round instants things happen, s: nothing is to depend on a tie.
const OFF_S: f64 = 0.001_37;

impl Site {
    fn bench(&self) -> Bench {
        Bench::new(&format!("kinetwin.{}", self.kind), self.set)
    }

    /// The specifications of an effect here with these parameters, in the registry's order: one for the device, or one for
    /// each component that it has at the place.
    fn specs(&self, effect: &EffectDescriptor, place: EffectPlace, values: &[f64]) -> Vec<EffectSpec> {
        let numbers: Vec<(&str, f64)> = effect.parameters.iter().map(|p| p.name).zip(values.iter().copied()).collect();
        let kind = self.bench().kind;
        let ports = kind.ports.iter().map(|port| port.name);
        let components: Vec<Option<&str>> = match (effect.id, is_outside(place)) {
            ("parameter-error", _) => NOTICED.iter().map(|name| Some(*name)).collect(),
            (_, true) => std::iter::once(None).chain(ports.map(Some)).collect(),
            (_, false) => vec![self.component],
        };
        let spec = |component: Option<&str>| spec(place.name(), effect.id, component, &numbers);
        let mut specs: Vec<EffectSpec> = components.into_iter().map(spec).collect();
        for spec in &mut specs {
            let component = spec.component.clone().unwrap_or_default();
            if effect.id == "swapped" {
                let pair = PAIRS.iter().find(|[one, _]| *one == component);
                let other = pair.map_or("", |[_, other]| other);
                spec.parameters.insert("with".to_owned(), ParameterValue::Text(other.to_owned()));
            }
            if effect.id == "parameter-error"
                && let Some(ParameterValue::Number(number)) =
                    self.bench().parameters.0.get(component.as_str()).map(|parameter| parameter.value.clone())
            {
                spec.parameters.insert("value".to_owned(), ParameterValue::Number(0.8 * number));
            }
        }
        specs.retain(|spec| self.device(from_ref(spec), 1).is_ok());
        specs
    }

    /// The device with effects, or why they do not fit.
    fn device(
        &self,
        effects: &[EffectSpec],
        seed: u64,
    ) -> Result<(Box<dyn Device>, &'static KindDescriptor), EffectError> {
        let bench = self.bench();
        Ok((build(bench.kind, &bench.parameters, "Device1", effects, seed)?, bench.kind))
    }

    /// What is seen of it with effects, whatever is random about them following from `seed`.
    fn life(&self, effects: &[EffectSpec], seed: u64, parts: &[f64]) -> Vec<Vec<f64>> {
        let (mut device, kind) = self.device(effects, seed).expect("it fits");
        self.live(device.as_mut(), kind, parts)
    }

    /// What is seen of a device on its day, every [`LOOK_S`] and a little after everything that happens; each span from one
    /// instant to the next in `parts` of these lengths.
    fn live(&self, device: &mut dyn Device, kind: &KindDescriptor, parts: &[f64]) -> Vec<Vec<f64>> {
        self.live_and(device, kind, parts, &mut |_, _| {})
    }

    /// The same, and `visit` is given the device at every look, and when that is.
    fn live_and(
        &self,
        device: &mut dyn Device,
        kind: &KindDescriptor,
        parts: &[f64],
        visit: &mut dyn FnMut(&mut dyn Device, f64),
    ) -> Vec<Vec<f64>> {
        let mut instants: Vec<(f64, Option<(&Act, u32)>)> = Vec::new();
        for (at, act) in self.day {
            let count = if let Stairs(_, _, _, count) = act { *count } else { 1 };
            for step in 0..count {
                let at = at + OFF_S + 0.01 * f64::from(step);
                instants.extend([(at, Some((act, step))), (at + AFTER_S, None)]);
            }
        }
        instants.extend((1..=LOOKS).map(|look| (f64::from(look) * LOOK_S, None)));
        instants.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut now, mut seen, mut eyes) = (0.0, Vec::new(), Eyes::default());
        for (at, act) in instants {
            eyes.advance(device, at - now, parts);
            now = at;
            match act {
                Some((act, step)) => act.on(device, kind, step),
                None => {
                    seen.push(eyes.see(device, kind));
                    visit(device, at);
                }
            }
        }
        seen
    }
}

/// Parameters of which a day's work tells.
const NOTICED: &[&str] =
    &["acceleration", "extendSpeed", "maxVelocityX", "buildUpTime", "interval", "forceGain", "velocityGain"];

/// Two signals of one type each, of which one does what the other does not.
const PAIRS: &[[&str; 2]] = &[
    ["lightBarrierA", "lightBarrierB"],
    ["limitExtended", "limitRetracted"],
    ["XTarget", "YTarget"],
    ["suctionOn", "blowOn"],
];

impl Act {
    fn on(&self, device: &mut dyn Device, kind: &KindDescriptor, step: u32) {
        let port = |name: &str| kind.port(name).expect(name);
        match *self {
            Command(values) => values.iter().for_each(|(name, value)| device.command(port(name), *value)),
            World([barrier_a, barrier_b, sealed], parts, queued) => {
                device.sense(&Surroundings { barrier_a, barrier_b, sealed, parts, queued, ..Surroundings::default() });
            }
            Share(others) => device.share(others),
            Stairs(name, first, rise, _) => device.command(port(name), first + rise * f64::from(step)),
        }
    }
}

/// What is added up from span to span.
#[derive(Default)]
struct Eyes {
    /// How far belt or plate have moved.
    moved: f64,
    now: f64,
    made: Vec<f64>,
}

impl Eyes {
    fn advance(&mut self, device: &mut dyn Device, seconds: f64, parts: &[f64]) {
        let whole: f64 = parts.iter().sum();
        let mut rest = seconds;
        for (index, part) in parts.iter().enumerate() {
            let span = if index + 1 == parts.len() { rest } else { seconds * part / whole };
            rest -= span;
            if span <= 0.0 {
                continue;
            }
            device.advance(span);
            self.now += span;
            match device.role() {
                Role::Carries(belt) => self.moved += belt.displacement,
                Role::Pushes(plate) => self.moved += plate.displacement,
                Role::Makes(source) => self.made.extend(source.due.iter().map(|ago| self.now - ago)),
                _ => {}
            }
        }
    }

    /// All that anybody sees of it: its reports, and what it is to the parts.
    fn see(&self, device: &mut dyn Device, kind: &KindDescriptor) -> Vec<f64> {
        let mut seen = vec![0.0; kind.ports.len()];
        device.report(&mut seen);
        seen.push(self.moved);
        match device.role() {
            Role::Carries(belt) => seen.extend([belt.transfer_slip, belt.grip.min(1e9)]),
            Role::Moves(tool) => {
                seen.extend(tool.position.iter().chain([&tool.rotation, &f64::from(u8::from(tool.grip))]))
            }
            Role::Holds(cups) => seen.push(f64::from(u8::from(cups.vacuum))),
            Role::Makes(source) => seen.extend(source.size.iter().chain(&self.made)),
            _ => {}
        }
        seen
    }
}

fn is_outside(place: EffectPlace) -> bool {
    matches!(place, EffectPlace::CommandLink | EffectPlace::Sensor | EffectPlace::ReportLink)
}

fn nominal(effect: &EffectDescriptor) -> Vec<f64> {
    effect.parameters.iter().map(|parameter| parameter.nominal).collect()
}

fn typical(effect: &EffectDescriptor) -> Vec<f64> {
    effect.parameters.iter().map(|parameter| parameter.typical).collect()
}

/// Every effect at every place on every site that takes it, with the first of its specifications there.
fn everywhere(
    values: fn(&EffectDescriptor) -> Vec<f64>,
    mut check: impl FnMut(&'static EffectDescriptor, &Site, EffectSpec),
) {
    for effect in EFFECTS {
        for &place in effect.places {
            for site in SITES {
                if let Some(spec) = site.specs(effect, place, &values(effect)).into_iter().next() {
                    check(effect, site, spec);
                }
            }
        }
    }
}

fn title(site: &Site, spec: &EffectSpec) -> String {
    format!("{} at {} on {} {:?}", spec.kind, spec.place.name(), site.kind, site.set)
}

/// The largest difference between two lives.
fn difference(one: &[Vec<f64>], other: &[Vec<f64>]) -> f64 {
    let rows = one.iter().zip(other);
    let each = rows.flat_map(|(a, b)| {
        let lengths = if a.len() == b.len() { 0.0 } else { f64::INFINITY };
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).chain([lengths])
    });
    each.fold(0.0, f64::max)
}

const WHOLE: &[f64] = &[1.0];

#[test]
fn every_effect_stands_somewhere_at_each_of_its_places_on_each_of_its_kinds() {
    let mut found = BTreeSet::new();
    everywhere(typical, |effect, site, spec| {
        found.insert((effect.id, spec.place.name(), site.kind));
    });
    for effect in EFFECTS {
        for place in effect.places {
            let is_missing = |kind: &&str| !found.contains(&(effect.id, place.name(), *kind));
            let kinds = effect.fits.iter().flat_map(|fit| match fit {
                Fit::Drives(kinds) | Fit::Parts(kinds) => *kinds,
                Fit::Signals(_) => &[],
            });
            // A sink has nothing that anybody sees by itself.
            let kinds = kinds.copied().filter(|kind| *kind != "UnloadingBay");
            let missing: Vec<&str> = kinds.filter(is_missing).collect();
            assert!(missing.is_empty(), "{} at {} is nowhere on {missing:?}", effect.id, place.name());
            assert!(found.iter().any(|(id, at, _)| *id == effect.id && *at == place.name()), "{}", effect.id);
        }
    }
}

#[test]
fn at_nominal_parameters_nothing_is_another_bit() {
    everywhere(nominal, |effect, site, spec| {
        if !effect.acts_always {
            let bits = |life: Vec<Vec<f64>>| life.concat().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            let with = bits(site.life(from_ref(&spec), 1, WHOLE));
            assert!(with == bits(site.life(&[], 1, WHOLE)), "{}", title(site, &spec));
        }
    });
}

/// What a stage itself does at its nominal parameters, where it is put though it need not be.
#[test]
fn the_equations_do_nothing_at_nominal_parameters() {
    let mut wrong = Vec::new();
    everywhere(nominal, |effect, site, spec| {
        if effect.acts_always {
            return;
        }
        let Bench { device, kind, parameters } = site.bench();
        let attached = attach::attach_all(device, kind, &parameters, "Device1", from_ref(&spec), 1);
        let with = site.live(attached.expect("it fits").as_mut(), kind, WHOLE);
        let off = difference(&site.life(&[], 1, WHOLE), &with);
        if off > 1e-9 {
            wrong.push(format!("{}: {off}", title(site, &spec)));
        }
    });
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn at_typical_parameters_it_shows_on_every_kind() {
    let (mut all, mut shown) = (BTreeSet::new(), BTreeSet::new());
    for site in SITES {
        let without = site.life(&[], 1, WHOLE);
        for effect in EFFECTS {
            for &place in effect.places {
                let specs = site.specs(effect, place, &typical(effect));
                let shows = |spec: &EffectSpec| {
                    // What is random about it may happen to do nothing once.
                    (1..=12).any(|seed| difference(&without, &site.life(from_ref(spec), seed, WHOLE)) > 1e-7)
                };
                let key = (effect.id, place.name(), site.kind);
                if specs.is_empty() || shown.contains(&key) {
                    continue;
                }
                all.insert(key);
                if specs.iter().any(shows) {
                    shown.insert(key);
                }
            }
        }
    }
    let hidden: Vec<_> = all.difference(&shown).collect();
    assert!(hidden.is_empty(), "{hidden:#?}");
}

/// As usual, but for what makes a servo's loop unstable: of a motion that never settles no two computations agree for long.
fn bearable(effect: &EffectDescriptor) -> Vec<f64> {
    match effect.id {
        "first-order-lag" => vec![0.003],
        "second-order-lag" => vec![600.0, 0.7],
        _ => typical(effect),
    }
}

/// How far a span that is cut anywhere may move a result, as a share of its greatest value or of 1: nothing but rounding,
/// where a law is exact. What a link makes late is looked up on straight lines between samples a millisecond apart, and a
/// servo's forces are held from one stretch to the next.
fn rounding(effect: &EffectDescriptor, site: &Site, spec: &EffectSpec) -> f64 {
    let looks_up = ["input-filter", "dead-time", "sampling-jitter", "clock-drift"].contains(&effect.id);
    if site.kind == "ServoAxis" && (looks_up || !site.set.contains(&("mode", "ideal"))) {
        1e-2
    } else if looks_up && spec.place == EffectPlace::ReportLink {
        6e-4
    } else {
        1e-8
    }
}

#[test]
fn a_span_may_be_cut_anywhere() {
    let mut wrong = Vec::new();
    everywhere(bearable, |effect, site, spec| {
        let [whole, cut] = [WHOLE, &[3.7, 1.0, 0.3, 8.1, 2.2]].map(|parts| site.life(from_ref(&spec), 1, parts));
        let greatest = whole.iter().flatten().fold(1.0, |most: f64, value| most.max(value.abs()));
        let off = difference(&whole, &cut) / greatest;
        if off > rounding(effect, site, &spec) {
            let rows = whole.iter().zip(&cut);
            let first = rows.clone().position(|(a, b)| difference(from_ref(a), from_ref(b)) > 0.5 * off * greatest);
            wrong.push(format!("{}: {off:e}, at look {first:?}", title(site, &spec)));
        }
    });
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// At every look of its day, as far as it says by then.
#[test]
fn reports_that_step_stay_as_long_as_a_device_with_an_effect_says() {
    let (mut wrong, mut said) = (Vec::new(), 0);
    everywhere(typical, |_, site, spec| {
        let (mut device, kind) = site.device(from_ref(&spec), 1).expect("it fits");
        let ports = kind.ports.iter().enumerate().filter(|(_, port)| port.direction == Direction::Report);
        let steps: Vec<usize> = ports
            .filter(|(_, port)| port.kind == Kind::Edge || port.ty == PortType::Boolean)
            .map(|(at, _)| at)
            .collect();
        let see = |device: &mut dyn Device| {
            let mut seen = vec![0.0; kind.ports.len()];
            device.report(&mut seen);
            steps.iter().map(|port| seen[*port]).collect::<Vec<f64>>()
        };
        let mut visit = |device: &mut dyn Device, at: f64| {
            let least = device.unchanged_for().min(3.0);
            if least <= 0.0 {
                return;
            }
            said += 1;
            let before = see(device.boxed().as_mut());
            for part in [0.5, 1.0 - 1e-9] {
                let mut there = device.boxed();
                there.advance(part * least);
                if see(there.as_mut()) != before {
                    wrong.push(format!("{}: {} s after {at} s, of {least} s", title(site, &spec), part * least));
                }
            }
        };
        site.live_and(device.as_mut(), kind, WHOLE, &mut visit);
    });
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(said > 1000, "{said}");
}

#[test]
fn what_is_out_of_range_is_refused_in_words() {
    for effect in EFFECTS {
        for (index, parameter) in effect.parameters.iter().enumerate() {
            let (least, greatest) = parameter.range;
            let beyond = [least - 1.0 - 0.1 * least.abs(), greatest + 1.0 + 0.1 * greatest.abs(), f64::NAN];
            for value in beyond {
                let mut values = typical(effect);
                values[index] = value;
                let numbers: Vec<_> = effect.parameters.iter().map(|p| p.name).zip(values).collect();
                let mut spec = spec(effect.places[0].name(), effect.id, None, &numbers);
                spec.parameters
                    .extend(effect.texts.iter().map(|t| (t.name.to_owned(), ParameterValue::Text("x".into()))));
                let error = resolve(&spec).expect_err(parameter.name).to_string();
                let expected = format!("effect {}: {} is {value}, expected a number from", effect.id, parameter.name);
                assert!(error.starts_with(&expected), "{error}");
            }
        }
        for parameter in effect.parameters.iter().filter(|parameter| parameter.default.is_none()) {
            let numbers = effect.parameters.iter().filter(|p| p.name != parameter.name).map(|p| (p.name, p.typical));
            let mut spec = spec(effect.places[0].name(), effect.id, None, &numbers.collect::<Vec<_>>());
            spec.parameters.extend(effect.texts.iter().map(|t| (t.name.to_owned(), ParameterValue::Text("x".into()))));
            let error = resolve(&spec).expect_err(parameter.name).to_string();
            assert!(error.contains(&format!("needs its parameter {}", parameter.name)), "{error}");
        }
    }
}

/// The names that reports and models use, by effect: they are what others read, and stay.
const NAMES: &[(&str, &[&str])] = &[
    ("inverted", &[]),
    ("swapped", &[]),
    ("stuck", &[]),
    ("intermittent", &[]),
    ("wrong-unit", &[]),
    ("input-filter", &["time_constant"]),
    ("dead-time", &["time"]),
    ("sampling-jitter", &["sigma"]),
    ("lost-messages", &["probability"]),
    ("clock-drift", &["rate"]),
    ("stale-hold", &["time"]),
    ("first-order-lag", &["time_constant"]),
    ("second-order-lag", &["natural_frequency", "damping"]),
    ("gain-error", &["gain"]),
    ("velocity-limit", &["limit"]),
    ("acceleration-limit", &["limit"]),
    ("jerk-limit", &["limit"]),
    ("force-limit", &["limit"]),
    ("dead-band", &["width"]),
    ("direction-asymmetry", &["asymmetry"]),
    ("supply-drop", &["fraction"]),
    ("switch-on-delay", &["time"]),
    ("switch-off-delay", &["time"]),
    ("load-dependent-speed", &["coefficient"]),
    ("coasting", &["deceleration"]),
    ("end-cushioning", &["length", "ratio"]),
    ("settling-time", &["time"]),
    ("coulomb-friction", &["force"]),
    ("viscous-friction", &["coefficient"]),
    ("stribeck-friction", &["force", "velocity"]),
    ("breakaway-friction", &["force"]),
    ("load-dependent-friction", &["coefficient"]),
    ("position-dependent-friction", &["amplitude", "period"]),
    ("backlash", &["gap"]),
    ("compliance", &["stiffness", "damping"]),
    ("belt-slip", &["ratio"]),
    ("belt-slip-above-acceleration", &["acceleration"]),
    ("scale-error", &["ratio"]),
    ("once-per-revolution-error", &["amplitude", "period", "phase"]),
    ("added-mass", &["mass"]),
    ("constant-force", &["force"]),
    ("gravity", &["force"]),
    ("carried-mass", &["mass"]),
    ("offset", &["offset"]),
    ("gain", &["gain"]),
    ("noise", &["sigma"]),
    ("quantisation", &["step"]),
    ("on-delay", &["time"]),
    ("off-delay", &["time"]),
    ("hysteresis", &["width"]),
    ("bounce", &["time", "count"]),
    ("drift", &["rate"]),
    ("blind-range", &["length"]),
    ("part-slip", &["acceleration"]),
    ("transfer-slip", &["ratio"]),
    ("back-pressure", &["coefficient"]),
    ("part-length-error", &["length"]),
    ("part-spacing-error", &["time"]),
    ("vacuum-build-up", &["time"]),
    ("leak", &["rate"]),
    ("parameter-error", &["value"]),
];

#[test]
fn the_registry_is_whole_and_every_line_of_it_says_what_it_should() {
    let ids: Vec<&str> = EFFECTS.iter().map(|effect| effect.id).collect();
    assert_eq!(ids, NAMES.iter().map(|(id, _)| *id).collect::<Vec<_>>());
    for (effect, (id, names)) in EFFECTS.iter().zip(NAMES) {
        let found: Vec<&str> = effect.parameters.iter().map(|parameter| parameter.name).collect();
        assert!(names.iter().all(|name| found.contains(name)), "{id} has {found:?}");
        let words = [effect.summary, effect.equation, effect.source, effect.excited_by];
        assert!(words.iter().all(|words| !words.is_empty()) && !effect.places.is_empty() && !effect.fits.is_empty());
        for parameter in effect.parameters {
            let (least, greatest) = parameter.range;
            let inside = [parameter.nominal, parameter.typical].into_iter().chain(parameter.default);
            assert!(inside.into_iter().all(|value| (least..=greatest).contains(&value)), "{id} {}", parameter.name);
        }
        let moves = effect.parameters.iter().any(|parameter| parameter.nominal != parameter.typical);
        assert!(effect.acts_always || moves, "{id} is never anything but nominal");
    }
}

#[test]
fn parameters_of_a_device_are_left_as_they_are_by_all_but_those_that_change_them() {
    let bench = SITES[0].bench();
    let slip = spec("transmission", "belt-slip", None, &[("ratio", 0.06)]);
    let same = parameters_of(bench.kind, &bench.parameters, "Device1", &[slip]).expect("parameters");
    let same: &Parameters = &same;
    assert_eq!(same, &bench.parameters);
}

/// A diagnosis compares counts before they are rounded: whatever a report passes keeps the parts of a count that it has, and is within two of what
/// it is when it is rounded, at both ends of a filter.
#[test]
fn parts_of_a_count_pass_every_effect_of_a_report() {
    let gain = |name: &'static str, value: f64| ("gain", "sensor", vec![(name, value)]);
    let of_link = |id: &'static str, name: &'static str, value: f64| (id, "report-link", vec![(name, value)]);
    let all = [
        gain("gain", 1.0),
        gain("gain", 0.9),
        of_link("wrong-unit", "factor", 2.0),
        of_link("dead-time", "time", 0.0137),
        of_link("input-filter", "time_constant", 0.0137),
        of_link("clock-drift", "rate", 0.01),
        of_link("sampling-jitter", "sigma", 0.01),
        ("drift", "sensor", vec![("rate", 3.0)]),
    ];
    for (id, place, values) in all {
        let count = |is_fine: bool| {
            let effect = spec(place, id, Some("encoder"), &values);
            let mut motor = super::bench::with("EncoderMotor", &[], &[effect]);
            if is_fine {
                motor.device.count_finely();
            }
            motor.check(&[("speedTarget", 10.0), ("enable", 1.0)], 1.23, &[]);
            motor.report("encoder")
        };
        let (whole, fine) = (count(false), count(true));
        assert!(whole.fract() == 0.0 && fine.fract() != 0.0, "{id}: {whole}, {fine}");
        assert!((fine - whole).abs() <= 2.0, "{id}: {whole}, {fine}");
    }
}
