//! The floor by itself: belts, plates and cups that the test moves by hand.

use std::f64::consts::FRAC_PI_2;

use proptest::prelude::*;

use super::contact::CONTACT_M;
use super::*;
use crate::device::{Load, Place, Sink, Source};
use crate::kinematics::{Shape, TOUCH_M, separation};
use crate::plant::PartKind;

const SIDE: f64 = 0.3;

fn belt(shape: Shape, x: f64, y: f64, yaw: f64) -> BeltBody {
    let surface = Surface::new(shape, &Upright::new(x, y, 0.0, yaw).pose());
    BeltBody {
        name: format!("belt at {x}, {y}"),
        surface,
        transfer: Transfer::Most,
        transfer_slip: 0.0,
        grip: f64::INFINITY,
        displacement: 0.0,
        speeds: [0.0; 2],
        neighbours: Vec::new(),
        open: [true; 2],
        drains: Vec::new(),
        beams: [None; 2],
        clear: Default::default(),
    }
}

pub(super) fn straight(x: f64, y: f64, length: f64, yaw: f64) -> BeltBody {
    belt(Shape::Straight { length, width: 0.6 }, x, y, yaw)
}

pub(super) fn floor(belts: Vec<BeltBody>) -> Floor {
    let mut floor = Floor { belts, ..Floor::default() };
    floor.connect_belts();
    floor
}

/// Puts a box on whatever is there at a place.
pub(super) fn box_at(floor: &mut Floor, x: f64, y: f64) -> Slot {
    part_at(floor, PartKind::Box, [SIDE, SIDE, 0.2], x, y)
}

fn part_at(floor: &mut Floor, kind: PartKind, size: [f64; 3], x: f64, y: f64) -> Slot {
    let block = Block::new(DVec3::from_array(size), Upright::new(x, y, 9.0, 0.0));
    let (height, support) = floor.beneath(&block, None).expect("something to stand on");
    let block = Block::new(block.size(), Upright::new(x, y, height, 0.0));
    floor.enter(kind, block, support)
}

fn plate(x: f64, y: f64, yaw: f64) -> PlateBody {
    let plate = Plate {
        position: 0.0,
        displacement: 0.0,
        size: [0.8, 0.4, 0.15],
        barriers: [Some(0.35), None],
        beam_height: 0.05,
    };
    PlateBody::new("plate", &Upright::new(x, y, 0.02, yaw).pose(), &plate)
}

fn cups(x: f64, y: f64, z: f64) -> CupsBody {
    let rim = DPose3::translation(x, y, z);
    CupsBody { name: "cups".to_owned(), rim, reach: 0.01, vacuum: false, always_sealed: false, held: None }
}

fn source(at: f64, size: [f64; 3]) -> Source {
    let due = vec![0.0];
    Source { at: [at, 0.0], turn: 0.0, kind: PartKind::Box, size, load: None, limit: None, due }
}

fn place(floor: &Floor, slot: Slot) -> DVec3 {
    floor.parts.get(slot).block.upright().place
}

fn check_place(floor: &Floor, slot: Slot, x: f64, y: f64, z: f64) {
    let found = place(floor, slot);
    assert!((found - DVec3::new(x, y, z)).length() < 2.0 * CONTACT_M, "{found} is not {x}, {y}, {z}");
}

/// Steps of 1 ms in which every belt moves by its entry of `ways`.
fn run(floor: &mut Floor, steps: usize, ways: &[f64]) {
    for _ in 0..steps {
        for (belt, way) in floor.belts.iter_mut().zip(ways) {
            belt.displacement = *way;
        }
        floor.advance(Instant::ZERO, 1e-3);
    }
}

/// Steps in which the only plate moves by `way`, from `position`, beside the belts.
fn run_plate(floor: &mut Floor, steps: usize, position: &mut f64, way: f64, ways: &[f64]) {
    for _ in 0..steps {
        *position += way;
        floor.plates[0].set(*position, way, 0.8);
        run(floor, 1, ways);
    }
    floor.plates[0].set(*position, 0.0, 0.8);
}

