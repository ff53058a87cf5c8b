//! The shapes that bodies are put together from. Each adds itself to a mesh, closed and facing outwards.

use std::f64::consts::TAU;

use super::Mesh;
use super::outline::{fill, rectangle};
use crate::kinematics::{DPose3, DVec2, DVec3};

/// Adds a cuboid of `size` about `centre`.
pub(crate) fn cuboid(mesh: &mut Mesh, size: DVec3, centre: DVec3) {
    let base = DPose3::from_translation(centre - DVec3::new(0.0, 0.0, size.z / 2.0));
    extrude(mesh, &rectangle(size.x, size.y), size.z, &base);
}

/// Adds a prism: `outline` (anticlockwise) in the x, y plane of `base`, raised by `height` along its z.
pub(crate) fn extrude(mesh: &mut Mesh, outline: &[DVec2], height: f64, base: &DPose3) {
    let count = outline.len() as u32;
    let mut ring = |z: f64| {
        let first = mesh.vertices.len() as u32;
        for corner in outline {
            mesh.vertex(base.transform_point(corner.extend(z)));
        }
        first
    };
    let (low, high) = (ring(0.0), ring(height));
    wall(mesh, low, high, count);
    for [a, b, c] in fill(outline) {
        mesh.triangles.push([low + c, low + b, low + a]);
        mesh.triangles.push([high + a, high + b, high + c]);
    }
}

/// Adds a tube of any section: what lies between `outer` and `inner` (both anticlockwise, with as many corners), raised by
/// `height` along the z of `base`.
pub(crate) fn tube(mesh: &mut Mesh, outer: &[DVec2], inner: &[DVec2], height: f64, base: &DPose3) {
    let count = outer.len() as u32;
    let mut ring = |outline: &[DVec2], z: f64| {
        let first = mesh.vertices.len() as u32;
        for corner in outline {
            mesh.vertex(base.transform_point(corner.extend(z)));
        }
        first
    };
    let rings = [ring(outer, 0.0), ring(outer, height), ring(inner, height), ring(inner, 0.0)];
    for index in 0..4 {
        wall(mesh, rings[index], rings[(index + 1) % 4], count);
    }
}

/// Joins two rings of `count` vertices, the second to the left of the first as it runs.
fn wall(mesh: &mut Mesh, low: u32, high: u32, count: u32) {
    for index in 0..count {
        let next = (index + 1) % count;
        mesh.triangles.push([low + index, low + next, high + next]);
        mesh.triangles.push([low + index, high + next, high + index]);
    }
}

/// Adds what `profile` sweeps when it is turned about the z axis of `base`: pairs of radius and height, from the bottom to the
/// top on the outside. It begins and ends on the axis (radius 0), or is closed by a disc there.
pub(crate) fn lathe(mesh: &mut Mesh, profile: &[[f64; 2]], segments: usize, base: &DPose3) {
    let mut before: Option<Ring> = None;
    let on_axis = |z: f64| [[0.0, z]];
    let first = profile.first().filter(|[radius, _]| *radius > 0.0).map(|[_, z]| on_axis(*z));
    let last = profile.last().filter(|[radius, _]| *radius > 0.0).map(|[_, z]| on_axis(*z));
    for &[radius, z] in first.iter().flatten().chain(profile).chain(last.iter().flatten()) {
        let ring = Ring::new(mesh, radius, z, segments, base);
        if let Some(before) = before {
            before.join(ring, mesh, segments as u32);
        }
        before = Some(ring);
    }
}

/// A ring of vertices, or the one vertex on the axis.
#[derive(Clone, Copy)]
struct Ring {
    first: u32,
    is_point: bool,
}

impl Ring {
    fn new(mesh: &mut Mesh, radius: f64, z: f64, segments: usize, base: &DPose3) -> Ring {
        let first = mesh.vertices.len() as u32;
        let is_point = radius == 0.0;
        for index in 0..if is_point { 1 } else { segments } {
            let arm = DVec2::from_angle(TAU * index as f64 / segments as f64) * radius;
            mesh.vertex(base.transform_point(arm.extend(z)));
        }
        Ring { first, is_point }
    }

    fn join(self, above: Ring, mesh: &mut Mesh, count: u32) {
        match (self.is_point, above.is_point) {
            (false, false) => wall(mesh, self.first, above.first, count),
            (true, false) => {
                (0..count)
                    .for_each(|i| mesh.triangles.push([self.first, above.first + (i + 1) % count, above.first + i]));
            }
            (false, true) => {
                (0..count)
                    .for_each(|i| mesh.triangles.push([self.first + i, self.first + (i + 1) % count, above.first]));
            }
            (true, true) => {}
        }
    }
}

