//! What the figures say about all scenes together.

use super::super::number::significant;
use super::super::{Contestant, Group};
use super::compare::listed;

pub(super) fn sentences(groups: &[&Group]) -> Vec<String> {
    [against_hard(groups), against_peers(groups), times(groups), software(groups), sizes(groups)]
        .into_iter()
        .flatten()
        .collect()
}

/// The scenes where our most exact family and another contestant can be compared.
fn compared<'a>(
    groups: &[&'a Group],
    with: impl Fn(&'a Group) -> Option<&'a Contestant>,
) -> Vec<(&'a Group, &'a Contestant, &'a Contestant)> {
    let compared =
        groups.iter().filter_map(|&group| Some((group, group.most_exact(Contestant::is_ours)?, with(group)?)));
    compared.collect()
}

fn against_hard(groups: &[&Group]) -> Option<String> {
    verdict("the plain hard shadow", &compared(groups, Group::baseline))
}

fn against_peers(groups: &[&Group]) -> Option<String> {
    verdict(
        "the most exact of the other soft shadows",
        &compared(groups, |group| group.most_exact(Contestant::is_peer)),
    )
}

/// On which scenes our most exact family is better or worse than the other.
fn verdict(other: &str, compared: &[(&Group, &Contestant, &Contestant)]) -> Option<String> {
    let scenes = |is: &dyn Fn(&Group, &Contestant, &Contestant) -> bool| {
        let named: Vec<&str> = compared
            .iter()
            .filter(|(group, ours, other)| is(group, ours, other))
            .map(|(group, ..)| group.scene.as_str())
            .collect();
        (named.len(), listed(named))
    };
    let (better, better_named) = scenes(&|group, ours, other| group.is_more_exact(ours, other));
    let (worse, worse_named) = scenes(&|group, ours, other| group.is_more_exact(other, ours));
    let all = compared.len();
    let place = |count: usize, named: &str| {
        if count == all { place_all(all) } else { format!("on {count} of {all} scenes ({named})") }
    };
    let parts: Vec<String> = [("more exact", better, better_named), ("less exact", worse, worse_named)]
        .into_iter()
        .filter(|(_, count, _)| *count > 0)
        .map(|(how, count, named)| format!("{how} than {other} {}", place(count, &named)))
        .collect();
    let verdict =
        if parts.is_empty() { format!("as exact as {other} {}", place_all(all)) } else { parts.join(", and ") };
    (all > 0).then(|| format!("The most exact smoothies are {verdict}."))
}

fn place_all(scenes: usize) -> String {
    if scenes == 1 { "on the one scene measured".to_owned() } else { format!("on all {scenes} scenes") }
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
