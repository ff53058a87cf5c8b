//! Two that meet, at known times and depths.

use std::sync::Arc;

use super::*;
use crate::kinematics::{Block, DPose3, DVec3, Joint, Upright};
use crate::mesh::Mesh;
use crate::scene::{Assembly, NodeId, Poses};

const GREY: [u8; 3] = [100; 3];

/// A cuboid about the origin, or a wedge: the lower half of one, cut from edge to edge.
fn mesh(assembly: &mut Assembly, size: DVec3, is_wedge: bool) -> crate::scene::MeshId {
    assembly.mesh(&format!("{size} {is_wedge}"), |mesh: &mut Mesh| {
        let h = size / 2.0;
        let corner = |index: u32| {
            let side = |bit: u32| if index & (1 << bit) == 0 { -1.0 } else { 1.0 };
            DVec3::new(side(0), side(1), side(2)) * h
        };
        let faces: &[[u32; 3]] = if is_wedge {
            &[[0, 3, 1], [0, 2, 3], [0, 1, 4], [2, 6, 3], [0, 4, 6], [0, 6, 2], [1, 3, 6], [1, 6, 4]]
        } else {
            &[
                [0, 2, 3],
                [0, 3, 1],
                [4, 5, 7],
                [4, 7, 6],
                [0, 1, 5],
                [0, 5, 4],
                [2, 6, 7],
                [2, 7, 3],
                [0, 4, 6],
                [0, 6, 2],
                [1, 3, 7],
                [1, 7, 5],
            ]
        };
        mesh.vertices = (0..8).map(|index| corner(index).to_array().map(|x| x as f32)).collect();
        mesh.triangles = faces.to_vec();
    })
}

/// A block of 0.2 that slides along x from 0, and another of 0.2 that stands at `at`.
fn bench(at: DVec3, is_wedge: bool) -> (Poses, NodeId) {
    let mut assembly = Assembly::default();
    let cube = mesh(&mut assembly, DVec3::splat(0.2), false);
    let other = mesh(&mut assembly, DVec3::splat(0.2), is_wedge);
    let slider = assembly.instance(0, "Slider", None, DPose3::IDENTITY);
    let slide = assembly.frame(slider, "Slide", DPose3::IDENTITY, Joint::prismatic(DVec3::X, [0.0, 9.0]));
    assembly.solid(slide, cube, DPose3::IDENTITY, GREY);
    let wall = assembly.instance(1, "Wall", None, DPose3::from_translation(at));
    assembly.solid(wall, other, DPose3::IDENTITY, GREY);
    let poses = Poses::new(Arc::new(assembly.finish()));
    let slide = poses.scene().find("Slider.Slide").expect("it");
    (poses, slide)
}

/// Where the slider first runs into the wall, by steps of 1 mm up to 2 m, how deep, and how many pairs were asked.
fn first(at: DVec3, is_wedge: bool) -> (Option<(usize, f64)>, u64) {
    let (mut poses, slide) = bench(at, is_wedge);
    let mut world = World::new(&poses);
    let mut found = Vec::new();
    let mut first = None;
    for step in 1..=2000 {
        poses.set(slide, step as f64 * 1e-3);
        poses.resolve();
        world.step(&poses, std::iter::empty(), &mut found);
        if let (None, [clash]) = (first, found.as_slice()) {
            first = Some((step, clash.depth));
        }
    }
    assert!(found.len() <= 1, "a pair is told once: {found:?}");
    (first, world.asked())
}

#[test]
fn a_slider_runs_into_a_wall_when_it_gets_there() {
    let (found, asked) = first(DVec3::new(1.0, 0.0, 0.0), false);
    let (step, depth) = found.expect("a collision");
    assert!((step, (depth - 1e-3).abs() < 1e-8) == (801, true), "step {step}, depth {depth}");
    // Through 400 steps of it the pair is asked at each; the way there and away costs a few looks.
    assert!(asked < 600, "{asked} pairs asked");
    assert_eq!(first(DVec3::new(1.0, 0.2001, 0.0), false).0, None);
    assert_eq!(first(DVec3::new(1.0, 0.20, 0.0), false).0, None, "side by side is no collision");
    assert!(first(DVec3::new(1.0, 0.199, 0.0), false).0.is_some());
}

