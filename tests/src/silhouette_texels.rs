//! The silhouette map by definition: what the raster pass draws from quads, in 64-bit floats.

use std::collections::HashMap;

use contrejour_layout::{LightView, OUTLINE_BLOCKER_LEFT, OWN_END_HIGH, OWN_END_LOW, Quad};
use glam::DVec2;

/// What a texel of a silhouette map holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SilhouetteTexel {
    /// Linear depth of the nearest silhouette.
    pub depth: f64,
    /// Distance to it in texels, positive on the blocker's side.
    pub signed_distance: f64,
}

/// The same by definition, and how rounding may move it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// What a texel holds.
    pub texel: SilhouetteTexel,
    /// How depth changes along the silhouette. Unit: depth a texel.
    pub depth_per_texel: f64,
    /// Whether the silhouette's nearest point is where the view's nearest or farthest depth cuts it off: an edge that runs
    /// along that depth is cut anywhere.
    pub is_cut_by_depth: bool,
}

/// Everything that a texel may hold, but for rounding.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Expected {
    /// What may win, the nearest first.
    pub candidates: Vec<Candidate>,
    /// Whether one of them must: else the texel may be empty.
    pub is_certain: bool,
    /// Whether one that must is so near that the texel is in its band however deep it is. Not where blockers on both sides of
    /// it end as near: what is between them may be as thin as rounding.
    pub is_in_least_band: bool,
}

/// Distances that differ by less, in texels, are equally far: end points are rounded to 32 bits, and a slant may count as so
/// much.
pub const TIE_TEXELS: f64 = 4e-3;

/// So near to a texel's border, in texels, rounding may look into its neighbour.
const BORDER_TEXELS: f64 = 2e-3;

/// Depths that differ by less of them may hide each other or not.
const DEPTH_TIE: f64 = 1e-4;

/// How an edge that is seen at a slant falls behind one that is not: the shader's `SLANT_PENALTY`.
const SLANT_PENALTY: f64 = 1e-3;

/// The silhouette map of a view with these quads over a shadow map of linear depth.
#[derive(Debug)]
pub struct Definition<'a> {
    /// The view's record.
    pub record: &'a LightView,
    /// Linear depth, row by row.
    pub shadow_depth: &'a [f32],
}

/// Whether something is so.
#[derive(Clone, Copy, PartialEq)]
enum Answer {
    Yes,
    Perhaps,
    No,
}

struct Contender {
    order: f64,
    answer: Answer,
    is_in_least_band: bool,
    candidate: Candidate,
}

/// The outline edges at each vertex of each caster, with their directions from there.
type Fans = HashMap<[u32; 2], Vec<(u32, DVec2)>>;

