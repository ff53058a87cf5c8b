//! The surface of a conveyor: where on it a place is, what of a part stands on it, and how it carries.

use super::{Beam, Block, Bounds, DPose3, DVec2, DVec3, Motion, Polygon};

/// The shape of a conveyor's surface in its own frame: it begins at the origin and runs along x, y is to its left, the
/// surface is z = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    Straight {
        length: f64,
        width: f64,
    },
    /// An arc of `radius` on the centre line that turns by `angle`, to the left if positive.
    Curve {
        radius: f64,
        angle: f64,
        width: f64,
    },
}

/// A place relative to a conveyor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Along {
    /// On its centre line, from its start; below 0 before it, above its length beyond its end.
    pub station: f64,
    /// To the left of the centre line.
    pub offset: f64,
}

/// How finely a curve is cut into straight slices: a quarter turn is thirty-two, so that the outer edge of a curve of 1 m
/// is off by 0.3 mm.
const SLICES_PER_RADIAN: f64 = 20.4;

/// Within what height a part stands on a surface, m.
const LEVEL_M: f64 = 1e-3;

/// The level surface of a conveyor in the world.
#[derive(Clone, Debug)]
pub struct Surface {
    shape: Shape,
    origin: DVec3,
    yaw: f64,
    /// The direction in which it begins.
    along: DVec2,
    /// The outline, cut into convex pieces.
    pieces: Vec<(Bounds, Polygon)>,
    bounds: Bounds,
}

impl Surface {
    /// The surface of `shape` whose frame is `pose`; the pose's tilt, if there is any, is dropped.
    pub fn new(shape: Shape, pose: &DPose3) -> Surface {
        let x = pose.rotation * DVec3::X;
        let along = x.truncate().normalize_or(DVec2::X);
        let yaw = along.to_angle();
        let mut surface =
            Surface { shape, origin: pose.translation, yaw, along, pieces: Vec::new(), bounds: Bounds::EMPTY };
        let count = match shape {
            Shape::Straight { .. } => 1,
            Shape::Curve { angle, .. } => (angle.abs() * SLICES_PER_RADIAN).ceil().max(1.0) as usize,
        };
        let step = surface.length() / count as f64;
        for index in 0..count {
            let polygon = surface.slice(step * index as f64, step * (index + 1) as f64);
            let mut bounds = Bounds::EMPTY;
            for corner in polygon.corners() {
                let corner = corner.extend(surface.origin.z);
                bounds = bounds.merged(Bounds { low: corner, high: corner });
            }
            surface.bounds = surface.bounds.merged(bounds);
            surface.pieces.push((bounds, polygon));
        }
        surface
    }

    /// The quadrilateral between two stations.
    fn slice(&self, from: f64, to: f64) -> Polygon {
        let half = self.width() / 2.0;
        let corner = |station, offset| self.at(Along { station, offset }).0;
        Polygon::new(&[corner(from, -half), corner(to, -half), corner(to, half), corner(from, half)])
    }

    /// Length of the centre line.
    pub fn length(&self) -> f64 {
        match self.shape {
            Shape::Straight { length, .. } => length,
            Shape::Curve { radius, angle, .. } => radius * angle.abs(),
        }
    }

    /// Width across the running direction.
    pub fn width(&self) -> f64 {
        match self.shape {
            Shape::Straight { width, .. } | Shape::Curve { width, .. } => width,
        }
    }

    /// Height of the surface in the world.
    pub fn height(&self) -> f64 {
        self.origin.z
    }

    /// The world's box about it, flat.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// Whether a body whose bottom is at `height` stands on it, if it is over it at all.
    pub fn bears(&self, height: f64) -> bool {
        (height - self.origin.z).abs() < LEVEL_M
    }

    /// Where the centre of the arc is, and which way it turns (1 left, -1 right).
    fn pivot(&self, radius: f64, angle: f64) -> (DVec2, f64) {
        let turn = angle.signum();
        (self.origin.truncate() + self.along.perp() * (radius * turn), turn)
    }

    /// Where `place` is relative to the conveyor.
    pub fn locate(&self, place: DVec2) -> Along {
        match self.shape {
            Shape::Straight { .. } => {
                let arm = place - self.origin.truncate();
                Along { station: arm.dot(self.along), offset: self.along.perp_dot(arm) }
            }
            Shape::Curve { radius, angle, .. } => {
                let (pivot, turn) = self.pivot(radius, angle);
                let arm = place - pivot;
                // Counted from the middle of the arc, where the angle has no jump within half a turn either way.
                let start = self.along.perp() * -turn;
                let middle = DVec2::from_angle(angle / 2.0).rotate(start);
                let swept = middle.perp_dot(arm).atan2(middle.dot(arm)) * turn;
                Along { station: radius * (swept + angle.abs() / 2.0), offset: (radius - arm.length()) * turn }
            }
        }
    }

