//! STL, as text and binary (3D Systems, "StereoLithography Interface Specification", 1988). Normals are not read: the order
//! of the corners says the same.

use super::numbers::triple;
use super::soup::Soup;
use super::{Wrong, text};
use crate::kinematics::DVec3;

const HEADER: usize = 84;
const RECORD: usize = 50;

pub(super) fn read(bytes: &[u8]) -> Result<Soup, Wrong> {
    // Binary files exist whose header begins with "solid": the length tells.
    let count = bytes.get(80..HEADER).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    match count {
        Some(count) if bytes.len() == HEADER + count as usize * RECORD => binary(&bytes[HEADER..]),
        _ if bytes.trim_ascii_start().starts_with(b"solid") && !bytes.contains(&0) => ascii(text(bytes)?),
        Some(count) => Err(Wrong::somewhere(
            format!("a binary STL of {} bytes that says it has {count} triangles", bytes.len()),
            format!("expected {} bytes: is it torn?", HEADER + count as usize * RECORD),
        )),
        None => Err(Wrong::somewhere("this is no STL", "expected one that begins with \"solid\", or a binary one")),
    }
}

fn binary(records: &[u8]) -> Result<Soup, Wrong> {
    let mut soup = Soup::default();
    for (index, record) in records.chunks_exact(RECORD).enumerate() {
        for corner in 0..3 {
            let coordinate = |axis: usize| {
                let at = 12 + corner * 12 + axis * 4;
                f64::from(f32::from_le_bytes([record[at], record[at + 1], record[at + 2], record[at + 3]]))
            };
            let place = DVec3::new(coordinate(0), coordinate(1), coordinate(2));
            if !place.is_finite() {
                let found = format!("triangle {} has a corner that is no number", index + 1);
                return Err(Wrong::somewhere(found, "expected finite coordinates"));
            }
            soup.vertices.push(place);
        }
        let first = index as u32 * 3;
        soup.triangles.push([first, first + 1, first + 2]);
    }
    Ok(soup)
}

fn ascii(text: &str) -> Result<Soup, Wrong> {
    let mut soup = Soup::default();
    let mut corners: Vec<u32> = Vec::new();
    let mut is_open = false;
    for (index, content) in text.lines().enumerate() {
        let line = index + 1;
        let mut words = content.split_whitespace();
        match words.next().unwrap_or_default() {
            "" | "solid" | "endsolid" | "endloop" => {}
            "facet" => is_open = true,
            "outer" if is_open => corners.clear(),
            "vertex" if is_open => {
                corners.push(soup.vertices.len() as u32);
                soup.vertices.push(DVec3::from_array(triple(&mut words, line)?));
            }
            "endfacet" if is_open && corners.len() == 3 => {
                soup.triangles.push([corners[0], corners[1], corners[2]]);
                soup.lines.push(line as u32);
                is_open = false;
            }
            "endfacet" => return Err(Wrong::at(line, format!("a facet of {} corners", corners.len()), "expected 3")),
            word => {
                return Err(Wrong::at(line, format!("{word:?} has no place here"), "expected facets with vertices"));
            }
        }
    }
    match is_open {
        true => Err(Wrong::at(text.lines().count(), "the file ends within a facet", "expected endfacet")),
        false => Ok(soup),
    }
}
