//! `kinetwin gap apply`.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;

use super::{Answer, Failure, words};
use crate::gap;
use crate::plant::ModelError;
use crate::plant::effects_file;
use crate::run::model;

/// Writes effects into a copy of a model.
///
/// The effects are those of an effects.xml, as a diagnosis writes it. Each becomes an <effect> of its instance in the copy's
/// plant file, which keeps its comments and its layout. The copy is a model like any other: it is checked, run and replayed
/// with its effects.
#[derive(Debug, Args)]
#[command(after_long_help = APPLY_HELP)]
pub struct ApplyArguments {
    /// The plant: a folder with a plant.xml, a plant's file, or a name of the catalogue (models/rig)
    #[arg(long, value_name = "MODEL")]
    pub model: String,
    /// The effects: a diagnosis's effects.xml
    #[arg(long, value_name = "FILE")]
    pub effects: PathBuf,
    /// The copy: a folder, or a plant's file where the name ends with .xml
    #[arg(short, long, value_name = "MODEL")]
    pub output: String,
    /// Replaces the files of the copy if there are any; without it, that is refused
    #[arg(long)]
    pub force: bool,
}

const APPLY_HELP: &str = "\
Examples:
  kinetwin gap apply --model models/rig --effects out/effects.xml -o my-rig
  kinetwin check my-rig
  kinetwin replay machine.cps.jsonl --model my-rig

Exit codes:
  0  the copy was written
  2  bad input or use: an effect that does not fit is told with its line; nothing was written";

/// Writes effects into a copy of a model.
pub fn apply(arguments: &ApplyArguments) -> Result<Answer, Failure> {
    let effects = arguments.effects.display().to_string();
    let text = fs::read_to_string(&arguments.effects)
        .map_err(|error| Failure(format!("error: failed to read {effects}: {error}")))?;
    let file = effects_file::read(&effects, &text).map_err(ModelError::from)?;
    let here = std::env::current_dir()?;
    let applied = gap::apply(&model::SOURCE, &arguments.model, &file, &arguments.output, &here.to_string_lossy())?;
    // Some of what can be wrong shows only when the plant is built.
    model::engine(&applied.plant, Duration::from_millis(1), 0)?;
    if let Some(there) = applied.files.keys().find(|path| !arguments.force && Path::new(path).exists()) {
        return Err(Failure(format!("error: {there} is there already; choose another -o, or replace it with --force")));
    }
    for (path, text) in &applied.files {
        let fail = |error: std::io::Error| Failure(format!("error: failed to write {path}: {error}"));
        if let Some(folder) = Path::new(path).parent() {
            fs::create_dir_all(folder).map_err(fail)?;
        }
        fs::write(path, text).map_err(fail)?;
    }
    applied.remarks.iter().for_each(|remark| words::tell(format_args!("warning: {remark}")));
    words::answer_line(format_args!("{}: {}", applied.path, told(&file)))?;
    Ok(Answer::Yes)
}

/// The effects in a line: `Axis + backlash, Belt + belt-slip`.
fn told(file: &effects_file::EffectsFile) -> String {
    let each = file.effects.iter().map(|addition| {
        let component = addition.effect.component.as_ref().map(|name| format!(".{name}")).unwrap_or_default();
        format!("{}{component} + {}", addition.instance.value, addition.effect.kind)
    });
    each.collect::<Vec<_>>().join(", ")
}