impl Definition<'_> {
    /// What each texel may hold, row by row.
    pub fn texels(&self, quads: &[Quad]) -> Vec<Expected> {
        let fans = fans(quads);
        let side = self.record.map_size as usize;
        let mut all: Vec<Vec<Contender>> = (0..side * side).map(|_| Vec::new()).collect();
        for quad in quads {
            let [low, high] = [quad.low_ndc, quad.high_ndc].map(vector);
            let width = (0..2).map(|end| {
                let place = [low, high][end];
                self.width(place, place.normalize_or_zero(), quad.q[end].into())
            });
            let reach = DVec2::splat(width.fold(0.0, f64::max));
            let [first, last] = [self.texel_of(low.min(high) - reach), self.texel_of(low.max(high) + reach)];
            let most = side as f64 - 1.0;
            let columns = first.x.floor().clamp(0.0, most) as usize..=last.x.floor().clamp(0.0, most) as usize;
            let rows = last.y.floor().clamp(0.0, most) as usize..=first.y.floor().clamp(0.0, most) as usize;
            for (row, column) in rows.flat_map(|row| columns.clone().map(move |column| (row, column))) {
                let place = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
                all[row * side + column].extend(self.contender(quad, &fans, place));
            }
        }
        all.into_iter().map(expected).collect()
    }

    fn contender(&self, quad: &Quad, fans: &Fans, texel: DVec2) -> Option<Contender> {
        let texels_per_ndc = 0.5 * f64::from(self.record.map_size);
        let place = (texel / f64::from(self.record.map_size) - 0.5) * DVec2::new(2.0, -2.0);
        let [low, high, outward] = [quad.low_ndc, quad.high_ndc, quad.outward].map(vector);
        let along = high - low;
        let length_squared = along.length_squared();
        let share =
            if length_squared > 0.0 { ((place - low).dot(along) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
        let nearest = low + share * along;
        let offset = (place - nearest) * texels_per_ndc;
        let distance = offset.length();
        let across = offset.dot(outward);
        let slant = if distance > 0.0 { 1.0 - across.abs() / distance } else { 0.0 };
        let q = f64::from(quad.q[0]) + share * (f64::from(quad.q[1]) - f64::from(quad.q[0]));
        let depth = self.depth_of_q(q);
        let across_way = if distance > 0.0 { offset / distance } else { outward };
        let width = self.width(nearest, across_way, q) * texels_per_ndc;
        let is_near = compared(width - distance, TIE_TEXELS);
        // Beyond an end where another edge is nearer, that other one draws.
        let is_nearest = if is_beyond(quad, share, offset, fans) { Answer::Perhaps } else { Answer::Yes };
        // As deep as the view is what a texel without a silhouette holds.
        let is_inside = match compared(f64::from(self.record.far_depth) - depth, DEPTH_TIE * depth.abs()) {
            Answer::Yes => Answer::Yes,
            _ => Answer::Perhaps,
        };
        let answers = [is_near, self.is_unhidden(nearest, outward, depth), is_nearest, is_inside];
        if answers.contains(&Answer::No) {
            return None;
        }
        let answer = if answers.contains(&Answer::Perhaps) { Answer::Perhaps } else { Answer::Yes };
        let signed_distance = if across > 0.0 { -distance } else { distance };
        let candidate = Candidate {
            texel: SilhouetteTexel { depth, signed_distance },
            depth_per_texel: self.depth_per_texel(quad, q),
            is_cut_by_depth: is_cut(quad, share) && self.is_at_an_end(depth),
        };
        let is_in_least_band = distance < f64::from(self.record.width_min_ndc) * texels_per_ndc - TIE_TEXELS;
        Some(Contender { order: distance + SLANT_PENALTY * slant, answer, is_in_least_band, candidate })
    }

    /// How depth changes along a quad's edge where it has this `q`.
    fn depth_per_texel(&self, quad: &Quad, q: f64) -> f64 {
        let [low, high] = [quad.low_ndc, quad.high_ndc].map(vector);
        let texels = 0.5 * f64::from(self.record.map_size) * low.distance(high);
        // Depth is -1 / q, or q.
        let depth_per_q = if self.record.perspective == 1 { (q * q).recip() } else { 1.0 };
        let depths = depth_per_q * f64::from(quad.q[1] - quad.q[0]).abs();
        if depths > 0.0 { depths / texels } else { 0.0 }
    }

    /// Whether the view ends at this depth.
    fn is_at_an_end(&self, depth: f64) -> bool {
        let ends = [self.record.near_depth, self.record.far_depth].map(f64::from);
        ends.iter().any(|end| (end - depth).abs() <= DEPTH_TIE * depth.abs())
    }

    /// Whether what is drawn just outside is deeper, in each texel that rounding may look into.
    fn is_unhidden(&self, ndc: DVec2, outward: DVec2, depth: f64) -> Answer {
        let outside = self.texel_of(ndc) + outward * DVec2::new(1.0, -1.0);
        let most = f64::from(self.record.map_size) - 1.0;
        let footprint = if self.record.perspective == 1 { depth } else { 1.0 } * f64::from(self.record.texel_world);
        let reach = f64::from(self.record.bias_smoothie_texels) * footprint;
        let border = DVec2::splat(BORDER_TEXELS);
        let [first, last] =
            [outside - border, outside + border].map(|place| place.floor().clamp(DVec2::ZERO, DVec2::splat(most)));
        let answers = [first, DVec2::new(first.x, last.y), DVec2::new(last.x, first.y), last].map(|texel| {
            let index = texel.y as usize * self.record.map_size as usize + texel.x as usize;
            let nearest = f64::from(self.shadow_depth[index]);
            compared(nearest + reach - depth, DEPTH_TIE * depth.abs())
        });
        if answers.iter().all(|answer| *answer == answers[0]) { answers[0] } else { Answer::Perhaps }
    }

    fn width(&self, ndc: DVec2, outward: DVec2, q: f64) -> f64 {
        let view = self.record;
        let width = f64::from(view.width_per_q_ndc) * (f64::from(view.q_max) - q);
        let width = width.max(view.width_min_ndc.into()).min(view.width_max_ndc.into());
        let along = f64::from(view.sphere_half_side) * ndc.dot(outward);
        width * (1.0 + along * along).sqrt()
    }

    fn texel_of(&self, ndc: DVec2) -> DVec2 {
        (ndc * DVec2::new(0.5, -0.5) + 0.5) * f64::from(self.record.map_size)
    }

    fn depth_of_q(&self, q: f64) -> f64 {
        if self.record.perspective == 1 { -1.0 / q } else { q }
    }
}

fn fans(quads: &[Quad]) -> Fans {
    let mut fans = Fans::new();
    for quad in quads {
        let outward = vector(quad.outward);
        let along = if quad.side == OUTLINE_BLOCKER_LEFT { outward.perp() } else { -outward.perp() };
        for (flag, vertex, direction) in
            [(OWN_END_LOW, quad.low_vertex, along), (OWN_END_HIGH, quad.high_vertex, -along)]
        {
            if quad.own_ends & flag != 0 {
                fans.entry([quad.caster, vertex]).or_default().push((quad.edge_id, direction));
            }
        }
    }
    fans
}

/// Whether a texel that has an end of an edge nearest has another edge at this end nearer.
fn is_beyond(quad: &Quad, share: f64, offset: DVec2, fans: &Fans) -> bool {
    let vertex = match share {
        0.0 => quad.low_vertex,
        1.0 => quad.high_vertex,
        _ => return false,
    };
    let fan = fans.get(&[quad.caster, vertex]).map_or(&[][..], Vec::as_slice);
    fan.iter().any(|(edge_id, direction)| *edge_id != quad.edge_id && offset.dot(*direction) > 0.0)
}

/// Whether a place on a quad's edge is an end where clipping cut it off.
fn is_cut(quad: &Quad, share: f64) -> bool {
    (share == 0.0 && quad.own_ends & OWN_END_LOW == 0) || (share == 1.0 && quad.own_ends & OWN_END_HIGH == 0)
}

/// Whether a difference is positive.
fn compared(difference: f64, tie: f64) -> Answer {
    match difference {
        _ if difference > tie => Answer::Yes,
        _ if difference >= -tie => Answer::Perhaps,
        _ => Answer::No,
    }
}

fn expected(mut contenders: Vec<Contender>) -> Expected {
    contenders.sort_by(|one, other| one.order.total_cmp(&other.order));
    let certain = contenders.iter().find(|contender| contender.answer == Answer::Yes).map(|contender| contender.order);
    let farthest = certain.map_or(f64::INFINITY, |order| order + TIE_TEXELS);
    let candidates: Vec<_> = contenders.iter().take_while(|it| it.order <= farthest).map(|it| it.candidate).collect();
    let is_on_one_side = |side: f64| candidates.iter().all(|candidate| side * candidate.texel.signed_distance >= 0.0);
    let is_reached = contenders.iter().any(|it| it.answer == Answer::Yes && it.is_in_least_band);
    Expected {
        is_certain: certain.is_some(),
        is_in_least_band: is_reached && (is_on_one_side(1.0) || is_on_one_side(-1.0)),
        candidates,
    }
}

fn vector(of: [f32; 2]) -> DVec2 {
    DVec2::from(of.map(f64::from))
}
