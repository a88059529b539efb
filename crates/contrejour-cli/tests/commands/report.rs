//! `contrejour report`: resume, shards, merge, and that two runs find the same.

use contrejour_lab::report::{Disagreement, Group, Report};
use libtest_mimic::Trial;

use crate::program::Folder;
use crate::{Outcome, cpu_trial, gpu_trial};

/// As little as a report can be.
const TINY: &str = "report --quick --picture-size 64x48 --scenes square,boxes --sizes 32,48 \
                    --techniques shadow-map,pcf,smoothies-0.08";

pub fn trials() -> Vec<Trial> {
    vec![
        cpu_trial("report::what_cannot_be_measured_is_refused", nonsense_is_refused),
        gpu_trial("report::nothing_is_begun_that_cannot_end", what_cannot_end_is_not_begun),
        gpu_trial("report::a_shard_says_that_it_is_a_part", a_shard_says_so),
        gpu_trial("report::shards_merge_into_what_one_run_finds", shards_merge),
        gpu_trial("report::goes_on_and_refuses_another_seed", goes_on),
        gpu_trial("report::cascades_are_measured", cascades_are_measured),
        gpu_trial("report::redoes_the_figures_of_the_papers", figures_are_made),
    ]
}

fn nonsense_is_refused() -> Outcome {
    let folder = Folder::new();
    for (arguments, expected) in [
        ("report --scenes nothing -o out", "nothing"),
        ("report --merge missing -o out", "holds no run"),
        ("report --shard 3/2 -o out", "no shard"),
    ] {
        let refusal = folder.run(arguments).refusal()?;
        if !refusal.contains(expected) {
            return Err(format!("{arguments}: {refusal}"));
        }
    }
    Ok(())
}

/// A size or scene that can't be measured is refused before anything is written, so that the mended command can go.
fn what_cannot_end_is_not_begun() -> Outcome {
    let dark = "size = [64, 48]\n[camera]\neye = [3, 2, 5]\ntarget = [0, 0, 0]\n\
                [light]\nkind = \"spot\"\nposition = [0, 4, 0]\ntarget = [0, 0, 0]\n\
                [[mesh]]\nshape = { kind = \"box\" }\nreceives = false\n";
    let folder = Folder::with(&[("dark.toml", dark)]);
    for (arguments, expected) in [
        ("--scenes square --sizes 32,99999999", "99999999"),
        ("--scenes square,dark.toml --sizes 32", "nothing to compare"),
    ] {
        let refusal = folder.run(&format!("report --quick --picture-size 64x48 {arguments} -o out")).refusal()?;
        if !refusal.contains(expected) || folder.names() != ["dark.toml"] {
            return Err(format!("{arguments}: {refusal}; left are {:?}", folder.names()));
        }
    }
    Ok(())
}

/// The page of a part says which part it is, also of one that has nothing.
fn a_shard_says_so() -> Outcome {
    let folder = Folder::new();
    let tiny = "report --quick --picture-size 64x48 --scenes square --sizes 32,48 --techniques shadow-map";
    for (shard, expected) in [("2/2", "shard 2/2: 1 of 2 groups measured"), ("3/9", "shard 3/9: 0 of 2 groups")] {
        folder.run(&format!("{tiny} --shard {shard} -o {}", &shard[..1])).stdout()?;
        if !folder.read(&format!("{}/index.html", &shard[..1]))?.contains(expected) {
            return Err(format!("the page of shard {shard} should say {expected:?}"));
        }
    }
    Ok(())
}

/// Two shards make the whole run's error figures to the last digit, and another seed does not.
fn shards_merge() -> Outcome {
    let folder = Folder::new();
    let page = folder.run(&format!("{TINY} -o whole")).stdout()?;
    if page.lines().last() != Some("whole/index.html") {
        return Err(format!("the page's path should come last: {page}"));
    }
    for number in [1, 2] {
        folder.run(&format!("{TINY} --shard {number}/2 -o part{number}")).stdout()?;
    }
    let refusal = folder.run("report --merge part1 -o merged").refusal()?;
    if !refusal.contains("shard 2/2 is missing") {
        return Err(refusal);
    }
    let told = folder.run("report --merge part2 part1 -o merged --json").json()?;
    if told["page"] != "merged/index.html" || told["groups"] != 4 {
        return Err(told.to_string());
    }
    let [whole, merged] = [read(&folder, "whole")?, read(&folder, "merged")?];
    differences(&whole, &merged)?;
    if merged.header.shard.is_some() || folder.read("merged/index.html")?.contains("groups measured") {
        return Err("the merged page is no part".into());
    }
    if !folder.read("merged/index.html")?.contains("data:image/png") {
        return Err("the merged page should hold pictures".into());
    }

    folder.run(&format!("{TINY} --seed 2 -o seeded")).stdout()?;
    match differences(&whole, &read(&folder, "seeded")?) {
        Ok(()) => Err("another seed should give other figures".into()),
        Err(_) => Ok(()),
    }
}

