//! The image of an edge: what of it is in view, widened by how far from it is drawn.

use contrejour_layout::LightView;
use glam::{Mat4, Vec2, Vec3, Vec4, Vec4Swizzles};

use crate::light_outline::widest_ndc;
use crate::view_depth::{depth_of_clip, least_depth, pancakes, q_of_depth, smoothie_width};

/// A point of the image plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ImagePoint {
    pub ndc: Vec2,
    pub q: f32,
}

/// What of an edge is in view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EdgeImage {
    pub low: ImagePoint,
    pub high: ImagePoint,
    pub span: Span,
}

/// The part of an edge that is inside: from `begin` to `end` of its parameter 0..1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Span {
    pub begin: f32,
    pub end: f32,
}

/// The image of an edge; none where none of it is in view.
pub(crate) fn edge_image(view: &LightView, clip_from_object: &Mat4, low: Vec3, high: Vec3) -> Option<EdgeImage> {
    let segment = Segment {
        low: *clip_from_object * low.extend(1.0),
        high: *clip_from_object * high.extend(1.0),
        delta: *clip_from_object * (high - low).extend(0.0),
    };

    // Clip by depth first, since the width that widens the frustum depends on it.
    let depth_span = segment.clip_by_depth(Span { begin: 0.0, end: 1.0 }, pancakes(view))?;
    let width_at = |t| smoothie_width(view, image_of(view, segment.at(t)).q);
    let width = width_at(depth_span.begin).max(width_at(depth_span.end));
    let span = segment.clip_by_sides(depth_span, 1.0 + widest_ndc(view, width))?;
    let [low, high] = [span.begin, span.end].map(|t| image_of(view, segment.at(t)));
    Some(EdgeImage { low, high, span })
}

/// A point in view but for rounding: the cut end of an edge that is far larger than the view can be anywhere, even in the
/// plane of the light.
fn image_of(view: &LightView, clip: Vec4) -> ImagePoint {
    let depth = depth_of_clip(view, clip).max(least_depth(view)).min(view.far_depth);
    let w = if view.perspective == 1 { depth } else { clip.w };
    let most = Vec2::splat(1.0 + widest_ndc(view, view.width_max_ndc));
    ImagePoint { ndc: (clip.xy() / w).max(-most).min(most), q: q_of_depth(view, depth) }
}

/// An edge in clip space.
struct Segment {
    low: Vec4,
    high: Vec4,
    delta: Vec4,
}

impl Segment {
    /// The ends themselves where nothing was cut off, so that neighbours share them to the bit.
    fn at(&self, t: f32) -> Vec4 {
        if t == 0.0 {
            return self.low;
        }
        if t == 1.0 {
            return self.high;
        }
        self.low + t * self.delta
    }

    /// What is left between the near and the far plane, or before the far one where casters in front cast too; none where
    /// nothing is.
    fn clip_by_depth(&self, span: Span, pancakes: bool) -> Option<Span> {
        let Self { low, high, .. } = self;
        clip_by_plane(span, low.w - low.z, high.w - high.z)
            .and_then(|span| if pancakes { Some(span) } else { clip_by_plane(span, low.z, high.z) })
            .filter(Span::has_length)
    }

    /// What is left between the four sides; none where nothing is.
    fn clip_by_sides(&self, span: Span, half_side: f32) -> Option<Span> {
        let Self { low, high, .. } = self;
        clip_by_plane(span, half_side * low.w + low.x, half_side * high.w + high.x)
            .and_then(|span| clip_by_plane(span, half_side * low.w - low.x, half_side * high.w - high.x))
            .and_then(|span| clip_by_plane(span, half_side * low.w + low.y, half_side * high.w + high.y))
            .and_then(|span| clip_by_plane(span, half_side * low.w - low.y, half_side * high.w - high.y))
            .filter(Span::has_length)
    }
}

impl Span {
    fn has_length(&self) -> bool {
        self.begin < self.end
    }
}

/// Keeps the part where the distance to a plane, linear from one end to the other, is not negative; none where it is
/// negative at both ends. Liang & Barsky 1984.
fn clip_by_plane(span: Span, low_distance: f32, high_distance: f32) -> Option<Span> {
    if low_distance >= 0.0 && high_distance >= 0.0 {
        return Some(span);
    }
    if low_distance < 0.0 && high_distance < 0.0 {
        return None;
    }
    let crossing = low_distance / (low_distance - high_distance);
    if low_distance < 0.0 {
        return Some(Span { begin: span.begin.max(crossing), ..span });
    }
    Some(Span { end: span.end.min(crossing), ..span })
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHOLE: Span = Span { begin: 0.0, end: 1.0 };

    #[test]
    fn planes_cut_what_is_outside() {
        assert_eq!(clip_by_plane(WHOLE, 1.0, 0.0), Some(WHOLE));
        assert_eq!(clip_by_plane(WHOLE, -1.0, -0.5), None);
        assert_eq!(clip_by_plane(WHOLE, -1.0, 3.0), Some(Span { begin: 0.25, end: 1.0 }));
        assert_eq!(clip_by_plane(WHOLE, 3.0, -1.0), Some(Span { begin: 0.0, end: 0.75 }));
        assert_eq!(clip_by_plane(Span { begin: 0.5, end: 1.0 }, -1.0, 3.0), Some(Span { begin: 0.5, end: 1.0 }));
    }

    #[test]
    fn segment_outside_one_corner_of_the_frustum_is_empty() {
        // Passes the left plane beyond the top plane: each plane alone leaves something.
        let low = Vec4::new(-3.0, 0.0, 0.5, 1.0);
        let high = Vec4::new(0.0, 3.0, 0.5, 1.0);
        let segment = Segment { low, high, delta: high - low };
        assert_eq!(segment.clip_by_sides(WHOLE, 1.0), None);
        assert!(segment.clip_by_sides(WHOLE, 2.0).is_some());
    }
}
