//! What the figures say about all scenes together.

use super::super::number::significant;
use super::super::{Contestant, Group};
use super::compare::{error, listed};

pub(super) fn sentences(groups: &[&Group]) -> Vec<String> {
    let others = [times(groups), software(groups), sizes(groups)];
    exactness(groups).into_iter().chain(others.into_iter().flatten()).collect()
}

/// How each family of ours stands to the plain hard shadow and to the most exact peer; who loses most comes first.
fn exactness(groups: &[&Group]) -> Vec<String> {
    let mut families: Vec<&str> = Vec::new();
    for ours in groups.iter().flat_map(|group| group.standing()).filter(|ours| ours.is_ours()) {
        if !families.contains(&ours.family.as_str()) {
            families.push(&ours.family);
        }
    }
    let mut verdicts: Vec<(usize, String)> = Vec::new();
    for family in families {
        let hard = verdict(groups, family, "the plain hard shadow", Group::baseline);
        let peer =
            verdict(groups, family, "the most exact other soft shadow", |group| group.most_exact(Contestant::is_peer));
        let losses = [&hard, &peer].into_iter().flatten().map(|(losses, _)| losses).sum();
        let said = [hard, peer].into_iter().flatten().map(|(_, verdict)| verdict).collect::<Vec<_>>().join("; ");
        if !said.is_empty() {
            verdicts.push((losses, format!("{} are {said}.", capitalised(family))));
        }
    }
    verdicts.sort_by_key(|(losses, _)| std::cmp::Reverse(*losses));
    verdicts.into_iter().map(|(_, verdict)| verdict).collect()
}

/// On which scenes a family is less and more exact than another contestant, and on how many it is less.
fn verdict<'a>(
    groups: &[&'a Group],
    family: &str,
    other: &str,
    with: impl Fn(&'a Group) -> Option<&'a Contestant>,
) -> Option<(usize, String)> {
    let [mut less, mut alike, mut more] = [const { Vec::new() }; 3];
    for &group in groups {
        let Some((ours, other)) = group.standing_for(family).zip(with(group)) else { continue };
        let place = format!("{} (RMSE {} against {})", group.scene, error(ours.rmse()), error(other.rmse()));
        if group.is_more_exact(other, ours) {
            less.push(place);
        } else if group.is_more_exact(ours, other) {
            more.push(place);
        } else {
            alike.push(place);
        }
    }
    let losses = less.len();
    let parts: Vec<String> = [("less exact than", less), ("as exact as", alike), ("more exact than", more)]
        .into_iter()
        .filter(|(_, places)| !places.is_empty())
        .map(|(how, places)| format!("{how} {other} on {}", listed(places)))
        .collect();
    (!parts.is_empty()).then(|| (losses, parts.join(", and ")))
}

fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// The range of times of smoothies and of the most exact other soft shadow, as ratios to the plain shadow map.
fn times(groups: &[&Group]) -> Option<String> {
    let ratio = |contestant: &Contestant| Some(contestant.ratio.as_ref()?.whole()?.median);
    let ours = groups.iter().flat_map(|group| group.standing().filter(|ours| ours.is_ours())).filter_map(ratio);
    let peers = groups.iter().filter_map(|group| group.most_exact(Contestant::is_peer)).filter_map(ratio);
    let ours = range(ours)?;
    let beside = range(peers).map_or(String::new(), |peers| format!(", the most exact other soft shadow {peers}"));
    Some(format!("Smoothies take {ours} times as long as the plain shadow map{beside}."))
}

/// `1.2 to 1.9`, or one number where both are written alike.
fn range(values: impl Iterator<Item = f64>) -> Option<String> {
    let values: Vec<f64> = values.collect();
    let least = values.iter().copied().min_by(f64::total_cmp)?;
    let most = values.iter().copied().max_by(f64::total_cmp)?;
    let [least, most] = [least, most].map(|value| significant(value, 2));
    Some(if least == most { least } else { format!("{least} to {most}") })
}

fn software(groups: &[&Group]) -> Option<String> {
    let software: Vec<&str> =
        groups.iter().filter(|group| group.machine.is_software).map(|group| group.scene.as_str()).collect();
    let place = if software.len() == groups.len() { "All" } else { "Some" };
    (!software.is_empty()).then(|| {
        format!(
            "{place} of these times come from a device in software: they rank the work, and do not say what a GPU \
             takes."
        )
    })
}

fn sizes(groups: &[&Group]) -> Option<String> {
    let first = groups.first()?;
    let sizes = if groups.iter().all(|group| group.map_size == first.map_size) {
        format!("maps of {} texels a side", first.map_size)
    } else {
        "the map size nearest to 1024 texels a side".to_owned()
    };
    Some(format!(
        "This text speaks of {sizes}, and of each family's most exact variant; the tables below hold the others."
    ))
}
