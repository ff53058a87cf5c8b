//! What the shape of a plant costs: a step of the de-palletizer with all sensors and collision pairs beside a plain parry3d
//! program that asks the same of the same triangles; a step by how many devices stand still; kinematics alone; loading.
//!
//! `cargo bench --bench scene` prints the table of docs/performance.md first: means, quantiles and ratios of one run.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use hdrhistogram::Histogram;
use kinetwin::device::KINDS;
use kinetwin::engine::Engine;
use kinetwin::kinematics::DVec3;
use kinetwin::plant::embedded::Embedded;
use kinetwin::plant::{Plant, load};
use kinetwin::prototype::source::{Layered, Memory};
use kinetwin::scene::{Poses, Scene};
use kinetwin::signal_map::RegisterId;
use kinetwin::value::Value;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Pose;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::{Ray, RayCast, intersection_test};
use parry3d_f64::shape::{Cuboid, TriMesh};

const STEP: Duration = Duration::from_millis(1);

struct Line {
    plant: Plant,
    engine: Engine,
    there: Vec<(RegisterId, Value)>,
    back: Vec<(RegisterId, Value)>,
    step: u32,
}

impl Line {
    /// The de-palletizer, belts running, the gantry on its way, at home in a steady state.
    fn new(is_watched: bool) -> Line {
        let plant = load(&Embedded, "models/depalletizer", KINDS).expect("a model of ours");
        let mut engine = Engine::new(&plant, STEP, 1).expect("a plant that runs");
        if is_watched {
            engine.show(&plant, Arc::new(Scene::of(&plant)));
            engine.watch();
        }
        let commands = |wanted: &[(&str, f64)]| commands(&plant, wanted);
        let running = commands(&[(".velocityTarget", 0.1), (".motorDirection", 1.0)]);
        let there = commands(&[("Robot.XTarget", 0.4), ("Robot.YTarget", 1.2), ("Robot.RTarget", 1.57)]);
        let back = commands(&[("Robot.XTarget", -0.4), ("Robot.YTarget", 0.0), ("Robot.RTarget", 0.0)]);
        engine.tick(&running);
        let mut line = Line { there, back, plant, engine, step: 0 };
        (0..40_000).for_each(|_| line.tick());
        line
    }

    fn tick(&mut self) {
        self.step += 1;
        let inputs: &[(RegisterId, Value)] = match self.step % 4000 {
            0 => &self.there,
            2000 => &self.back,
            _ => &[],
        };
        self.engine.tick(inputs);
    }
}

fn commands(plant: &Plant, wanted: &[(&str, f64)]) -> Vec<(RegisterId, Value)> {
    let signals = plant.signal_map.signals().iter().enumerate();
    let wanted = |name: &str| wanted.iter().find(|(end, _)| name.ends_with(end)).map(|(_, value)| *value);
    signals
        .filter_map(|(index, it)| Some((RegisterId(index as u32), Value::from_f64(it.ty.element, wanted(&it.name)?))))
        .collect()
}

/// Mean and quantiles of `count` calls, µs.
fn measure(count: u32, mut call: impl FnMut()) -> (f64, f64, f64, f64) {
    let mut histogram = Histogram::<u64>::new_with_bounds(1, 10_000_000_000, 3).expect("bounds");
    for _ in 0..count {
        let begun = Instant::now();
        call();
        histogram.saturating_record(begun.elapsed().as_nanos() as u64);
    }
    let us = |ns: u64| ns as f64 / 1e3;
    (
        histogram.mean() / 1e3,
        us(histogram.value_at_quantile(0.5)),
        us(histogram.value_at_quantile(0.99)),
        us(histogram.max()),
    )
}

/// A program of a page: all triangles that stand still in one mesh, what moves as boxes in a tree of their own. At each step the
/// tree is made anew, every beam is cast at the boxes about it, and every moving box is asked whether it meets the mesh.
struct Plain {
    standing: TriMesh,
    /// Half sizes of what moves.
    boxes: Vec<(Pose, Cuboid)>,
    rays: Vec<(Ray, f64)>,
}

