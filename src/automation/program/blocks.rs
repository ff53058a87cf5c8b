//! The program of `models/r001`: every 10 ms it sets both commands of every block, in one message.

use std::time::Duration;

use crate::automation::network::{Context, Program};
use crate::signal_map::{Direction, RegisterId, SignalMap};
use crate::time::Instant;
use crate::value::{ElementaryType, Value};

/// How often every command is set.
const CYCLE: Duration = Duration::from_millis(10);
/// Speeds go round within this many cycles, 0.01 rad/s apart.
const ROUND: u64 = 1_000;

/// Sets everything, again and again.
pub struct Blocks {
    commands: Vec<(RegisterId, ElementaryType)>,
    due: Option<Instant>,
    cycles: u64,
}

impl Blocks {
    /// For the blocks in `map`.
    pub fn new(map: &SignalMap) -> Blocks {
        let commands = map.directed(Direction::Command).map(|(register, signal)| (register, signal.ty.element));
        Blocks { commands: commands.collect(), due: None, cycles: 0 }
    }
}

impl Program for Blocks {
    fn start(&mut self, cx: &mut Context<'_>) {
        cx.decided("blocks", "COLD", format_args!("{} commands every 10 ms", self.commands.len()));
        self.due = Some(cx.now);
        cx.wake_at(cx.now);
    }

    fn event(&mut self, cx: &mut Context<'_>) {
        let Some(due) = self.due.filter(|due| *due <= cx.now) else { return };
        self.cycles += 1;
        for &(register, element) in &self.commands {
            let value = match element {
                ElementaryType::Bool => Value::Bool(self.cycles % 2 == 1),
                element => Value::from_f64(element, (self.cycles % ROUND) as f64 * 0.01),
            };
            cx.set_value(register, value);
        }
        // A cycle that was slept through is left out.
        let next = if due + CYCLE <= cx.now { cx.now + CYCLE } else { due + CYCLE };
        self.due = Some(next);
        cx.wake_at(next);
    }
}
