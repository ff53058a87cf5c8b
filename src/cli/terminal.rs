//! The terminal, taken over for one screen, and given back whatever happens.

use std::io::{self, IsTerminal, Write};
use std::time::Duration;

use crossterm::event::{Event, KeyCode, KeyEventKind, KeyModifiers};
use crossterm::{cursor, event, execute, queue, terminal};

use super::picture::Picture;

/// What somebody pressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// `q`, Escape or Ctrl-C.
    End,
}

/// The terminal while it shows one screen. Dropping it gives it back.
pub struct Terminal {
    colours: bool,
}

impl Terminal {
    /// Takes the terminal over, if standard output and input are one; gives it back even if the program panics.
    pub fn take() -> io::Result<Option<Terminal>> {
        if !io::stdout().is_terminal() || !io::stdin().is_terminal() {
            return Ok(None);
        }
        let before = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            give_back();
            before(panic);
        }));
        terminal::enable_raw_mode()?;
        // From here on the terminal is given back when this goes.
        let taken = Terminal { colours: std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()) };
        execute!(io::stdout(), terminal::EnterAlternateScreen, terminal::DisableLineWrap, cursor::Hide)?;
        Ok(Some(taken))
    }

    /// How many columns and rows there are.
    pub fn size(&self) -> (usize, usize) {
        let (columns, rows) = terminal::size().unwrap_or((80, 24));
        (usize::from(columns), usize::from(rows))
    }

    /// Shows `picture`, all of it at once.
    pub fn show(&mut self, picture: &Picture) -> io::Result<()> {
        let mut out = io::stdout().lock();
        queue!(out, terminal::BeginSynchronizedUpdate)?;
        out.write_all(picture.to_ansi(self.colours).as_bytes())?;
        queue!(out, terminal::EndSynchronizedUpdate)?;
        out.flush()
    }

    /// Waits at most `span` for a key that means something here.
    pub fn key(&mut self, span: Duration) -> io::Result<Option<Key>> {
        if !event::poll(span)? {
            return Ok(None);
        }
        let Event::Key(key) = event::read()? else { return Ok(None) };
        if key.kind == KeyEventKind::Release {
            return Ok(None);
        }
        let control_c = key.code == KeyCode::Char('c') && key.modifiers.contains(KeyModifiers::CONTROL);
        let ends = control_c || matches!(key.code, KeyCode::Char('q') | KeyCode::Esc);
        Ok(ends.then_some(Key::End))
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        give_back();
    }
}

/// Brings the terminal back as it was; does no harm where it was never taken.
pub fn give_back() {
    // Whatever fails here, there is nothing better to do than to try the rest.
    let _ = execute!(io::stdout(), cursor::Show, terminal::EnableLineWrap, terminal::LeaveAlternateScreen);
    let _ = terminal::disable_raw_mode();
}
