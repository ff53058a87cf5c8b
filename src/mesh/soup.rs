//! What a file holds before it is a mesh: vertices and triangles with the lines they come from.

use std::collections::HashMap;

use super::{Mesh, Up, Wrong};
use crate::kinematics::DVec3;

/// Triangles as they were read.
#[derive(Clone, Debug, Default)]
pub(super) struct Soup {
    /// In the file's unit and axes.
    pub vertices: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    /// Of each triangle, the line that it was read from; empty where the format has none.
    pub lines: Vec<u32>,
}

/// The square of sin of the angle between two edges below which a triangle has no area: rounding of f32 coordinates leaves
/// some 1e-14 of it.
const FLAT: f64 = 1e-13;

impl Soup {
    /// Adds a polygon of vertices that are there already.
    pub fn polygon(&mut self, corners: &[u32], line: usize) -> Result<(), Wrong> {
        if corners.len() < 3 {
            return Err(Wrong::at(line, format!("a face of {} corners", corners.len()), "expected at least 3"));
        }
        if let Some(corner) = corners.iter().find(|corner| **corner as usize >= self.vertices.len()) {
            let found = format!("vertex {corner} (counted from 0) of {}", self.vertices.len());
            return Err(Wrong::at(line, found, "expected one that is there"));
        }
        let places: Vec<DVec3> = corners.iter().map(|corner| self.vertices[*corner as usize]).collect();
        for triangle in super::outline::fill_in_space(&places) {
            self.triangles.push(triangle.map(|index| corners[index as usize]));
            self.lines.push(line as u32);
        }
        Ok(())
    }

    /// The mesh, in metres with z up; equal vertices are made one.
    pub fn into_mesh(self, name: &str, metres: f64, up: Up) -> Result<Mesh, Wrong> {
        if self.triangles.is_empty() {
            return Err(Wrong::somewhere("a file without a triangle", "expected a mesh"));
        }
        let mut mesh = Mesh::new(name);
        let mut known: HashMap<[u32; 3], u32> = HashMap::with_capacity(self.vertices.len());
        let place = |vertex: DVec3| {
            let turned = if up == Up::Y { DVec3::new(vertex.x, -vertex.z, vertex.y) } else { vertex };
            (turned * metres).to_array().map(|x| x as f32 + 0.0)
        };
        let mut renumbered = Vec::with_capacity(self.vertices.len());
        for vertex in &self.vertices {
            let place = place(*vertex);
            renumbered.push(*known.entry(place.map(f32::to_bits)).or_insert_with(|| {
                mesh.vertices.push(place);
                mesh.vertices.len() as u32 - 1
            }));
        }
        for (index, triangle) in self.triangles.iter().enumerate() {
            let line = self.lines.get(index).map(|line| *line as usize);
            self.check(index, *triangle, line)?;
            let [a, b, c] = triangle.map(|corner| renumbered[corner as usize]);
            // What is smaller than the f32 coordinates can tell is no more there.
            if a != b && b != c && c != a {
                mesh.triangles.push([a, b, c]);
            }
        }
        Ok(mesh)
    }

    fn check(&self, index: usize, triangle: [u32; 3], line: Option<usize>) -> Result<(), Wrong> {
        let wrong = |found: String, expected: &str| Err(Wrong { line, found, expected: expected.to_owned() });
        let number = index + 1;
        let [a, b, c] = triangle.map(|corner| self.vertices[corner as usize]);
        if !(a + b + c).is_finite() {
            return wrong(format!("triangle {number} has a corner that is no number"), "expected finite coordinates");
        }
        let (u, v) = (b - a, c - a);
        if u.cross(v).length_squared() <= FLAT * u.length_squared() * v.length_squared() {
            let expected = "expected three corners that are not on one line; the program that wrote it can remove \
                            degenerate faces";
            return wrong(format!("triangle {number} has no area"), expected);
        }
        Ok(())
    }
}
