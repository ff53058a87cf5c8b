//! The pieces that bodies are made of, and how far two of them are apart.

use std::sync::Arc;

use parry3d_f64::query::sat::{
    cuboid_cuboid_find_local_separating_edge_twoway as edges_apart,
    cuboid_cuboid_find_local_separating_normal_oneway as faces_apart,
};
use parry3d_f64::query::{contact, distance};
use parry3d_f64::shape::{Cuboid, Shape, TriMesh};

use crate::kinematics::{Bounds, DPose3, DVec3};
use crate::mesh::Mesh;

/// How deep two bodies may be in one another and still only touch, m.
pub const COLLISION_M: f64 = 1e-4;

/// How far a corner may be from a box's and the piece still be that box, m: rounding to f32 at some metres.
const SAME_CORNER_M: f64 = 1e-5;

/// A connected part of a mesh, about the middle of its box.
#[derive(Clone)]
pub(super) struct Piece {
    pub pose: DPose3,
    pub half: DVec3,
    pub radius: f64,
    /// Its triangles about the middle; `None` where it is its box.
    pub surface: Option<Arc<TriMesh>>,
}

impl Piece {
    /// A box of so much to each side.
    pub fn cuboid(pose: DPose3, half: DVec3) -> Piece {
        Piece { pose, half, radius: half.length(), surface: None }
    }

    /// The piece as it is when its frame is at `pose`.
    pub fn at(&self, pose: &DPose3) -> Piece {
        Piece { pose: *pose * self.pose, ..self.clone() }
    }

    /// The world's box about it.
    pub fn bounds(&self) -> Bounds {
        bounds_of(&self.pose, self.half)
    }
}

/// The box, with its faces along the axes, about a turned one.
pub(super) fn bounds_of(pose: &DPose3, half: DVec3) -> Bounds {
    let reach = [DVec3::X * half.x, DVec3::Y * half.y, DVec3::Z * half.z].map(|arm| (pose.rotation * arm).abs());
    let reach = reach[0] + reach[1] + reach[2];
    Bounds { low: pose.translation - reach, high: pose.translation + reach }
}

/// The pieces of a mesh: its vertices are joined by its triangles.
pub(super) fn pieces_of(mesh: &Mesh) -> Vec<Piece> {
    let mut root: Vec<u32> = (0..mesh.vertices.len() as u32).collect();
    for &[a, b, c] in &mesh.triangles {
        let first = find(&mut root, a);
        for other in [b, c] {
            let other = find(&mut root, other);
            root[other as usize] = first;
        }
    }
    let mut of_root = std::collections::BTreeMap::<u32, Vec<[u32; 3]>>::new();
    for triangle in &mesh.triangles {
        of_root.entry(find(&mut root, triangle[0])).or_default().push(*triangle);
    }
    of_root.into_values().filter_map(|triangles| piece_of(mesh, &triangles)).collect()
}

fn find(root: &mut [u32], mut at: u32) -> u32 {
    while root[at as usize] != at {
        root[at as usize] = root[root[at as usize] as usize];
        at = root[at as usize];
    }
    at
}

fn piece_of(mesh: &Mesh, triangles: &[[u32; 3]]) -> Option<Piece> {
    let mut places = std::collections::BTreeMap::<u32, u32>::new();
    let mut vertices: Vec<DVec3> = Vec::new();
    let mut renumbered = Vec::with_capacity(triangles.len());
    for triangle in triangles {
        renumbered.push(triangle.map(|corner| {
            *places.entry(corner).or_insert_with(|| {
                vertices.push(DVec3::from_array(mesh.vertices[corner as usize].map(f64::from)));
                vertices.len() as u32 - 1
            })
        }));
    }
    let low = vertices.iter().fold(DVec3::INFINITY, |low, vertex| low.min(*vertex));
    let high = vertices.iter().fold(DVec3::NEG_INFINITY, |high, vertex| high.max(*vertex));
    let (centre, half) = ((low + high) / 2.0, (high - low) / 2.0);
    let piece = Piece::cuboid(DPose3::from_translation(centre), half);
    vertices.iter_mut().for_each(|vertex| *vertex -= centre);
    let is_corner = |vertex: &DVec3| (vertex.abs() - half).abs().max_element() < SAME_CORNER_M;
    if triangles.len() == 12 && vertices.len() == 8 && vertices.iter().all(is_corner) {
        return Some(piece);
    }
    let surface = TriMesh::new(vertices, renumbered).ok()?;
    Some(Piece { surface: Some(Arc::new(surface)), ..piece })
}

/// How far two pieces are apart, m: never more than they are; negative by how deep they are in one another. Where the answer is
/// more than `enough`, it may be any number above it.
pub(super) fn apart(a: &Piece, b: &Piece, enough: f64) -> f64 {
    let round = (a.pose.translation - b.pose.translation).length() - a.radius - b.radius;
    if round > enough {
        return round;
    }
    let boxes = boxes_apart(a, b);
    if boxes > 0.0 || (a.surface.is_none() && b.surface.is_none()) {
        return boxes;
    }
    surfaces_apart(a, b)
}

/// By separating axes: the faces' normals of both and the products of their edges (Gottschalk, Lin, Manocha 1996).
fn boxes_apart(a: &Piece, b: &Piece) -> f64 {
    let (ca, cb) = (Cuboid::new(a.half), Cuboid::new(b.half));
    let b_in_a = a.pose.inv_mul(&b.pose);
    let by_faces = faces_apart(&ca, &cb, &b_in_a).0.max(faces_apart(&cb, &ca, &b.pose.inv_mul(&a.pose)).0);
    if by_faces > 0.0 { by_faces } else { by_faces.max(edges_apart(&ca, &cb, &b_in_a).0) }
}

fn surfaces_apart(a: &Piece, b: &Piece) -> f64 {
    let boxes = [Cuboid::new(a.half), Cuboid::new(b.half)];
    let (sa, sb): (&dyn Shape, &dyn Shape) = match (&a.surface, &b.surface) {
        (Some(sa), Some(sb)) => (sa.as_ref(), sb.as_ref()),
        (Some(sa), None) => (sa.as_ref(), &boxes[1]),
        (None, Some(sb)) => (&boxes[0], sb.as_ref()),
        (None, None) => (&boxes[0], &boxes[1]),
    };
    match distance(&a.pose, sa, &b.pose, sb) {
        Ok(found) if found.distance > 0.0 => found.distance,
        _ => match contact(&a.pose, sa, &b.pose, sb, 0.0) {
            Ok(Some(contact)) => contact.dist.min(0.0),
            _ => 0.0,
        },
    }
}
