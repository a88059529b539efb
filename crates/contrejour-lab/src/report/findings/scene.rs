//! What the figures say about one scene.

use super::super::number::{percent, significant};
use super::super::{Contestant, CostRatio, Group};
use super::compare::{error, listed, with_errors};

/// An umbra that is wrong on less than this share of the receivers is not worth a sentence.
const UMBRA_WORTH_TELLING: f64 = 0.001;

/// A motion figure has to be this many times the plain shadow map's, or this part of it, to be worth a sentence.
const MOTION_WORTH_TELLING: f64 = 1.25;

pub(super) fn sentences(group: &Group) -> Vec<String> {
    [
        most_exact(group),
        fastest(group),
        front(group),
        less_exact_than_hard(group),
        umbra_too_large(group),
        more_exact_than_hard(group),
        beaten_by_peers(group),
        beats_peers(group),
        largest_jumps(group),
        mean_jumps(group),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn most_exact(group: &Group) -> Option<String> {
    let best = group.most_exact(|_| true)?;
    let time = best.ratio.as_ref().and_then(CostRatio::whole);
    let at = time.map_or(String::new(), |ratio| {
        format!(", in {} times the time of the plain shadow map", significant(ratio.median, 3))
    });
    let others = group.standing().filter(|other| other.family != best.family && !group.is_more_exact(best, other));
    let like = listed(others.map(|other| other.family.as_str()));
    let alike = if like.is_empty() {
        String::new()
    } else {
        format!("; {like} can't be told from it within the noise of the truth")
    };
    Some(format!("Most exact: {}, with an RMSE of {}{at}{alike}.", best.family, error(best.rmse())))
}

fn fastest(group: &Group) -> Option<String> {
    let time = |contestant: &&Contestant| contestant.cost.whole().median_ms;
    let best = group.standing().min_by(|a, b| time(a).total_cmp(&time(b)))?;
    let others = group.standing().filter(|other| other.family != best.family && !best.is_faster_than(other));
    let like = listed(others.map(|other| other.family.as_str()));
    let alike = if like.is_empty() { String::new() } else { format!("; within the spread of its frames: {like}") };
    Some(format!(
        "Fastest: {}, at {} ms and an RMSE of {}{alike}.",
        best.family,
        significant(best.cost.whole().median_ms, 3),
        error(best.rmse())
    ))
}

fn front(group: &Group) -> Option<String> {
    let mut families: Vec<(&str, usize)> = Vec::new();
    for contestant in group.contestants.iter().filter(|contestant| contestant.on_front) {
        match families.iter_mut().find(|(family, _)| *family == contestant.family) {
            Some((_, variants)) => *variants += 1,
            None => families.push((&contestant.family, 1)),
        }
    }
    let named = families.iter().map(|(family, variants)| match variants {
        1 => (*family).to_owned(),
        _ => format!("{family} ({variants} variants)"),
    });
    (!families.is_empty()).then(|| format!("Nothing measured is both faster and more exact than {}.", listed(named)))
}

fn ours(group: &Group) -> impl Iterator<Item = &Contestant> {
    group.standing().filter(|contestant| contestant.is_ours())
}

fn less_exact_than_hard(group: &Group) -> Option<String> {
    let hard = group.baseline()?;
    let worse: Vec<_> = ours(group).filter(|ours| group.is_more_exact(hard, ours)).collect();
    if worse.is_empty() {
        return None;
    }
    let peer = group.most_exact(Contestant::is_peer);
    let beside = peer.map_or(String::new(), |peer| format!("; {} has {}", peer.family, error(peer.rmse())));
    Some(format!(
        "By RMSE less exact than the plain hard shadow ({}): {}{beside}.",
        error(hard.rmse()),
        with_errors(&worse)
    ))
}

fn umbra_too_large(group: &Group) -> Option<String> {
    let is_too_large = |ours: &&Contestant| {
        let umbra = &ours.errors.umbra;
        umbra.too_large() >= UMBRA_WORTH_TELLING && umbra.too_large() > umbra.too_small()
    };
    let shares: Vec<String> = ours(group)
        .filter(is_too_large)
        .map(|ours| format!("{} ({})", percent(ours.errors.umbra.too_large()), ours.family))
        .collect();
    (!shares.is_empty()).then(|| {
        format!("The umbra, which smoothies never shrink, is too large on {} of the receivers.", listed(shares))
    })
}

fn more_exact_than_hard(group: &Group) -> Option<String> {
    let hard = group.baseline()?;
    let better: Vec<_> = ours(group).filter(|ours| group.is_more_exact(ours, hard)).collect();
    let at = error(hard.rmse());
    (!better.is_empty()).then(|| format!("More exact than the plain hard shadow ({at}): {}.", with_errors(&better)))
}

fn beaten_by_peers(group: &Group) -> Option<String> {
    let best = group.most_exact(Contestant::is_ours)?;
    let winners: Vec<_> = group.standing().filter(|peer| peer.is_peer() && group.beats(peer, best)).collect();
    (!winners.is_empty())
        .then(|| format!("Both more exact and faster than {}: {}.", with_errors(&[best]), with_errors(&winners)))
}

fn beats_peers(group: &Group) -> Option<String> {
    let beaten = |ours: &Contestant| -> Vec<&Contestant> {
        group.standing().filter(|peer| peer.is_peer() && group.beats(ours, peer)).collect()
    };
    let wins: Vec<String> = ours(group)
        .map(|ours| (ours, beaten(ours)))
        .filter(|(_, beaten)| !beaten.is_empty())
        .map(|(ours, beaten)| format!("{} than {}", with_errors(&[ours]), with_errors(&beaten)))
        .collect();
    (!wins.is_empty()).then(|| format!("Both more exact and faster: {}.", listed(wins)))
}

/// The largest jump of each family of ours beside that of the most exact peer.
fn largest_jumps(group: &Group) -> Option<String> {
    let largest = |contestant: &Contestant| {
        let motion = contestant.errors.motion.as_ref()?;
        Some(format!("{} ({})", error(motion.largest), contestant.family))
    };
    let told: Vec<String> = ours(group).filter_map(largest).collect();
    let peer = group.most_exact(|contestant| contestant.is_peer() && contestant.errors.motion.is_some());
    let beside =
        peer.and_then(largest).map_or(String::new(), |peer| format!("; with the most exact other soft shadow {peer}"));
    (!told.is_empty()).then(|| {
        format!(
            "While the light moves, visibility jumps beyond what the truth does by at most {}{beside}.",
            listed(told)
        )
    })
}

fn mean_jumps(group: &Group) -> Option<String> {
    let mean = |contestant: &Contestant| contestant.errors.motion.as_ref().map(|motion| motion.mean);
    let hard = group.baseline().and_then(mean).filter(|&mean| mean > 0.0)?;
    let is_told = |times: f64| times >= MOTION_WORTH_TELLING || times <= 1.0 / MOTION_WORTH_TELLING;
    let told: Vec<String> = ours(group)
        .filter_map(|ours| Some((ours, mean(ours)? / hard)))
        .filter(|&(_, times)| is_told(times))
        .map(|(ours, times)| format!("{} ({})", significant(times, 2), ours.family))
        .collect();
    (!told.is_empty()).then(|| {
        format!(
            "Averaged over all pixels and steps, these jumps are this many times the plain shadow map's: {}.",
            listed(told)
        )
    })
}
