//! What a page shows beside the report: where things stand, and the recordings themselves. A diagnosis fills it in from
//! held-out data; whatever is left empty is left out of the page.

use crate::plant::{Plant, Pose, Task};

/// The pictures' data.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Evidence {
    /// The plant's name.
    pub plant: String,
    /// Every instance of the plant, whether it has a gap or not: see [`sites`].
    pub sites: Vec<Site>,
    /// Levels of the devices with causes, those with the largest gap first.
    pub series: Vec<Series>,
    /// Truth values of the devices with causes, those with the largest gap first.
    pub strips: Vec<Strip>,
}

/// Where an instance stands, seen from above.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    pub device: String,
    /// The middle of it, in metres.
    pub at: [f64; 2],
    /// Its outline, a closed polygon in metres; empty for what has a place and no shape.
    pub outline: Vec<[f64; 2]>,
}

/// A level over a span of time, all at the same instants. NaN is a gap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// The signal's whole name.
    pub signal: String,
    /// Its unit, SI or the signal's own: `m`.
    pub unit: String,
    /// Where the span is from: `held-out trace holdout.cps.jsonl, 12 s to 20 s`.
    pub caption: String,
    /// In seconds, rising.
    pub times: Vec<f64>,
    pub measured: Vec<f64>,
    /// Of the model as it is.
    pub nominal: Vec<f64>,
    /// Of the model with the causes; `None` where nothing is added.
    pub with_effect: Option<Vec<f64>>,
    /// The noise floor, RMS in `unit`.
    pub floor: f64,
}

/// A truth value over a span of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Strip {
    pub signal: String,
    pub caption: String,
    /// The span that is drawn as a strip, in seconds.
    pub span: [f64; 2],
    pub measured: Switching,
    pub nominal: Switching,
    pub with_effect: Option<Switching>,
    /// How much later than the machine's each paired edge of the whole recording is, model as it is.
    pub late: Vec<EdgeError>,
    /// The cycle that edges are reported in, in seconds; 0 where it is not known.
    pub cycle: f64,
}

/// A truth value that changes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Switching {
    /// What it is before its first change.
    pub initial: bool,
    /// The instants of its changes in seconds, rising.
    pub changes: Vec<f64>,
}

/// By how much an edge of the model is later than the machine's, in seconds; negative is early.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EdgeError {
    /// When the machine's was seen.
    pub at: f64,
    /// `None` where the model does not make it.
    pub nominal: Option<f64>,
    pub with_effect: Option<f64>,
}

/// The sites of a plant's instances.
pub fn sites(plant: &Plant) -> Vec<Site> {
    let site = |instance: &crate::plant::Instance| {
        let outline = instance.tasks.iter().find_map(|task| outline(&instance.pose, task)).unwrap_or_default();
        let middle = |axis: usize| outline.iter().map(|point| point[axis]).sum::<f64>() / outline.len().max(1) as f64;
        let at = if outline.is_empty() { [instance.pose.x, instance.pose.y] } else { [middle(0), middle(1)] };
        Site { device: instance.name.clone(), at, outline }
    };
    plant.instances.iter().map(site).collect()
}

/// Pieces that an arc is drawn in.
const PIECES: usize = 12;

fn outline(pose: &Pose, task: &Task) -> Option<Vec<[f64; 2]>> {
    let parameters = &task.parameters;
    let place = |[x, y]: [f64; 2]| {
        let (sin, cos) = pose.rz.sin_cos();
        [pose.x + x * cos - y * sin, pose.y + x * sin + y * cos]
    };
    let box_of = |from: [f64; 2], to: [f64; 2]| {
        [[from[0], from[1]], [to[0], from[1]], [to[0], to[1]], [from[0], to[1]]].map(place).to_vec()
    };
    match task.kind.name {
        "kinetwin.StraightConveyor" => {
            let half = parameters.number("width") / 2.0;
            Some(box_of([0.0, -half], [parameters.number("length"), half]))
        }
        "kinetwin.ConveyorCurve" => {
            let (radius, angle) = (parameters.number("radius"), parameters.number("angle"));
            let half = parameters.number("width") / 2.0;
            let at = |piece: usize, offset: f64| {
                let turned = angle * piece as f64 / PIECES as f64;
                let reach = radius - offset * angle.signum();
                place([reach * turned.abs().sin(), (radius - reach * turned.cos()) * angle.signum()])
            };
            let inner = (0..=PIECES).map(|piece| at(piece, -half));
            Some(inner.chain((0..=PIECES).rev().map(|piece| at(piece, half))).collect())
        }
        "kinetwin.Pusher" => {
            let half = parameters.numbers("plateSize").get(1).map_or(0.25, |width| width / 2.0);
            Some(box_of([0.0, -half], [parameters.number("stroke"), half]))
        }
        _ => None,
    }
}
