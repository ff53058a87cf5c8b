//! glTF 2.0, as JSON with its buffers beside it or in it, and binary (`.glb`). Of the default scene, all triangles in their
//! places.

use base64::Engine as _;
use gltf::buffer::Source;
use gltf::mesh::Mode;
use gltf::{Gltf, Node};

use super::Wrong;
use super::soup::Soup;
use crate::kinematics::DVec3;

/// Nodes under nodes end here: glTF forbids circles, and its library does not look.
const DEEPEST: usize = 64;

type Beside<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

pub(super) fn read(bytes: &[u8], beside: Beside<'_>) -> Result<Soup, Wrong> {
    let file = Gltf::from_slice(bytes)
        .map_err(|error| Wrong::somewhere(format!("this is no glTF: {error}"), "expected glTF 2.0, JSON or binary"))?;
    let mut blob = file.blob.clone();
    let mut buffers = Vec::new();
    for buffer in file.buffers() {
        let data = match buffer.source() {
            Source::Bin => blob.take().ok_or_else(|| torn("its binary part is missing"))?,
            Source::Uri(uri) => from_uri(uri, beside)?,
        };
        if data.len() < buffer.length() {
            return Err(torn(&format!("buffer {} has {} bytes of {}", buffer.index(), data.len(), buffer.length())));
        }
        buffers.push(data);
    }
    for view in file.views() {
        let end = view.offset().checked_add(view.length());
        if end.is_none_or(|end| end > buffers[view.buffer().index()].len()) {
            return Err(torn(&format!("view {} reaches beyond its buffer", view.index())));
        }
    }
    let mut soup = Soup::default();
    let scene = file.default_scene().or_else(|| file.scenes().next());
    let identity = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    for node in scene.iter().flat_map(|scene| scene.nodes()) {
        add(&node, &identity, &buffers, &mut soup, 0)?;
    }
    Ok(soup)
}

fn torn(what: &str) -> Wrong {
    Wrong::somewhere(what, "expected a whole file: is it torn?")
}

fn from_uri(uri: &str, beside: Beside<'_>) -> Result<Vec<u8>, Wrong> {
    let Some(data) = uri.strip_prefix("data:") else {
        return beside(uri).map_err(|error| Wrong::somewhere(error, "expected the buffer that the file names"));
    };
    let encoded = data.split_once(";base64,").map(|(_, encoded)| encoded);
    encoded
        .and_then(|encoded| base64::engine::general_purpose::STANDARD.decode(encoded).ok())
        .ok_or_else(|| Wrong::somewhere("a data URI that is no base64", "expected data:…;base64,…"))
}

/// Columns of a 4 × 4 matrix.
type Matrix = [[f64; 4]; 4];

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|column| std::array::from_fn(|row| (0..4).map(|inner| a[inner][row] * b[column][inner]).sum()))
}

fn add(node: &Node<'_>, above: &Matrix, buffers: &[Vec<u8>], soup: &mut Soup, depth: usize) -> Result<(), Wrong> {
    if depth > DEEPEST {
        return Err(Wrong::somewhere("nodes under nodes without end", format!("expected at most {DEEPEST}")));
    }
    let matrix = product(above, &node.transform().matrix().map(|column| column.map(f64::from)));
    for primitive in node.mesh().iter().flat_map(|mesh| mesh.primitives()) {
        let Some(corners) = corners_of(primitive.mode()) else { continue };
        let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(Vec::as_slice));
        let Some(positions) = reader.read_positions() else { continue };
        let first = soup.vertices.len() as u32;
        for position in positions {
            let [x, y, z] = position.map(f64::from);
            let row = |row: usize| matrix[0][row] * x + matrix[1][row] * y + matrix[2][row] * z + matrix[3][row];
            soup.vertices.push(DVec3::new(row(0), row(1), row(2)));
        }
        let count = soup.vertices.len() as u32 - first;
        let indices: Vec<u32> = match reader.read_indices() {
            Some(indices) => indices.into_u32().collect(),
            None => (0..count).collect(),
        };
        if let Some(index) = indices.iter().find(|index| **index >= count) {
            return Err(Wrong::somewhere(format!("vertex {index} of {count}"), "expected one that is there"));
        }
        soup.triangles.extend(corners(&indices).into_iter().map(|corners| corners.map(|corner| first + corner)));
    }
    node.children().try_for_each(|child| add(&child, &matrix, buffers, soup, depth + 1))
}

type Corners = fn(&[u32]) -> Vec<[u32; 3]>;

/// How a list of indices becomes triangles; `None` for points and lines.
fn corners_of(mode: Mode) -> Option<Corners> {
    match mode {
        Mode::Triangles => Some(|all| all.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect()),
        Mode::TriangleStrip => Some(|all| {
            let turned =
                |(index, t): (usize, &[u32])| if index % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] };
            all.windows(3).enumerate().map(turned).collect()
        }),
        Mode::TriangleFan => Some(|all| {
            let rest = all.get(1..).unwrap_or_default();
            rest.windows(2).map(|pair| [all[0], pair[0], pair[1]]).collect()
        }),
        _ => None,
    }
}