    /// The place at a station and an offset, and the running direction there as a heading.
    pub fn at(&self, along: Along) -> (DVec2, f64) {
        match self.shape {
            Shape::Straight { .. } => {
                let place = self.origin.truncate() + self.along * along.station + self.along.perp() * along.offset;
                (place, self.yaw)
            }
            Shape::Curve { radius, angle, .. } => {
                let (pivot, turn) = self.pivot(radius, angle);
                let swept = along.station / radius * turn;
                let arm = self.along.perp() * (along.offset - radius * turn);
                (pivot + DVec2::from_angle(swept).rotate(arm), self.yaw + swept)
            }
        }
    }

    /// How a body whose centre stands at `centre` is moved when the surface moves by `displacement` on its centre line.
    pub fn carry(&self, centre: DVec2, displacement: f64) -> Motion {
        match self.shape {
            Shape::Straight { .. } => Motion { shift: self.along * displacement, turn: 0.0 },
            Shape::Curve { radius, angle, .. } => {
                let (pivot, turn) = self.pivot(radius, angle);
                let swept = displacement / radius * turn;
                let arm = centre - pivot;
                Motion { shift: DVec2::from_angle(swept).rotate(arm) - arm, turn: swept }
            }
        }
    }

    /// How much of `block`'s bottom face is over it, m²; at whatever height.
    pub fn area_under(&self, block: &Block) -> f64 {
        let footprint = block.footprint();
        let over = |bounds: &Bounds| {
            let (a, b) = (bounds, block.bounds());
            a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y
        };
        if !over(&self.bounds) {
            return 0.0;
        }
        self.pieces.iter().filter(|(bounds, _)| over(bounds)).map(|(_, piece)| footprint.clipped(piece).area()).sum()
    }

    /// How far any point of `block` may move at least until a corner of its bottom face is no longer over it, m; below 0 where
    /// one is not over it now.
    pub fn margin_of(&self, block: &Block) -> f64 {
        let (half, length) = (self.width() / 2.0, self.length());
        let margin = |&corner: &DVec2| {
            let Along { station, offset } = self.locate(corner);
            let ends = match self.shape {
                Shape::Straight { .. } => station.min(length - station),
                Shape::Curve { radius, angle, .. } => {
                    // How far it is to the line of an end, which runs through the pivot.
                    let arm = radius - offset * angle.signum();
                    let swept = station.min(length - station) / radius;
                    arm * swept.min(std::f64::consts::FRAC_PI_2).sin()
                }
            };
            ends.min(half - offset.abs())
        };
        block.footprint().corners().iter().map(margin).fold(f64::INFINITY, f64::min)
    }

