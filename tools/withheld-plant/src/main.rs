//! Plants that share nothing with the diagnosis, and sealed cases of them.
//!
//! Of the library this crate uses the words of signals and traces alone (`value`, `time`, `wire`, `trace`): every equation
//! here is its own, so that a diagnosis that is right about these plants is right about more than itself.

#[cfg(test)]
mod bench;

mod arguments;
mod belt;
mod belt_drive;
mod cases;
mod catalogue;
mod chance;
mod classes;
mod drawn;
mod drive;
mod exam;
mod gripper;
mod line;
mod machine;
mod magnitude;
mod motor;
mod plans;
mod plant;
mod ports;
mod pusher;
mod quirk;
mod recent;
mod record;
mod rig;
mod robot;
mod script;
mod sensor;
mod servo;
mod site;
mod socket;
mod stream;
mod switch;
mod train;
mod workbench;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    match exam::run(arguments::Arguments::parse()) {
        Ok(said) => {
            println!("{said}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            let mut cause = std::error::Error::source(&error);
            while let Some(error) = cause {
                eprintln!("  because: {error}");
                cause = error.source();
            }
            ExitCode::from(2)
        }
    }
}
