//! Triangle meshes and the files they come from: STL, OBJ, glTF and VRML 97.
//!
//! A mesh is read whole or not at all: what is no number, no triangle of it, or no mesh of the format that its name says is
//! an error that names the file and, where the format is text, the line. STL and OBJ are read here and not by a library
//! because the libraries that read them do not say in which line something is wrong.
//!
//! STEP and IGES describe surfaces, not triangles. No library in Rust reads them well enough to triangulate what CAD systems
//! write; they are refused with a message that says how to convert.

mod gltf;
mod numbers;
mod obj;
pub(crate) mod outline;
pub(crate) mod primitive;
mod simplify;
mod soup;
mod stl;
#[cfg(test)]
mod tests;
mod triangles;
mod vrml;

use std::fmt;

pub use self::triangles::Mesh;

/// How a file's coordinates become ours: metres, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Metres in one of the file's units; `None` where the format says so itself.
    pub metres: Option<f64>,
    /// Which of the file's axes points up; `None` for what is usual in the format.
    pub up: Option<Up>,
    /// How far a simplified mesh may lie from the file's, m; 0 leaves it as it is.
    pub simplify: f64,
}

/// The axis that points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Up {
    Y,
    Z,
}

/// Why a file is no mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshError {
    pub file: String,
    /// Counted from 1; `None` where the format has no lines.
    pub line: Option<usize>,
    pub found: String,
    pub expected: String,
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let MeshError { file, line, found, expected } = self;
        match line {
            Some(line) => write!(f, "{file}:{line}: {found}: {expected}"),
            None => write!(f, "{file}: {found}: {expected}"),
        }
    }
}

impl std::error::Error for MeshError {}

/// What a reader finds wrong, before the file's name is known.
#[derive(Clone, Debug)]
struct Wrong {
    line: Option<usize>,
    found: String,
    expected: String,
}

impl Wrong {
    fn at(line: usize, found: impl Into<String>, expected: impl Into<String>) -> Wrong {
        Wrong { line: Some(line), found: found.into(), expected: expected.into() }
    }

    fn somewhere(found: impl Into<String>, expected: impl Into<String>) -> Wrong {
        Wrong { line: None, found: found.into(), expected: expected.into() }
    }
}

/// A format, by the end of a file's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Stl,
    Obj,
    Gltf,
    Vrml,
}

const FORMATS: &str = "expected a file that ends with .stl, .obj, .gltf, .glb or .wrl";

fn format_of(path: &str) -> Result<Format, Wrong> {
    let end = path.rsplit_once('.').map(|(_, end)| end.to_ascii_lowercase()).unwrap_or_default();
    Ok(match end.as_str() {
        "stl" => Format::Stl,
        "obj" => Format::Obj,
        "gltf" | "glb" => Format::Gltf,
        "wrl" | "vrml" => Format::Vrml,
        "step" | "stp" | "iges" | "igs" => {
            let kind = if end.starts_with('s') { "STEP" } else { "IGES" };
            return Err(Wrong::somewhere(
                format!("{kind} describes surfaces, not triangles"),
                "expected a mesh; FreeCAD converts it: `freecadcmd -c \"import Mesh, Part; s = Part.read('in.step'); \
                 Mesh.Mesh(s.tessellate(0.1)).write('out.stl')\"`, then unit=\"mm\"",
            ));
        }
        _ => return Err(Wrong::somewhere("this is no format of meshes known here", FORMATS)),
    })
}

/// Reads the mesh of the file at `path` from its `bytes`; `beside` gives the bytes of a file that it names, by its path as
/// seen from the file's folder.
pub fn read(
    path: &str,
    bytes: &[u8],
    reading: Reading,
    beside: &dyn Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<Mesh, MeshError> {
    let read = || {
        let format = format_of(path)?;
        let soup = match format {
            Format::Stl => stl::read(bytes)?,
            Format::Obj => obj::read(text(bytes)?)?,
            Format::Gltf => gltf::read(bytes, beside)?,
            Format::Vrml => vrml::read(text(bytes)?)?,
        };
        // glTF and VRML 97 are in metres with y up by their standards; STL and OBJ say neither.
        let says = matches!(format, Format::Gltf | Format::Vrml);
        let metres = match (reading.metres, says) {
            (Some(metres), _) => metres,
            (None, true) => 1.0,
            (None, false) => {
                return Err(Wrong::somewhere(
                    "a mesh in no unit",
                    "expected a unit, as unit=\"mm\": its format has none",
                ));
            }
        };
        let up = reading.up.unwrap_or(if says { Up::Y } else { Up::Z });
        soup.into_mesh(path, metres, up)
    };
    let mesh =
        read().map_err(|Wrong { line, found, expected }| MeshError { file: path.to_owned(), line, found, expected })?;
    Ok(if reading.simplify > 0.0 { mesh.simplified(reading.simplify) } else { mesh })
}

fn text(bytes: &[u8]) -> Result<&str, Wrong> {
    std::str::from_utf8(bytes).map_err(|error| {
        let line = bytes[..error.valid_up_to()].iter().filter(|byte| **byte == b'\n').count() + 1;
        Wrong::at(line, "this is no text", "expected UTF-8")
    })
}
