//! VRML 97 (ISO/IEC 14772-1): the triangles of its IndexedFaceSet and Box nodes under Transform, Group and the like, with
//! DEF and USE. No kept library reads it. What has no faces (lights, sensors, scripts) is passed over; PROTO is refused.

use std::collections::HashMap;
use std::rc::Rc;

use super::Wrong;
use super::numbers::number;
use super::soup::Soup;
use crate::kinematics::{DQuat, DVec3};

/// Nodes within nodes end here.
const DEEPEST: usize = 200;

/// Reads the triangles of a world.
pub(super) fn read(text: &str) -> Result<Soup, Wrong> {
    if !text.starts_with("#VRML V2.0 utf8") {
        let found = match text.starts_with("#VRML V1.0") {
            true => "this is VRML 1.0",
            false => "this is no VRML 97",
        };
        return Err(Wrong::at(1, found, "expected a first line #VRML V2.0 utf8"));
    }
    let mut parser = Parser { tokens: tokens(text)?, next: 0, names: HashMap::new() };
    let mut soup = Soup::default();
    while parser.next < parser.tokens.len() {
        if parser.is_word("ROUTE") {
            parser.next += 4;
            continue;
        }
        if let Some(node) = parser.node(0)? {
            add(&node, &Placing::HERE, &mut soup)?;
        }
    }
    Ok(soup)
}

#[derive(Clone, Debug, PartialEq)]
enum Token<'a> {
    Word(&'a str),
    Text,
    Open(char),
    Close(char),
}

/// Words, strings and brackets with their lines; commas are blanks, comments are none.
fn tokens(text: &str) -> Result<Vec<(Token<'_>, usize)>, Wrong> {
    let mut tokens = Vec::new();
    let mut line = 1;
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '\n' => {
                line += 1;
                1
            }
            '#' => rest.find('\n').unwrap_or(rest.len()),
            '"' => {
                let end = end_of_string(rest)
                    .ok_or_else(|| Wrong::at(line, "a string without an end", "expected a \" that closes it"))?;
                tokens.push((Token::Text, line));
                line += rest[..end].matches('\n').count();
                end
            }
            '{' | '[' => {
                tokens.push((Token::Open(first), line));
                1
            }
            '}' | ']' => {
                tokens.push((Token::Close(first), line));
                1
            }
            c if c.is_whitespace() || c == ',' => c.len_utf8(),
            _ => {
                let is_end = |c: char| c.is_whitespace() || ",{}[]\"#".contains(c);
                let end = rest.find(is_end).unwrap_or(rest.len());
                tokens.push((Token::Word(&rest[..end]), line));
                end
            }
        };
        rest = &rest[length..];
    }
    Ok(tokens)
}

fn end_of_string(text: &str) -> Option<usize> {
    let mut is_escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            '"' if !is_escaped => return Some(at + 1),
            _ => is_escaped = c == '\\' && !is_escaped,
        }
    }
    None
}

/// A node with those of its fields that hold something.
#[derive(Debug)]
struct Node<'a> {
    kind: &'a str,
    line: usize,
    fields: Vec<(&'a str, Field<'a>)>,
}

#[derive(Debug, Default)]
struct Field<'a> {
    /// Words that are no nodes: numbers, TRUE, FALSE; with their lines.
    words: Vec<(&'a str, usize)>,
    nodes: Vec<Rc<Node<'a>>>,
}

impl<'a> Node<'a> {
    fn field(&self, name: &str) -> Option<&Field<'a>> {
        self.fields.iter().find(|(known, _)| *known == name).map(|(_, field)| field)
    }

    fn nodes(&self, name: &str) -> &[Rc<Node<'a>>] {
        self.field(name).map(|field| field.nodes.as_slice()).unwrap_or_default()
    }

    /// So many numbers, or `default` where the field is not there.
    fn numbers<const N: usize>(&self, name: &str, default: [f64; N]) -> Result<[f64; N], Wrong> {
        let Some(field) = self.field(name) else { return Ok(default) };
        let numbers: Result<Vec<f64>, Wrong> = field.words.iter().map(|(word, line)| number(word, *line)).collect();
        let numbers = numbers?;
        let count = numbers.len();
        numbers
            .try_into()
            .map_err(|_| Wrong::at(self.line, format!("{name} of {count} numbers"), format!("expected {N}")))
    }

    fn is(&self, name: &str, default: bool) -> bool {
        match self.field(name).and_then(|field| field.words.first()) {
            Some((word, _)) => *word == "TRUE",
            None => default,
        }
    }
}

struct Parser<'a> {
    tokens: Vec<(Token<'a>, usize)>,
    next: usize,
    names: HashMap<&'a str, Rc<Node<'a>>>,
}

impl<'a> Parser<'a> {
    fn peek(&self) -> Option<&(Token<'a>, usize)> {
        self.tokens.get(self.next)
    }

