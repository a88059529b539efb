//! What tells series apart: a colour and a shape, so that neither alone has to.

use plotters::prelude::*;

/// Middle tones with enough contrast on white and on black; neighbours differ in hue and lightness.
const COLOURS: [RGBColor; 8] = [
    RGBColor(0x2f, 0x7f, 0xc8),
    RGBColor(0xd9, 0x6c, 0x0b),
    RGBColor(0x2a, 0x9a, 0x6a),
    RGBColor(0xcf, 0x45, 0x7d),
    RGBColor(0x8b, 0x6f, 0xd8),
    RGBColor(0x1c, 0x9a, 0xaf),
    RGBColor(0xa0, 0x86, 0x1d),
    RGBColor(0x80, 0x84, 0x8c),
];

/// Shapes of marks. As many as colours would pair each colour with one shape for ever.
const SHAPES: [Shape; 5] = [Shape::Disk, Shape::Square, Shape::Triangle, Shape::Diamond, Shape::Cross];

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mark {
    pub(super) colour: RGBColor,
    shape: Shape,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    Disk,
    Square,
    Triangle,
    Diamond,
    Cross,
}

impl Mark {
    /// The mark of a series by its number among those of its plot. The first 40 are different.
    pub(super) fn of(series: usize) -> Self {
        Self { colour: COLOURS[series % COLOURS.len()], shape: SHAPES[series % SHAPES.len()] }
    }

    /// The mark at a place, `size` from its middle to its rim.
    pub(super) fn at<Backend: DrawingBackend>(
        &self,
        (x, y): (i32, i32),
        size: i32,
    ) -> DynElement<'static, Backend, (i32, i32)> {
        let filled = self.colour.filled();
        let polygon = |corners: &[(i32, i32)]| {
            let corners: Vec<_> = corners.iter().map(|&(right, down)| (x + right, y + down)).collect();
            Polygon::new(corners, filled).into_dyn()
        };
        // Sizes that look alike have equal areas.
        let [square, long] = [size * 9 / 10, size * 13 / 10];
        match self.shape {
            Shape::Disk => Circle::new((x, y), size, filled).into_dyn(),
            Shape::Square => polygon(&[(-square, -square), (square, -square), (square, square), (-square, square)]),
            Shape::Triangle => polygon(&[(0, -long), (long, size * 9 / 10), (-long, size * 9 / 10)]),
            Shape::Diamond => polygon(&[(0, -long), (long, 0), (0, long), (-long, 0)]),
            Shape::Cross => Cross::new((x, y), size, self.colour.stroke_width((size / 2) as u32)).into_dyn(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forty_series_are_told_apart() {
        for a in 0..40 {
            for b in 0..a {
                assert_ne!(Mark::of(a), Mark::of(b));
            }
        }
        assert_eq!(Mark::of(40), Mark::of(0));
    }
}