fn deepest(floor: &Floor) -> f64 {
    let blocks: Vec<Block> = floor.parts.iter().map(|(_, part)| part.block).collect();
    let mut deepest: f64 = 0.0;
    for (index, first) in blocks.iter().enumerate() {
        for second in &blocks[index + 1..] {
            deepest = deepest.max(-separation(first, second).0);
        }
    }
    deepest
}

#[test]
fn a_part_moves_with_its_belt() {
    let mut floor = floor(vec![straight(0.0, 0.0, 2.0, 0.0)]);
    let slot = box_at(&mut floor, 0.5, 0.1);
    run(&mut floor, 100, &[1e-3]);
    check_place(&floor, slot, 0.6, 0.1, 0.0);
}

/// A belt that goes up to 0.5 m/s within 0.25 s, and parts that follow half as steeply: one that was there loses ½·0.5·(0.5 − 0.25) m, one that
/// was put there half way up a quarter of that. Where the belt then stops at once both slide on by ½·0.5²/1 m.
#[test]
fn parts_slide_each_by_itself() {
    let mut floor = floor(vec![straight(0.0, 0.0, 4.0, 0.0)]);
    floor.belts[0].grip = 1.0;
    let move_belt = |floor: &mut Floor, from: f64, to: f64, seconds: f64| {
        let steps = (seconds * 1e3).round();
        let speed = |step: f64| from + (to - from) * step / steps;
        for step in 0..steps as u32 {
            let speeds = [speed(f64::from(step)), speed(f64::from(step + 1))];
            floor.belts[0].speeds = speeds;
            run(floor, 1, &[0.5e-3 * (speeds[0] + speeds[1])]);
        }
    };
    let first = box_at(&mut floor, 0.5, 0.0);
    move_belt(&mut floor, 0.0, 0.25, 0.125);
    let second = box_at(&mut floor, 2.0, 0.0);
    move_belt(&mut floor, 0.25, 0.5, 0.125);
    move_belt(&mut floor, 0.5, 0.5, 0.75);
    check_place(&floor, first, 0.5 + 0.4375 - 0.0625, 0.0, 0.0);
    check_place(&floor, second, 2.0 + 0.4375 - 0.015625 - 0.015625, 0.0, 0.0);
    floor.belts[0].speeds = [0.5, 0.0];
    run(&mut floor, 1, &[0.0]);
    move_belt(&mut floor, 0.0, 0.0, 1.0);
    for (slot, start) in [(first, 0.875), (second, 2.40625)] {
        let slid = place(&floor, slot).x - start;
        // The step in which it stopped is one at an even deceleration.
        assert!((slid - 0.125).abs() < 5e-4, "{slid}");
        assert_eq!(floor.parts.get(slot).slider.velocity(), None);
    }
}

#[test]
fn a_part_changes_to_the_belt_that_carries_most_of_it() {
    let mut floor = floor(vec![straight(0.0, 0.0, 1.0, 0.0), straight(1.0, 0.0, 1.0, 0.0)]);
    let slot = box_at(&mut floor, 0.9, 0.0);
    // The second belt stands: the part goes on until just more than half of it is there.
    run(&mut floor, 300, &[1e-3, 0.0]);
    assert!((1.0..1.0011).contains(&place(&floor, slot).x), "{}", place(&floor, slot));
    run(&mut floor, 100, &[0.0, 2e-3]);
    assert!((1.2..1.2011).contains(&place(&floor, slot).x), "{}", place(&floor, slot));
}

#[test]
fn transfer_by_share_mixes_the_two_speeds() {
    let mut floor = floor(vec![straight(0.0, 0.0, 1.0, 0.0), straight(1.0, 0.0, 1.0, 0.0)]);
    floor.belts[0].transfer = Transfer::Share;
    let slot = box_at(&mut floor, 0.95, 0.0);
    run(&mut floor, 1, &[1e-3, 4e-3]);
    // A third stands on the second belt.
    check_place(&floor, slot, 0.95 + 2e-3, 0.0, 0.0);
}

