//! Contact: how near to another a part may come.

use super::part::{Parts, Slot};
use crate::kinematics::{Block, Motion, TOUCH_M, separation};

/// To what distance contact is found, m: parts that met stand at most this far apart.
pub(super) const CONTACT_M: f64 = 1e-6;

/// How deep two parts may be in one another before that counts as a collision, m.
pub(super) const COLLISION_M: f64 = 1e-4;

/// Whether two blocks are in one another, more than by rounding.
pub(super) fn overlap(a: &Block, b: &Block) -> bool {
    a.bounds().meet(b.bounds()) && separation(a, b).0 < -TOUCH_M
}

/// Between `safe`, where `apart` is not negative, and `deep`, where it is, the point nearest to `deep` at which bodies are
/// still apart, by [`CONTACT_M`] at most.
///
/// Secants, because the distance is all but linear within a step's motion; bisection where they do not get there.
pub(super) fn nearest_contact(safe: f64, deep: f64, apart: impl Fn(f64) -> f64) -> f64 {
    let (mut safe, mut deep) = (safe, deep);
    let (mut gap, mut depth) = (apart(safe), apart(deep));
    for round in 0..60 {
        if gap <= CONTACT_M {
            break;
        }
        let share = if round < 8 { (gap - CONTACT_M / 2.0) / (gap - depth) } else { 0.5 };
        let middle = safe + (deep - safe) * share;
        let found = apart(middle);
        if found >= 0.0 {
            (safe, gap) = (middle, found);
        } else {
            (deep, depth) = (middle, found);
        }
    }
    safe
}

/// A body that others may meet: a part with all that stands on it, or a plate.
#[derive(Clone, Copy, Debug)]
pub(super) enum Body<'a> {
    Group(Slot),
    Block(&'a Block),
}

/// How far two bodies are apart after `motions` of them, and the direction from the first to the second in which that is so;
/// infinitely far where none of their blocks are near each other.
pub(super) fn apart(parts: &Parts, bodies: [Body<'_>; 2], motions: [Motion; 2]) -> (f64, crate::kinematics::DVec3) {
    let mut nearest = (f64::INFINITY, crate::kinematics::DVec3::X);
    visit(parts, bodies[0], motions[0], &mut |first| {
        visit(parts, bodies[1], motions[1], &mut |second| {
            // What is further away than this bears on nothing within a step.
            if first.bounds().grown(0.01).meet(second.bounds()) {
                let found = separation(first, second);
                if found.0 < nearest.0 {
                    nearest = found;
                }
            }
        });
    });
    nearest
}

fn visit(parts: &Parts, body: Body<'_>, motion: Motion, to: &mut dyn FnMut(&Block)) {
    match body {
        Body::Block(block) => to(block),
        Body::Group(slot) if motion.is_none() => parts.visit_group(slot, &mut |_, part| to(&part.block)),
        Body::Group(slot) => {
            let centre = parts.get(slot).block.upright().place.truncate();
            parts.visit_group(slot, &mut |_, part| {
                let mut block = part.block;
                block.move_to(block.upright().moved(motion, centre));
                to(&block);
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(apart: impl Fn(f64) -> f64 + Copy) {
        let found = nearest_contact(0.0, 1.0, apart);
        assert!((0.0..=CONTACT_M).contains(&apart(found)), "at {found}: {} apart", apart(found));
    }

    #[test]
    fn contact_is_found_to_a_micrometre() {
        check(|x| 0.3 - x);
        check(|x| 0.3 - x * x * x);
        check(|x| if x < 0.7 { 0.1 } else { 0.1 - (x - 0.7) });
        check(|x| (0.5 - x).signum() * (0.5 - x).abs().sqrt());
    }

    #[test]
    fn who_stands_in_contact_stays() {
        assert_eq!(nearest_contact(0.0, 1.0, |x| 5e-7 - x), 0.0);
    }
}
