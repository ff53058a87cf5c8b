//! Plane outlines and how they are filled with triangles.

use crate::kinematics::{DVec2, DVec3};

/// The triangles of the simple polygon `corners`, which runs anticlockwise, by ear clipping (Meisters 1975). Outlines here have
/// some tens of corners: that it takes the cube of them does not show.
pub(crate) fn fill(corners: &[DVec2]) -> Vec<[u32; 3]> {
    let mut left: Vec<u32> = (0..corners.len() as u32).collect();
    let mut triangles = Vec::with_capacity(corners.len().saturating_sub(2));
    while left.len() > 3 {
        let count = left.len();
        let ear = (0..count).find(|&index| is_ear(corners, &left, index));
        // A polygon has an ear; one that crosses itself by rounding may not, and loses a corner all the same.
        let index = ear.unwrap_or(0);
        triangles.push([left[(index + count - 1) % count], left[index], left[(index + 1) % count]]);
        left.remove(index);
    }
    if let [a, b, c] = left[..] {
        triangles.push([a, b, c]);
    }
    triangles
}

/// The triangles of a polygon in space, which is nearly plane and runs anticlockwise as seen from outside.
pub(crate) fn fill_in_space(corners: &[DVec3]) -> Vec<[u32; 3]> {
    if corners.len() == 3 {
        return vec![[0, 1, 2]];
    }
    // Its normal by Newell's method: right for any simple polygon, plane or not quite.
    let next = corners.iter().cycle().skip(1);
    let normal: DVec3 = corners.iter().zip(next).map(|(a, b)| a.cross(*b)).sum();
    let normal = normal.normalize_or(DVec3::Z);
    let across = normal.any_orthonormal_vector();
    let up = normal.cross(across);
    let flat: Vec<DVec2> = corners.iter().map(|corner| DVec2::new(corner.dot(across), corner.dot(up))).collect();
    fill(&flat)
}

fn is_ear(corners: &[DVec2], left: &[u32], index: usize) -> bool {
    let count = left.len();
    let at = |index: usize| corners[left[index % count] as usize];
    let [a, b, c] = [at(index + count - 1), at(index), at(index + 1)];
    let side = |a: DVec2, b: DVec2, p: DVec2| (b - a).perp_dot(p - a);
    if side(a, b, c) <= 0.0 {
        return false;
    }
    let holds = |p: DVec2| side(a, b, p) >= 0.0 && side(b, c, p) >= 0.0 && side(c, a, p) >= 0.0;
    let others = (0..count).map(at).filter(|p| *p != a && *p != b && *p != c);
    !others.into_iter().any(holds)
}

/// A circle of `radius` in `segments`, anticlockwise from the x axis.
#[cfg(test)]
pub(crate) fn circle(radius: f64, segments: usize) -> Vec<DVec2> {
    let angle = |index: usize| std::f64::consts::TAU * index as f64 / segments as f64;
    (0..segments).map(|index| DVec2::from_angle(angle(index)) * radius).collect()
}

/// A rectangle about the origin.
pub(crate) fn rectangle(width: f64, height: f64) -> Vec<DVec2> {
    let (x, y) = (width / 2.0, height / 2.0);
    vec![DVec2::new(-x, -y), DVec2::new(x, -y), DVec2::new(x, y), DVec2::new(-x, y)]
}

/// A belt's path about two pulleys of `radius` whose centres are `reach` apart along x, about the origin: half circles of
/// `segments` at its ends.
pub(crate) fn stadium(reach: f64, radius: f64, segments: usize) -> Vec<DVec2> {
    let half = |centre: f64, from: f64| {
        (0..=segments).map(move |index| {
            let angle = from + std::f64::consts::PI * index as f64 / segments as f64;
            DVec2::new(centre, 0.0) + DVec2::from_angle(angle) * radius
        })
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    half(reach / 2.0, -quarter).chain(half(-reach / 2.0, quarter)).collect()
}

/// A square profile of `side` with a slot of `slot` in each side, `depth` deep: the extrusion that machine frames are made of.
pub(crate) fn slotted(side: f64, slot: f64, depth: f64) -> Vec<DVec2> {
    let (h, s) = (side / 2.0, slot / 2.0);
    let one =
        [DVec2::new(h, -h), DVec2::new(h, -s), DVec2::new(h - depth, -s), DVec2::new(h - depth, s), DVec2::new(h, s)];
    let quarter = |turns: i32| DVec2::from_angle(std::f64::consts::FRAC_PI_2 * f64::from(turns));
    (0..4).flat_map(|turns| one.map(|corner| quarter(turns).rotate(corner))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(corners: &[DVec2]) -> f64 {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(a, b)| a.perp_dot(*b) / 2.0).sum()
    }

    #[track_caller]
    fn check(corners: &[DVec2], expected: f64) {
        assert!((area(corners) - expected).abs() < 1e-12, "{}", area(corners));
        let triangles = fill(corners);
        assert_eq!(triangles.len(), corners.len() - 2);
        let areas: Vec<f64> = triangles.iter().map(|t| area(&t.map(|index| corners[index as usize]))).collect();
        assert!(areas.iter().all(|area| *area > 0.0), "{areas:?}");
        assert!((areas.iter().sum::<f64>() - expected).abs() < 1e-12, "{areas:?}");
    }

    #[test]
    fn outlines_are_filled_once() {
        check(&rectangle(2.0, 3.0), 6.0);
        check(&slotted(0.04, 0.008, 0.01), 0.04 * 0.04 - 4.0 * 0.008 * 0.01);
        let hexagon = 6.0 / 2.0 * (std::f64::consts::TAU / 6.0).sin();
        check(&circle(1.0, 6), hexagon);
        check(&stadium(2.0, 1.0, 3), 2.0 * 2.0 + hexagon);
        let arrow = [DVec2::new(0.0, 0.0), DVec2::new(2.0, -1.0), DVec2::new(1.0, 0.0), DVec2::new(2.0, 1.0)];
        check(&arrow, 1.0);
    }
}
