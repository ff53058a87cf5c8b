//! How many steps a second: of the rig, and of the de-palletization line with all belts running and the gantry on its way.
//! Criterion's `thrpt` is ticks per second; a tick of 1 ms in real time needs 1 000 of them.

use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use kinetwin::device::KINDS;
use kinetwin::engine::Engine;
use kinetwin::plant::embedded::Embedded;
use kinetwin::plant::{Plant, load};
use kinetwin::signal_map::RegisterId;
use kinetwin::value::{ElementaryType, Value};

struct Bench {
    plant: Plant,
    engine: Engine,
}

impl Bench {
    fn new(model: &str) -> Bench {
        let plant = load(&Embedded, model, KINDS).expect("a model of ours");
        let engine = Engine::new(&plant, Duration::from_millis(1), 1).expect("a plant that runs");
        Bench { plant, engine }
    }

    /// Commands by the last part of their names.
    fn commands(&self, wanted: &[(&str, f64)]) -> Vec<(RegisterId, Value)> {
        let mut commands = Vec::new();
        for (index, signal) in self.plant.signal_map.signals().iter().enumerate() {
            for (_, value) in wanted.iter().filter(|(name, _)| signal.name.ends_with(name)) {
                let element: ElementaryType = signal.ty.element;
                commands.push((RegisterId(index as u32), Value::from_f64(element, *value)));
            }
        }
        commands
    }

    /// Runs to where the plant is busy.
    fn warm_up(&mut self, wanted: &[(&str, f64)], seconds: u32) {
        let commands = self.commands(wanted);
        self.engine.tick(&commands);
        for _ in 0..seconds * 1000 {
            self.engine.tick(&[]);
        }
    }
}

fn ticks(c: &mut Criterion) {
    let mut group = c.benchmark_group("engine");
    group.throughput(Throughput::Elements(1));
    for (model, seconds) in [("models/rig", 3), ("models/depalletizer", 40)] {
        let mut bench = Bench::new(model);
        // Slow enough that the belts stay full, so that no tick is one of an empty plant.
        let running = [
            (".velocityTarget", 0.1),
            (".motorDirection", 1.0),
            (".suctionOn", 1.0),
            (".speedTarget", 20.0),
            (".enable", 1.0),
        ];
        bench.warm_up(&running, seconds);
        let there = bench.commands(&[(".XTarget", 0.8), (".YTarget", 1.2), (".positionTarget", 0.5)]);
        let back = bench.commands(&[(".XTarget", 0.0), (".YTarget", 0.0), (".positionTarget", 0.0)]);
        println!("{model}: {} parts", bench.engine.parts().count());
        group.bench_function(format!("tick of {model}"), |b| {
            let mut step: u32 = 0;
            b.iter(|| {
                step += 1;
                let inputs: &[(RegisterId, Value)] = match step % 4000 {
                    0 => &there,
                    2000 => &back,
                    _ => &[],
                };
                bench.engine.tick(inputs).len()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, ticks);
criterion_main!(benches);