#[test]
fn a_curve_turns_a_part_by_its_angle() {
    let curve = Shape::Curve { radius: 0.8, angle: FRAC_PI_2, width: 0.6 };
    let belts = vec![straight(0.0, 0.0, 1.0, 0.0), belt(curve, 1.0, 0.0, 0.0), straight(1.8, 0.8, 2.0, FRAC_PI_2)];
    let mut floor = floor(belts);
    let slot = box_at(&mut floor, 0.5, 0.0);
    run(&mut floor, 2500, &[1e-3; 3]);
    let upright = floor.parts.get(slot).block.upright();
    assert!((upright.yaw - FRAC_PI_2).abs() < 2e-3, "{}", upright.yaw);
    assert!((upright.place.x - 1.8).abs() < 2e-3 && upright.place.y > 1.4, "{}", upright.place);
}

#[test]
fn blocked_parts_queue() {
    let mut floor = floor(vec![straight(0.0, 0.0, 4.0, 0.0), straight(4.0, 0.0, 1.0, 0.0)]);
    let head = box_at(&mut floor, 4.1, 0.0);
    let queue: Vec<Slot> = [0.4, 1.2, 2.0, 2.31].map(|x| box_at(&mut floor, x, 0.0)).to_vec();
    run(&mut floor, 3500, &[1e-3, 0.0]);
    check_place(&floor, head, 4.1, 0.0, 0.0);
    for (index, &slot) in queue.iter().rev().enumerate() {
        let x = place(&floor, slot).x;
        let expected = 4.1 - SIDE * (index + 1) as f64;
        assert!(x <= expected + TOUCH_M && x > expected - 6.0 * CONTACT_M, "{x} is not {expected}");
    }
    assert_eq!(floor.counts().collisions, 0);
    // When the way is free they go on together.
    run(&mut floor, 100, &[1e-3, 1e-3]);
    assert!((place(&floor, queue[0]).x - (4.2 - 4.0 * SIDE)).abs() < 1e-4, "{}", place(&floor, queue[0]));
}

#[test]
fn parts_leave_when_their_centre_passes_an_open_end() {
    let mut forwards = floor(vec![straight(0.0, 0.0, 1.0, 0.0)]);
    box_at(&mut forwards, 0.9, 0.0);
    run(&mut forwards, 100, &[1e-3]);
    assert_eq!(forwards.counts().boxes_present, 1);
    run(&mut forwards, 2, &[1e-3]);
    let expected = PartCounts { boxes_in: 1, boxes_out: 1, ..PartCounts::default() };
    assert_eq!(forwards.counts(), expected);
    let mut backwards = floor(vec![straight(0.0, 0.0, 1.0, 0.0)]);
    box_at(&mut backwards, 0.1, 0.0);
    run(&mut backwards, 102, &[-1e-3]);
    assert_eq!(backwards.counts(), expected);
}

#[test]
fn a_part_pushed_off_the_side_is_lost_and_said_where() {
    let mut floor = floor(vec![straight(0.0, 0.0, 2.0, 0.0)]);
    floor.add_plate(plate(1.0, -0.5, FRAC_PI_2));
    box_at(&mut floor, 1.0, 0.0);
    run_plate(&mut floor, 700, &mut 0.0, 1e-3, &[0.0]);
    assert_eq!(floor.counts(), PartCounts { boxes_in: 1, boxes_lost: 1, ..PartCounts::default() });
    let text = floor.tally.incidents[0].to_string();
    assert!(text.contains("box 1 fell from belt at 0, 0 at x 1.000, y 0.30"), "{text}");
}

#[test]
fn a_plate_pushes_a_row_of_parts_onto_another_belt() {
    let mut floor = floor(vec![straight(0.0, 0.0, 2.0, 0.0), straight(0.0, 0.65, 2.0, 0.0)]);
    floor.add_plate(plate(1.0, -0.35, FRAC_PI_2));
    let first = box_at(&mut floor, 1.0, -0.05);
    let second = box_at(&mut floor, 1.05, 0.27);
    let mut position = 0.0;
    run_plate(&mut floor, 375, &mut position, 2e-3, &[0.0, 0.0]);
    check_place(&floor, first, 1.0, 0.4 + SIDE / 2.0, 0.0);
    check_place(&floor, second, 1.05, 0.4 + SIDE * 1.5, 0.0);
    assert_eq!(floor.parts.get(first).support, Support::Belt(1));
    // Back again, it leaves them there; they go with their new belt.
    run_plate(&mut floor, 375, &mut position, -2e-3, &[1e-3, 0.0]);
    check_place(&floor, first, 1.0, 0.4 + SIDE / 2.0, 0.0);
    run(&mut floor, 100, &[0.0, 1e-3]);
    check_place(&floor, second, 1.15, 0.4 + SIDE * 1.5, 0.0);
    assert_eq!(floor.counts().collisions, 0);
}

