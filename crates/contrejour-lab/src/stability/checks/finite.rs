//! Numbers that are infinite or none.

use contrejour_layout::{CasterLight, Corner, LightView, Quad, ReceiverView};

/// What counts as floats in a record.
pub(in super::super) trait Floats {
    fn floats(&self) -> impl Iterator<Item = f32>;
}

impl Floats for Quad {
    fn floats(&self) -> impl Iterator<Item = f32> {
        [self.low_ndc, self.high_ndc, self.outward, self.width_ndc, self.q].into_iter().flatten()
    }
}

impl Floats for Corner {
    fn floats(&self) -> impl Iterator<Item = f32> {
        let directions = [self.apex_ndc, self.begin, self.middle, self.end].into_iter().flatten();
        directions.chain([self.width_ndc, self.q])
    }
}

impl Floats for CasterLight {
    fn floats(&self) -> impl Iterator<Item = f32> {
        self.light_object.map(f32::from_bits).into_iter().chain(self.light_clip_from_object)
    }
}

impl Floats for LightView {
    fn floats(&self) -> impl Iterator<Item = f32> {
        [
            self.near_depth,
            self.far_depth,
            self.ndc_scale,
            self.ndc_offset,
            self.q_max,
            self.sphere_half_side,
            self.width_per_q_ndc,
            self.width_min_ndc,
            self.width_max_ndc,
            self.bias_smoothie_texels,
            self.texel_world,
            self.depth_unit,
            self.warp_exponent,
            self.reach_ndc,
        ]
        .into_iter()
    }
}

impl Floats for ReceiverView {
    fn floats(&self) -> impl Iterator<Item = f32> {
        let numbers = [
            self.near_depth,
            self.far_depth,
            self.texel_world,
            self.bias_constant_texels,
            self.bias_slope_texels,
            self.bias_normal_texels,
            self.depth_unit,
            self.ndc_scale,
            self.ndc_offset,
            self.light_size,
            self.search_max_ndc,
            self.blur_texels,
            self.bleed_cut,
            self.min_variance,
            self.warp_exponent,
            self.edge_texels,
        ];
        self.light_clip_from_world.into_iter().chain(self.light_world).chain(numbers)
    }
}

/// A plane, with its constant.
impl Floats for [f32; 4] {
    fn floats(&self) -> impl Iterator<Item = f32> {
        self.iter().copied()
    }
}

impl Floats for f32 {
    fn floats(&self) -> impl Iterator<Item = f32> {
        [*self].into_iter()
    }
}

/// How many floats of some records are not finite.
pub(in super::super) fn non_finite<Record: Floats>(records: &[Record]) -> u64 {
    records.iter().flat_map(Floats::floats).filter(|value| !value.is_finite()).count() as u64
}

#[cfg(test)]
mod tests {
    use bytemuck::{Pod, Zeroable, cast_slice_mut};

    use super::*;

    /// Plants a number in each word of a record; those are found that the record says are floats.
    fn words_that_count<Record: Floats + Pod + Zeroable>() -> usize {
        let is_found = |word: &usize| {
            [f32::NAN, f32::INFINITY, f32::NEG_INFINITY].into_iter().all(|planted| {
                let mut record = [Record::zeroed()];
                cast_slice_mut::<Record, f32>(&mut record)[*word] = planted;
                non_finite(&record) == 1
            })
        };
        (0..size_of::<Record>() / 4).filter(is_found).count()
    }

    #[test]
    fn every_float_of_a_record_counts() {
        assert_eq!(words_that_count::<Quad>(), 10);
        assert_eq!(words_that_count::<Corner>(), 10);
        assert_eq!(words_that_count::<CasterLight>(), 20);
        assert_eq!(words_that_count::<LightView>(), 14);
        assert_eq!(words_that_count::<ReceiverView>(), 36);
        assert_eq!(words_that_count::<f32>(), 1);
        assert_eq!(non_finite(&[0.0, f32::NAN, f32::MAX, f32::INFINITY]), 2);
    }
}
