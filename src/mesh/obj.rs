//! Wavefront OBJ: its vertices and faces. Normals, texture coordinates, groups and materials are passed over.

use super::Wrong;
use super::numbers::triple;
use super::soup::Soup;
use crate::kinematics::DVec3;

const PASSED_OVER: &[&str] = &["vn", "vt", "vp", "o", "g", "s", "usemtl", "mtllib", "l", "p", "mg", "lod", "bevel"];

pub(super) fn read(text: &str) -> Result<Soup, Wrong> {
    let mut soup = Soup::default();
    for (index, content) in text.lines().enumerate() {
        let line = index + 1;
        let mut words = content.split('#').next().unwrap_or_default().split_whitespace();
        match words.next().unwrap_or_default() {
            "" => {}
            "v" => soup.vertices.push(DVec3::from_array(triple(&mut words, line)?)),
            "f" => {
                let count = soup.vertices.len();
                let corners: Result<Vec<u32>, Wrong> = words.map(|word| corner(word, count, line)).collect();
                soup.polygon(&corners?, line)?;
            }
            word if PASSED_OVER.contains(&word) => {}
            word => {
                let found = format!("{word:?} is no statement of an OBJ of triangles");
                return Err(Wrong::at(line, found, "expected v, f, or what may be passed over, as vn"));
            }
        }
    }
    Ok(soup)
}

/// `7`, `7/1/3` or `-1`: vertices are counted from 1, or backwards from the last.
fn corner(word: &str, count: usize, line: usize) -> Result<u32, Wrong> {
    let index = word.split('/').next().unwrap_or_default();
    let place = match index.parse::<i64>() {
        Ok(index) if index > 0 => Some(index - 1),
        Ok(index) if index < 0 => Some(count as i64 + index),
        _ => None,
    };
    match place.filter(|place| (0..count as i64).contains(place)) {
        Some(place) => Ok(place as u32),
        None => Err(Wrong::at(
            line,
            format!("{word:?} names no vertex"),
            format!("expected 1 to {count}, or -1 to -{count}"),
        )),
    }
}
