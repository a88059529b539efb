//! The fence: one closed surface with real holes, no box inside another.

use super::surface::Surface;
use glam::DVec3;

pub(super) fn fence(size: [f64; 3], columns: u32, rows: u32, bar: f64) -> Surface {
    let lines_x = bar_lines(size[0], columns, bar);
    let lines_y = bar_lines(size[1], rows, bar);
    let half_depth = 0.5 * size[2];
    // Cells lie between neighbouring lines; odd columns of odd rows are holes, and all around is open air.
    let [cells_x, cells_y] = [lines_x.len() - 1, lines_y.len() - 1];
    let solid = |x: usize, y: usize| x < cells_x && y < cells_y && (x.is_multiple_of(2) || y.is_multiple_of(2));

    let mut surface = Surface::default();
    for y in 0..cells_y {
        for x in 0..cells_x {
            if !solid(x, y) {
                continue;
            }
            let corner = |right: usize, up: usize, depth: f64| DVec3::new(lines_x[x + right], lines_y[y + up], depth);
            let ring =
                |depth: f64| [corner(0, 0, depth), corner(1, 0, depth), corner(1, 1, depth), corner(0, 1, depth)];
            let (back, front) = (ring(-half_depth), ring(half_depth));
            surface.flat_quad(front);
            surface.flat_quad([back[0], back[3], back[2], back[1]]);
            // Walls, where the neighbour below, right, above or left is open. Below and left of the first cell the
            // index wraps to the highest number, which is no cell.
            let neighbours = [(x, y.wrapping_sub(1)), (x + 1, y), (x, y + 1), (x.wrapping_sub(1), y)];
            for (side, (next_x, next_y)) in neighbours.into_iter().enumerate() {
                if !solid(next_x, next_y) {
                    let end = (side + 1) % 4;
                    surface.flat_quad([back[side], back[end], front[end], front[side]]);
                }
            }
        }
    }
    surface
}

/// Where bars begin and end along a side with `holes` equal holes, from one end to the other.
fn bar_lines(length: f64, holes: u32, bar: f64) -> Vec<f64> {
    let hole = (length - f64::from(holes + 1) * bar) / f64::from(holes);
    (0..=holes)
        .flat_map(|index| {
            let begin = f64::from(index) * (bar + hole) - 0.5 * length;
            [begin, begin + bar]
        })
        .collect()
}