    fn is_word(&self, word: &str) -> bool {
        matches!(self.peek(), Some((Token::Word(found), _)) if *found == word)
    }

    fn line(&self) -> usize {
        self.tokens.get(self.next).or(self.tokens.last()).map_or(1, |(_, line)| *line)
    }

    fn word(&mut self) -> Result<&'a str, Wrong> {
        match self.peek() {
            Some((Token::Word(word), _)) => {
                let word = *word;
                self.next += 1;
                Ok(word)
            }
            _ => Err(Wrong::at(self.line(), "something else than a name", "expected the name of a node or a field")),
        }
    }

    fn bracket(&mut self, bracket: Token<'a>) -> Result<(), Wrong> {
        match self.peek() {
            Some((found, _)) if *found == bracket => {
                self.next += 1;
                Ok(())
            }
            _ => {
                let (Token::Open(c) | Token::Close(c)) = bracket else { return Ok(()) };
                Err(Wrong::at(self.line(), "brackets that do not fit", format!("expected {c:?}")))
            }
        }
    }

    /// A node, or nothing for NULL.
    fn node(&mut self, depth: usize) -> Result<Option<Rc<Node<'a>>>, Wrong> {
        if depth > DEEPEST {
            return Err(Wrong::at(
                self.line(),
                "nodes within nodes without end",
                format!("expected at most {DEEPEST}"),
            ));
        }
        let mut name = None;
        let line = self.line();
        let kind = match self.word()? {
            "NULL" => return Ok(None),
            "USE" => {
                let used = self.word()?;
                let known = self.names.get(used).cloned();
                return known.map(Some).ok_or_else(|| {
                    Wrong::at(
                        line,
                        format!("USE {used}, which is not defined yet"),
                        format!("expected DEF {used} before it"),
                    )
                });
            }
            "DEF" => {
                name = Some(self.word()?);
                self.word()?
            }
            "PROTO" | "EXTERNPROTO" => {
                return Err(Wrong::at(line, "a PROTO", "expected a world without: export it as plain IndexedFaceSets"));
            }
            kind => kind,
        };
        self.bracket(Token::Open('{'))?;
        let mut fields = Vec::new();
        while !matches!(self.peek(), Some((Token::Close('}'), _))) {
            if self.peek().is_none() {
                return Err(Wrong::at(self.line(), format!("the file ends within a {kind}"), "expected '}'"));
            }
            if self.is_word("ROUTE") {
                self.next += 4;
                continue;
            }
            let field = self.word()?;
            fields.push((field, self.field(depth)?));
        }
        self.next += 1;
        let node = Rc::new(Node { kind, line, fields });
        if let Some(name) = name {
            self.names.insert(name, Rc::clone(&node));
        }
        Ok(Some(node))
    }

    fn field(&mut self, depth: usize) -> Result<Field<'a>, Wrong> {
        let mut field = Field::default();
        let is_list = matches!(self.peek(), Some((Token::Open('['), _)));
        self.next += usize::from(is_list);
        loop {
            match self.peek().cloned() {
                Some((Token::Close(']'), _)) if is_list => {
                    self.next += 1;
                    return Ok(field);
                }
                Some((Token::Text, _)) => self.next += 1,
                Some((Token::Word(word), line)) if is_value(word) => {
                    self.next += 1;
                    field.words.push((word, line));
                }
                // A name begins a node where one is due, and the next field otherwise.
                Some((Token::Word(word), _)) => {
                    let opens = matches!(self.tokens.get(self.next + 1), Some((Token::Open('{'), _)));
                    let is_node = opens || ["DEF", "USE", "NULL"].contains(&word);
                    let is_first = field.words.is_empty() && field.nodes.is_empty();
                    if !is_node || !(is_list || is_first) {
                        if is_list {
                            return Err(Wrong::at(
                                self.line(),
                                format!("{word:?} in a list"),
                                "expected a number or a node",
                            ));
                        }
                        return Ok(field);
                    }
                    field.nodes.extend(self.node(depth + 1)?);
                }
                _ if is_list => return Err(Wrong::at(self.line(), "a list without an end", "expected ']'")),
                _ => return Ok(field),
            }
        }
    }
}

fn is_value(word: &str) -> bool {
    word == "TRUE"
        || word == "FALSE"
        || word.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
        || word.eq_ignore_ascii_case("nan")
}

/// What Transform nodes do: p ↦ matrix · p + shift.
#[derive(Clone, Copy)]
struct Placing {
    columns: [DVec3; 3],
    shift: DVec3,
}

impl Placing {
    const HERE: Placing = Placing { columns: [DVec3::X, DVec3::Y, DVec3::Z], shift: DVec3::ZERO };

    fn point(&self, p: DVec3) -> DVec3 {
        self.direction(p) + self.shift
    }

    fn direction(&self, p: DVec3) -> DVec3 {
        self.columns[0] * p.x + self.columns[1] * p.y + self.columns[2] * p.z
    }