#[test]
fn a_part_that_runs_into_the_side_of_a_plate_waits() {
    let mut floor = floor(vec![straight(0.0, 0.0, 4.0, 0.0)]);
    floor.add_plate(plate(2.0, -0.35, FRAC_PI_2));
    let slot = box_at(&mut floor, 1.0, 0.0);
    let mut position = 0.0;
    run_plate(&mut floor, 300, &mut position, 2e-3, &[0.0]);
    run(&mut floor, 1000, &[1e-3]);
    check_place(&floor, slot, 1.8 - SIDE / 2.0, 0.0, 0.0);
    run_plate(&mut floor, 300, &mut position, -2e-3, &[1e-3]);
    assert!(place(&floor, slot).x > 1.74, "{}", place(&floor, slot));
    assert_eq!(floor.counts().collisions, 0);
}

/// A robot set one into the other, as it does in a replay whose line stands.
#[test]
fn parts_in_one_another_are_pushed_and_do_not_push_each_other_back() {
    let mut floor = floor(vec![straight(0.0, 0.0, 4.0, 0.0)]);
    floor.add_plate(plate(2.0, -0.5, FRAC_PI_2));
    for (x, y) in [(2.0, 0.0), (2.0, 0.05), (2.02, -0.02)] {
        let block = Block::new(DVec3::new(SIDE, SIDE, 0.2), Upright::new(x, y, 0.0, 0.0));
        floor.enter(PartKind::Box, block, Support::Belt(0));
    }
    run_plate(&mut floor, 450, &mut 0.0, 1e-3, &[0.0]);
    for (_, part) in floor.parts.iter() {
        let y = part.block.upright().place.y;
        assert!((0.1 - CONTACT_M..0.3).contains(&y), "{y}");
    }
}

#[test]
fn what_is_crushed_between_two_plates_is_counted_once() {
    let mut floor = floor(vec![straight(0.0, 0.0, 4.0, 0.0)]);
    floor.add_plate(plate(2.0, -0.35, FRAC_PI_2));
    floor.add_plate(plate(2.0, 0.36, -FRAC_PI_2));
    box_at(&mut floor, 2.0, 0.0);
    run_plate(&mut floor, 420, &mut 0.0, 1e-3, &[0.0]);
    assert_eq!(floor.counts().collisions, 1);
    let text = floor.tally.incidents[0].to_string();
    assert!(text.contains("box 1 and the plate of plate are 1.0 mm in one another"), "{text}");
}

#[test]
fn boxes_ride_on_a_pallet_and_leave_with_it() {
    let mut floor = floor(vec![straight(0.0, 0.0, 4.0, 0.0)]);
    let pallet = part_at(&mut floor, PartKind::Pallet, [1.2, 0.5, 0.14], 1.0, 0.0);
    let lower = box_at(&mut floor, 0.8, 0.0);
    let upper = box_at(&mut floor, 0.85, 0.1);
    assert_eq!(floor.parts.get(upper).support, Support::Part(lower));
    run(&mut floor, 500, &[1e-3]);
    check_place(&floor, upper, 1.35, 0.1, 0.34);
    assert_eq!(floor.parts.root_of(upper), pallet);
    run(&mut floor, 2600, &[1e-3]);
    let counts = floor.counts();
    assert_eq!((counts.boxes_out, counts.pallets_out, counts.boxes_present), (2, 1, 0));
}

