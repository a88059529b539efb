//! Reports as one table: a row a contestant, a column a figure.

use super::{Contestant, Group, Header, Report};
use crate::metrics::{ErrorFigures, Ratio, Timing};

/// A column's name and a cell.
type Cell = (String, String);

impl Report {
    /// Everything that was measured as comma-separated values with a head. A figure that was not measured is an empty
    /// cell; a stage that only some techniques have is a column of its own.
    ///
    /// # Errors
    ///
    /// None that a report can cause: writing to memory is all that happens.
    pub fn to_csv(&self) -> Result<Vec<u8>, csv::Error> {
        let rows: Vec<Vec<Cell>> = self
            .groups
            .iter()
            .flat_map(|group| group.contestants.iter().map(|contestant| row(&self.header, group, contestant)))
            .collect();
        let mut columns: Vec<&str> = Vec::new();
        for (column, _) in rows.iter().flatten() {
            if !columns.contains(&column.as_str()) {
                columns.push(column);
            }
        }
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&columns)?;
        for row in &rows {
            let cell =
                |name: &&str| row.iter().find(|(column, _)| column == name).map_or("", |(_, cell)| cell.as_str());
            writer.write_record(columns.iter().map(cell))?;
        }
        writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))
    }
}

fn row(header: &Header, group: &Group, contestant: &Contestant) -> Vec<Cell> {
    let mut row = Row(Vec::new());
    row.group(group);
    row.contestant(contestant);
    row.errors(contestant);
    row.cost(contestant);
    row.header(header);
    row.stages(contestant);
    row.0
}

/// A row that is being filled.
struct Row(Vec<Cell>);

impl Row {
    fn put(&mut self, column: &str, value: impl ToString) {
        self.0.push((column.to_owned(), value.to_string()));
    }

    fn put_some(&mut self, column: &str, value: Option<impl ToString>) {
        self.put(column, value.map_or_else(String::new, |value| value.to_string()));
    }

    fn group(&mut self, group: &Group) {
        self.put("scene", &group.scene);
        self.put("map_size", group.map_size);
        self.put("faces", group.faces);
        self.put("edges", group.edges);
        self.put("light_size", group.light_size);
        self.put("device", &group.machine.device);
        self.put("device_is_software", group.machine.is_software);
        self.put("cores", group.machine.cores);
        self.put("truth_samples_mean", group.truth.samples_mean);
        self.put("truth_standard_error_rms", group.truth.standard_error_rms);
        self.put("truth_standard_error_max", group.truth.standard_error_max);
    }

    fn contestant(&mut self, contestant: &Contestant) {
        let parameters =
            contestant.parameters.iter().map(|parameter| format!("{}={}", parameter.name, parameter.value));
        self.put("label", &contestant.label);
        self.put("family", &contestant.family);
        self.put("technique", &contestant.technique);
        self.put("parameters", parameters.collect::<Vec<_>>().join("; "));
        self.put("stands", contestant.stands);
        self.put("on_front", contestant.on_front);
    }

    fn errors(&mut self, contestant: &Contestant) {
        let errors = &contestant.errors;
        self.figures("", Some(&errors.receivers));
        self.figures("penumbra_", errors.penumbra.as_ref());
        self.put("umbra_too_large_pixels", errors.umbra.too_large_pixels);
        self.put("umbra_too_large", errors.umbra.too_large());
        self.put("umbra_too_small_pixels", errors.umbra.too_small_pixels);
        self.put("umbra_too_small", errors.umbra.too_small());
        self.put_some("flip", errors.flip);
        let motion = errors.motion.as_ref();
        self.put_some("motion_steps", motion.map(|motion| motion.steps));
        self.put_some("motion_mean", motion.map(|motion| motion.mean));
        self.put_some("motion_percentile_99", motion.map(|motion| motion.percentile_99));
        self.put_some("motion_largest", motion.map(|motion| motion.largest));
    }

    fn figures(&mut self, of: &str, figures: Option<&ErrorFigures>) {
        self.put_some(&format!("{of}pixels"), figures.map(|figures| figures.pixels));
        self.put_some(&format!("{of}rmse"), figures.map(|figures| figures.rmse));
        self.put_some(&format!("{of}mean_absolute"), figures.map(|figures| figures.mean_absolute));
        self.put_some(&format!("{of}percentile_99"), figures.map(|figures| figures.percentile_99));
    }

