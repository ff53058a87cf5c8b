//! `structure.xml`, the kinematic structure file of the reference's section 3.4.5: which frames a prototype's shape has, how
//! they move in each other, and which meshes hang on them.
//!
//! ```xml
//! <structure>
//!   <mesh file="housing.stl" unit="mm" colour="45;92;140"/>
//!   <frame name="Spintore">
//!     <pose x="10 mm"/>
//!     <joint type="prismatic" axis="1;0;0" min="0" max="${stroke}"/>
//!     <mesh file="plate.stl" unit="mm" simplify="0.2 mm"/>
//!   </frame>
//! </structure>
//! ```
//!
//! A frame stands in the instance's own frame, or in the one that its `parent` names. `${name}` is the value of a parameter
//! of the prototype whose `affectGeometry` is true.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::quantity::{parse_number, parse_numbers};
use super::source::Source;
use super::{source, substitute, words};
use crate::kinematics::{DPose3, DQuat, DVec3, Joint, JointKind};
use crate::mesh::{Mesh, Reading, Up};
use crate::value::Quantity;
use crate::xml::{Element, Faults, Located};

/// The shape of one instance: frames and what hangs on them.
#[derive(Clone, Debug, Default)]
pub struct Structure {
    /// Each after the one it stands in.
    pub frames: Vec<StructureFrame>,
    pub bodies: Vec<StructureBody>,
}

/// A frame of a structure.
#[derive(Clone, Debug, PartialEq)]
pub struct StructureFrame {
    pub name: String,
    /// The frame it stands in, by its place in the structure; `None` for the instance's own.
    pub parent: Option<usize>,
    pub rest: DPose3,
    pub joint: Joint,
}

/// A mesh in its place on a frame.
#[derive(Clone, Debug)]
pub struct StructureBody {
    /// By its place in the structure; `None` for the instance's own frame.
    pub frame: Option<usize>,
    pub mesh: Arc<Mesh>,
    pub place: DPose3,
    pub colour: [u8; 3],
    pub is_solid: bool,
}

/// What a mesh looks like where nobody says.
pub const GREY: [u8; 3] = [160, 164, 168];

/// The meshes of a model, each read once.
pub struct Meshes<'a> {
    source: &'a dyn Source,
    known: BTreeMap<String, Result<Arc<Mesh>, String>>,
}

impl<'a> Meshes<'a> {
    /// Meshes of `source`, none read yet.
    pub fn new(source: &'a dyn Source) -> Meshes<'a> {
        Meshes { source, known: BTreeMap::new() }
    }

    /// The mesh of the file at `path`. The error is one line, with the file's name and the line where it is text.
    pub fn get(&mut self, path: &str, reading: Reading) -> Result<Arc<Mesh>, String> {
        let key = format!("{path} {reading:?}");
        if let Some(known) = self.known.get(&key) {
            return known.clone();
        }
        let home = source::folder(path);
        let beside = |file: &str| self.source.read_bytes(&source::join(home, file)).map_err(|error| error.to_string());
        let read = self.source.read_bytes(path).map_err(|error| error.to_string());
        let mesh = read.and_then(|bytes| {
            crate::mesh::read(path, &bytes, reading, &beside).map(Arc::new).map_err(|error| error.to_string())
        });
        self.known.insert(key, mesh.clone());
        mesh
    }
}

/// Reads the structure of an instance from `root`, its file's root element. `folder` is where its meshes are, `parameters` are
/// those of the prototype that affect its geometry. Where something is wrong, it is told and there is none.
pub fn read(
    root: &Element,
    folder: &str,
    parameters: &BTreeMap<String, String>,
    meshes: &mut Meshes<'_>,
    faults: &mut Faults,
) -> Option<Structure> {
    if root.name.value != "structure" {
        let found = format!("the root element is <{}>", root.name.value);
        faults.push(root.name.fault(found, "expected <structure>"));
        return None;
    }
    root.allow_attributes(&[], faults);
    root.allow_children(&["frame", "mesh"], faults);
    let before = faults.iter().count();
    let mut reader = Reader { folder, parameters, meshes, faults };
    let elements: Vec<&Element> = root.children_named("frame").collect();
    let order = reader.order(&elements);
    let mut structure = Structure::default();
    for child in root.children_named("mesh") {
        structure.bodies.extend(reader.body(child, None));
    }
    let mut places: BTreeMap<&str, usize> = BTreeMap::new();
    for element in order {
        let parent = element.attribute("parent").and_then(|parent| places.get(parent.value.as_str()).copied());
        let Some(frame) = reader.frame(element, parent) else { continue };
        let place = structure.frames.len();
        structure.frames.push(frame);
        if let Some(name) = element.attribute("name") {
            places.insert(&name.value, place);
        }
        for child in element.children_named("mesh") {
            structure.bodies.extend(reader.body(child, Some(place)));
        }
    }
    (reader.faults.iter().count() == before).then_some(structure)
}

struct Reader<'a, 'b> {
    folder: &'a str,
    parameters: &'a BTreeMap<String, String>,
    meshes: &'a mut Meshes<'b>,
    faults: &'a mut Faults,
}

impl Reader<'_, '_> {
    fn refuse(&mut self, text: &Located<String>, found: impl Into<String>, expected: impl Into<String>) {
        self.faults.push(text.fault(found, expected));
    }