#[test]
fn cups_take_a_part_along_and_put_it_down_on_what_is_beneath() {
    let mut floor = floor(vec![straight(0.0, 0.0, 2.0, 0.0), straight(0.0, 2.0, 2.0, 0.0)]);
    part_at(&mut floor, PartKind::Pallet, [1.2, 0.5, 0.14], 1.0, 0.0);
    let slot = box_at(&mut floor, 1.0, 0.0);
    floor.add_cups(cups(1.05, 0.02, 0.345));
    assert!(floor.about_cups(0).sealed);
    floor.cups[0].vacuum = true;
    run(&mut floor, 1, &[0.0, 0.0]);
    assert_eq!(floor.parts.get(slot).support, Support::Cups(0));
    // Lifted, turned a quarter about the cups, set down 3 mm above the other belt.
    let turned = crate::kinematics::DQuat::from_rotation_z(FRAC_PI_2);
    floor.cups[0].rim = DPose3::from_parts(DVec3::new(1.05, 2.0, 0.208), turned);
    run(&mut floor, 1, &[1e-3, 1e-3]);
    check_place(&floor, slot, 1.07, 1.95, 0.003);
    floor.cups[0].vacuum = false;
    run(&mut floor, 1, &[0.0, 0.0]);
    check_place(&floor, slot, 1.07, 1.95, 0.0);
    assert_eq!(floor.parts.get(slot).support, Support::Belt(1));
    assert_eq!(floor.counts().collisions, 0);
}

#[test]
fn a_part_let_go_over_nothing_is_lost() {
    let mut floor = floor(vec![straight(0.0, 0.0, 2.0, 0.0)]);
    box_at(&mut floor, 1.0, 0.0);
    floor.add_cups(cups(1.0, 0.0, 0.2));
    floor.cups[0].vacuum = true;
    run(&mut floor, 1, &[0.0]);
    floor.cups[0].rim = DPose3::translation(1.0, 3.0, 1.0);
    run(&mut floor, 1, &[0.0]);
    floor.cups[0].vacuum = false;
    run(&mut floor, 1, &[0.0]);
    assert_eq!(floor.counts().boxes_lost, 1);
    assert!(!floor.about_cups(0).sealed);
}

#[test]
fn a_part_carried_through_another_is_a_collision() {
    let mut floor = floor(vec![straight(0.0, 0.0, 4.0, 0.0)]);
    let slot = box_at(&mut floor, 1.0, 0.0);
    box_at(&mut floor, 2.0, 0.0);
    floor.add_cups(cups(1.0, 0.0, 0.2));
    floor.cups[0].vacuum = true;
    for step in 0..2000 {
        floor.cups[0].rim = DPose3::translation(1.0 + 1e-3 * f64::from(step), 0.0, 0.2);
        run(&mut floor, 1, &[0.0]);
    }
    assert!(place(&floor, slot).x > 2.9);
    assert_eq!(floor.counts().collisions, 1);
}

#[test]
fn a_bay_skips_an_instant_while_its_place_is_taken() {
    let mut floor = floor(vec![straight(0.0, 0.0, 2.0, 0.0)]);
    floor.bays.push(Bay { belt: 0, source: source(0.15, [SIDE, 0.2, 0.2]), made: 0 });
    // Due in every step: the place is free again when the last one's rear has passed 0.3.
    run(&mut floor, 1, &[0.0]);
    assert_eq!(floor.counts().boxes_in, 1);
    run(&mut floor, 299, &[1e-3]);
    assert_eq!(floor.counts().boxes_in, 1);
    run(&mut floor, 2, &[1e-3]);
    assert_eq!(floor.counts().boxes_in, 2);
    floor.bays[0].source.limit = Some(2);
    run(&mut floor, 1000, &[1e-3]);
    assert_eq!(floor.counts().boxes_in, 2);
}

#[test]
fn a_part_due_within_a_step_has_moved_since() {
    let mut floor = floor(vec![straight(0.0, 0.0, 2.0, 0.0)]);
    floor.bays.push(Bay { belt: 0, source: source(0.5, [SIDE, 0.2, 0.2]), made: 0 });
    floor.bays[0].source.due = vec![0.25e-3];
    run(&mut floor, 1, &[1e-3]);
    let slot = floor.parts.roots()[0];
    check_place(&floor, slot, 0.50025, 0.0, 0.0);
}

