//! The table of times of Chan and Durand (2003), as ratios beside theirs.

use super::super::error::RunError;
use super::super::lab::Lab;
use super::super::subject::{NamedScene, Subject};
use super::methods::{BICUBIC, Method, SHADOW_MAP, THICK, THIN};
use super::sight::built_in;
use super::turns::turns;
use crate::metrics::{Ratio, Timing};
use crate::report::{Body, Figure, Table};

/// In the order of the paper's columns.
const METHODS: [Method; 4] = [SHADOW_MAP, BICUBIC, THIN, THICK];

/// Texels along the map's side, and the paper's times of the methods. Unit: milliseconds.
const TIMES_OF_2003: [(u32, [f64; 4]); 2] = [(256, [16.0, 129.0, 19.0, 19.0]), (1024, [17.0, 142.0, 22.0, 24.0])];

pub(super) fn make(lab: &Lab) -> Result<Figure, RunError> {
    let named = NamedScene { name: "cylinder".to_owned(), scene: built_in("cylinder")? };
    let subject = Subject::new(lab.gpu, &named, lab.options.effort.picture_size)?;
    let mut rows = Vec::new();
    let mut largest = None;
    for (map_size, theirs) in TIMES_OF_2003 {
        let costs = turns(lab, &subject, &METHODS, map_size, &lab.options.effort)?;
        let ours = [0, 1, 2, 3].map(|method| *costs[method].whole());
        rows.extend(rows_of(map_size, theirs, ours));
        largest = Some((map_size, theirs, ours));
    }
    let clock = if lab.gpu.is_software() { "the clock on the wall, around a submission" } else { "device timestamps" };
    let caption = format!(
        "The cylinder on a plane, after the table of times of Chan and Durand (2003). Their time is that of a whole \
         picture; ours, by {clock}, is that of the shadow work and of asking all receivers, so the ratios of the \
         methods can be compared and the milliseconds cannot. Ratios are to the shadow map of the same size; the \
         range holds the 5th to the 95th percentile of both times. {}",
        largest.map_or_else(String::new, |(map_size, theirs, ours)| told(map_size, theirs, ours)),
    );
    let columns = ["map, method", "2003, ms", "2003, ratio", "here, ms", "here, ratio", "range"];
    let table = Table { columns: columns.map(str::to_owned).to_vec(), rows };
    Ok(Figure { title: "Time of the methods, 2003 and here".to_owned(), caption, body: Body::Table(table) })
}

fn rows_of(map_size: u32, theirs: [f64; 4], ours: [Timing; 4]) -> Vec<Vec<String>> {
    let row = |method: usize| {
        let ratio = ours[method].over(&ours[0]);
        let [median, range] = match ratio {
            Some(Ratio { median, low, high }) => [format!("{median:.2}"), format!("{low:.2} to {high:.2}")],
            None => ["too short".to_owned(), String::new()],
        };
        vec![
            format!("{map_size}, {}", METHODS[method].label),
            format!("{:.0}", theirs[method]),
            format!("{:.2}", ratios(theirs)[method]),
            format!("{:.3}", ours[method].median_ms),
            median,
            range,
        ]
    };
    (0..METHODS.len()).map(row).collect()
}

/// Times as multiples of the first.
fn ratios(times: [f64; 4]) -> [f64; 4] {
    times.map(|time| time / times[0])
}

/// Which method is how much dearer than the shadow map, then and now.
fn told(map_size: u32, theirs: [f64; 4], ours: [Timing; 4]) -> String {
    if ours[0].median_ms <= 0.0 {
        return "Here the shadow map is too fast for the clock.".to_owned();
    }
    let [then, now] = [ratios(theirs), ratios(ours.map(|timing| timing.median_ms))];
    let order = if now[1] > now[3] { "still the dearer of the two" } else { "now the cheaper of the two" };
    format!(
        "At {map_size} texels the bicubic filter took {:.1} times as long as the shadow map in 2003 and takes {:.1} \
         times as long here, thick smoothies {:.1} times and {:.1} times; so the filter is {order}.",
        then[1], now[1], then[3], now[3],
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn timings(medians: [f64; 4]) -> [Timing; 4] {
        medians.map(|median_ms| Timing { median_ms, low_ms: 0.5 * median_ms, high_ms: 2.0 * median_ms, frames: 9 })
    }

    #[test]
    fn the_paper_is_told_in_ratios() {
        let rounded = TIMES_OF_2003.map(|(_, times)| ratios(times).map(|ratio| (100.0 * ratio).round() / 100.0));
        assert_eq!(rounded, [[1.0, 8.06, 1.19, 1.19], [1.0, 8.35, 1.29, 1.41]]);
    }

    #[test]
    fn a_row_holds_both_years() {
        let rows = rows_of(256, TIMES_OF_2003[0].1, timings([2.0, 3.0, 4.0, 5.0]));
        assert_eq!(rows[1], ["256, bicubic filter", "129", "8.06", "3.000", "1.50", "0.38 to 6.00"]);
        assert_eq!(rows_of(256, TIMES_OF_2003[0].1, timings([0.0; 4]))[1][4], "too short");
    }

    #[test]
    fn what_is_told_follows_the_times() {
        let told = |medians| told(1024, TIMES_OF_2003[1].1, timings(medians));
        assert!(told([2.0, 3.0, 4.0, 5.0]).ends_with(
            "takes 1.5 times as long here, thick smoothies 1.4 times and \
            2.5 times; so the filter is now the cheaper of the two."
        ));
        assert!(told([2.0, 9.0, 4.0, 5.0]).contains("still the dearer"));
        assert!(told([0.0; 4]).contains("too fast"));
    }
}
