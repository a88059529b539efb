//! Strips of pictures: the truth, each technique, and where they differ.

use std::path::Path;

use maud::{Markup, html};

use super::super::embed::{EmbedError, embed};
use super::super::number::significant;
use super::super::{Contestant, Group, Report, difference_colour};

/// Half of the steps of the key of colours.
const KEY_STEPS: i8 = 8;

pub(super) fn strips(report: &Report, folder: &Path) -> Result<Markup, EmbedError> {
    let has_picture = |group: &&Group| group.truth_picture.is_some() || group.standing().any(is_shown);
    let headlines = report.scenes().into_iter().filter_map(|scene| report.headline_of(scene));
    let strips: Vec<Markup> =
        headlines.filter(has_picture).map(|group| strip(group, folder)).collect::<Result<_, EmbedError>>()?;
    Ok(html! {
        @if !strips.is_empty() {
            p.lead {
                "Visibility alone, black to white, and below it the difference from the truth: blue is too dark, "
                "orange is too light, light grey is right. Small differences are strengthened (the colour follows the "
                "root)."
            }
            (key())
            @for strip in &strips { (strip) }
        }
    })
}

fn is_shown(contestant: &Contestant) -> bool {
    contestant.picture.is_some() || contestant.difference.is_some()
}

fn strip(group: &Group, folder: &Path) -> Result<Markup, EmbedError> {
    let truth = match &group.truth_picture {
        Some(path) => Some(image(folder, path, &format!("Visibility in truth, {}", group.scene))?),
        None => None,
    };
    let mut tiles = Vec::new();
    for contestant in group.standing().filter(|contestant| is_shown(contestant)) {
        tiles.push(tile(contestant, &group.scene, folder)?);
    }
    Ok(html! {
        h3 { (group.scene) " " small { (group.map_size) " texels" } }
        div.strip {
            @if let Some(truth) = truth {
                figure.truth { (truth) figcaption { strong { "truth" } " ray-traced" } }
            }
            @for tile in &tiles { (tile) }
        }
    })
}

fn tile(contestant: &Contestant, scene: &str, folder: &Path) -> Result<Markup, EmbedError> {
    let named = |what: &str, path: &Option<String>| match path {
        Some(path) => image(folder, path, &format!("{what} {}, {scene}", contestant.family)).map(Some),
        None => Ok(None),
    };
    let picture = named("Visibility by", &contestant.picture)?;
    let difference = named("Difference from the truth of", &contestant.difference)?;
    Ok(html! {
        figure {
            @if let Some(picture) = picture { (picture) }
            @if let Some(difference) = difference { (difference) }
            figcaption { strong { (contestant.family) } " RMSE " (significant(contestant.errors.receivers.rmse, 3)) }
        }
    })
}

/// A picture file inside the page.
pub(super) fn image(folder: &Path, path: &str, alt: &str) -> Result<Markup, EmbedError> {
    let picture = embed(folder, path)?;
    Ok(html! { img src=(picture.data_uri) width=(picture.width) height=(picture.height) alt=(alt) loading="lazy"; })
}

/// The key of the difference's colours, evenly in the difference.
fn key() -> Markup {
    let colours = (-KEY_STEPS..=KEY_STEPS).map(|step| {
        let [r, g, b] = difference_colour(f32::from(step) / f32::from(KEY_STEPS));
        format!("background:rgb({r} {g} {b})")
    });
    html! {
        div.key role="img" aria-label="From blue (too dark by 1) by light grey (equal) to orange (too light by 1)" {
            span { "too dark by 1" }
            span.colours { @for colour in colours { i style=(colour) {} } }
            span { "too light by 1" }
        }
    }
}
