//! The hash of an engine's state, to tell whether two runs were the same.

use super::{Engine, Unit};
use crate::engine::floor::Support;
use crate::plant::PartKind;
use crate::value::Value;

/// FNV-1a, 64 bits (Fowler, Noll, Vo): not against anyone who means harm, but any bit that differs changes it, and it is the
/// same on every machine.
#[derive(Clone, Copy, Debug)]
struct Fnv(u64);

impl Fnv {
    const START: Fnv = Fnv(0xcbf2_9ce4_8422_2325);

    fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    fn whole(&mut self, number: u64) {
        self.bytes(&number.to_le_bytes());
    }

    /// The bits of a number: 0.0 and -0.0 are two.
    fn number(&mut self, number: f64) {
        self.whole(number.to_bits());
    }

    fn value(&mut self, value: &Value) {
        match value {
            Value::String(bytes) => self.bytes(bytes),
            Value::Wstring(units) => units.iter().for_each(|unit| self.bytes(&unit.to_le_bytes())),
            Value::Array(values) => values.iter().for_each(|value| self.value(value)),
            Value::Lint(number) | Value::Time(number) => self.whole(*number as u64),
            Value::Ulint(number) | Value::Lword(number) => self.whole(*number),
            other => self.number(other.to_f64().unwrap_or(0.0)),
        }
    }
}

impl Engine {
    /// A hash of the whole state, 64 bits of FNV-1a: the time of the next tick; all registers; every number of every device's
    /// state; every part with its number, kind, size, pose and support; the counts of parts. Two runs of one plant with one
    /// step, seed and the same inputs have the same at every tick.
    pub fn state_hash(&self) -> u64 {
        let mut hash = Fnv::START;
        hash.whole(self.now.nanos() as u64);
        self.registers.all().iter().for_each(|value| hash.value(value));
        for Unit { device, .. } in &self.units {
            device.state(&mut |number| hash.number(number));
        }
        self.hash_parts(&mut hash);
        for held in self.held() {
            hash.whole(u64::from(held.signal.0) + 1);
        }
        self.dead_drives().for_each(|name| hash.bytes(name.as_bytes()));
        hash.0
    }

    fn hash_parts(&self, hash: &mut Fnv) {
        for (_, part) in self.floor.parts.iter() {
            hash.whole(part.number);
            hash.whole(match part.kind {
                PartKind::Box => 0,
                PartKind::Pallet => 1,
            });
            let upright = part.block.upright();
            let numbers = part.block.size().to_array().into_iter().chain(upright.place.to_array()).chain([upright.yaw]);
            numbers.for_each(|number| hash.number(number));
            let (what, which) = match part.support {
                Support::Belt(belt) => (0, belt as u64),
                Support::Part(below) => (1, self.floor.parts.get(below).number),
                Support::Cups(cups) => (2, cups as u64),
                Support::Sink { sink, left } => (3 ^ left.to_bits(), sink as u64),
            };
            hash.whole(what);
            hash.whole(which);
            if let Some(velocity) = part.slider.velocity() {
                hash.number(velocity);
            }
        }
        let counts = self.floor.counts();
        for count in [counts.boxes_in, counts.boxes_out, counts.boxes_lost, counts.pallets_in, counts.pallets_out] {
            hash.whole(count);
        }
        hash.whole(counts.collisions);
        self.floor.bays.iter().for_each(|bay| hash.whole(bay.made));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_digests_are_fnvs() {
        // Of the authors' table of test vectors.
        for (text, digest) in
            [("", 0xcbf2_9ce4_8422_2325_u64), ("a", 0xaf63_dc4c_8601_ec8c), ("foobar", 0x8594_4171_f739_67e8)]
        {
            let mut hash = Fnv::START;
            hash.bytes(text.as_bytes());
            assert_eq!(hash.0, digest, "{text}");
        }
    }
}