impl Plain {
    fn of(line: &Line) -> Plain {
        let poses = line.engine.poses().expect("shown");
        let scene = poses.scene();
        let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
        let mut boxes = Vec::new();
        for body in scene.bodies() {
            let mesh = &scene.meshes()[body.mesh.index()];
            let place = *poses.world(body.node) * body.place;
            let moves =
                scene.node(body.node).name.starts_with("Robot.") || scene.node(body.node).name.starts_with("Gripper");
            if moves {
                let [low, high] =
                    mesh.bounds().expect("vertices").map(|corner| DVec3::from_array(corner.map(f64::from)));
                boxes.push((place * Pose::from_translation((low + high) / 2.0), Cuboid::new((high - low) / 2.0)));
                continue;
            }
            let first = vertices.len() as u32;
            vertices.extend(mesh.vertices.iter().map(|v| place.transform_point(DVec3::from_array(v.map(f64::from)))));
            triangles.extend(mesh.triangles.iter().map(|t| t.map(|corner| first + corner)));
        }
        for part in line.engine.parts() {
            let size = DVec3::from_array(part.size);
            let centre = DVec3::from_array(part.place) + DVec3::new(0.0, 0.0, size.z / 2.0 + 1e-3);
            boxes.push((Pose::from_translation(centre), Cuboid::new(size / 2.0)));
        }
        let rays = scene.beams().iter().map(|beam| {
            let [from, to] = beam.ends.map(|end| poses.world(beam.node).transform_point(end));
            (Ray::new(from, (to - from).normalize()), (to - from).length())
        });
        Plain { rays: rays.collect(), standing: TriMesh::new(vertices, triangles).expect("a mesh"), boxes }
    }

    fn step(&mut self) -> usize {
        let mut met = 0;
        let leaves: Vec<Aabb> = self.boxes.iter().map(|(pose, cuboid)| cuboid.aabb(pose)).collect();
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &leaves);
        for (ray, length) in &self.rays {
            let around = Aabb::new(ray.origin, ray.origin).merged_with(ray.point_at(*length));
            for index in tree.intersect_aabb(&around) {
                let (pose, cuboid) = &self.boxes[index as usize];
                met += usize::from(cuboid.cast_ray(pose, ray, *length, true).is_some());
            }
        }
        for (pose, cuboid) in &self.boxes {
            let meets =
                intersection_test(&Pose::IDENTITY, &self.standing, pose, cuboid).is_ok_and(|found| found.intersecting);
            met += usize::from(meets);
        }
        met
    }
}

trait Grown {
    fn merged_with(self, point: DVec3) -> Aabb;
}

impl Grown for Aabb {
    fn merged_with(mut self, point: DVec3) -> Aabb {
        self.take_point(point);
        self
    }
}

/// A plant of `count` conveyors in rows, and one pusher.
fn generated(count: usize) -> Memory {
    let mut text =
        "<plant name=\"generated\">\n<instance name=\"Pusher\" prototype=\"Pusher\"><pose z=\"1\"/></instance>\n"
            .to_owned();
    for index in 0..count.saturating_sub(1) {
        let (row, column) = (index / 50, index % 50);
        let _ = writeln!(
            text,
            "<instance name=\"C{index}\" prototype=\"StraightConveyor\"><pose x=\"{}\" y=\"{}\" z=\"0.75\"/></instance>",
            3 + column * 3,
            row * 2
        );
    }
    text += "</plant>";
    Memory(BTreeMap::from([("generated/plant.xml".to_owned(), text)]))
}

fn loaded(files: Memory) -> (Plant, Engine) {
    let plant = load(&Layered(files, Embedded), "generated", KINDS).expect("a plant");
    let mut engine = Engine::new(&plant, STEP, 1).expect("an engine");
    engine.show(&plant, Arc::new(Scene::of(&plant)));
    engine.watch();
    (plant, engine)
}

