//! The checks of single `v`, `vn` and `f` lines.

use crate::load::is_finite;

/// What an index of a face counts.
pub(super) const VERTEX: &str = "vertex";
const NORMAL: &str = "normal";

/// An index that is checked at the end, because it may name something that follows.
pub(super) struct Pending {
    pub(super) line: usize,
    pub(super) what: &'static str,
    pub(super) index: i64,
}

/// What has been read so far.
#[derive(Default)]
pub(super) struct Seen {
    pub(super) is_vertex_used: Vec<bool>,
    pub(super) normal_count: usize,
    pub(super) colored_count: usize,
    pub(super) pending: Vec<Pending>,
}

/// Position of `x y z`, `x y z w` or `x y z r g b`.
pub(super) fn vertex_position(rest: &str, seen: &mut Seen) -> Result<[f32; 3], &'static str> {
    let mut numbers = [0.0_f32; 6];
    let mut count = 0;
    for word in rest.split_whitespace() {
        let number = word.parse().map_err(|_| "a vertex has a word that is no number; write numbers like -1.5e3")?;
        if count < 6 {
            numbers[count] = number;
        }
        count += 1;
    }
    let [x, y, z, w, ..] = numbers;
    match count {
        3 => Ok([x, y, z]),
        4 if w == 0.0 => Err("a vertex has weight 0, a point at infinity; delete its fourth number"),
        4 => Ok([x / w, y / w, z / w]),
        6 if !is_finite([numbers[3], numbers[4], numbers[5]]) => {
            Err("a vertex has a colour that is no finite number; correct it")
        }
        6 => {
            seen.colored_count += 1;
            Ok([x, y, z])
        }
        _ => Err("a vertex has the wrong number of numbers; write x y z, x y z w or x y z r g b"),
    }
}

/// Whether a `vn` line starts with three finite numbers.
pub(super) fn is_normal(rest: &str) -> bool {
    let mut words = rest.split_whitespace();
    let mut normal = [f32::NAN; 3];
    for coordinate in &mut normal {
        if let Some(number) = words.next().and_then(|word| word.parse().ok()) {
            *coordinate = number;
        }
    }
    is_finite(normal)
}

/// Checks the corners of a face, counts them, and marks their vertices as used when there are three or more.
pub(super) fn check_face(rest: &str, line: usize, seen: &mut Seen) -> Result<usize, &'static str> {
    let corner_count = rest.split_whitespace().count();
    if corner_count < 3 {
        return Ok(corner_count);
    }
    for corner in rest.split_whitespace() {
        check_corner(corner, line, seen).ok_or(
            "a face has a corner that is not v, v/vt, v//vn or v/vt/vn; write whole numbers, from 1 or negative",
        )?;
    }
    Ok(corner_count)
}

fn check_corner(corner: &str, line: usize, seen: &mut Seen) -> Option<()> {
    let mut parts = corner.split('/');
    let vertex: i64 = parts.next()?.parse().ok()?;
    match absolute(vertex, seen.is_vertex_used.len()) {
        Some(number) => seen.is_vertex_used[number] = true,
        None => seen.pending.push(Pending { line, what: VERTEX, index: vertex }),
    }
    if let Some(texture) = parts.next().filter(|part| !part.is_empty()) {
        texture.parse::<i64>().ok()?;
    }
    if let Some(normal) = parts.next().filter(|part| !part.is_empty()) {
        let normal: i64 = normal.parse().ok()?;
        if absolute(normal, seen.normal_count).is_none() {
            seen.pending.push(Pending { line, what: NORMAL, index: normal });
        }
    }
    parts.next().is_none().then_some(())
}

/// Index from 0 of what an OBJ file calls `index` when it has `count` of them; `None` when out of range.
fn absolute(index: i64, count: usize) -> Option<usize> {
    let from_zero = if index < 0 {
        count.checked_sub(usize::try_from(index.unsigned_abs()).ok()?)?
    } else {
        usize::try_from(index).ok()?.checked_sub(1)?
    };
    (from_zero < count).then_some(from_zero)
}
