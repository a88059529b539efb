//! The CPU twins of the stages on a frame's buffers.

use contrejour_mirror as mirror;
use contrejour_plan::Stage;

use crate::frame::Frame;

impl Frame {
    /// Runs the CPU twins of all stages from `begin` on and before `end`, in the library's order.
    ///
    /// # Panics
    ///
    /// When no stage has one of the names.
    pub fn run_mirrors(&mut self, begin: &str, end: &str) {
        let place = |name: &str| {
            let found = Stage::ALL.iter().position(|stage| stage.name() == name);
            found.unwrap_or_else(|| panic!("there is no stage {name}"))
        };
        for stage in &Stage::ALL[place(begin)..place(end)] {
            self.run_mirror(stage.name());
        }
    }

    /// Runs the CPU twin of a stage.
    ///
    /// # Panics
    ///
    /// When no stage has the name.
    pub fn run_mirror(&mut self, stage: &str) {
        match stage {
            "place_casters" => mirror::PlaceCasters {
                view: &self.view,
                caster_places: &self.caster_places,
                caster_lights: &mut self.caster_lights,
                counters: &mut self.counters,
            }
            .run(),
            "list_blocks" => mirror::ListBlocks {
                view: &self.view,
                caster_lights: &self.caster_lights,
                face_blocks: &self.face_blocks,
                edge_blocks: &self.edge_blocks,
                face_items: &mut self.face_items,
                edge_items: &mut self.edge_items,
                counters: &mut self.counters,
            }
            .run(),
            "write_item_args" => mirror::WriteItemArgs {
                view: &self.view,
                counters: &self.counters,
                item_args: &mut self.item_args,
                draw_args: &mut self.draw_args,
            }
            .run(),
            "classify_faces" => mirror::ClassifyFaces {
                view: &self.view,
                face_items: &self.face_items,
                casters: &self.casters,
                caster_lights: &self.caster_lights,
                planes: &self.planes,
                lit: &mut self.lit,
                recheck_words: &mut self.recheck_words,
                counters: &mut self.counters,
            }
            .run(),
            "write_recheck_args" => mirror::WriteRecheckArgs {
                view: &self.view,
                counters: &self.counters,
                recheck_args: &mut self.recheck_args,
            }
            .run(),
            "recheck_faces" => mirror::RecheckFaces {
                view: &self.view,
                recheck_words: &self.recheck_words,
                casters: &self.casters,
                caster_lights: &self.caster_lights,
                faces: &self.faces,
                positions: &self.positions,
                lit: &mut self.lit,
                undecided: &mut self.undecided,
                counters: &mut self.counters,
            }
            .run(),
            "write_refine_args" => mirror::WriteRefineArgs {
                view: &self.view,
                counters: &self.counters,
                refine_args: &mut self.refine_args,
            }
            .run(),
            "refine_faces" => mirror::RefineFaces {
                view: &self.view,
                undecided: &self.undecided,
                counters: &self.counters,
                casters: &self.casters,
                caster_lights: &self.caster_lights,
                faces: &self.faces,
                positions: &self.positions,
                lit: &mut self.lit,
            }
            .run(),
            "resolve_faces" => mirror::ResolveFaces {
                view: &self.view,
                undecided: &self.undecided,
                counters: &self.counters,
                casters: &self.casters,
                caster_lights: &self.caster_lights,
                faces: &self.faces,
                positions: &self.positions,
                lit: &mut self.lit,
            }
            .run(),
            "detect_silhouette" => mirror::DetectSilhouette {
                view: &self.view,
                edge_items: &self.edge_items,
                casters: &self.casters,
                edges: &self.edges,
                incidences: &self.incidences,
                lit: &self.lit,
                silhouettes: &mut self.silhouettes,
                outline_sides: &mut self.outline_sides,
                counters: &mut self.counters,
            }
            .run(),
            "write_extrude_args" => mirror::WriteExtrudeArgs {
                view: &self.view,
                counters: &self.counters,
                extrude_args: &mut self.extrude_args,
            }
            .run(),
            "extrude_edges" => mirror::ExtrudeEdges {
                view: &self.view,
                silhouettes: &self.silhouettes,
                casters: &self.casters,
                caster_lights: &self.caster_lights,
                edges: &self.edges,
                positions: &self.positions,
                quads: &mut self.quads,
                counters: &mut self.counters,
            }
            .run(),
            "build_corners" => mirror::BuildCorners {
                view: &self.view,
                quads: &self.quads,
                casters: &self.casters,
                caster_lights: &self.caster_lights,
                positions: &self.positions,
                outline_sides: &self.outline_sides,
                vertex_edges: &self.vertex_edges,
                corners: &mut self.corners,
                counters: &mut self.counters,
            }
            .run(),
            "write_draw_args" => {
                mirror::WriteDrawArgs { view: &self.view, counters: &self.counters, draw_args: &mut self.draw_args }
                    .run();
            }
            _ => panic!("no stage is named {stage}"),
        }
    }
}