#[test]
fn where_boxes_overlap_the_triangles_decide() {
    // The wedge's upper half towards +x is empty: above it the slider passes, its lower edge along the slope.
    let above = first(DVec3::new(1.0, 0.0, -0.15), true).0;
    let box_alone = first(DVec3::new(1.0, 0.0, -0.15), false).0;
    assert_eq!(box_alone.map(|(step, _)| step), Some(801));
    let (step, _) = above.expect("it runs up against the wedge's back");
    assert_eq!(step, 801, "the ridge is at its back, at x = 0.9");
    // Shifted so that only the empty corner of the wedge's box is met.
    let (mut poses, slide) = bench(DVec3::new(0.0, 0.0, -0.15), true);
    poses.set(slide, 0.16);
    poses.resolve();
    let mut world = World::new(&poses);
    let mut found = Vec::new();
    for step in 0..60 {
        poses.set(slide, 0.16 - f64::from(step) * 1e-3);
        poses.resolve();
        world.step(&poses, std::iter::empty(), &mut found);
    }
    // The slope falls by 1 in 1 from z = -0.05 at x = -0.1; at the slider's lower edge, z = -0.1, it is at x = -0.05: the
    // slider's left face, at its place less 0.1, gets there at 0.05, and the boxes overlap from the start.
    assert_eq!(found.len(), 0, "{found:?}");
    for step in 60..140 {
        poses.set(slide, 0.16 - f64::from(step) * 1e-3);
        poses.resolve();
        world.step(&poses, std::iter::empty(), &mut found);
        if !found.is_empty() {
            assert!((109..=112).contains(&step), "at step {step}");
            return;
        }
    }
    panic!("it never ran into the slope");
}

#[test]
fn what_is_in_contact_at_the_start_may_touch() {
    let (mut poses, slide) = bench(DVec3::new(0.15, 0.0, 0.0), false);
    let mut world = World::new(&poses);
    assert_eq!(world.pairs_left_out().collect::<Vec<_>>(), [["Slider.Slide", "Wall"]]);
    let mut found = Vec::new();
    for step in 0..500 {
        poses.set(slide, f64::from(step % 100) * 1e-3);
        poses.resolve();
        world.step(&poses, std::iter::empty(), &mut found);
    }
    assert_eq!(found, []);
}

#[test]
fn parts_run_into_what_moves_and_what_stands_and_not_into_each_other() {
    let (mut poses, slide) = bench(DVec3::new(1.0, 0.0, 0.0), false);
    let mut world = World::new(&poses);
    let mut blocks: Vec<Block> =
        [0.3, 0.35].iter().map(|y| Block::new(DVec3::splat(0.1), Upright::new(0.5, *y, -0.05, 0.0))).collect();
    let mut found = Vec::new();
    let mut told = Vec::new();
    for step in 0..1000 {
        // The first goes along x at y = 0.14, in reach of nobody, then is put before the slider.
        let x = 0.5 + f64::from(step) * 1e-3;
        blocks[0].move_to(Upright::new(x, if step < 200 { 0.16 } else { 0.0 }, -0.05, 0.0));
        poses.set(slide, if step < 600 { 0.0 } else { 0.0 + f64::from(step - 600) * 4e-3 });
        poses.resolve();
        let parts = blocks.iter().enumerate().map(|(slot, block)| Part { slot, number: slot as u64 + 1, block });
        world.step(&poses, parts, &mut found);
        told.extend(found.drain(..).map(|clash| (step, clash.between)));
    }
    let wall = poses.scene().find("Wall").expect("it");
    assert_eq!(told[0], (351, [Obstacle::Link(wall), Obstacle::Part(1)]));
    // It went through the wall; then the slider, faster, comes from behind and runs into the wall first.
    assert!(told.iter().any(|(_, pair)| *pair == [Obstacle::Link(slide), Obstacle::Link(wall)]), "{told:?}");
    assert!(told.iter().all(|(_, pair)| !pair.contains(&Obstacle::Part(2))), "{told:?}");
}

#[test]
fn a_part_that_went_is_forgotten_and_its_place_taken_again() {
    let (poses, slide) = bench(DVec3::new(1.0, 0.0, 0.0), false);
    let mut world = World::new(&poses);
    let block = Block::new(DVec3::splat(0.1), Upright::new(0.12, 0.0, -0.05, 0.0));
    let away = Block::new(DVec3::splat(0.1), Upright::new(0.5, 0.0, -0.05, 0.0));
    let mut found = Vec::new();
    let mut step = |number: u64, block: &Block| {
        world.step(&poses, std::iter::once(Part { slot: 3, number, block }), &mut found);
        std::mem::take(&mut found).iter().map(|clash| clash.between).collect::<Vec<_>>()
    };
    assert_eq!(step(7, &block), [[Obstacle::Link(slide), Obstacle::Part(7)]]);
    assert!(step(7, &block).is_empty());
    assert!(step(8, &away).is_empty());
    assert_eq!(step(9, &block), [[Obstacle::Link(slide), Obstacle::Part(9)]]);
}