fn table() {
    let mut watched = Line::new(true);
    let scene = Arc::clone(watched.engine.poses().expect("shown").scene());
    let parts = watched.engine.parts().count();
    println!("de-palletizer: {} triangles, {} bodies, {parts} parts", scene.triangles(), scene.bodies().len());
    let row = |name: &str, (mean, p50, p99, max): (f64, f64, f64, f64)| {
        println!("{name:<44} mean {mean:>8.2}  p50 {p50:>8.2}  p99 {p99:>8.2}  max {max:>8.2} µs");
        mean
    };
    let full = row("a step, all sensors and collision pairs", measure(100_000, || watched.tick()));
    println!("{:<44} {:.0} times real time; goal 100; mean 10 µs, p99 60 µs", "", 1000.0 / full);
    let asked = watched.engine.watched().expect("watched").asked();
    println!(
        "{:<44} {:.1} pairs of pieces a step, {} collisions",
        "",
        asked as f64 / watched.engine.steps() as f64,
        watched.engine.collisions()
    );
    let mut bare = Line::new(false);
    let bare_mean = row("the same without the scene", measure(100_000, || bare.tick()));
    let mut plain = Plain::of(&watched);
    let plain_mean = row(
        "a plain parry3d program, the same queries",
        measure(2_000, || {
            black_box(plain.step());
        }),
    );
    println!("ratios: plain / full {:.1}, full / without the scene {:.2}", plain_mean / full, full / bare_mean);

    let joints =
        ["Robot.X", "Robot.Y", "Robot.Z", "Robot.R", "Pusher1.Spintore", "Pusher2.Spintore", "Pusher3.Spintore"];
    let mut poses = Poses::new(Arc::clone(&scene));
    let joints = joints.map(|name| scene.find(name).expect(name));
    let mut at = 0.0;
    let kinematics = measure(200_000, || {
        at += 1e-4;
        joints.iter().for_each(|joint| poses.set(*joint, at));
        poses.resolve();
    });
    let mean = row("kinematics alone, all seven joints moving", kinematics);
    println!("{:<44} {:.0} times real time; goal 1000", "", 1000.0 / mean);

    println!("a step by the devices that stand still, one pusher moving:");
    for count in [10, 100, 1_000, 10_000] {
        let (plant, mut engine) = loaded(generated(count));
        let commands = [commands(&plant, &[("Pusher.command", 1.0)]), commands(&plant, &[("Pusher.command", 2.0)])];
        // Until all that stands still sleeps.
        (0..200).for_each(|_| {
            engine.tick(&[]);
        });
        let mut step = 0;
        let whole = measure(4_000, || {
            step += 1;
            let inputs: &[(RegisterId, Value)] = if step % 1000 == 1 { &commands[step / 1000 % 2] } else { &[] };
            engine.tick(inputs);
        });
        let mut poses = Poses::new(Arc::clone(engine.poses().expect("shown").scene()));
        let slide = poses.scene().find("Pusher.Spintore").expect("it");
        let mut world = kinetwin::collision::World::new(&poses);
        let mut found = Vec::new();
        let mut at = 0.0;
        let shape = measure(20_000, || {
            at = (at + 5e-4) % 0.5;
            poses.set(slide, at);
            poses.resolve();
            world.step(&poses, std::iter::empty(), &mut found);
        });
        let triangles = engine.poses().expect("shown").scene().triangles();
        engine.keep_awake(true);
        let visited = measure(500, || {
            engine.tick(&[]);
        });
        println!(
            "  {count:>6} devices, {triangles:>9} triangles: scene and collisions {:>7.3} µs, the whole engine {:>8.2} µs, \
             {:>8.2} µs with all devices visited",
            shape.0, whole.0, visited.0
        );
    }

    let begun = Instant::now();
    let plant = load(&Embedded, "models/depalletizer", KINDS).expect("a model of ours");
    let scene = Arc::new(Scene::of(&plant));
    let built = begun.elapsed();
    let mut engine = Engine::new(&plant, STEP, 1).expect("an engine");
    engine.show(&plant, Arc::clone(&scene));
    engine.watch();
    println!(
        "loading {} triangles: read and built {:.3} s, with the engine and its collision shapes {:.3} s; goal 0.5",
        scene.triangles(),
        built.as_secs_f64(),
        begun.elapsed().as_secs_f64()
    );
    let text = kinetwin::bench::devices::plant_xml(kinetwin::bench::devices::LARGE);
    let files = Memory(BTreeMap::from([("generated/plant.xml".to_owned(), text)]));
    let begun = Instant::now();
    let (_, engine) = loaded(files);
    let triangles = engine.poses().expect("shown").scene().triangles();
    println!("loading 2000 devices, {triangles} triangles: {:.2} s; goal 10", begun.elapsed().as_secs_f64());
}

fn steps(c: &mut Criterion) {
    table();
    let mut line = Line::new(true);
    c.bench_function("scene: a step of the de-palletizer, watched", |b| b.iter(|| line.tick()));
    let mut plain = Plain::of(&line);
    c.bench_function("scene: the same queries in a plain parry3d program", |b| b.iter(|| plain.step()));
    black_box(&line.plant);
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).measurement_time(Duration::from_secs(3));
    targets = steps
}
criterion_main!(benches);
