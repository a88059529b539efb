//! What a mesh takes as a topology-aware vertex stream.

use contrejour_mesh::{TamForm, TamMemory, TamOptions, TamPrecision, TamStream, TopologyAwareMesh};
use serde::Serialize;

/// The stream of a mesh, in all forms that it may have.
#[derive(Serialize)]
pub(super) struct StreamReport {
    faces: usize,
    never_silhouette_faces: u32,
    faces_without_area: u32,
    overdrawn_edges: u32,
    items: TamMemory,
    half_items: TamMemory,
    face_records: TamMemory,
    half_face_records: TamMemory,
    indices: TamMemory,
}

impl StreamReport {
    pub fn new(mesh: &TopologyAwareMesh) -> Self {
        let stream = TamStream::new(mesh, &TamOptions::default());
        let memory = |form, precision| stream.memory(form, precision, &mesh.report);
        Self {
            faces: stream.faces.len(),
            never_silhouette_faces: stream.never_silhouette_faces,
            faces_without_area: stream.faces_without_area,
            overdrawn_edges: stream.overdrawn_edges,
            items: memory(TamForm::Items, TamPrecision::Full),
            half_items: memory(TamForm::Items, TamPrecision::Half),
            face_records: memory(TamForm::Faces, TamPrecision::Full),
            half_face_records: memory(TamForm::Faces, TamPrecision::Half),
            indices: TamMemory::of_neighbours(&mesh.report),
        }
    }

    /// As a table for people.
    pub fn text(&self) -> String {
        let row = |name: &str, value: String| format!("{name:<22}{value:>10}");
        let counts = [
            ("faces in a TAM stream", self.faces.to_string()),
            ("  never silhouette", self.never_silhouette_faces.to_string()),
            ("  without area", self.faces_without_area.to_string()),
            ("  overdrawn edges", self.overdrawn_edges.to_string()),
        ];
        let forms = [
            ("  bytes of items", &self.items),
            ("    in halves", &self.half_items),
            ("  bytes of faces", &self.face_records),
            ("    in halves", &self.half_face_records),
            ("  bytes of indices", &self.indices),
        ];
        let counts = counts.map(|(name, count)| row(name, count) + "\n");
        let forms = forms.map(|(name, TamMemory { face_bytes, bytes, of_unindexed, of_indexed })| {
            let row = row(name, bytes.to_string());
            format!("{row}  {face_bytes} a face; {of_unindexed:.2} of no index, {of_indexed:.2} of an index\n")
        });
        counts.concat() + &forms.concat()
    }
}
