//! What controls which plant: the programs by the plants' names.

mod blocks;
pub mod depalletizer;
mod maps;
pub mod packaging;
pub mod rig;

pub use maps::{map_of, plants};

use std::sync::Arc;

use super::image::{BindError, Binder};
use super::network::{Context, Program};
use super::playback::{Opener, Playback, PlaybackError};
use crate::signal_map::SignalMap;

/// What an automation does with the plant.
pub enum Control {
    /// Runs the function blocks written for the plant of the map's name; a plant that has none has its commands held
    /// at 0.
    ByPlant,
    /// Plays the automation's side of a recorded trace. The trace is opened anew for each start.
    Playback(Box<Opener>),
}

/// Why a program cannot start.
#[derive(Debug, thiserror::Error)]
pub enum StartError {
    #[error(transparent)]
    Bind(#[from] BindError),
    #[error(transparent)]
    Playback(#[from] PlaybackError),
}

impl Control {
    /// The program for the plant of `map`, at its beginning.
    pub(super) fn program(&mut self, map: &Arc<SignalMap>) -> Result<Box<dyn Program>, StartError> {
        let mut binder = Binder::new(map);
        Ok(match self {
            Control::Playback(open) => Box::new(Playback::open(open, map.clone())?),
            Control::ByPlant => match map.plant() {
                "rig" | "rig-toleranced" => {
                    let program = rig::program(&mut binder);
                    Box::new(binder.finish(program)?)
                }
                "depalletizer" => {
                    let program = depalletizer::program(&mut binder);
                    Box::new(binder.finish(program)?)
                }
                "packaging" => {
                    let program = packaging::program(&mut binder);
                    Box::new(binder.finish(program)?)
                }
                "r001" => Box::new(blocks::Blocks::new(map)),
                _ => Box::new(Hold),
            },
        })
    }
}

/// Holds every command at 0: the program of a plant that we know nothing of.
struct Hold;

impl Program for Hold {
    fn start(&mut self, cx: &mut Context<'_>) {
        let plant = cx.image().map().plant();
        cx.decided("network", "COLD", format_args!("no program for {plant:?}: all commands are held at 0"));
    }

    fn event(&mut self, _cx: &mut Context<'_>) {}
}
