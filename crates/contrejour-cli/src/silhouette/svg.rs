//! Silhouettes as a drawing, as seen from the light.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, DVec4};

use super::found::{FoundEdge, FoundVertex};
use super::loops::{Arc, closed_path, loops};
use super::sight::Sight;

/// Longer side of the drawing, without margins.
const SIDE: f64 = 1000.0;

const MARGIN: f64 = 40.0;

/// A light inside a mesh sees all around; the drawing ends at this tangent of the angle from its middle.
const WIDEST_TANGENT: f64 = 3.0;

/// A drawing of the edges from `light`, a position and 1 or a direction towards the light and 0, towards the middle of
/// the bounds. What lies in the shadow is filled; edges with faces on both sides are thin.
pub fn svg(edges: &[FoundEdge], light: DVec4, bounds: (DVec3, DVec3), name: &str) -> String {
    let sight = Sight::new(light, bounds.0, bounds.1);
    let mut is_cut = false;
    let lines: Vec<Line> = edges
        .iter()
        .filter_map(|edge| {
            let (ends, cut) = sight.line(edge.low.position_world, edge.high.position_world)?;
            is_cut |= cut;
            Some(Line { ends, edge })
        })
        .collect();
    is_cut |= lines.len() < edges.len();

    let frame = Frame::around(lines.iter().flat_map(|line| line.ends), light.w != 0.0);
    let shadow = if is_cut { None } else { shadow_path(&lines, &frame) };
    let path_of = |is_inner: bool| -> String {
        let chosen = lines.iter().filter(|line| line.edge.is_inner == is_inner);
        chosen.map(|line| segment(line.ends.map(|end| frame.place(end)))).collect()
    };
    let (outline, inner) = (path_of(false), path_of(true));
    let [width, height] = frame.size();
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" height=\"{height:.0}\">\n\
         <title>Silhouette of {}</title>\n\
         <desc>{} silhouette edges as seen from the light</desc>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fbfaf7\"/>\n",
        escaped(name),
        edges.len()
    );
    if let Some(shadow) = shadow.filter(|path| !path.is_empty()) {
        svg += &format!("<path d=\"{shadow}\" fill=\"#dcd8cd\" fill-rule=\"nonzero\"/>\n");
    }
    svg += "<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
    if !inner.is_empty() {
        svg += &format!("<path d=\"{inner}\" stroke=\"#3b6fb5\" stroke-width=\"0.8\"/>\n");
    }
    if !outline.is_empty() {
        svg += &format!("<path d=\"{outline}\" stroke=\"#1f1d1a\" stroke-width=\"1.6\"/>\n");
    }
    svg + "</g>\n</svg>\n"
}

struct Line<'a> {
    ends: [DVec2; 2],
    edge: &'a FoundEdge,
}

fn segment([begin, end]: [DVec2; 2]) -> String {
    format!("M{:.2} {:.2}L{:.2} {:.2}", begin.x, begin.y, end.x, end.y)
}

/// The silhouette as closed loops: their winding is not zero where the light is hidden.
fn shadow_path(lines: &[Line<'_>], frame: &Frame) -> Option<String> {
    let mut vertex_of = BTreeMap::new();
    let mut points = Vec::new();
    let mut vertex = |found: &FoundVertex, point: DVec2| {
        let key = (found.number, found.position_world.to_array().map(f64::to_bits));
        *vertex_of.entry(key).or_insert_with(|| {
            points.push(frame.place(point));
            points.len() - 1
        })
    };
    let arcs: Vec<Arc> = lines
        .iter()
        .map(|Line { ends, edge }| {
            let (low, high) = (vertex(&edge.low, ends[0]), vertex(&edge.high, ends[1]));
            let (begin, end) = if edge.multiplicity > 0 { (low, high) } else { (high, low) };
            Arc { begin, end, count: edge.multiplicity.unsigned_abs() }
        })
        .collect();
    let loops = loops(&arcs)?;
    Some(loops.iter().map(|vertices| closed_path(vertices.iter().map(|&vertex| points[vertex]))).collect())
}

/// Where the light's plane goes in the drawing.
struct Frame {
    min: DVec2,
    max: DVec2,
    scale: f64,
}

impl Frame {
    fn around(points: impl Iterator<Item = DVec2>, is_perspective: bool) -> Self {
        let widest = if is_perspective { WIDEST_TANGENT } else { f64::INFINITY };
        let (min, max) = points
            .map(|point| point.clamp(DVec2::splat(-widest), DVec2::splat(widest)))
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), point| (min.min(point), max.max(point)));
        let side = (max - min).max_element();
        if side > 0.0 && side.is_finite() {
            Self { min, max, scale: SIDE / side }
        } else {
            Self { min: DVec2::ZERO, max: DVec2::ZERO, scale: 1.0 }
        }
    }

    fn size(&self) -> [f64; 2] {
        (self.scale * (self.max - self.min) + 2.0 * MARGIN).to_array()
    }

    /// y points down in a drawing.
    fn place(&self, point: DVec2) -> DVec2 {
        self.scale * DVec2::new(point.x - self.min.x, self.max.y - point.y) + MARGIN
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::silhouette::found::tests::edge;

    const SUN: DVec4 = DVec4::Z;
    const BOUNDS: (DVec3, DVec3) = (DVec3::NEG_ONE, DVec3::ONE);

    fn triangle() -> [FoundEdge; 3] {
        let [a, b, c] = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        [edge((0, a), (1, b), 1), edge((0, a), (2, c), -1), edge((1, b), (2, c), 1)]
    }

    #[test]
    fn a_triangle_is_filled_and_upright() {
        let text = svg(&triangle(), SUN, BOUNDS, "a<b.obj");
        assert!(text.contains("viewBox=\"0 0 1080 580\""), "{text}");
        assert!(text.contains("M40.00 540.00L1040.00 540.00L540.00 40.00Z"), "{text}");
        assert!(text.contains("a&lt;b.obj"), "{text}");
    }

    #[test]
    fn an_edge_behind_the_light_leaves_nothing_filled() {
        let text = svg(&triangle(), DVec4::new(0.0, 0.5, 0.0, 1.0), BOUNDS, "");
        assert!(!text.contains("fill-rule") && !text.contains("NaN") && !text.contains("inf"), "{text}");
    }

    #[test]
    fn nothing_is_an_empty_drawing() {
        let text = svg(&[], SUN, BOUNDS, "");
        assert!(text.contains("viewBox=\"0 0 80 80\"") && !text.contains("<path"), "{text}");
    }
}
