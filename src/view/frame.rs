//! The stream's messages: what has changed for one viewer since the last that this viewer was sent.
//!
//! A message is binary, little-endian, without gaps:
//!
//! ```text
//! u8  1: a frame              u8  1: it begins anew, forget all before; else 0
//! u16 0                       u32 number of the run: another after a reset
//! f64 simulated time, s       f64 playback's or the run's speed, simulated seconds to a second; 0: as fast as possible
//! u32 frames that moved:      u32 place in the scene, f32 × 7 position (m) and quaternion x y z w in the world
//! u32 parts new or moved:     u32 number, u32 kind (0 box, 1 pallet), f32 × 3 size, f32 × 4 centre of the bottom face and turn
//! u32 parts gone:             u32 number
//! u32 values that changed:    u32 register, f64 value (NaN for what is no number)
//! u32 beams that changed:     u32 place in the scene, u32 1: cut, 0: free
//! u32 frames of the ghost that moved, and its parts new or moved, and gone, each as above
//! ```

use std::collections::BTreeMap;

use crate::engine::PartState;
use crate::kinematics::DPose3;
use crate::plant::PartKind;
use crate::run::control::Picture;
use crate::value::Value;

/// A picture and what it is of.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    /// The number of the run; another after a reset.
    pub run: u32,
    pub picture: Picture,
    /// Where frames and parts of the trace laid over it are.
    pub ghost: Option<Ghost>,
    /// Simulated seconds to a second, 0 for as fast as possible; backwards where negative.
    pub speed: f64,
}

/// Where the frames and the parts of a second trace are.
#[derive(Clone, Debug, Default)]
pub struct Ghost {
    pub poses: Vec<DPose3>,
    pub parts: Vec<PartState>,
}

/// What one viewer has been sent.
#[derive(Debug, Default)]
pub struct Seen {
    run: Option<u32>,
    plant: Standing,
    ghost: Standing,
    values: Vec<f64>,
    beams: Vec<bool>,
}

/// Where frames and parts were.
#[derive(Debug, Default)]
struct Standing {
    poses: Vec<[f32; 7]>,
    parts: BTreeMap<u64, [f32; 7]>,
}

impl Seen {
    /// The message that brings a viewer from what it has been sent to `frame`.
    pub fn message(&mut self, frame: &Frame) -> Vec<u8> {
        let begins = self.run != Some(frame.run);
        if begins {
            *self = Seen { run: Some(frame.run), ..Seen::default() };
        }
        let picture = &frame.picture;
        let mut out = Vec::with_capacity(1 << 10);
        out.extend([1, u8::from(begins), 0, 0]);
        out.extend(frame.run.to_le_bytes());
        out.extend(picture.frame.now.seconds().to_le_bytes());
        out.extend(frame.speed.to_le_bytes());
        self.plant.poses(&mut out, &picture.poses);
        self.plant.parts(&mut out, &picture.frame.parts);
        self.values(&mut out, &picture.frame.registers);
        self.beams(&mut out, &picture.beams);
        let (poses, parts) = match &frame.ghost {
            Some(ghost) => (ghost.poses.as_slice(), ghost.parts.as_slice()),
            None => (&[] as &[DPose3], &[] as &[PartState]),
        };
        self.ghost.poses(&mut out, poses);
        self.ghost.parts(&mut out, parts);
        out
    }

    fn values(&mut self, out: &mut Vec<u8>, registers: &[Value]) {
        self.values.resize(registers.len(), f64::INFINITY);
        listed(out, |out| {
            let mut count = 0;
            for (index, value) in registers.iter().enumerate() {
                let value = value.to_f64().unwrap_or(f64::NAN);
                if self.values[index].to_bits() != value.to_bits() {
                    self.values[index] = value;
                    out.extend((index as u32).to_le_bytes());
                    out.extend(value.to_le_bytes());
                    count += 1;
                }
            }
            count
        });
    }

    fn beams(&mut self, out: &mut Vec<u8>, beams: &[bool]) {
        let is_new = self.beams.len() != beams.len();
        self.beams.resize(beams.len(), false);
        listed(out, |out| {
            let mut count = 0;
            for (index, (seen, is_cut)) in self.beams.iter_mut().zip(beams).enumerate() {
                if is_new || seen != is_cut {
                    *seen = *is_cut;
                    out.extend((index as u32).to_le_bytes());
                    out.extend(u32::from(*is_cut).to_le_bytes());
                    count += 1;
                }
            }
            count
        });
    }
}

impl Standing {
    fn poses(&mut self, out: &mut Vec<u8>, poses: &[DPose3]) {
        // Nothing is at no number: all are new then.
        self.poses.resize(poses.len(), [f32::NAN; 7]);
        listed(out, |out| {
            let mut count = 0;
            for (index, (seen, pose)) in self.poses.iter_mut().zip(poses).enumerate() {
                let pose = numbers_of(pose);
                if *seen != pose {
                    *seen = pose;
                    out.extend((index as u32).to_le_bytes());
                    pose.iter().for_each(|number| out.extend(number.to_le_bytes()));
                    count += 1;
                }
            }
            count
        });
    }