    /// The frames, each after the one it stands in; those in a circle, or in a frame that is not there, are told.
    fn order<'e>(&mut self, elements: &[&'e Element]) -> Vec<&'e Element> {
        let mut named: BTreeMap<&str, &Element> = BTreeMap::new();
        for element in elements {
            element.allow_attributes(&["name", "parent"], self.faults);
            element.allow_children(&["pose", "joint", "mesh"], self.faults);
            words::identifier(element, "name", self.faults);
            let Some(name) = element.attribute("name") else { continue };
            if named.insert(&name.value, element).is_some() {
                self.refuse(name, format!("two frames are called {:?}", name.value), "expected each name once");
            }
        }
        let parent_of = |element: &Element| element.attribute("parent").cloned();
        let mut order: Vec<&'e Element> = Vec::new();
        for element in elements {
            let mut chain: Vec<&'e Element> = vec![element];
            let mut at: &Element = element;
            while let Some(parent) = parent_of(at) {
                let Some(next) =
                    elements.iter().find(|it| it.attribute("name").is_some_and(|n| n.value == parent.value))
                else {
                    let names: Vec<&str> = named.keys().copied().collect();
                    let found = format!("there is no frame {:?}", parent.value);
                    self.refuse(&parent, found, format!("expected {}", crate::xml::one_of(names)));
                    break;
                };
                if chain.iter().any(|known| std::ptr::eq(*known, *next)) {
                    let found = format!("the frame {:?} stands in itself, by way of its parents", parent.value);
                    self.refuse(&parent, found, "expected a tree: parents that lead to a frame without one");
                    break;
                }
                chain.push(next);
                at = next;
            }
            for link in chain.into_iter().rev() {
                if !order.iter().any(|known| std::ptr::eq(*known, link)) {
                    order.push(link);
                }
            }
        }
        order
    }

    fn frame(&mut self, element: &Element, parent: Option<usize>) -> Option<StructureFrame> {
        let name = element.attribute("name")?.value.clone();
        let rest = self.pose(element);
        let mut joints = element.children_named("joint");
        let joint = joints.next().map_or(Some(Joint::FIXED), |joint| self.joint(joint));
        if let Some(second) = joints.next() {
            self.refuse(&second.name, "a second <joint>", "expected at most one in a frame: put a frame between");
        }
        Some(StructureFrame { name, parent, rest, joint: joint? })
    }

    fn joint(&mut self, element: &Element) -> Option<Joint> {
        element.allow_attributes(&["type", "axis", "min", "max", "zero"], self.faults);
        let kinds =
            [("fixed", JointKind::Fixed), ("prismatic", JointKind::Prismatic), ("revolute", JointKind::Revolute)];
        let kind = element.required_choice("type", &kinds, self.faults)?;
        if kind == JointKind::Fixed {
            return Some(Joint::FIXED);
        }
        let Some(axis) = element.attribute("axis") else {
            self.refuse(&element.name, "a joint without an axis", "expected axis=\"x;y;z\" in this element");
            return None;
        };
        let vector = self.numbers(axis, Quantity::One)?;
        let direction = <[f64; 3]>::try_from(vector).ok().and_then(|axis| DVec3::from_array(axis).try_normalize());
        let Some(direction) = direction else {
            self.refuse(axis, format!("{:?} is no axis", axis.value), "expected three numbers, not all 0: 1;0;0");
            return None;
        };
        let quantity = if kind == JointKind::Prismatic { Quantity::Length } else { Quantity::Angle };
        let low = self.optional(element, "min", quantity, f64::NEG_INFINITY)?;
        let high = self.optional(element, "max", quantity, f64::INFINITY)?;
        let zero = self.optional(element, "zero", quantity, 0.0)?;
        if low > high {
            let found = format!("a joint from {low} to {high}");
            self.refuse(&element.name, found, "expected min not above max");
            return None;
        }
        Some(Joint { kind, axis: direction, limits: [low, high], zero })
    }

    fn body(&mut self, element: &Element, frame: Option<usize>) -> Option<StructureBody> {
        element.allow_attributes(&["file", "unit", "up", "colour", "solid", "simplify"], self.faults);
        element.allow_children(&["pose"], self.faults);
        let place = self.pose(element);
        let file = element.required("file", self.faults)?;
        let metres = match element.attribute("unit") {
            None => None,
            Some(unit) => match parse_number(&format!("1 {}", unit.value), None, &[Quantity::Length]) {
                Ok(metres) => Some(metres),
                Err(error) => {
                    self.refuse(unit, error.found, error.expected);
                    return None;
                }
            },
        };
        let up = element.choice("up", &[("y", Up::Y), ("z", Up::Z)], self.faults);
        let is_solid = element.choice("solid", &[("true", true), ("false", false)], self.faults).unwrap_or(true);
        let simplify = self.optional(element, "simplify", Quantity::Length, 0.0)?;
        let colour = match element.attribute("colour") {
            Some(colour) => self.colour(colour)?,
            None => GREY,
        };
        let path = source::join(self.folder, &file.value);
        match self.meshes.get(&path, Reading { metres, up, simplify }) {
            Ok(mesh) => Some(StructureBody { frame, mesh, place, colour, is_solid }),
            Err(error) => {
                self.refuse(file, error, "expected a mesh that can be read");
                None
            }
        }
    }

    fn colour(&mut self, text: &Located<String>) -> Option<[u8; 3]> {
        let channels: Option<Vec<u8>> =
            text.value.split(';').map(|channel| channel.trim().parse::<u8>().ok()).collect();
        let colour = channels.and_then(|channels| <[u8; 3]>::try_from(channels).ok());
        if colour.is_none() {
            let found = format!("{:?} is no colour", text.value);
            self.refuse(text, found, "expected red;green;blue, each 0 to 255");
        }
        colour
    }

    /// The `<pose>` in an element: turned about the fixed x, y and z axes, in this order.
    fn pose(&mut self, element: &Element) -> DPose3 {
        let Some(pose) = element.children_named("pose").next() else { return DPose3::IDENTITY };
        pose.allow_attributes(&["x", "y", "z", "rx", "ry", "rz"], self.faults);
        let mut of = |name: &str, quantity| self.optional(pose, name, quantity, 0.0).unwrap_or(0.0);
        let place = DVec3::new(of("x", Quantity::Length), of("y", Quantity::Length), of("z", Quantity::Length));
        let [rx, ry, rz] = ["rx", "ry", "rz"].map(|name| of(name, Quantity::Angle));
        let about = DQuat::from_rotation_z(rz) * DQuat::from_rotation_y(ry) * DQuat::from_rotation_x(rx);
        DPose3::from_parts(place, about)
    }

    /// A number that may be left out; `None` where it is wrong.
    fn optional(&mut self, element: &Element, name: &str, quantity: Quantity, default: f64) -> Option<f64> {
        let Some(text) = element.attribute(name) else { return Some(default) };
        match self.numbers(text, quantity)?.as_slice() {
            [number] => Some(*number),
            numbers => {
                let found = format!("{:?} holds {} numbers", text.value, numbers.len());
                self.refuse(text, found, "expected one");
                None
            }
        }
    }

    fn numbers(&mut self, text: &Located<String>, quantity: Quantity) -> Option<Vec<f64>> {
        let parameter = |name: &str| self.parameters.get(name).map(String::as_str);
        let read = match substitute(&text.value, "", parameter) {
            Ok(replaced) => parse_numbers(&replaced, None, &[quantity]),
            Err(name) => {
                let found = format!("there is no parameter {name:?} that affects the geometry");
                let expected =
                    "expected a parameter of prototype.xml with <property name=\"affectGeometry\" value=\"true\"/>";
                self.refuse(text, found, expected);
                return None;
            }
        };
        match read {
            Ok(numbers) => Some(numbers),
            Err(error) => {
                self.refuse(text, error.found, error.expected);
                None
            }
        }
    }
}
