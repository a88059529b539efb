//! Places where a blocker ends and no silhouette is near.

/// Neighbouring texels between which a blocker ends, of which one knows no silhouette within a texel of it. A blocker whose
/// middle of a texel is covered ends before the next one's, so both are nearer than that. It ends where one of them shows it
/// and the other shows nothing, or something that is farther by a [`STEP`](STEP_SLOPES).
///
/// Depths are those of the shadow map, `far_depth` where nothing is; silhouettes are depth, as far where none is near, and
/// signed distance in texels. Row by row.
pub(in super::super) fn open_boundary(depths: &[f32], silhouettes: &[[f32; 2]], side: usize, far_depth: f32) -> u64 {
    let shows_blocker = |texel: usize| depths[texel] < far_depth;
    let knows = |texel: usize| {
        let [depth, distance] = silhouettes[texel];
        depth < far_depth && distance.abs() <= 1.0 + ROUNDING_TEXELS
    };
    let is_step = |texels: Option<[usize; 4]>| {
        let Some(texels) = texels.filter(|texels| texels.iter().all(|&texel| shows_blocker(texel))) else {
            return false;
        };
        let [before, jump, after] = [0, 1, 2].map(|pair| (depths[texels[pair + 1]] - depths[texels[pair]]).abs());
        jump > STEP_SLOPES * before.max(after) && jump > STEP_SHARE * far_depth
    };
    // From texel to texel along rows, then along columns.
    let count = |stride: usize, length: usize| {
        let is_open = |texel: &usize| {
            let (one, other) = (*texel, texel + stride);
            let place = one / stride % length;
            let around = (place > 0 && place + 2 < length).then(|| [one - stride, one, other, other + stride]);
            let ends = shows_blocker(one) != shows_blocker(other) || is_step(around);
            ends && !(knows(one) && knows(other))
        };
        (0..depths.len()).filter(|texel| texel / stride % length + 1 < length).filter(is_open).count() as u64
    };
    count(1, side) + count(side, depths.len() / side)
}

/// A step between two texels is so many times as high as those beside it, which the slope of a face explains.
const STEP_SLOPES: f32 = 8.0;

/// And so high at least, of the farthest depth: a face of a curved surface that is seen edge-on within a texel is lower.
const STEP_SHARE: f32 = 0.1;

/// Rasterisers take a middle that lies on an edge for either side, and round corners: to 1/256 texel most, some to 1/16.
const ROUNDING_TEXELS: f32 = 0.1;

#[cfg(test)]
mod tests {
    use super::*;

    /// A blocker on the left half of four texels by two, and the distance to its edge.
    fn half() -> ([f32; 8], [[f32; 2]; 8]) {
        let depths = std::array::from_fn(|texel| if texel % 4 < 2 { 2.0 } else { 9.0 });
        let silhouettes = std::array::from_fn(|texel| [2.0, 1.5 - (texel % 4) as f32]);
        (depths, silhouettes)
    }

    #[test]
    fn a_blocker_ends_before_another_too() {
        let (mut depths, good) = half();
        depths.iter_mut().for_each(|depth| *depth = depth.min(8.0));
        assert_eq!(open_boundary(&depths, &good, 4, 9.0), 0);
        assert_eq!(open_boundary(&depths, &[[9.0, 0.0]; 8], 4, 9.0), 2);
        // A face that is seen at a slant.
        let slanted = std::array::from_fn::<f32, 8, _>(|texel| 2.0 + (texel % 4) as f32);
        assert_eq!(open_boundary(&slanted, &[[9.0, 0.0]; 8], 4, 9.0), 0);
    }

    #[test]
    fn a_closed_boundary_is_told_from_an_open_one() {
        let (depths, good) = half();
        assert_eq!(open_boundary(&depths, &good, 4, 9.0), 0);
        for (texel, planted) in [(1, [9.0, 0.0]), (2, [9.0, 0.0]), (5, [2.0, 1.5]), (6, [2.0, f32::NAN])] {
            let mut silhouettes = good;
            silhouettes[texel] = planted;
            assert_eq!(open_boundary(&depths, &silhouettes, 4, 9.0), 1, "{texel}: {planted:?}");
        }
        assert_eq!(open_boundary(&depths, &[[9.0, 0.0]; 8], 4, 9.0), 2);
    }
}
