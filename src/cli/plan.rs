//! The plant from above, drawn in braille: belts, plates, tools, beams, and the parts on them where they are now.

use crossterm::style::Color;

use super::picture::{Drawing, Style};
use crate::engine::PartState;
use crate::plant::{PartKind, Plant, Pose, Task};
use crate::signal_map::{RegisterId, SignalMap};
use crate::value::Value;

const BELT: Style = Style::of(Color::DarkGrey);
const RUNNING: Style = Style::of(Color::DarkGreen);
const BEAM: Style = Style::of(Color::Red);
const MACHINE: Style = Style::of(Color::DarkCyan);
const TOOL: Style = Style::of(Color::Magenta);
pub const BOX: Style = Style::of(Color::Yellow);
pub const PALLET: Style = Style::of(Color::DarkYellow);

/// What lies above what; the uppermost gives a character its colour.
mod layer {
    pub const BELT: u8 = 1;
    pub const MACHINE: u8 = 2;
    pub const PALLET: u8 = 3;
    pub const BOX: u8 = 4;
    pub const BEAM: u8 = 5;
    pub const TOOL: u8 = 6;
}

type Point = [f64; 2];

/// What of a plant can be drawn.
#[derive(Clone, Debug)]
pub struct Plan {
    items: Vec<Item>,
    low: Point,
    high: Point,
}

#[derive(Clone, Debug)]
enum Item {
    Belt {
        /// Both edges.
        edges: [Vec<Point>; 2],
        running: Option<RegisterId>,
        /// Both ends of each beam, and the signal that says whether it is cut.
        beams: Vec<([Point; 2], RegisterId)>,
    },
    Plate {
        /// Where its front is when retracted, and when extended.
        fronts: [[Point; 2]; 2],
        retracted: Option<RegisterId>,
        extended: Option<RegisterId>,
    },
    Tool {
        pose: Pose,
        /// Positions, and the factors that take them to metres.
        x: (RegisterId, f64),
        y: (RegisterId, f64),
    },
    /// What has a place and no shape that is known here.
    Spot(Point),
}

impl Plan {
    /// The plan of `plant`.
    pub fn new(plant: &Plant) -> Plan {
        let mut items = Vec::new();
        for instance in &plant.instances {
            for task in &instance.tasks {
                items.extend(item(&instance.pose, task, &plant.signal_map));
            }
        }
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for [x, y] in items.iter().flat_map(Item::corners) {
            low = [low[0].min(x), low[1].min(y)];
            high = [high[0].max(x), high[1].max(y)];
        }
        Plan { items, low, high }
    }

    /// Draws it with `parts` on it into so many characters; `registers` are those of the same plant, by id.
    pub fn draw(&self, columns: usize, rows: usize, registers: &[Value], parts: &[PartState]) -> Drawing {
        let mut sheet = Sheet::new(self, Drawing::new(columns, rows));
        for item in &self.items {
            item.draw(&mut sheet, registers);
        }
        for part in parts {
            let (layer, style) = match part.kind {
                PartKind::Pallet => (layer::PALLET, PALLET),
                PartKind::Box => (layer::BOX, BOX),
            };
            let pose = Pose { x: part.place[0], y: part.place[1], rz: part.yaw, ..Pose::default() };
            let [length, width, _] = part.size.map(|size| size / 2.0);
            let corners = [[-length, -width], [length, -width], [length, width], [-length, width]];
            sheet.fill(&corners.map(|corner| place(&pose, corner)), layer, style);
        }
        sheet.drawing
    }
}

/// A drawing with its scale.
struct Sheet {
    drawing: Drawing,
    /// Dots to a metre.
    scale: f64,
    /// Where the world's origin is, dots.
    origin: Point,
}

impl Sheet {
    /// Fits `plan` into `drawing`, in its middle.
    fn new(plan: &Plan, drawing: Drawing) -> Sheet {
        let (width, height) = drawing.size();
        let span = |axis: usize| (plan.high[axis] - plan.low[axis]).max(0.5);
        let scale = ((width - 1.0) / span(0)).min((height - 1.0) / span(1)).max(0.0);
        let middle = |axis: usize| (plan.low[axis] + plan.high[axis]) / 2.0;
        let finite = |x: f64| if x.is_finite() { x } else { 0.0 };
        let origin = [width / 2.0 - finite(middle(0)) * scale, height / 2.0 + finite(middle(1)) * scale];
        Sheet { drawing, scale, origin }
    }

    /// A place of the world, x to the right and y upwards, in dots.
    fn dots(&self, point: Point) -> (f64, f64) {
        (self.origin[0] + point[0] * self.scale, self.origin[1] - point[1] * self.scale)
    }

    fn line(&mut self, from: Point, to: Point, layer: u8, style: Style) {
        let (from, to) = (self.dots(from), self.dots(to));
        self.drawing.line(from, to, layer, style);
    }

    fn fill(&mut self, corners: &[Point], layer: u8, style: Style) {
        let corners: Vec<(f64, f64)> = corners.iter().map(|corner| self.dots(*corner)).collect();
        self.drawing.fill(&corners, layer, style);
    }
}

impl Item {
    /// Points that lie within the plan.
    fn corners(&self) -> Vec<Point> {
        match self {
            Item::Belt { edges, .. } => edges.concat(),
            Item::Plate { fronts, .. } => fronts.concat(),
            Item::Tool { pose, .. } => vec![[pose.x, pose.y]],
            Item::Spot(point) => vec![*point],
        }
    }

