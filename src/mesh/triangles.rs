//! Triangles.

use crate::kinematics::DVec3;

/// A triangle mesh. Triangles turn anticlockwise as seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// What it is of: the name of a shape with its measures, or the file it was read from.
    pub name: String,
    /// In its own frame, m.
    pub vertices: Vec<[f32; 3]>,
    /// Indices of vertices.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// A mesh of nothing.
    pub fn new(name: impl Into<String>) -> Mesh {
        Mesh { name: name.into(), ..Mesh::default() }
    }

    /// Adds a vertex.
    pub(crate) fn vertex(&mut self, place: DVec3) -> u32 {
        self.vertices.push(place.to_array().map(|x| x as f32));
        self.vertices.len() as u32 - 1
    }

    /// The box about it: its least and its greatest corner, m; `None` where it has no vertex.
    pub fn bounds(&self) -> Option<[[f32; 3]; 2]> {
        let first = *self.vertices.first()?;
        let mut bounds = [first, first];
        for vertex in &self.vertices {
            for axis in 0..3 {
                bounds[0][axis] = bounds[0][axis].min(vertex[axis]);
                bounds[1][axis] = bounds[1][axis].max(vertex[axis]);
            }
        }
        Some(bounds)
    }

    /// The volume it encloses, m³: positive where it is closed and its triangles face outwards (a sum of the tetrahedra from the
    /// origin to each triangle).
    pub fn volume(&self) -> f64 {
        let at = |index: u32| DVec3::from_array(self.vertices[index as usize].map(f64::from));
        self.triangles.iter().map(|&[a, b, c]| at(a).dot(at(b).cross(at(c))) / 6.0).sum()
    }

    /// How many of its edges belong to one triangle only, or to two that run along it the same way: 0 where it is closed.
    pub fn open_edges(&self) -> usize {
        let bits = |index: u32| self.vertices[index as usize].map(|x| (x + 0.0).to_bits());
        let mut edges = std::collections::BTreeMap::new();
        for &[a, b, c] in &self.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let (from, to) = (bits(from), bits(to));
                *edges.entry(if from < to { (from, to) } else { (to, from) }).or_insert(0i32) +=
                    if from < to { 1 } else { -1 };
            }
        }
        edges.values().filter(|count| **count != 0).count()
    }
}
