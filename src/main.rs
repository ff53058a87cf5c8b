//! The program. See `kinetwin --help`.

use std::process::ExitCode;

fn main() -> ExitCode {
    kinetwin::cli::main()
}