/// Adds a straight round bar from `from` to `to`.
pub(crate) fn bar(mesh: &mut Mesh, from: DVec3, to: DVec3, radius: f64, segments: usize) {
    lathe(mesh, &[[radius, 0.0], [radius, (to - from).length()]], segments, &along(from, to));
}

/// The frame at `from` whose z points to `to`.
pub(crate) fn along(from: DVec3, to: DVec3) -> DPose3 {
    let way = (to - from).normalize_or(DVec3::Z);
    DPose3::from_parts(from, crate::kinematics::DQuat::from_rotation_arc(DVec3::Z, way))
}

/// Adds a ring sector about the z axis through `pivot`: radii `radii`, heights `heights`, from the angle `from` by `swept`
/// (positive: to the left).
pub(crate) fn sector(
    mesh: &mut Mesh,
    pivot: DVec2,
    radii: [f64; 2],
    heights: [f64; 2],
    angles: [f64; 2],
    count: usize,
) {
    let [from, swept] = angles;
    let section = |index: usize| {
        let direction = DVec2::from_angle(from + swept * index as f64 / count as f64);
        let at = |radius: f64, z: f64| (pivot + direction * radius).extend(z);
        [at(radii[0], heights[0]), at(radii[1], heights[0]), at(radii[1], heights[1]), at(radii[0], heights[1])]
    };
    let first = mesh.vertices.len() as u32;
    for index in 0..=count {
        for corner in section(index) {
            mesh.vertex(corner);
        }
    }
    let mut triangle = |a: u32, b: u32, c: u32| {
        let turned = if swept > 0.0 { [a, b, c] } else { [a, c, b] };
        mesh.triangles.push(turned.map(|index| first + index));
    };
    for index in 0..count as u32 {
        let (here, there) = (index * 4, index * 4 + 4);
        for corner in 0..4 {
            let next = (corner + 1) % 4;
            triangle(here + corner, there + next, here + next);
            triangle(here + corner, there + corner, there + next);
        }
    }
    let end = count as u32 * 4;
    triangle(0, 1, 2);
    triangle(0, 2, 3);
    triangle(end, end + 2, end + 1);
    triangle(end, end + 3, end + 2);
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::super::outline::{circle, stadium};
    use super::*;

    #[track_caller]
    fn check(make: impl Fn(&mut Mesh), volume: f64) {
        let mut mesh = Mesh::new("test");
        make(&mut mesh);
        assert_eq!(mesh.open_edges(), 0);
        assert!((mesh.volume() / volume - 1.0).abs() < 1e-5, "{} is not {volume}", mesh.volume());
    }

    #[test]
    fn shapes_are_closed_and_face_outwards() {
        check(|mesh| cuboid(mesh, DVec3::new(1.0, 2.0, 3.0), DVec3::new(5.0, 0.0, -1.0)), 6.0);
        let tilted = along(DVec3::ONE, DVec3::new(2.0, 3.0, 1.5));
        let disc = |radius: f64, segments: f64| 0.5 * segments * (TAU / segments).sin() * radius * radius;
        check(|mesh| extrude(mesh, &circle(1.0, 12), 2.0, &tilted), 2.0 * disc(1.0, 12.0));
        check(|mesh| tube(mesh, &stadium(1.0, 0.2, 8), &stadium(1.0, 0.1, 8), 0.5, &tilted), {
            0.5 * (0.4 + disc(0.2, 16.0) - 0.2 - disc(0.1, 16.0))
        });
        check(|mesh| bar(mesh, DVec3::ZERO, DVec3::new(0.0, 1.0, 0.0), 0.1, 24), disc(0.1, 24.0));
        check(|mesh| lathe(mesh, &[[0.0, 0.0], [1.0, 1.0], [0.0, 2.0]], 64, &tilted), 2.0 / 3.0 * disc(1.0, 64.0));
        let ring =
            |swept: f64| move |mesh: &mut Mesh| sector(mesh, DVec2::ONE, [1.0, 2.0], [-0.1, 0.1], [0.3, swept], 90);
        let quarter = 0.2 * 3.0 * 0.5 * 90.0 * (FRAC_PI_2 / 90.0).sin();
        check(ring(FRAC_PI_2), quarter);
        check(ring(-FRAC_PI_2), quarter);
        assert!((quarter / (0.2 * 3.0 * PI / 4.0) - 1.0).abs() < 1e-3);
    }
}
