//! The report as a table for people.

use std::fmt;

use super::report::{Findings, TopologyReport};

impl fmt::Display for TopologyReport {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        row(f, "vertices", self.vertices)?;
        row(f, "  after welding", self.used_vertices)?;
        row(f, "  welded to another", self.welded_vertices)?;
        findings(f, "  unused", &self.unused_vertices)?;
        row(f, "faces", self.faces)?;
        findings(f, "  repeated vertex", &self.repeated_vertex_faces)?;
        findings(f, "  zero area", &self.zero_area_faces)?;
        findings(f, "    unlit, no partner", &self.unlit_faces)?;
        findings(f, "  duplicate", &self.duplicate_faces)?;
        row(f, "edges", self.edges)?;
        row(f, "  convex", self.convex_edges)?;
        row(f, "  concave", self.concave_edges)?;
        row(f, "  coplanar", self.coplanar_edges)?;
        findings(f, "  border", &self.border_edges)?;
        findings(f, "  non-manifold", &self.non_manifold_edges)?;
        findings(f, "  flipped", &self.flipped_edges)?;
        row(f, "  never silhouette", self.never_silhouette_edges)?;
        row(f, "most faces at an edge", self.most_faces_at_an_edge)?;
        row(f, "connected parts", self.components)?;
        let answer = |yes: bool| if yes { "yes" } else { "no" };
        row(f, "closed", answer(self.closed))?;
        row(f, "manifold", answer(self.manifold))?;
        row(f, "oriented", answer(self.oriented))
    }
}

fn row(f: &mut fmt::Formatter, name: &str, value: impl fmt::Display) -> fmt::Result {
    writeln!(f, "{name:<22}{value:>10}")
}

fn findings<Id: ListedId>(f: &mut fmt::Formatter, name: &str, findings: &Findings<Id>) -> fmt::Result {
    write!(f, "{name:<22}{:>10}", findings.count)?;
    let ids: Vec<String> = findings.first.iter().map(ListedId::text).collect();
    if !ids.is_empty() {
        let more = if findings.count as usize > ids.len() { ", .." } else { "" };
        write!(f, "  {}: {}{more}", Id::NAME, ids.join(", "))?;
    }
    writeln!(f)
}

/// An id as the table shows it.
trait ListedId {
    const NAME: &str;
    fn text(&self) -> String;
}

impl ListedId for u32 {
    const NAME: &str = "id";
    fn text(&self) -> String {
        self.to_string()
    }
}

impl ListedId for [u32; 2] {
    const NAME: &str = "between";
    fn text(&self) -> String {
        format!("{}-{}", self[0], self[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn findings_name_the_first_ids() {
        let report = TopologyReport {
            vertices: 5,
            border_edges: [[0, 1], [1, 2]].into_iter().collect(),
            duplicate_faces: (10..30).collect(),
            ..Default::default()
        };
        let text = report.to_string();
        let line = |start: &str| text.lines().find(|line| line.starts_with(start)).expect("every count has a line");
        assert_eq!(line("vertices"), "vertices                       5");
        assert_eq!(line("  border"), "  border                       2  between: 0-1, 1-2");
        assert_eq!(line("  dup"), "  duplicate                   20  id: 10, 11, 12, 13, 14, 15, 16, 17, ..");
        assert_eq!(line("  zero"), "  zero area                    0");
    }
}