    /// P' = T · C · R · SR · S · −SR · −C · P (ISO/IEC 14772-1, 6.52).
    fn under(&self, node: &Node<'_>) -> Result<Placing, Wrong> {
        let turn = |name: &str| {
            let [x, y, z, angle] = node.numbers(name, [0.0, 0.0, 1.0, 0.0])?;
            Ok(DQuat::from_axis_angle(DVec3::new(x, y, z).normalize_or(DVec3::Z), angle))
        };
        let vector = |name: &str, default: f64| node.numbers(name, [default; 3]).map(DVec3::from_array);
        let (shift, centre, scale) = (vector("translation", 0.0)?, vector("center", 0.0)?, vector("scale", 1.0)?);
        let (rotation, orientation) = (turn("rotation")?, turn("scaleOrientation")?);
        let linear = |p: DVec3| rotation * (orientation * ((orientation.inverse() * p) * scale));
        let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| self.direction(linear(axis)));
        Ok(Placing { columns, shift: self.point(shift + centre - linear(centre)) })
    }

    fn mirrors(&self) -> bool {
        self.columns[0].dot(self.columns[1].cross(self.columns[2])) < 0.0
    }
}

fn add(node: &Node<'_>, placing: &Placing, soup: &mut Soup) -> Result<(), Wrong> {
    match node.kind {
        "Transform" => {
            let placing = placing.under(node)?;
            node.nodes("children").iter().try_for_each(|child| add(child, &placing, soup))
        }
        "Group" | "Anchor" | "Billboard" | "Collision" | "Inline" => {
            node.nodes("children").iter().try_for_each(|child| add(child, placing, soup))
        }
        // The finest level.
        "LOD" => node.nodes("level").first().map_or(Ok(()), |child| add(child, placing, soup)),
        "Switch" => {
            let [which] = node.numbers("whichChoice", [-1.0])?;
            let chosen = (which >= 0.0).then(|| node.nodes("choice").get(which as usize)).flatten();
            chosen.map_or(Ok(()), |child| add(child, placing, soup))
        }
        "Shape" => node.nodes("geometry").iter().try_for_each(|geometry| match geometry.kind {
            "IndexedFaceSet" => faces(geometry, placing, soup),
            "Box" => cuboid(geometry, placing, soup),
            // Lines and points have no faces.
            "IndexedLineSet" | "PointSet" => Ok(()),
            kind => {
                Err(Wrong::at(geometry.line, format!("a {kind}"), "expected IndexedFaceSet or Box: export it as faces"))
            }
        }),
        _ => Ok(()),
    }
}

fn faces(node: &Node<'_>, placing: &Placing, soup: &mut Soup) -> Result<(), Wrong> {
    let Some(points) = node.nodes("coord").first().and_then(|coord| coord.field("point")) else { return Ok(()) };
    if points.words.len() % 3 != 0 {
        let found = format!("{} coordinates of points", points.words.len());
        return Err(Wrong::at(node.line, found, "expected three for each point"));
    }
    let first = soup.vertices.len() as u32;
    for point in points.words.chunks_exact(3) {
        let [x, y, z] = [0, 1, 2].map(|axis| number(point[axis].0, point[axis].1));
        soup.vertices.push(placing.point(DVec3::new(x?, y?, z?)));
    }
    let turns_round = !node.is("ccw", true) ^ placing.mirrors();
    let mut corners: Vec<u32> = Vec::new();
    let indices = node.field("coordIndex").map(|field| field.words.as_slice()).unwrap_or_default();
    let end =
        indices.last().map(|(_, line)| ("-1", *line)).filter(|_| indices.last().is_some_and(|(word, _)| *word != "-1"));
    for (word, line) in indices.iter().copied().chain(end) {
        let index: i64 = word
            .parse()
            .map_err(|_| Wrong::at(line, format!("{word:?} is no index"), "expected a whole number, or -1"))?;
        if index >= 0 {
            corners.push(u32::try_from(index).ok().and_then(|index| first.checked_add(index)).unwrap_or(u32::MAX));
            continue;
        }
        if turns_round {
            corners.reverse();
        }
        soup.polygon(&corners, line)?;
        corners.clear();
    }
    Ok(())
}

fn cuboid(node: &Node<'_>, placing: &Placing, soup: &mut Soup) -> Result<(), Wrong> {
    let half = DVec3::from_array(node.numbers("size", [2.0; 3])?) / 2.0;
    let first = soup.vertices.len() as u32;
    for corner in 0..8 {
        let side = |bit: u32| if corner & (1 << bit) == 0 { -1.0 } else { 1.0 };
        soup.vertices.push(placing.point(DVec3::new(side(0), side(1), side(2)) * half));
    }
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    for mut side in sides {
        if placing.mirrors() {
            side.reverse();
        }
        soup.polygon(&side.map(|corner| first + corner), node.line)?;
    }
    Ok(())
}
