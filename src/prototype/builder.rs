//! `builder.js`, the parametric geometry of the reference's section 3.4.5: a function `build(parameters)` that makes frames and
//! bodies by calling `frame`, `box`, `cylinder`, `lathe`, `extrude` and `mesh`; and `customizer.js`, a function
//! `customize(parameters)` that gives values to parameters that an instance leaves alone.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::Deserialize;
use serde_json::Value;

use super::quantity::parse_number;
use super::source;
use super::structure::{Meshes, Structure, StructureBody, StructureFrame};
use crate::kinematics::{DPose3, DQuat, DVec2, DVec3, Joint};
use crate::mesh::primitive::{cuboid, extrude, lathe};
use crate::mesh::{Mesh, Reading, Up};
use crate::script::{self, ScriptError};
use crate::value::Quantity;

/// What a script may call.
const PRELUDE: &str = include_str!("builder_prelude.js");

/// A script of a prototype.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Script {
    /// Its path.
    pub path: String,
    pub text: String,
}

#[derive(Deserialize)]
struct Made {
    frames: Vec<MadeFrame>,
    bodies: Vec<MadeBody>,
}

#[derive(Deserialize)]
struct MadeFrame {
    name: String,
    parent: Option<String>,
    at: [f64; 3],
    turn: [f64; 3],
    joint: Option<MadeJoint>,
}

#[derive(Deserialize)]
struct MadeJoint {
    r#type: String,
    axis: [f64; 3],
    min: Option<f64>,
    max: Option<f64>,
    zero: f64,
}

#[derive(Deserialize)]
struct MadeBody {
    frame: Option<String>,
    at: [f64; 3],
    turn: [f64; 3],
    colour: [u8; 3],
    solid: bool,
    form: Form,
}

#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum Form {
    Box { size: [f64; 3] },
    Lathe { profile: Vec<[f64; 2]>, segments: usize },
    Extrude { outline: Vec<[f64; 2]>, height: f64 },
    Mesh { file: String, unit: Option<String>, up: Option<String>, simplify: f64 },
}

/// Builds the shape of an instance whose parameters are `parameters`, an object. Files that the script names are seen from its
/// folder.
///
/// # Errors
/// The script is wrong, throws, or does not end; a mesh that it names cannot be read.
pub fn build(script: &Script, parameters: &Value, meshes: &mut Meshes<'_>) -> Result<Structure, ScriptError> {
    let made = script::call(&script.path, PRELUDE, &script.text, "__run", parameters)?;
    let made: Made = serde_json::from_value(made).map_err(|error| whole(format!("it made no shape: {error}")))?;
    let mut structure = Structure::default();
    let mut places: BTreeMap<&str, usize> = BTreeMap::new();
    for frame in &made.frames {
        let parent = frame.parent.as_ref().and_then(|parent| places.get(parent.as_str()).copied());
        let joint = frame.joint.as_ref().map_or(Joint::FIXED, joint);
        places.insert(&frame.name, structure.frames.len());
        structure.frames.push(StructureFrame {
            name: frame.name.clone(),
            parent,
            rest: pose(frame.at, frame.turn),
            joint,
        });
    }
    let mut known: BTreeMap<String, Arc<Mesh>> = BTreeMap::new();
    for body in &made.bodies {
        let frame = body.frame.as_ref().and_then(|frame| places.get(frame.as_str()).copied());
        let mesh = mesh(&body.form, script, meshes, &mut known)?;
        let place = pose(body.at, body.turn);
        let (colour, is_solid) = (body.colour, body.solid);
        structure.bodies.push(StructureBody { frame, mesh, place, colour, is_solid });
    }
    Ok(structure)
}

/// What `customize` gives for an instance whose parameters are `parameters`: new values by name.
///
/// # Errors
/// The script is wrong, throws, or does not end; what it gives is no object.
pub fn customize(script: &Script, parameters: &Value) -> Result<BTreeMap<String, Value>, ScriptError> {
    let given = script::call(&script.path, PRELUDE, &script.text, "__customize", parameters)?;
    serde_json::from_value(given).map_err(|_| whole("customize gave no object: expected { name: value }".to_owned()))
}

fn whole(message: String) -> ScriptError {
    ScriptError { line: None, message }
}

fn pose(at: [f64; 3], turn: [f64; 3]) -> DPose3 {
    let [rx, ry, rz] = turn;
    let about = DQuat::from_rotation_z(rz) * DQuat::from_rotation_y(ry) * DQuat::from_rotation_x(rx);
    DPose3::from_parts(DVec3::from_array(at), about)
}

fn joint(made: &MadeJoint) -> Joint {
    let limits = [made.min.unwrap_or(f64::NEG_INFINITY), made.max.unwrap_or(f64::INFINITY)];
    let axis = DVec3::from_array(made.axis);
    let joint = if made.r#type == "prismatic" { Joint::prismatic(axis, limits) } else { Joint::revolute(axis, limits) };
    Joint { zero: made.zero, ..joint }
}

/// The mesh of a form; those of equal forms are one.
fn mesh(
    form: &Form,
    script: &Script,
    meshes: &mut Meshes<'_>,
    known: &mut BTreeMap<String, Arc<Mesh>>,
) -> Result<Arc<Mesh>, ScriptError> {
    let key = match form {
        Form::Mesh { file, unit, up, simplify } => {
            let metres = unit.as_ref().map(|unit| parse_number(&format!("1 {unit}"), None, &[Quantity::Length]));
            let metres = metres.transpose().map_err(|error| whole(format!("{}: {}", error.found, error.expected)))?;
            let up = match up.as_deref() {
                None => None,
                Some("y") => Some(Up::Y),
                Some("z") => Some(Up::Z),
                Some(other) => return Err(whole(format!("up is {other:?}: expected \"y\" or \"z\""))),
            };
            let path = source::join(source::folder(&script.path), file);
            return meshes.get(&path, Reading { metres, up, simplify: *simplify }).map_err(whole);
        }
        Form::Box { size } => format!("box {size:?}"),
        Form::Lathe { profile, segments } => format!("lathe {profile:?} {segments}"),
        Form::Extrude { outline, height } => format!("extrude {outline:?} {height}"),
    };
    if let Some(mesh) = known.get(&key) {
        return Ok(Arc::clone(mesh));
    }
    let mut mesh = Mesh::new(key.clone());
    match form {
        Form::Box { size } => cuboid(&mut mesh, DVec3::from_array(*size), DVec3::ZERO),
        Form::Lathe { profile, segments } => lathe(&mut mesh, profile, *segments, &DPose3::IDENTITY),
        Form::Extrude { outline, height } => {
            let mut outline: Vec<DVec2> = outline.iter().map(|corner| DVec2::from_array(*corner)).collect();
            let next = outline.iter().cycle().skip(1);
            let area: f64 = outline.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum();
            if area == 0.0 {
                return Err(whole(
                    "extrude: the outline has no area: expected corners that are not on one line".to_owned(),
                ));
            }
            if area < 0.0 {
                outline.reverse();
            }
            extrude(&mut mesh, &outline, *height, &DPose3::IDENTITY);
        }
        Form::Mesh { .. } => {}
    }
    let mesh = Arc::new(mesh);
    known.insert(key, Arc::clone(&mesh));
    Ok(mesh)
}
