//! One function block per device type. A block knows its device by the device's signals alone: it turns changes of inputs
//! into events (and writes them to the log), and requests into changes of outputs.

mod arm;
mod axis;
mod conveyor;
mod gripper;
mod inverter;
mod motor;
mod pusher;
mod robot;

pub use arm::SixAxisRobotFb;
pub use axis::ServoAxisFb;
pub use conveyor::{ConveyorFb, Travel};
pub use gripper::SuctionCapGripperFb;
pub use inverter::{InverterConveyorFb, SpeedProfile};
pub use motor::EncoderMotorFb;
pub use pusher::PusherFb;
pub use robot::{CartesianRobotFb, Target};

use crate::automation::image::Input;
use crate::automation::network::Context;

/// A light barrier: its level, and its edges until a sequence takes them.
#[derive(Debug)]
pub struct Barrier {
    input: Input<bool>,
    label: &'static str,
    cut: bool,
    rises: u32,
    falls: u32,
}

impl Barrier {
    /// The barrier behind `input`; `label` is its name in the log, `A` or `B`.
    fn new(input: Input<bool>, label: &'static str) -> Barrier {
        Barrier { input, label, cut: false, rises: 0, falls: 0 }
    }

    /// Whether a part is in the beam.
    pub fn cut(&self) -> bool {
        self.cut
    }

    /// Takes the oldest arrival not yet taken.
    pub fn take_rise(&mut self) -> bool {
        let some = self.rises > 0;
        self.rises = self.rises.saturating_sub(1);
        some
    }

    /// Takes the oldest departure not yet taken.
    pub fn take_fall(&mut self) -> bool {
        let some = self.falls > 0;
        self.falls = self.falls.saturating_sub(1);
        some
    }

    /// Forgets the edges not yet taken.
    pub fn forget(&mut self) {
        (self.rises, self.falls) = (0, 0);
    }

    fn update(&mut self, block: &str, cx: &Context<'_>) {
        let cut = cx.get(self.input);
        if cut == self.cut {
            return;
        }
        self.cut = cut;
        if cut {
            self.rises += 1;
            cx.noted(block, "IND", format_args!("barrier {} cut", self.label));
        } else {
            self.falls += 1;
            cx.noted(block, "IND", format_args!("barrier {} free", self.label));
        }
    }
}