/// The same arguments measure nothing again; others are refused, or start all over.
fn goes_on() -> Outcome {
    let folder = Folder::new();
    let tiny = "report --quick --picture-size 64x48 --scenes square --techniques shadow-map,pcf -o out";
    folder.run(&format!("{tiny} --sizes 32,48")).stdout()?;
    let first = read(&folder, "out")?;
    std::fs::remove_file(folder.path("out/groups/square-48.json")).map_err(|error| error.to_string())?;
    folder.run(&format!("{tiny} --sizes 32,48")).stdout()?;
    let second = read(&folder, "out")?;
    if first.groups[0] != second.groups[0] {
        return Err("a kept group should not be measured again".into());
    }
    differences(&first, &second)?;
    std::fs::remove_dir_all(folder.path("out/pictures")).map_err(|error| error.to_string())?;
    folder.run(&format!("{tiny} --sizes 32,48")).stdout()?;
    differences(&first, &read(&folder, "out")?)?;
    let refusal = folder.run(&format!("{tiny} --sizes 32,48 --seed 9")).refusal()?;
    if !(refusal.contains("another seed") && refusal.contains("--restart")) {
        return Err(refusal);
    }
    let again = folder.run(&format!("{tiny} --sizes 32 --seed 9 --restart --json")).json()?;
    if again["groups"] == 1 { Ok(()) } else { Err(again.to_string()) }
}

/// Cascades follow the scene's camera: finer maps have smaller errors, and maps without texels to move by are refused first.
fn cascades_are_measured() -> Outcome {
    let scene = "[camera]\neye = [3, 2, 5]\ntarget = [0, 0, 0]\nfar = 30\n\
                 [light]\nkind = \"directional\"\ntowards_light = [1, 2, 1]\ncascades = 3\n\
                 [[mesh]]\nshape = { kind = \"box\", size = [12, 0.2, 12] }\ntranslate = [0, -1, 0]\n\
                 [[mesh]]\nshape = { kind = \"torus\" }\n";
    let folder = Folder::with(&[("cascaded.toml", scene)]);
    let tiny = "report --quick --picture-size 64x48 --scenes cascaded.toml --techniques pcf,smoothies-by-light-size";
    let refusal = folder.run(&format!("{tiny} --sizes 64,2 -o out")).refusal()?;
    if !refusal.contains("at least 4 texels") || folder.names() != ["cascaded.toml"] {
        return Err(format!("{refusal}; left are {:?}", folder.names()));
    }
    folder.run(&format!("{tiny} --sizes 16,256 -o out")).stdout()?;
    let report = read(&folder, "out")?;
    let of_group =
        |group: &Group| group.contestants.iter().map(|contestant| contestant.errors.receivers.rmse).collect();
    let errors: Vec<Vec<f64>> = report.groups.iter().map(of_group).collect();
    match &errors[..] {
        [coarse, fine] if coarse.len() > 1 && coarse.iter().zip(fine).all(|(coarse, fine)| fine < coarse) => Ok(()),
        _ => Err(format!("the errors are {errors:?}")),
    }
}

/// Every figure is made once and is on the page; a report of chosen techniques has none.
fn figures_are_made() -> Outcome {
    let folder = Folder::new();
    let tiny = "report --quick --picture-size 64x48 --scenes square --sizes 32";
    let told = folder.run(&format!("{tiny} -o out --json")).json()?;
    if told["figures"] != 15 {
        return Err(told.to_string());
    }
    let page = folder.read("out/index.html")?;
    if let Some(figure) = read(&folder, "out")?.figures.iter().find(|figure| !page.contains(&figure.title)) {
        return Err(format!("the page lacks {}", figure.title));
    }
    let told = folder.run(&format!("{tiny} --techniques shadow-map -o chosen --json")).json()?;
    if told["figures"] == 0 { Ok(()) } else { Err(told.to_string()) }
}

fn read(folder: &Folder, name: &str) -> Result<Report, String> {
    Report::read(&folder.path(name)).map_err(|error| error.to_string())
}

/// What two reports do not agree on, times left aside: so few frames on a busy machine say nothing about them.
fn differences(one: &Report, other: &Report) -> Outcome {
    let is_error = |found: &Disagreement| !matches!(found, Disagreement::Ratio { .. });
    match one.disagreements(other).into_iter().find(is_error) {
        Some(found) => Err(found.to_string()),
        None => Ok(()),
    }
}
