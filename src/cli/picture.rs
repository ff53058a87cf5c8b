//! A picture made of characters: text anywhere, and drawings in braille dots, two across and four down in each character.

use std::fmt::Write as _;

use crossterm::style::{Attribute, Color, ResetColor, SetAttribute, SetForegroundColor};

/// How a character looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    pub color: Color,
    pub bold: bool,
}

impl Style {
    /// The terminal's own colour.
    pub const PLAIN: Style = Style { color: Color::Reset, bold: false };

    /// A colour.
    pub const fn of(color: Color) -> Style {
        Style { color, bold: false }
    }

    /// The same, bold.
    pub const fn bold(self) -> Style {
        Style { bold: true, ..self }
    }
}

#[derive(Clone, Copy, Debug)]
struct Cell {
    character: char,
    style: Style,
}

const BLANK: Cell = Cell { character: ' ', style: Style::PLAIN };

/// A rectangle of characters.
#[derive(Clone, Debug)]
pub struct Picture {
    columns: usize,
    rows: usize,
    cells: Vec<Cell>,
}

impl Picture {
    /// A blank picture.
    pub fn new(columns: usize, rows: usize) -> Picture {
        Picture { columns, rows, cells: vec![BLANK; columns * rows] }
    }

    /// Its width in characters.
    pub fn columns(&self) -> usize {
        self.columns
    }

    fn set(&mut self, column: usize, row: usize, character: char, style: Style) {
        if column < self.columns && row < self.rows {
            self.cells[row * self.columns + column] = Cell { character, style };
        }
    }

    /// Writes `text`, cut off at the right edge; control characters become blanks. Gives the column after it.
    pub fn text(&mut self, column: usize, row: usize, text: &str, style: Style) -> usize {
        let mut at = column;
        for character in text.chars() {
            let character = if character.is_control() { ' ' } else { character };
            self.set(at, row, character, style);
            at += 1;
        }
        at
    }

    /// Writes `text` so that it ends before `column`.
    pub fn text_right(&mut self, column: usize, row: usize, text: &str, style: Style) {
        self.text(column.saturating_sub(text.chars().count()), row, text, style);
    }

    /// Lays `drawing` over it, its upper left corner at `column`, `row`.
    pub fn draw(&mut self, column: usize, row: usize, drawing: &Drawing) {
        for y in 0..drawing.rows {
            for x in 0..drawing.columns {
                let dots = drawing.dots[y * drawing.columns + x];
                if dots.bits != 0 {
                    let character = char::from_u32(0x2800 + u32::from(dots.bits)).unwrap_or(' ');
                    self.set(column + x, row + y, character, dots.style);
                }
            }
        }
    }

    /// The bare characters, a line for each row, without blanks at the ends.
    #[cfg(test)]
    pub fn to_text(&self) -> String {
        let line = |row: &[Cell]| row.iter().map(|cell| cell.character).collect::<String>().trim_end().to_owned();
        self.cells.chunks(self.columns).map(line).collect::<Vec<_>>().join("\n")
    }

    /// The characters with the codes that a terminal colours them by, in whole rows from the upper left corner. Without
    /// `colours` there are no codes but bold.
    pub fn to_ansi(&self, colours: bool) -> String {
        let mut out = String::with_capacity(self.cells.len() * 2);
        let mut present = Style::PLAIN;
        for (index, row) in self.cells.chunks(self.columns).enumerate() {
            // Each row is placed by itself: nothing depends on what the terminal does at the end of a line.
            write_to(&mut out, format_args!("{}", crossterm::cursor::MoveTo(0, index as u16)));
            for cell in row {
                if cell.style != present {
                    write_to(&mut out, format_args!("{}{}", SetAttribute(Attribute::Reset), ResetColor));
                    if cell.style.bold {
                        write_to(&mut out, format_args!("{}", SetAttribute(Attribute::Bold)));
                    }
                    if colours && cell.style.color != Color::Reset {
                        write_to(&mut out, format_args!("{}", SetForegroundColor(cell.style.color)));
                    }
                    present = cell.style;
                }
                out.push(cell.character);
            }
        }
        write_to(&mut out, format_args!("{}{}", SetAttribute(Attribute::Reset), ResetColor));
        out
    }
}

fn write_to(out: &mut String, what: std::fmt::Arguments<'_>) {
    // Writing to a string cannot fail.
    let _ = out.write_fmt(what);
}

#[derive(Clone, Copy, Debug)]
struct Dots {
    bits: u8,
    style: Style,
    /// Whose colour the character has: that of the uppermost drawn in it.
    layer: u8,
}

/// A drawing in braille dots.
#[derive(Clone, Debug)]
pub struct Drawing {
    columns: usize,
    rows: usize,
    dots: Vec<Dots>,
}