    fn draw(&self, sheet: &mut Sheet, registers: &[Value]) {
        match self {
            Item::Belt { edges, running, beams } => {
                let style = if is_true(registers, *running) { RUNNING } else { BELT };
                for edge in edges {
                    edge.windows(2).for_each(|ends| sheet.line(ends[0], ends[1], layer::BELT, style));
                }
                for (ends, cut) in beams {
                    if is_true(registers, Some(*cut)) {
                        sheet.line(ends[0], ends[1], layer::BEAM, BEAM);
                    }
                }
            }
            Item::Plate { fronts, retracted, extended } => {
                // Between its limits nobody knows where it is: it is drawn halfway.
                let part = match (is_true(registers, *retracted), is_true(registers, *extended)) {
                    (true, _) => 0.0,
                    (_, true) => 1.0,
                    _ => 0.5,
                };
                let between = |end: usize| {
                    let [from, to] = [fronts[0][end], fronts[1][end]];
                    [from[0] + (to[0] - from[0]) * part, from[1] + (to[1] - from[1]) * part]
                };
                sheet.line(between(0), between(1), layer::MACHINE, MACHINE);
            }
            Item::Tool { pose, x, y } => {
                let read = |(id, to_si): (RegisterId, f64)| number(registers, id) * to_si;
                let at = sheet.dots(place(pose, [read(*x), read(*y)]));
                for offset in -2..=2 {
                    let offset = f64::from(offset);
                    sheet.drawing.dot(at.0 + offset, at.1, layer::TOOL, TOOL);
                    sheet.drawing.dot(at.0, at.1 + offset, layer::TOOL, TOOL);
                }
            }
            Item::Spot(point) => {
                let at = sheet.dots(*point);
                sheet.drawing.dot(at.0, at.1, layer::MACHINE, MACHINE);
            }
        }
    }
}

fn number(registers: &[Value], id: RegisterId) -> f64 {
    registers.get(id.index()).and_then(Value::to_f64).unwrap_or(0.0)
}

fn is_true(registers: &[Value], id: Option<RegisterId>) -> bool {
    id.is_some_and(|id| number(registers, id) != 0.0)
}

/// A point of an instance's frame in the world, seen from above.
fn place(pose: &Pose, [x, y]: Point) -> Point {
    let (sin, cos) = pose.rz.sin_cos();
    [pose.x + x * cos - y * sin, pose.y + x * sin + y * cos]
}

fn port(task: &Task, name: &str) -> Option<RegisterId> {
    task.ports.get(task.kind.port(name)?).copied().flatten()
}

/// What is drawn of a task; nothing for what has no body.
fn item(pose: &Pose, task: &Task, map: &SignalMap) -> Option<Item> {
    let parameters = &task.parameters;
    match task.kind.name {
        "kinetwin.StraightConveyor" => {
            let length = parameters.number("length");
            Some(belt(pose, task, length, &|station| ([station, 0.0], 0.0)))
        }
        "kinetwin.ConveyorCurve" => {
            let (radius, angle) = (parameters.number("radius"), parameters.number("angle"));
            let arc = move |station: f64| {
                let turned = station / radius * angle.signum();
                ([radius * turned.sin().abs(), radius * (1.0 - turned.cos()) * angle.signum()], turned)
            };
            Some(belt(pose, task, radius * angle.abs(), &arc))
        }
        "kinetwin.Pusher" => {
            let half = parameters.numbers("plateSize").get(1).map_or(0.25, |width| width / 2.0);
            let front = |x: f64| [place(pose, [x, -half]), place(pose, [x, half])];
            let fronts = [front(0.0), front(parameters.number("stroke"))];
            Some(Item::Plate { fronts, retracted: port(task, "limitRetracted"), extended: port(task, "limitExtended") })
        }
        "kinetwin.CartesianRobot" => {
            let axis = |name: &str| port(task, name).map(|id| (id, map.signal(id).unit.to_si));
            Some(Item::Tool { pose: *pose, x: axis("actualPosX")?, y: axis("actualPosY")? })
        }
        "kinetwin.SuctionCapGripper" | "kinetwin.LoadingBay" | "kinetwin.UnloadingBay" => None,
        _ => Some(Item::Spot([pose.x, pose.y])),
    }
}

/// A belt whose centre line and direction at a station are given by `centre`, in the instance's frame.
fn belt(pose: &Pose, task: &Task, length: f64, centre: &dyn Fn(f64) -> (Point, f64)) -> Item {
    let half = task.parameters.number("width") / 2.0;
    let at = |station: f64, offset: f64| {
        let ([x, y], yaw) = centre(station);
        place(pose, [x - offset * yaw.sin(), y + offset * yaw.cos()])
    };
    const PIECES: usize = 16;
    let edge = |offset: f64| (0..=PIECES).map(|i| at(length * i as f64 / PIECES as f64, offset)).collect();
    let beam = |barrier: &str, signal: &str| {
        let station = task.parameters.number(barrier);
        Some(([at(station, -half), at(station, half)], port(task, signal)?))
    };
    let beams = [beam("barrierA", "lightBarrierA"), beam("barrierB", "lightBarrierB")];
    Item::Belt {
        edges: [edge(-half), edge(half)],
        running: port(task, "driveRunning"),
        beams: beams.into_iter().flatten().collect(),
    }
}