#[test]
fn a_bay_puts_a_loaded_pallet() {
    let mut floor = floor(vec![straight(0.0, 0.0, 3.0, 0.0)]);
    let load = Load { kind: PartKind::Box, size: [0.36, 0.32, 0.24], counts: [3, 2, 2], gap: 0.04 };
    let source = Source { kind: PartKind::Pallet, load: Some(load), ..source(0.7, [1.2, 0.8, 0.144]) };
    floor.bays.push(Bay { belt: 0, source, made: 0 });
    run(&mut floor, 2, &[0.0]);
    let counts = floor.counts();
    assert_eq!((counts.boxes_in, counts.pallets_in, counts.collisions), (12, 1, 0));
    let mut places: Vec<[f64; 3]> = floor.parts.iter().map(|(_, part)| part.block.upright().place.to_array()).collect();
    places.sort_by(|a, b| a.partial_cmp(b).expect("no NaN"));
    for (found, expected) in places[..2].iter().zip([[0.3, -0.18, 0.144], [0.3, -0.18, 0.384]]) {
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} is not {expected:?}");
    }
}

fn drain(place: Place, kind: Option<PartKind>, delay: f64) -> Drain {
    Drain { name: "drain".to_owned(), belt: 0, sink: Sink { place, kind, delay } }
}

#[test]
fn an_unloading_bay_takes_what_passes_its_place() {
    for (place, way, x) in [(Place::At(1.0), 1e-3, 0.5), (Place::At(1.0), -1e-3, 1.5), (Place::End, 1e-3, 1.5)] {
        let mut floor = floor(vec![straight(0.0, 0.0, 2.0, 0.0), straight(2.0, 0.0, 1.0, 0.0)]);
        floor.add_drain(drain(place, Some(PartKind::Box), 0.0));
        box_at(&mut floor, x, 0.0);
        run(&mut floor, 499, &[way, 0.0]);
        assert_eq!(floor.counts().boxes_present, 1, "{place:?}");
        run(&mut floor, 2, &[way, 0.0]);
        assert_eq!(floor.counts().boxes_out, 1, "{place:?}");
    }
}

#[test]
fn an_unloading_bay_passes_what_is_not_its_kind() {
    let mut floor = floor(vec![straight(0.0, 0.0, 2.0, 0.0)]);
    floor.add_drain(drain(Place::At(1.0), Some(PartKind::Pallet), 0.0));
    box_at(&mut floor, 0.9, 0.0);
    run(&mut floor, 500, &[1e-3]);
    assert_eq!(floor.counts().boxes_present, 1);
}

#[test]
fn a_part_stays_at_an_unloading_bay_for_its_time() {
    let mut floor = floor(vec![straight(0.0, 0.0, 2.0, 0.0)]);
    floor.add_drain(drain(Place::End, None, 0.5));
    box_at(&mut floor, 1.9, 0.0);
    run(&mut floor, 550, &[1e-3]);
    assert_eq!(floor.counts().boxes_present, 1);
    assert!((place(&floor, floor.parts.roots()[0]).x - 2.0).abs() < 2e-3);
    run(&mut floor, 60, &[1e-3]);
    assert_eq!(floor.counts().boxes_out, 1);
}

#[test]
fn beams_see_parts_on_belts_and_before_plates() {
    let mut floor = floor(vec![straight(0.0, 0.0, 2.0, 0.0)]);
    floor.belts[0].beams = [Some(floor.belts[0].surface.beam(0.3, 0.05)), Some(floor.belts[0].surface.beam(0.6, 0.05))];
    floor.add_plate(plate(1.0, -0.35, FRAC_PI_2));
    box_at(&mut floor, 0.15, 0.0);
    let seen = |floor: &Floor| (floor.at_belt(0).barrier_a, floor.at_belt(0).barrier_b, floor.at_plate(0).barrier_a);
    assert_eq!(seen(&floor), (false, false, false));
    run(&mut floor, 1, &[1e-3]);
    assert_eq!(seen(&floor), (true, false, false));
    run(&mut floor, 400, &[1e-3]);
    assert_eq!(seen(&floor), (false, true, false));
    run(&mut floor, 300, &[1e-3]);
    assert_eq!(seen(&floor), (false, false, true));
}