    fn parts(&mut self, out: &mut Vec<u8>, parts: &[PartState]) {
        let mut gone = std::mem::take(&mut self.parts);
        let seen = &mut self.parts;
        listed(out, |out| {
            let mut count = 0;
            for part in parts {
                let now = numbers_of_part(part);
                if gone.remove(&part.number) != Some(now) {
                    out.extend((part.number as u32).to_le_bytes());
                    out.extend(kind_of(part.kind).to_le_bytes());
                    now.iter().for_each(|number| out.extend(number.to_le_bytes()));
                    count += 1;
                }
                seen.insert(part.number, now);
            }
            count
        });
        out.extend((gone.len() as u32).to_le_bytes());
        gone.keys().for_each(|number| out.extend((*number as u32).to_le_bytes()));
    }
}

/// Writes a list behind its length.
fn listed(out: &mut Vec<u8>, write: impl FnOnce(&mut Vec<u8>) -> u32) {
    let at = out.len();
    out.extend([0; 4]);
    let count = write(out);
    out[at..at + 4].copy_from_slice(&count.to_le_bytes());
}

fn numbers_of(pose: &DPose3) -> [f32; 7] {
    let (place, turn) = (pose.translation, pose.rotation);
    [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w].map(|number| number as f32)
}

fn numbers_of_part(part: &PartState) -> [f32; 7] {
    let ([l, w, h], [x, y, z]) = (part.size, part.place);
    [l, w, h, x, y, z, part.yaw].map(|number| number as f32)
}

/// The number of a kind in the stream.
pub fn kind_of(kind: PartKind) -> u32 {
    match kind {
        PartKind::Box => 0,
        PartKind::Pallet => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::DVec3;

    const HEAD: usize = 24;
    const LISTS: usize = 8 * 4;

    fn part(number: u64, x: f64) -> PartState {
        PartState { number, kind: PartKind::Box, size: [0.4, 0.3, 0.2], place: [x, 0.0, 0.8], yaw: 0.0 }
    }

    fn frame(x: f64, parts: &[PartState], value: f32) -> Frame {
        let mut frame = Frame { run: 1, speed: 1.0, ..Frame::default() };
        frame.picture.poses = vec![DPose3::IDENTITY, DPose3::from_translation(DVec3::new(x, 0.0, 0.0))];
        frame.picture.frame.parts = parts.to_vec();
        frame.picture.frame.registers = vec![Value::Bool(true), Value::Real(value)];
        frame.picture.beams = vec![false, true];
        frame
    }

    #[test]
    fn a_viewer_is_sent_only_what_changed() {
        let mut seen = Seen::default();
        let all = seen.message(&frame(1.0, &[part(7, 0.0)], 0.5));
        assert_eq!((all[0], all[1], all.len()), (1, 1, HEAD + LISTS + 2 * 32 + 36 + 2 * 12 + 2 * 8));
        assert_eq!(seen.message(&frame(1.0, &[part(7, 0.0)], 0.5)).len(), HEAD + LISTS, "nothing moved");
        assert_eq!(seen.message(&frame(1.5, &[part(7, 0.0)], 0.5)).len(), HEAD + LISTS + 32, "one frame moved");
        assert_eq!(seen.message(&frame(1.5, &[part(7, 0.1)], 0.6)).len(), HEAD + LISTS + 36 + 12);
        assert_eq!(seen.message(&frame(1.5, &[], 0.6)).len(), HEAD + LISTS + 4, "a part is gone");
    }

    #[test]
    fn what_a_slow_viewer_misses_is_in_the_next_message() {
        let (mut slow, mut other) = (Seen::default(), Seen::default());
        let first = frame(0.0, &[part(1, 0.0)], 0.0);
        slow.message(&first);
        other.message(&first);
        other.message(&frame(0.5, &[part(1, 0.2), part(2, 0.0)], 0.3));
        let last = frame(0.7, &[part(2, 0.1)], 0.4);
        // A frame, a part that moved or came, one that is gone, a value.
        assert_eq!(other.message(&last).len(), HEAD + LISTS + 32 + 36 + 4 + 12);
        assert_eq!(slow.message(&last).len(), HEAD + LISTS + 32 + 36 + 4 + 12);
    }

    #[test]
    fn after_a_reset_all_is_sent_anew() {
        let mut seen = Seen::default();
        let mut again = frame(1.0, &[part(7, 0.0)], 0.5);
        let first = seen.message(&again).len();
        again.run = 2;
        let message = seen.message(&again);
        assert_eq!((message[1], message.len()), (1, first));
    }
}
