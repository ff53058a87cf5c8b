//! The de-palletization line's program. `models/depalletizer/README.md` describes the plant, its positions and the rules
//! of hand-over that the sequences here keep.
//!
//! Sequences meet in two hand-shakes only: the pallet, between the pallet conveyors and the robot, and the set-down place,
//! between the robot and the loose boxes. Belts, pushers and exits need nothing of each other but their barriers.

mod pallets;
mod picking;
mod set_down;
mod sorting;
#[cfg(test)]
mod tests;

use crate::automation::block::{CartesianRobotFb, ConveyorFb, PusherFb, SuctionCapGripperFb, Travel};
use crate::automation::image::Binder;
use crate::automation::network::{Block, Context, Devices, Network, Sequence};

/// Speed of the box line and of the exits, m/s.
const LINE_M_S: f64 = 0.6;

/// The line's devices, and the hand-shakes between its sequences.
pub struct Line {
    conveyors: [ConveyorFb; 10],
    curves: [ConveyorFb; 2],
    pushers: [PusherFb; 3],
    robot: CartesianRobotFb,
    /// Gripper 1, in front at the set-down place, and gripper 2.
    grippers: [SuctionCapGripperFb; 2],
    pallet: Pallet,
    set_down: SetDown,
    /// How many boxes each exit's pusher has pushed over that the exit has not taken notice of.
    pushed: [u32; 3],
}

/// The pallet at the picking place, between the pallet conveyors and the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pallet {
    /// None is there: the next may come.
    Wanted,
    /// One is on its last way.
    Coming,
    /// It stands: the robot may work.
    Ready,
    /// The robot is done with it and out of its way: it may leave.
    Spent,
}

/// The place on Conveyor4 where boxes join the box line: one user at a time.
#[derive(Clone, Copy, Debug, Default)]
struct SetDown {
    /// The robot wants the place, or has it.
    robot_asks: bool,
    /// The robot has it.
    robot_holds: bool,
    /// A loose box has it, from before Conveyor4 to its barrier B.
    loose_holds: bool,
    /// Boxes let onto the place that have not passed Conveyor4's barrier B.
    boxes: u32,
    /// The last of them came by the robot: a loose box may follow it at once.
    last_by_robot: bool,
}

impl Line {
    /// Conveyor `number`, 1 to 10 as the plan counts them.
    fn conveyor(&mut self, number: usize) -> &mut ConveyorFb {
        &mut self.conveyors[number - 1]
    }
}

impl Devices for Line {
    fn each(&mut self, visit: &mut dyn FnMut(&mut dyn Block)) {
        self.conveyors.iter_mut().for_each(|block| visit(block));
        self.curves.iter_mut().for_each(|block| visit(block));
        self.pushers.iter_mut().for_each(|block| visit(block));
        visit(&mut self.robot);
        self.grippers.iter_mut().for_each(|block| visit(block));
    }
}

/// The program, bound to the line's signals.
pub fn program(binder: &mut Binder<'_>) -> Network<Line> {
    let line = Line {
        conveyors: std::array::from_fn(|i| ConveyorFb::bind(binder, &format!("Conveyor{}", i + 1))),
        curves: std::array::from_fn(|i| ConveyorFb::bind(binder, &format!("Curve{}", i + 1))),
        pushers: std::array::from_fn(|i| PusherFb::bind(binder, &format!("Pusher{}", i + 1))),
        robot: CartesianRobotFb::bind(binder, "Robot"),
        grippers: std::array::from_fn(|i| SuctionCapGripperFb::bind(binder, &format!("Gripper{}", i + 1))),
        pallet: Pallet::Wanted,
        set_down: SetDown::default(),
        pushed: [0; 3],
    };
    let mut sequences: Vec<Box<dyn Sequence<Line>>> = vec![
        Box::new(BoxLine::default()),
        Box::new(pallets::PickingPlace::default()),
        Box::new(pallets::Infeed::default()),
        Box::new(set_down::Loose::default()),
        Box::new(picking::Picking::default()),
    ];
    for lane in sorting::LANES {
        sequences.push(Box::new(sorting::Sorter::new(lane)));
        sequences.push(Box::new(sorting::Exit::new(lane)));
    }
    Network::new(line, sequences)
}

/// The belts that always run: Conveyor4, Curve1, Conveyor5, Conveyor6, Curve2, Conveyor7.
#[derive(Default)]
struct BoxLine {
    runs: bool,
}

impl Sequence<Line> for BoxLine {
    fn advance(&mut self, line: &mut Line, cx: &mut Context<'_>) -> bool {
        if self.runs {
            return false;
        }
        self.runs = true;
        cx.decided("BoxLine", "INIT", format_args!("forwards at {LINE_M_S} m/s"));
        for number in [4, 5, 6, 7] {
            line.conveyor(number).run(cx, LINE_M_S, Travel::Forward);
        }
        for curve in &mut line.curves {
            curve.run(cx, LINE_M_S, Travel::Forward);
        }
        true
    }
}