    fn cost(&mut self, contestant: &Contestant) {
        let (cost, ratio) = (&contestant.cost, contestant.ratio.as_ref());
        self.timing("device", cost.device.as_ref(), ratio.and_then(|ratio| ratio.device));
        self.timing("wall", Some(&cost.wall), ratio.and_then(|ratio| ratio.wall));
        self.timing("record", Some(&cost.record), ratio.and_then(|ratio| ratio.record));
        self.put("map_bytes", cost.map_bytes);
        self.put_some("map_bytes_ratio", ratio.and_then(|ratio| ratio.maps));
        self.put("buffer_bytes", cost.buffer_bytes);
        self.put_some("buffer_bytes_ratio", ratio.and_then(|ratio| ratio.buffers));
    }

    fn stages(&mut self, contestant: &Contestant) {
        let mut ratios = contestant.ratio.iter().flat_map(|ratio| &ratio.stages).map(|stage| stage.ratio);
        for stage in &contestant.cost.stages {
            self.timing(&stage.name, Some(&stage.timing), ratios.next().flatten());
        }
    }

    fn timing(&mut self, of: &str, timing: Option<&Timing>, ratio: Option<Ratio>) {
        self.put_some(&format!("{of}_median_ms"), timing.map(|timing| timing.median_ms));
        self.put_some(&format!("{of}_low_ms"), timing.map(|timing| timing.low_ms));
        self.put_some(&format!("{of}_high_ms"), timing.map(|timing| timing.high_ms));
        self.put_some(&format!("{of}_frames"), timing.map(|timing| timing.frames));
        self.put_some(&format!("{of}_ratio"), ratio.map(|ratio| ratio.median));
        self.put_some(&format!("{of}_ratio_low"), ratio.map(|ratio| ratio.low));
        self.put_some(&format!("{of}_ratio_high"), ratio.map(|ratio| ratio.high));
    }

    fn header(&mut self, header: &Header) {
        let [width, height] = header.picture_size;
        self.put("command", &header.command);
        self.put("version", &header.version);
        self.put("seed", header.seed);
        self.put("picture_width", width);
        self.put("picture_height", height);
    }
}

#[cfg(test)]
mod tests {
    use super::super::{StageCost, sample};

    #[test]
    fn every_contestant_is_a_row_and_every_stage_a_column() {
        let mut smoothies = sample::contestant("smoothies, \"wide\", 2", "smoothies", "smoothies", 0.14, 3.0);
        let timing = smoothies.cost.stages[0].timing;
        smoothies.cost.stages.push(StageCost { name: "smoothie_buffer".into(), timing });
        smoothies.errors.flip = None;
        let plain = sample::contestant("plain", "plain", "shadow-map", 0.1 + 0.2, 2.0);
        let report = sample::report(vec![
            sample::group("square", 512, vec![plain.clone(), smoothies]),
            sample::group("square", 1024, vec![plain]),
        ]);

        let text = report.to_csv().expect("memory can be written to");
        let mut reader = csv::Reader::from_reader(text.as_slice());
        let head = reader.headers().expect("there is a head").clone();
        let rows: Vec<_> = reader.records().map(|row| row.expect("all rows are as long as the head")).collect();
        let cell = |row: usize, name: &str| {
            let column = head.iter().position(|column| column == name).expect("the column is there");
            rows[row][column].to_owned()
        };
        assert_eq!(rows.len(), 3);
        assert_eq!([0, 1, 2].map(|row| cell(row, "map_size")), ["512", "512", "1024"]);
        assert_eq!(cell(1, "label"), "smoothies, \"wide\", 2");
        assert_eq!(cell(0, "rmse"), "0.30000000000000004");
        assert_eq!([cell(0, "flip").is_empty(), cell(1, "flip").is_empty()], [false, true]);
        assert_eq!(cell(1, "wall_ratio"), "1.5");
        let stage = "smoothie_buffer_median_ms";
        assert_eq!([cell(0, stage).is_empty(), cell(1, stage).is_empty()], [true, false]);
    }
}