impl Drawing {
    /// An empty drawing of so many characters.
    pub fn new(columns: usize, rows: usize) -> Drawing {
        Drawing { columns, rows, dots: vec![Dots { bits: 0, style: Style::PLAIN, layer: 0 }; columns * rows] }
    }

    /// Its width and height in dots.
    pub fn size(&self) -> (f64, f64) {
        ((self.columns * 2) as f64, (self.rows * 4) as f64)
    }

    /// One dot, counted from the upper left corner. A character has the style of the uppermost layer in it.
    pub fn dot(&mut self, x: f64, y: f64, layer: u8, style: Style) {
        let (width, height) = self.size();
        if !(0.0..width).contains(&x) || !(0.0..height).contains(&y) {
            return;
        }
        let (x, y) = (x as usize, y as usize);
        // The dots of U+2800: the left column top down are bits 0, 1, 2, 6, the right one 3, 4, 5, 7.
        const BITS: [[u8; 4]; 2] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];
        let dots = &mut self.dots[y / 4 * self.columns + x / 2];
        dots.bits |= BITS[x % 2][y % 4];
        if layer >= dots.layer {
            dots.layer = layer;
            dots.style = style;
        }
    }

    /// A straight line.
    pub fn line(&mut self, from: (f64, f64), to: (f64, f64), layer: u8, style: Style) {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let count = dx.abs().max(dy.abs()).ceil().clamp(1.0, 4096.0);
        for step in 0..=count as usize {
            let part = step as f64 / count;
            self.dot(from.0 + dx * part, from.1 + dy * part, layer, style);
        }
    }

    /// A filled convex polygon; at least the dot at its first corner.
    pub fn fill(&mut self, corners: &[(f64, f64)], layer: u8, style: Style) {
        let Some(&first) = corners.first() else { return };
        self.dot(first.0, first.1, layer, style);
        let (width, height) = self.size();
        let low = corners.iter().fold(f64::INFINITY, |low, corner| low.min(corner.1)).max(0.0).floor();
        let high = corners.iter().fold(f64::NEG_INFINITY, |high, corner| high.max(corner.1)).min(height);
        let mut y = low + 0.5;
        while y <= high {
            let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
            for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                if (from.1 <= y) != (to.1 <= y) {
                    let x = from.0 + (y - from.1) / (to.1 - from.1) * (to.0 - from.0);
                    left = left.min(x);
                    right = right.max(x);
                }
            }
            let mut x = left.max(0.0).floor() + 0.5;
            while x <= right.min(width) {
                if x >= left {
                    self.dot(x, y, layer, style);
                }
                x += 1.0;
            }
            y += 1.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INK: Style = Style::of(Color::Yellow);

    fn check(draw: impl Fn(&mut Drawing), expect: &str) {
        let mut drawing = Drawing::new(4, 2);
        draw(&mut drawing);
        let mut picture = Picture::new(4, 2);
        picture.draw(0, 0, &drawing);
        assert_eq!(picture.to_text(), expect);
    }

    #[test]
    fn dots_lines_and_fillings() {
        check(|d| d.dot(0.0, 0.0, 0, INK), "⠁\n");
        check(|d| d.dot(7.9, 7.9, 0, INK), "\n   ⢀");
        check(|d| d.dot(8.0, 0.0, 0, INK), "\n");
        check(|d| d.line((0.0, 0.0), (7.0, 0.0), 0, INK), "⠉⠉⠉⠉\n");
        check(|d| d.line((0.0, 0.0), (7.0, 7.0), 0, INK), "⠑⢄\n  ⠑⢄");
        check(|d| d.fill(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)], 0, INK), "⣿⣿\n");
        check(|d| d.fill(&[(-9.0, -9.0), (99.0, -9.0), (99.0, 99.0), (-9.0, 99.0)], 0, INK), "⣿⣿⣿⣿\n⣿⣿⣿⣿");
    }

    #[test]
    fn text_is_cut_off_and_cannot_control_the_terminal() {
        let mut picture = Picture::new(8, 1);
        picture.text(5, 0, "\u{1b}[2J", INK);
        assert_eq!(picture.to_text(), "      [2");
        assert!(!picture.to_ansi(false).contains("\u{1b}[2J"));
    }

    #[test]
    fn without_colours_no_colour_is_set() {
        let mut picture = Picture::new(3, 1);
        picture.text(0, 0, "abc", INK);
        let coloured = format!("{}", SetForegroundColor(Color::Yellow));
        assert!(picture.to_ansi(true).contains(&coloured));
        assert!(!picture.to_ansi(false).contains(&coloured));
    }
}
