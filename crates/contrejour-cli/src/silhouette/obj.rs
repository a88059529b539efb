//! Silhouettes as OBJ line elements.

use std::collections::BTreeMap;
use std::fmt::Write;

use glam::DVec3;

use super::found::FoundEdge;

/// Vertices of the edges in world space and one `l` line an edge, which runs so that more of its faces lie on its left
/// as seen from the light.
pub fn obj(edges: &[FoundEdge], name: &str) -> String {
    let mut text = format!(
        "# Silhouette edges of {}; faces lie on the left of each line as seen from the light.\n",
        name.replace('\n', " ")
    );
    let mut line_numbers = BTreeMap::new();
    let mut lines = String::new();
    for edge in edges {
        let [low, high] = [edge.low, edge.high].map(|vertex| {
            let key = (vertex.number, vertex.position_world.to_array().map(f64::to_bits));
            let next = line_numbers.len() + 1;
            *line_numbers.entry(key).or_insert_with(|| {
                text += &vertex_line(vertex.position_world);
                next
            })
        });
        let (begin, end) = if edge.multiplicity > 0 { (low, high) } else { (high, low) };
        // Writing to a string cannot fail.
        let _ = writeln!(lines, "l {begin} {end}");
    }
    text + &lines
}

fn vertex_line(position: DVec3) -> String {
    let [x, y, z] = position.to_array().map(coordinate);
    format!("v {x} {y} {z}\n")
}

/// The shortest text that reads back as the same number; most are `f32` and need fewer digits.
fn coordinate(value: f64) -> String {
    let short = value as f32;
    if f64::from(short) == value { short.to_string() } else { value.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::silhouette::found::tests::edge;

    #[test]
    fn vertices_are_written_once_and_lines_run_with_the_lit_side_left() {
        let (a, b, c) = ([0.0, 0.0, 0.0], [0.1f32, 0.0, 0.0].map(f64::from), [0.0, 1.5, 0.0]);
        let edges = [edge((0, a), (4, b), 2), edge((0, a), (9, c), -2)];
        let text = obj(&edges, "a.obj");
        let lines: Vec<&str> = text.lines().skip(1).collect();
        assert_eq!(lines, ["v 0 0 0", "v 0.1 0 0", "v 0 1.5 0", "l 1 2", "l 3 1"]);
    }

    #[test]
    fn the_same_number_in_two_places_is_two_vertices() {
        let edges = [edge((0, [0.0; 3]), (1, [1.0; 3]), 1), edge((0, [5.0; 3]), (1, [6.0; 3]), 1)];
        assert_eq!(obj(&edges, "").lines().filter(|line| line.starts_with("v ")).count(), 4);
    }
}
