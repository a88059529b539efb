//! Places where a blocker ends and no silhouette is near.

/// Neighbouring texels, of which one shows a blocker and the other nothing, and of which one knows no silhouette within a
/// texel of it. A blocker whose middle of a texel is covered ends before the next one's, so both are nearer than that.
///
/// Depths are those of the shadow map, `far_depth` where nothing is; silhouettes are depth, as far where none is near, and
/// signed distance in texels. Row by row.
pub(in super::super) fn open_boundary(depths: &[f32], silhouettes: &[[f32; 2]], side: usize, far_depth: f32) -> u64 {
    let shows_blocker = |texel: usize| depths[texel] < far_depth;
    let knows = |texel: usize| {
        let [depth, distance] = silhouettes[texel];
        depth < far_depth && distance.abs() <= 1.0 + ROUNDING_TEXELS
    };
    let is_open =
        |&(one, other): &(usize, usize)| shows_blocker(one) != shows_blocker(other) && !(knows(one) && knows(other));
    let across = (0..depths.len()).filter(|texel| (texel + 1) % side != 0).map(|texel| (texel, texel + 1));
    let down = (side..depths.len()).map(|texel| (texel - side, texel));
    across.chain(down).filter(is_open).count() as u64
}

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