    /// The beam of a light barrier across the whole width at `station`, `height` above the surface.
    pub fn beam(&self, station: f64, height: f64) -> Beam {
        let end = |offset| self.at(Along { station, offset }).0.extend(self.origin.z + height);
        Beam::new(end(self.width() / 2.0), end(-self.width() / 2.0))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use proptest::prelude::*;

    use super::super::Upright;
    use super::*;

    const LEFT: Shape = Shape::Curve { radius: 0.8, angle: FRAC_PI_2, width: 0.6 };
    const RIGHT: Shape = Shape::Curve { radius: 0.8, angle: -FRAC_PI_2, width: 0.6 };
    const STRAIGHT: Shape = Shape::Straight { length: 2.0, width: 0.6 };

    fn surface(shape: Shape) -> Surface {
        Surface::new(shape, &Upright::new(1.0, 2.0, 0.75, 0.0).pose())
    }

    fn check_end(shape: Shape, x: f64, y: f64, heading: f64) {
        let surface = surface(shape);
        let (place, yaw) = surface.at(Along { station: surface.length(), offset: 0.0 });
        assert!((place - DVec2::new(x, y)).length() < 1e-12, "{place}");
        assert!((yaw - heading).abs() < 1e-12, "{yaw}");
    }

    #[test]
    fn conveyors_end_where_they_should() {
        check_end(STRAIGHT, 3.0, 2.0, 0.0);
        check_end(LEFT, 1.8, 2.8, FRAC_PI_2);
        check_end(RIGHT, 1.8, 1.2, -FRAC_PI_2);
        check_end(Shape::Curve { radius: 1.0, angle: PI, width: 0.5 }, 1.0, 4.0, PI);
    }

    #[test]
    fn a_box_half_on_two_belts_is_half_on_each() {
        let before = surface(STRAIGHT);
        let after = Surface::new(LEFT, &Upright::new(3.0, 2.0, 0.75, 0.0).pose());
        let block = Block::new(DVec3::new(0.36, 0.32, 0.2), Upright::new(3.0, 2.0, 0.75, 0.0));
        assert!((before.area_under(&block) - 0.18 * 0.32).abs() < 1e-12);
        let on_curve = after.area_under(&block);
        assert!((on_curve - 0.18 * 0.32).abs() < 1e-12, "{on_curve}");
    }

    #[test]
    fn slices_of_a_curve_lose_next_to_nothing() {
        let all = Block::new(DVec3::new(9.0, 9.0, 0.2), Upright::new(1.0, 2.0, 0.75, 0.0));
        let exact = FRAC_PI_2 / 2.0 * (1.1f64.powi(2) - 0.5f64.powi(2));
        let found = surface(LEFT).area_under(&all);
        assert!(found < exact && found > exact * 0.999, "{found} of {exact}");
    }

    #[test]
    fn a_beam_lies_across_the_belt() {
        let [left, right] = surface(LEFT).beam(0.8 * FRAC_PI_2, 0.05).ends();
        assert!((left - DVec3::new(1.5, 2.8, 0.8)).length() < 1e-12, "{left}");
        assert!((right - DVec3::new(2.1, 2.8, 0.8)).length() < 1e-12, "{right}");
    }

    #[test]
    fn corners_within_and_without() {
        let held =
            |x| surface(STRAIGHT).margin_of(&Block::new(DVec3::splat(0.4), Upright::new(x, 2.0, 0.75, 0.0))) >= 0.0;
        assert!(held(1.2) && held(2.8) && !held(1.19) && !held(2.81));
    }

    proptest! {
        #[test]
        fn a_part_stays_within_as_long_as_it_moves_less_than_its_margin(
            shape in prop_oneof![
                Just(STRAIGHT), Just(LEFT), Just(RIGHT), Just(Shape::Curve { radius: 0.5, angle: 2.8, width: 0.6 }),
            ],
            (along, across, yaw) in (0.0..1.0, -0.25..0.25, -PI..PI),
            (way, share, turned) in (-PI..PI, 0.0..1.0, 0.0..1.0),
        ) {
            let surface = surface(shape);
            let place: DVec2 = surface.at(Along { station: surface.length() * along, offset: across }).0;
            let block = Block::new(DVec3::new(0.2, 0.1, 0.2), Upright { place: place.extend(0.75), yaw });
            let margin = surface.margin_of(&block);
            let is_over = |block: &Block| block.footprint().corners().iter().all(|&corner| {
                let Along { station, offset } = surface.locate(corner);
                (0.0..=surface.length()).contains(&station) && offset.abs() <= surface.width() / 2.0
            });
            prop_assert_eq!(margin >= 0.0, is_over(&block), "{}", margin);
            if margin > 0.0 {
                // The margin is spent on a shift and on a turn.
                let left = margin * share * 0.999;
                let shift: DVec2 = DVec2::from_angle(way) * (left * (1.0 - turned));
                let turn = left * turned / block.radius();
                let mut moved = block;
                moved.move_to(Upright { place: (place + shift).extend(0.75), yaw: yaw + turn });
                prop_assert!(is_over(&moved), "margin {}", margin);
            }
        }

        #[test]
        fn a_place_is_found_again(
            shape in prop_oneof![Just(STRAIGHT), Just(LEFT), Just(RIGHT)], yaw in -3.0..3.0f64,
            part in 0.0..1.0f64, offset in -0.3..0.3f64,
        ) {
            let surface = Surface::new(shape, &Upright::new(-4.0, 7.0, 0.3, yaw).pose());
            let along = Along { station: part * surface.length(), offset };
            let found = surface.locate(surface.at(along).0);
            prop_assert!((found.station - along.station).abs() < 1e-9 && (found.offset - along.offset).abs() < 1e-9);
        }

        #[test]
        fn carrying_goes_along_the_centre_line(
            shape in prop_oneof![Just(STRAIGHT), Just(LEFT), Just(RIGHT)], part in 0.1..0.9f64, way in -0.1..0.1f64,
            offset in -0.3..0.3f64,
        ) {
            let surface = surface(shape);
            let station = part * surface.length();
            let (place, heading) = surface.at(Along { station, offset });
            let motion = surface.carry(place, way);
            let upright = Upright { place: place.extend(0.75), yaw: heading };
            let moved = upright.moved(motion, place);
            let (expected, turned) = surface.at(Along { station: station + way, offset });
            prop_assert!((moved.place.truncate() - expected).length() < 1e-9);
            prop_assert!((moved.yaw - turned).abs() < 1e-9);
        }
    }
}
