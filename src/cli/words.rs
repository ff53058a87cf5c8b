//! Words out: what was asked for to standard output, what there is to tell to standard error.
//!
//! Who reads may leave before all is said, as in `kinetwin replay … | head`. That is no fault: the rest goes unsaid, and the
//! command ends as it would have.

use std::fmt::Display;
use std::io::{self, Write};

use super::Failure;

/// Says `text`, which ends its own lines, on standard output.
pub fn answer(text: impl Display) -> Result<(), Failure> {
    print(&mut io::stdout().lock(), &text)
        .map_err(|error| Failure(format!("error: failed to write to standard output: {error}")))
}

/// Says a line on standard output.
pub fn answer_line(text: impl Display) -> Result<(), Failure> {
    answer(format_args!("{text}\n"))
}

/// Says a line on standard error. Where that leads nowhere there is nobody left to tell.
pub fn tell(text: impl Display) {
    let _ = print(&mut io::stderr().lock(), &format_args!("{text}\n"));
}

/// `n` of them: `1 box`, `2 boxes`.
pub fn counted(n: usize, one: &str, more: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { more })
}

fn print(out: &mut impl Write, text: &dyn Display) -> io::Result<()> {
    match write!(out, "{text}").and_then(|()| out.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Broken(io::ErrorKind);

    impl Write for Broken {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(self.0.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Err(self.0.into())
        }
    }

    #[test]
    fn a_reader_who_left_is_no_fault_and_a_full_disk_is() {
        assert!(print(&mut Broken(io::ErrorKind::BrokenPipe), &"words").is_ok());
        assert!(print(&mut Broken(io::ErrorKind::StorageFull), &"words").is_err());
    }

    #[test]
    fn one_is_not_many() {
        assert_eq!([0, 1, 2].map(|n| counted(n, "box", "boxes")), ["0 boxes", "1 box", "2 boxes"]);
    }
}
