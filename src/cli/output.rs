//! Files that a command writes: whole or not at all.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use super::Failure;

/// The file that is being written.
pub type Output = BufWriter<File>;

/// Writes the file `output`. It is refused where there is one already, unless `force` replaces it. What is written stands
/// under another name, ending in `.partial`, until it is whole: what is read may be what is replaced.
pub fn write_whole<T>(
    output: &Path,
    force: bool,
    write: impl FnOnce(Output) -> Result<(Output, T), Failure>,
) -> Result<T, Failure> {
    if output.exists() && !force {
        return Err(Failure(format!(
            "error: {} is there already; choose another file, or replace it with --force",
            output.display()
        )));
    }
    let fail = |error: std::io::Error| Failure(format!("error: failed to write {}: {error}", output.display()));
    let mut partial = output.to_owned().into_os_string();
    partial.push(".partial");
    let written = write(BufWriter::new(File::create(&partial).map_err(fail)?));
    match written {
        Ok((mut file, answer)) => {
            file.flush().and_then(|()| std::fs::rename(&partial, output)).map_err(fail)?;
            Ok(answer)
        }
        Err(failure) => {
            // What was begun is of no use to anybody; the error says why.
            let _ = std::fs::remove_file(&partial);
            Err(failure)
        }
    }
}
