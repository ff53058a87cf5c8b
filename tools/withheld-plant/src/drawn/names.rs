//! Names for devices, as people give them: none says more than that it is a device of its kind, some not even that.

use crate::chance::Dice;

/// A name for a device of `kind`, unlike all in `taken`.
pub fn draw(kind: &str, taken: &[String], dice: &mut Dice) -> String {
    let words: &[&str] = match kind {
        "Belt" => &["Belt", "Conveyor", "Band", "Infeed", "Outfeed", "Line"],
        "Feed" => &["Bay", "Source", "Magazine", "Entry"],
        "Pusher" => &["Pusher", "Cylinder", "Ejector", "Stop"],
        "Robot" => &["Robot", "Gantry", "Portal", "Picker"],
        "Gripper" => &["Gripper", "Suction", "Cups", "Vacuum"],
        "Axis" => &["Axis", "Slide", "Lift", "Drive"],
        _ => &["Motor", "Spindle", "Roller", "Drive"],
    };
    loop {
        let word = dice.one_of(words);
        let number = dice.below(90) + 10;
        let name = match dice.below(4) {
            0 => format!("{word}{number}"),
            1 => format!("{word}_{number}"),
            2 => format!("M{number}_{word}"),
            _ => format!("K{number}A{}", dice.below(9) + 1),
        };
        if !taken.contains(&name) {
            return name;
        }
    }
}
