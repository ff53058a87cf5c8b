//! A link that answers at once gives what a stream gives afterwards.

use crate::catalogue::ENTRIES;
use crate::chance::Dice;
use crate::plant::Kind;
use crate::quirk::Quirk;
use crate::rig::{commands, signals};
use crate::socket::link::Link;
use crate::stream::Stream;

const END: f64 = 3.0;

/// A signal at instants at most 0.1 ms apart: a level that swings, a flag or a code that changes, or a command that is held.
fn points(kind: Kind, is_edge: bool) -> Vec<(f64, f64)> {
    let mut dice = Dice::new(5, 0);
    let (mut all, mut at) = (Vec::new(), 0.0);
    while at < END {
        let wave = (5.0 * at).sin() + 0.3 * (17.0 * at).cos();
        let held = (5.0 * (at / 0.04).floor() * 0.04).sin();
        all.push((
            at,
            match kind {
                Kind::Level if is_edge => held,
                Kind::Level => wave,
                _ => f64::from(wave > 0.2),
            },
        ));
        at += dice.between(0.2e-4, 1e-4);
    }
    all
}

/// How many of all instants differ by more than `allowed`.
fn differing(quirk: &Quirk, kind: Kind, is_edge: bool, allowed: f64) -> usize {
    let points = points(kind, is_edge);
    let mut stream = Stream::new(is_edge);
    points.iter().for_each(|(at, x)| stream.push(*at, *x));
    let stream = stream.through(quirk, kind, &mut Dice::new(8, 0), END + 1.0);
    let mut link = Link::of(quirk, kind, is_edge, 8);
    let passed = points.iter().map(|(at, x)| (*at, link.as_mut().map_or(*x, |link| link.pass(*at, *x))));
    passed.filter(|(at, y)| (y - stream.at(*at)).abs() > allowed).count()
}

#[test]
fn every_effect_on_a_link_or_at_a_sensor_is_the_same_while_it_happens() {
    let (commands, signals) = (commands(), signals());
    let mut checked = 0;
    for entry in ENTRIES {
        let is_command = entry.place == "command-link";
        if !is_command && entry.place != "report-link" && entry.place != "sensor" {
            continue;
        }
        for spot in entry.spots {
            let fits = |name: &str| name.starts_with(spot.0) && name.ends_with(spot.1);
            let kinds: Vec<Kind> = match is_command {
                true => commands.iter().filter(|(name, _)| fits(name)).map(|(_, kind)| *kind).collect(),
                false => signals.iter().filter(|signal| fits(&signal.name)).map(|signal| signal.kind).collect(),
            };
            assert!(!kinds.is_empty(), "{}: {spot:?} is no signal", entry.effect);
            for kind in kinds {
                let mut quirk = entry.quirk((spot.0, spot.1, 1.0), 0.4, &mut Dice::new(2, 0));
                quirk.parameters.push(("cycle".to_owned(), 0.02));
                let allowed = match entry.effect {
                    // A filter's stream stands at steps of 0.1 ms; the link follows between them.
                    "input-filter" => 2e-3,
                    // On its way from its first point to its second, which comes late, the stream is on a line.
                    "dead-time" | "clock-drift" => 1e-3,
                    _ => 1e-9,
                };
                let differ = differing(&quirk, kind, is_command || kind.is_edge(), allowed);
                assert_eq!(differ, 0, "{} of a {kind:?} at {spot:?}", entry.effect);
                checked += 1;
            }
        }
    }
    assert!(checked > 80, "{checked} effects only: the catalogue has moved");
}

#[test]
fn the_filter_of_a_flag_or_a_code_is_the_same_while_it_happens() {
    for kind in [Kind::Flag, Kind::Code] {
        for time in [0.03, 0.2, 0.7] {
            let filter = crate::bench::quirk("D", "input-filter", &[("time_constant", time)]);
            assert_eq!(differing(&filter, kind, true, 1e-9), 0, "{kind:?} {time}");
        }
    }
}
