//! Brings the lights of a bundle and their clip spaces into the space of each caster, and leaves out casters that a view
//! can't see.

use contrejour_layout::{
    CASTER_IN_VIEW, CASTER_NEVER, CasterLight, CasterPlace, LightView, SeatCounters, VIEW_CULLS, VIEW_PANCAKES,
    ViewBundle,
};

/// The stage `place_casters`: where casters stand to what the view's stages need of each.
pub struct PlaceCasters<'a> {
    /// The lights, their clip spaces and how many casters there are.
    pub bundle: &'a ViewBundle,
    /// Where each caster stands.
    pub caster_places: &'a [CasterPlace],
    /// The light of each seat as each caster sees it.
    pub caster_lights: &'a mut [CasterLight],
    /// Counts casters that cast for each seat, and those of them without an image.
    pub counters: &'a mut [SeatCounters],
}

type Columns = [[f32; 4]; 4];

impl PlaceCasters<'_> {
    /// Does what the whole dispatch does.
    ///
    /// # Panics
    ///
    /// When the buffers hold fewer casters than the view says.
    pub fn run(mut self) {
        for seat in 0..self.bundle.shape.seat_count as usize {
            self.place_for(seat);
        }
    }

    fn place_for(&mut self, seat: usize) {
        let view = &self.bundle.views[seat];
        let counts = &mut self.counters[seat].counts;
        let of_seat = &mut self.caster_lights[seat * self.bundle.shape.caster_stride as usize..];
        for (place, caster_light) in self.caster_places.iter().zip(of_seat).take(view.caster_count as usize) {
            *caster_light = CasterLight::default();
            let light = light_in_object_space(view, place);
            let matrix = clip_from_scaled(view, place);
            let has_place = place.casts != CASTER_NEVER && light.iter().all(|value| value.is_finite());
            if has_place && may_be_seen(view, place, &matrix) {
                counts.casters += 1;
                counts.imageless_casters += u32::from(!has_image(&matrix));
                *caster_light = CasterLight {
                    light_object: light.map(f32::to_bits),
                    light_clip_from_object: if has_image(&matrix) { flat(&matrix) } else { [0.0; 16] },
                    mirrored: place.mirrored,
                    casts: 1,
                    ..CasterLight::default()
                };
            }
        }
    }
}

fn flat(matrix: &Columns) -> [f32; 16] {
    std::array::from_fn(|index| matrix[index / 4][index % 4])
}

/// A 64-bit float of two words, the low one first; zero below the smallest normal number.
fn float64([low, high]: [u32; 2]) -> f64 {
    let value = f64::from_bits(u64::from(high) << 32 | u64::from(low));
    if value.is_subnormal() { 0.0 } else { value }
}

/// The number at a place of a vector or a matrix by columns of four, two numbers to a row of words.
fn of_rows(rows: &[[u32; 4]], place: usize) -> f64 {
    let [x, y, z, w] = rows[place / 2];
    float64(if place.is_multiple_of(2) { [x, y] } else { [z, w] })
}

/// The nearest 32-bit float; zeros have no sign.
fn float32(value: f64) -> f32 {
    value as f32 + 0.0
}

fn light_in_object_space(view: &LightView, place: &CasterPlace) -> [f32; 4] {
    let is_point = of_rows(&view.light_world, 3) != 0.0;
    let mut object = [0.0_f64; 3];
    for column in 0..3 {
        let world = of_rows(&view.light_world, column);
        let along = if is_point { world - float64(place.origin_world[column]) } else { world };
        for (row, value) in object.iter_mut().enumerate() {
            *value += float64(place.object_from_world[3 * column + row]) * along;
        }
    }
    if !is_point && !object.into_iter().all(is_held) {
        let largest = object.into_iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        object = object.map(|value| scaled_down(value, largest));
    }
    let [x, y, z] = object.map(float32);
    [x, y, z, if is_point { 1.0 } else { 0.0 }]
}

/// Whether a 32-bit float has all the digits of a normal number, or is the number itself.
fn is_held(value: f64) -> bool {
    let nearest = value as f32;
    nearest.is_normal() || f64::from(nearest) == value
}

/// Times the power of two that brings the largest one into 1..2.
fn scaled_down(value: f64, largest: f64) -> f64 {
    if largest == 0.0 || value == 0.0 {
        return 0.0;
    }
    let exponent = (largest.to_bits() >> 52) as i64 - 1023;
    // Each step is a normal power of two, and the result is exact.
    let half = exponent / 2;
    value * 2.0_f64.powi(-half as i32) * 2.0_f64.powi((half - exponent) as i32)
}

fn clip_from_scaled(view: &LightView, place: &CasterPlace) -> Columns {
    std::array::from_fn(|column| {
        std::array::from_fn(|row| {
            let mut entry = 0.0;
            for k in 0..4 {
                let factor = match k {
                    0..3 => float64(place.world_from_scaled[3 * column + k]),
                    _ if column == 3 => 1.0,
                    _ => 0.0,
                };
                entry += of_rows(&view.light_clip_from_world, 4 * k + row) * factor;
            }
            float32(entry)
        })
    })
}

/// 2^-110: devices may flush numbers below 2^-126, and 16 bits of an image above that are enough.
const LEAST_IMAGE: f32 = f32::MIN_POSITIVE * 65_536.0;

fn has_image(matrix: &Columns) -> bool {
    let largest = matrix[..3].iter().flat_map(|[x, y, ..]| [x, y]).fold(0.0, |largest: f32, x| largest.max(x.abs()));
    matrix.as_flattened().iter().all(|entry| entry.is_finite()) && largest >= LEAST_IMAGE
}

/// Room for rounding of the depth, in NDC.
const DEPTH_GUARD_NDC: f32 = 1e-5;

fn may_be_seen(view: &LightView, place: &CasterPlace, matrix: &Columns) -> bool {
    if view.flags & VIEW_CULLS == 0 || place.casts != CASTER_IN_VIEW {
        return true;
    }
    let side = 1.0 + view.reach_ndc;
    let front = [0.0, 0.0, 1.0, DEPTH_GUARD_NDC];
    let planes = [
        [1.0, 0.0, 0.0, side],
        [-1.0, 0.0, 0.0, side],
        [0.0, 1.0, 0.0, side],
        [0.0, -1.0, 0.0, side],
        [0.0, 0.0, -1.0, 1.0 + DEPTH_GUARD_NDC],
    ];
    let has_front = view.flags & VIEW_PANCAKES == 0;
    if has_front && is_beyond(place, matrix, front) {
        return false;
    }
    !planes.into_iter().any(|plane| is_beyond(place, matrix, plane))
}

/// What rounding can do, relative to the sum of the terms' magnitudes: some ten operations of 2^-23 each.
const ROUNDING: f32 = 2e-6;

fn is_beyond(place: &CasterPlace, matrix: &Columns, plane: [f32; 4]) -> bool {
    let ([x, y, z], [dx, dy, dz]) = (place.box_middle, place.box_half);
    let (middle, half_size) = ([x, y, z, 1.0], [dx, dy, dz, 0.0]);
    let normal = matrix.map(|column| dot(plane, column));
    let farthest = dot(normal, middle) + dot(normal.map(f32::abs), half_size);
    let sizes = matrix.map(|column| dot(plane.map(f32::abs), column.map(f32::abs)));
    let reach = std::array::from_fn(|axis| middle[axis].abs() + half_size[axis]);
    farthest < -ROUNDING * dot(sizes, reach)
}

fn dot(a: [f32; 4], b: [f32; 4]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
}
