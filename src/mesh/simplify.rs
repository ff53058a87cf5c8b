//! Fewer triangles for the same shape.

use meshopt::{SimplifyOptions, VertexDataAdapter, simplify, typed_to_bytes};

use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::TriMesh;

use super::Mesh;
use crate::kinematics::DVec3;

/// How often the error asked of the library is halved where its estimate was too kind.
const HALVINGS: u32 = 6;

impl Mesh {
    /// The mesh with fewer triangles, nowhere further than `error` metres from where it was: what looks at it, a ray or a
    /// box, sees it off by no more than that. Edges are collapsed by their quadric error (meshoptimizer), which is an
    /// estimate: the distance of every vertex that is gone is measured afterwards.
    pub fn simplified(&self, error: f64) -> Mesh {
        let mut asked = error;
        for _ in 0..HALVINGS {
            match self.collapsed(asked) {
                Some(simple) if self.departure(&simple) <= error => return simple,
                _ => asked /= 2.0,
            }
        }
        self.clone()
    }

    /// How far at most a vertex of this one lies from the surface of `other`, m.
    pub fn departure(&self, other: &Mesh) -> f64 {
        let Some(surface) = other.surface() else { return f64::INFINITY };
        let distance = |vertex: &[f32; 3]| surface.distance_to_local_point(vec3(vertex), true);
        self.vertices.iter().map(distance).fold(0.0, f64::max)
    }

    /// As a shape to ask; `None` where it has no triangle.
    pub fn surface(&self) -> Option<TriMesh> {
        TriMesh::new(self.vertices.iter().map(vec3).collect(), self.triangles.clone()).ok()
    }

    fn collapsed(&self, error: f64) -> Option<Mesh> {
        let places = VertexDataAdapter::new(typed_to_bytes(&self.vertices), size_of::<[f32; 3]>(), 0).ok()?;
        let indices: Vec<u32> = self.triangles.iter().flatten().copied().collect();
        let kept = simplify(&indices, &places, 0, error as f32, SimplifyOptions::ErrorAbsolute, None);
        let mut places = vec![u32::MAX; self.vertices.len()];
        let mut simple = Mesh::new(self.name.clone());
        for corners in kept.chunks_exact(3) {
            let triangle = [corners[0], corners[1], corners[2]].map(|corner| {
                let place = &mut places[corner as usize];
                if *place == u32::MAX {
                    *place = simple.vertices.len() as u32;
                    simple.vertices.push(self.vertices[corner as usize]);
                }
                *place
            });
            simple.triangles.push(triangle);
        }
        (!simple.triangles.is_empty()).then_some(simple)
    }
}

fn vec3(vertex: &[f32; 3]) -> DVec3 {
    DVec3::from_array(vertex.map(f64::from))
}
