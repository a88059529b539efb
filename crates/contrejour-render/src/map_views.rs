//! The light's maps as grey pictures.

use image::RgbaImage;

/// A map as a picture, and what its greys mean.
#[derive(Clone, Debug)]
pub struct MapView {
    /// The picture.
    pub picture: RgbaImage,
    /// What white and black stand for, one line.
    pub legend: String,
}

/// Grey of the farthest surface; nothing at all is black, so that the two can be told apart.
const FARTHEST_GREY: f64 = 40.0;

/// Depths as greys: the nearest white, the farthest dark grey, `empty` or more black.
///
/// `depth` is in local units; `world_per_local` turns it into the world's for the legend.
pub(crate) fn depth_view(depth: &[f32], size: u32, empty: f32, world_per_local: f64) -> MapView {
    let seen = || depth.iter().copied().filter(|&depth| depth < empty);
    let nearest = f64::from(seen().fold(f32::INFINITY, f32::min));
    let farthest = f64::from(seen().fold(f32::NEG_INFINITY, f32::max));
    let range = farthest - nearest;
    let grey = |depth: f32| {
        // Positive, so that NaN is nothing.
        if depth < empty {
            let share = if range > 0.0 { (f64::from(depth) - nearest) / range } else { 0.0 };
            return (255.0 + share * (FARTHEST_GREY - 255.0)).round() as u8;
        }
        0
    };
    let legend = if range.is_finite() {
        let [nearest, farthest] = [nearest, farthest].map(|depth| depth * world_per_local);
        format!("white: depth {nearest:.4}, dark grey: depth {farthest:.4}, black: nothing")
    } else {
        "black: nothing".to_owned()
    };
    MapView { picture: grey_picture(depth, size, grey), legend }
}

/// Alpha as greys.
pub(crate) fn alpha_view(alpha: &[f32], size: u32) -> MapView {
    let grey = |alpha: f32| (255.0 * alpha.clamp(0.0, 1.0)).round() as u8;
    MapView {
        picture: grey_picture(alpha, size, grey),
        legend: "black: alpha 0, at a silhouette; white: alpha 1, at the rim of a smoothie or nothing".to_owned(),
    }
}

/// Signed distances to silhouettes, where one is near, as two colours; as one where they do not tell sides.
pub(crate) fn distance_view(distances: &[f32], is_near: &[bool], size: u32, has_sides: bool) -> MapView {
    let near = || distances.iter().zip(is_near).filter(|(_, is_near)| **is_near).map(|(distance, _)| distance.abs());
    let farthest = near().fold(0.0, f32::max);
    let picture = RgbaImage::from_fn(size, size, |x, y| {
        let texel = y as usize * size as usize + x as usize;
        let brightness =
            (255.0 * (1.0 - 0.75 * distances[texel].abs() / farthest.max(f32::MIN_POSITIVE))).round() as u8;
        image::Rgba(match (is_near[texel], distances[texel] > 0.0) {
            (false, _) => [0, 0, 0, 255],
            (true, true) => [brightness, brightness / 2, 0, 255],
            (true, false) => [0, brightness / 2, brightness, 255],
        })
    });
    let legend = if farthest > 0.0 {
        let sides = if has_sides {
            "orange: inside a silhouette, blue: outside"
        } else {
            "orange: on any side of a silhouette"
        };
        format!("{sides}, bright at it, dark {farthest:.2} texels away; black: none is near")
    } else {
        "black: no silhouette is near".to_owned()
    };
    MapView { picture, legend }
}

/// Grey of a texel that one triangle covers; what none covers is black.
const ONCE_GREY: f32 = 64.0;

/// How many triangles cover each texel, as greys.
pub(crate) fn count_view(counts: &[f32], size: u32, what: &str) -> MapView {
    let most = counts.iter().copied().fold(0.0, f32::max);
    let grey = |count: f32| {
        let share = if most > 1.0 { (count - 1.0) / (most - 1.0) } else { 1.0 };
        if count > 0.0 { (ONCE_GREY + share * (255.0 - ONCE_GREY)).round() as u8 } else { 0 }
    };
    let covered = counts.iter().filter(|&&count| count > 0.0).count();
    let legend = if covered > 0 {
        let mean = counts.iter().sum::<f32>() / covered as f32;
        format!(
            "black: no triangle of the {what}, dark grey: one, white: {most}; {mean:.1} in the mean where there are any"
        )
    } else {
        format!("black: no triangle of the {what}")
    };
    MapView { picture: grey_picture(counts, size, grey), legend }
}

fn grey_picture(values: &[f32], size: u32, grey: impl Fn(f32) -> u8) -> RgbaImage {
    RgbaImage::from_fn(size, size, |x, y| {
        let grey = grey(values[y as usize * size as usize + x as usize]);
        image::Rgba([grey, grey, grey, 255])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn greys(view: &MapView) -> Vec<u8> {
        view.picture.pixels().map(|pixel| pixel.0[0]).collect()
    }

    #[test]
    fn near_is_bright_and_nothing_is_black() {
        let view = depth_view(&[2.0, 4.0, 3.0, 10.0], 2, 10.0, 0.5);
        assert_eq!(greys(&view), [255, 40, 148, 0]);
        assert_eq!(view.legend, "white: depth 1.0000, dark grey: depth 2.0000, black: nothing");
    }

    #[test]
    fn an_empty_map_and_a_flat_one_have_no_range() {
        assert_eq!(greys(&depth_view(&[10.0; 4], 2, 10.0, 1.0)), [0; 4]);
        assert_eq!(greys(&depth_view(&[3.0; 4], 2, 10.0, 1.0)), [255; 4]);
        assert_eq!(greys(&depth_view(&[f32::NAN; 4], 2, 10.0, 1.0)), [0; 4]);
    }

    #[test]
    fn distances_are_orange_inside_and_blue_outside() {
        let view = distance_view(&[2.0, -1.0, 0.0, 0.0], &[true, true, true, false], 2, true);
        let colors: Vec<[u8; 3]> = view.picture.pixels().map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        assert_eq!(colors, [[64, 32, 0], [0, 79, 159], [0, 127, 255], [0, 0, 0]]);
        assert!(view.legend.contains("2.00 texels"), "{}", view.legend);
        assert_eq!(distance_view(&[0.0], &[false], 1, true).legend, "black: no silhouette is near");
        let blended = distance_view(&[2.0], &[true], 1, false);
        assert!(blended.legend.starts_with("orange: on any side of a silhouette, bright"), "{}", blended.legend);
    }

    #[test]
    fn what_is_drawn_more_often_is_brighter() {
        let view = count_view(&[0.0, 1.0, 3.0, 2.0], 2, "faces");
        assert_eq!(greys(&view), [0, 64, 255, 160]);
        assert_eq!(
            view.legend,
            "black: no triangle of the faces, dark grey: one, white: 3; 2.0 in the mean where there are any"
        );
        assert_eq!(greys(&count_view(&[0.0, 1.0, 1.0, 0.0], 2, "faces")), [0, 255, 255, 0]);
        assert_eq!(count_view(&[0.0], 1, "faces").legend, "black: no triangle of the faces");
    }

    #[test]
    fn alpha_is_grey() {
        assert_eq!(greys(&alpha_view(&[0.0, 1.0, 0.5, 2.0], 2)), [0, 255, 128, 255]);
    }
}
