//! What each light has of its own: technique, map size, softness and colour.

use contrejour_plan::{ShadowSettings, Technique};

use super::options::{StressOptions, Variety};

/// A light's own, whatever place it has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Own {
    pub settings: ShadowSettings,
    /// How large it is over its common size.
    pub softness: f64,
    /// Linear colour; white is 1.
    pub color: [f32; 3],
}

/// Which of five lights have smoothies, whatever else there is: without them no silhouette would be looked for. Kinds of
/// lights take turns by six, so all kinds get some.
const SMOOTHIES_OF_FIVE: [bool; 5] = [true, false, true, false, true];

/// Texels along a side of maps.
const MAP_SIZES: [u32; 5] = [256, 384, 512, 768, 1024];

/// Sizes of lights over their common ones: from points on.
const SOFTNESSES: [f64; 5] = [0.0, 0.5, 1.0, 2.0, 4.0];

/// Linear colours around which those of lights are; they take turns.
const COLORS: [[f32; 3]; 4] = [[1.0, 0.88, 0.7], [0.68, 0.84, 1.0], [1.0, 0.72, 0.56], [0.84, 0.95, 0.78]];

/// How much less of a channel a colour may have than the one that it is around.
const SHADE: f32 = 0.2;

/// What the lights of a run have of their own, by its seed: the first ones have the same however many there are.
pub(super) fn of_lights(options: &StressOptions) -> Vec<Own> {
    let mut random = fastrand::Rng::with_seed(options.seed ^ 0x0011_6875);
    let mut others: Vec<&str> = Technique::NAMES.into_iter().filter(|name| *name != "smoothies").collect();
    random.shuffle(&mut others);
    let mut others = others.into_iter().cycle();
    let base = options.settings;
    let mut own = |index: usize| {
        let has_smoothies = SMOOTHIES_OF_FIVE[index % SMOOTHIES_OF_FIVE.len()];
        let name = if has_smoothies { "smoothies" } else { others.next().unwrap_or("smoothies") };
        let [map_size, softness] = [MAP_SIZES.len(), SOFTNESSES.len()].map(|count| random.usize(..count));
        let color = COLORS[index % COLORS.len()].map(|channel| channel * (1.0 - SHADE * random.f32()));
        Own {
            settings: ShadowSettings {
                technique: match options.techniques {
                    Variety::Same => base.technique,
                    Variety::Own => name.parse().unwrap_or(base.technique),
                },
                map_size: if options.map_sizes == Variety::Own { MAP_SIZES[map_size] } else { base.map_size },
                ..base
            },
            softness: if options.softness == Variety::Own { SOFTNESSES[softness] } else { 1.0 },
            color,
        }
    };
    (0..options.lights).map(&mut own).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    fn options(variety: Variety) -> StressOptions {
        StressOptions { lights: 40, techniques: variety, map_sizes: variety, softness: variety, ..Default::default() }
    }

    #[test]
    fn own_is_own_and_follows_from_the_seed() {
        let lights = of_lights(&options(Variety::Own));
        let techniques: BTreeSet<_> = lights.iter().map(|own| own.settings.technique.name()).collect();
        assert_eq!(techniques, Technique::NAMES.into_iter().collect());
        let smoothies = lights.iter().filter(|own| own.settings.technique.name() == "smoothies").count();
        assert_eq!(smoothies, 24);
        let sizes: BTreeSet<_> = lights.iter().map(|own| own.settings.map_size).collect();
        assert_eq!(sizes, MAP_SIZES.into_iter().collect());
        assert!(lights.iter().all(|own| own.settings.validate().is_ok()));
        assert!(lights.iter().any(|own| own.softness == 0.0) && lights.iter().any(|own| own.softness == 4.0));
        assert_eq!(of_lights(&StressOptions { lights: 7, ..options(Variety::Own) }), lights[..7]);
        assert_ne!(of_lights(&StressOptions { seed: 2, ..options(Variety::Own) }), lights);
    }

    #[test]
    fn the_same_is_what_the_options_say() {
        let options = options(Variety::Same);
        let lights = of_lights(&options);
        assert!(lights.iter().all(|own| own.settings == options.settings && own.softness == 1.0));
    }
}
