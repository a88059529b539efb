//! What `contrejour plan` prints.

use core::fmt;

use super::{EntryPoints, FramePlan, Outputs, PipelinePlan};

impl fmt::Display for FramePlan {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let wanted = match self.outputs {
            Outputs::Silhouettes => "the list of silhouette edges",
            Outputs::Maps => "the maps",
            Outputs::VisibilityTexture => "the maps and a visibility texture",
        };
        writeln!(formatter, "wanted: {wanted}")?;
        writeln!(formatter, "technique: {}, {} texels", self.settings.technique, self.settings.map_size)?;
        let casting = self.casting.len();
        let face_blocks: u64 = self.pages.iter().map(|page| u64::from(page.counts.face_blocks)).sum();
        let edge_blocks: u64 = self.pages.iter().map(|page| u64::from(page.counts.edge_blocks)).sum();
        writeln!(formatter, "casting: {casting}; {face_blocks} blocks of faces, {edge_blocks} of edges at most")?;
        if self.pages.len() > 1 {
            writeln!(formatter, "pages: {}", self.pages.len())?;
        }
        if self.seats > 1 {
            writeln!(formatter, "tested together: up to {} views", self.seats)?;
        }

        let (stages, passes) = if self.is_drawn() { (&self.stages[..], &self.passes[..]) } else { (&[][..], &[][..]) };
        write_names(formatter, "stages", stages.iter().map(|stage| stage.name()))?;
        write_names(formatter, "passes", passes.iter().map(|pass| pass.name()))?;
        write_table(formatter, "pipelines", self.pipelines.iter().map(pipeline_row))?;
        let buffer_bytes: u64 = self.buffers.iter().map(|buffer| buffer.bytes).sum();
        let buffers = self.buffers.iter().map(|buffer| {
            [
                if self.pages.len() > 1 && buffer.kind.is_paged() {
                    format!("{}, page {}", buffer.kind.name(), buffer.page)
                } else {
                    buffer.kind.name().to_owned()
                },
                if buffer.seats > 1 {
                    format!("{} x {} x {} B", buffer.seats, buffer.items, buffer.kind.item_bytes())
                } else {
                    format!("{} x {} B", buffer.items, buffer.kind.item_bytes())
                },
                human(buffer.bytes),
            ]
        });
        write_table(formatter, &format!("buffers, {} together", human(buffer_bytes)), buffers)?;
        let texture_bytes: u64 = self.textures.iter().map(|texture| texture.bytes).sum();
        let textures = self.textures.iter().map(|texture| {
            let texels = format!("{0} x {0} {1}", texture.size, texture.format.name());
            let texels = if texture.levels > 1 { format!("{texels}, {} levels", texture.levels) } else { texels };
            [texture.kind.name().to_owned(), texels, human(texture.bytes)]
        });
        write_table(formatter, &format!("textures, {} together", human(texture_bytes)), textures)?;
        let left_out = self.left_out.iter().map(|left_out| [left_out.what.to_string(), left_out.reason.to_string()]);
        write_table(formatter, "left out", left_out)
    }
}

fn pipeline_row(pipeline: &PipelinePlan) -> [String; 3] {
    let constants: Vec<_> = pipeline.constants.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    let (runs, starts) = match pipeline.entry_points {
        EntryPoints::Compute(stage) => (stage.name(), stage.name().to_owned()),
        EntryPoints::Raster { pass, vertex, fragment } => match fragment {
            Some(fragment) => (pass.name(), format!("{vertex} + {fragment}")),
            None => (pass.name(), vertex.to_owned()),
        },
    };
    [runs.to_owned(), starts, constants.join(", ")]
}

fn write_names<'a>(
    formatter: &mut fmt::Formatter<'_>,
    title: &str,
    names: impl Iterator<Item = &'a str>,
) -> fmt::Result {
    write_table(formatter, title, names.map(|name| [name.to_owned()]))
}

/// A titled table with columns as wide as their widest cell.
fn write_table<const COLUMNS: usize>(
    formatter: &mut fmt::Formatter<'_>,
    title: &str,
    rows: impl Iterator<Item = [String; COLUMNS]>,
) -> fmt::Result {
    let rows: Vec<_> = rows.collect();
    writeln!(formatter, "\n{title}")?;
    if rows.is_empty() {
        writeln!(formatter, "  none")?;
    }
    let widths: [usize; COLUMNS] =
        core::array::from_fn(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0));
    for row in &rows {
        let cells: Vec<_> = row.iter().zip(widths).map(|(cell, width)| format!("{cell:width$}")).collect();
        writeln!(formatter, "  {}", cells.join("  ").trim_end())?;
    }
    Ok(())
}

/// A size with a unit that suits it.
fn human(bytes: u64) -> String {
    const UNITS: [&str; 4] = ["KiB", "MiB", "GiB", "TiB"];
    if bytes < 1024 {
        return format!("{bytes} B");
    }
    let mut size = bytes as f64 / 1024.0;
    let mut unit = 0;
    while size >= 1024.0 && unit + 1 < UNITS.len() {
        size /= 1024.0;
        unit += 1;
    }
    format!("{size:.1} {}", UNITS[unit])
}

#[cfg(test)]
mod tests {
    use super::human;

    #[test]
    fn sizes_are_readable() {
        assert_eq!(human(0), "0 B");
        assert_eq!(human(1023), "1023 B");
        assert_eq!(human(1536), "1.5 KiB");
        assert_eq!(human(128 << 20), "128.0 MiB");
        assert_eq!(human(u64::MAX), "16777216.0 TiB");
    }
}