/// A floor on which much happens: two belts in line, one beside them, a plate across, boxes at random.
fn busy(places: &[(f64, f64)], reversed: bool) -> Floor {
    let mut floor =
        floor(vec![straight(0.0, 0.0, 3.0, 0.0), straight(3.0, 0.0, 2.0, 0.0), straight(1.0, 0.65, 3.0, 0.0)]);
    floor.add_plate(plate(2.0, -0.35, FRAC_PI_2));
    let mut put: Vec<(f64, f64)> = Vec::new();
    for &(x, y) in places {
        if put.iter().all(|(a, b): &(f64, f64)| (a - x).abs() > SIDE + 0.01 || (b - y).abs() > SIDE + 0.01) {
            put.push((x, y));
        }
    }
    if reversed {
        put.reverse();
    }
    put.into_iter().for_each(|(x, y)| {
        box_at(&mut floor, x, y);
    });
    floor
}

fn drive(floor: &mut Floor, ways: [f64; 3], plate: f64) {
    let mut position = 0.0;
    run(floor, 200, &ways);
    run_plate(floor, (0.75 / plate) as usize, &mut position, plate, &ways);
    run(floor, 200, &ways);
    run_plate(floor, (0.75 / plate) as usize, &mut position, -plate, &ways);
    run(floor, 300, &ways);
}

/// The places of all parts, sorted.
fn places(floor: &Floor) -> Vec<DVec3> {
    floor.parts.iter().map(|(_, part)| part.block.upright().place).collect()
}

/// The place of `some` that has no place of `others` within `reach` to itself. Parts have no names, and two of them side by
/// side have no order either.
fn alone(some: &[DVec3], others: &[DVec3], reach: f64) -> Option<DVec3> {
    let mut left = others.to_vec();
    some.iter().copied().find(|place| {
        let beside = left.iter().position(|other| (*other - *place).length() < reach);
        beside.map(|at| left.swap_remove(at)).is_none()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Whatever stands there and however the belts run: nothing gets into anything, nothing gets lost unseen, and, unless
    /// belts run against one another, the order in which the parts came in makes no difference.
    #[test]
    fn parts_never_go_through_one_another(
        spots in prop::collection::vec((0.2..4.8f64, -0.14..0.14f64), 1..14),
        first in -2e-3..2e-3f64, second in -2e-3..2e-3f64, third in -2e-3..2e-3f64, plate in 1e-3..4e-3f64,
    ) {
        let mut floor = busy(&spots, false);
        let mut other = busy(&spots, true);
        drive(&mut floor, [first, second, third], plate);
        drive(&mut other, [first, second, third], plate);
        prop_assert!(deepest(&floor) < 1e-6, "{} m in one another", deepest(&floor));
        let counts = floor.counts();
        prop_assert_eq!(counts.collisions, 0);
        prop_assert_eq!(counts.boxes_in, counts.boxes_out + counts.boxes_lost + counts.boxes_present);
        // Between belts that run against one another parts are held at a seam, where the least difference, that of a few
        // contacts, decides which belt carries a part or who comes first.
        let ways = [first, second, third];
        if ways.iter().any(|way| *way > 0.0) && ways.iter().any(|way| *way < 0.0) {
            return Ok(());
        }
        let (places, others) = (places(&floor), places(&other));
        prop_assert_eq!(places.len(), others.len());
        let alone = alone(&places, &others, 2e-5);
        prop_assert!(alone.is_none(), "{alone:?} of {places:?} is in none of {others:?}: the order of coming in matters");
    }
}

/// Found by the test above: two parts whose places along the belt differ by less than they do by the order of coming in.
#[test]
fn the_order_of_coming_in_makes_no_difference_to_parts_side_by_side() {
    let spots = [(2.63975071417716, 0.0), (3.24352731358734, 0.06168569064283313), (2.10182026557651, 0.0)];
    let [floor, other] = [false, true].map(|reversed| {
        let mut floor = busy(&spots, reversed);
        drive(&mut floor, [0.0006478297222830095, -0.0018610103804126267, 0.001776827915147979], 0.0029629286754542135);
        places(&floor)
    });
    assert_eq!(floor.len(), other.len());
    assert_eq!(alone(&floor, &other, 2e-5), None);
}
