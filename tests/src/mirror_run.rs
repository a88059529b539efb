//! The CPU twins of the stages on a frame's buffers.

use contrejour_mirror as mirror;
use contrejour_plan::Stage;

use crate::frame::{DRAW_STRIDE, Frame};

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
        let (seat, shape) = (self.seat, self.bundle.shape);
        let [casters, silhouettes, outlines] =
            [shape.caster_stride, shape.silhouette_stride, shape.outline_stride].map(|stride| self.begin(stride));
        match stage {
            "place_casters" => mirror::PlaceCasters {
                bundle: &self.bundle,
                caster_places: &self.caster_places,
                caster_lights: &mut self.caster_lights,
                counters: &mut self.counters,
            }
            .run(),
            "list_blocks" => mirror::ListBlocks {
                bundle: &self.bundle,
                caster_lights: &self.caster_lights,
                face_blocks: &self.face_blocks,
                edge_blocks: &self.edge_blocks,
                face_items: &mut self.face_items,
                face_tests: &mut self.face_tests,
                edge_tests: &mut self.edge_tests,
                counters: &mut self.counters,
            }
            .run(),
            "write_item_args" => mirror::WriteItemArgs {
                bundle: &self.bundle,
                counters: &self.counters,
                item_args: &mut self.item_args,
                draw_args: &mut self.draw_args,
            }
            .run(),
            "classify_faces" => mirror::ClassifyFaces {
                bundle: &self.bundle,
                face_tests: &self.face_tests,
                casters: &self.casters,
                caster_lights: &self.caster_lights,
                planes: &self.planes,
                lit: &mut self.lit,
                recheck_words: &mut self.recheck_words,
                counters: &mut self.counters,
            }
            .run(),
            "write_recheck_args" => mirror::WriteRecheckArgs {
                bundle: &self.bundle,
                counters: &self.counters,
                recheck_args: &mut self.recheck_args,
            }
            .run(),
            "recheck_faces" => mirror::RecheckFaces {
                bundle: &self.bundle,
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
                bundle: &self.bundle,
                counters: &self.counters,
                refine_args: &mut self.refine_args,
            }
            .run(),
            "refine_faces" => mirror::RefineFaces {
                bundle: &self.bundle,
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
                bundle: &self.bundle,
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
                bundle: &self.bundle,
                edge_tests: &self.edge_tests,
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
                view: &self.bundle.views[seat],
                counters: &self.counters[seat].counts,
                extrude_args: &mut self.extrude_args,
            }
            .run(),
            "extrude_edges" => mirror::ExtrudeEdges {
                view: &self.bundle.views[seat],
                silhouettes: &self.silhouettes[silhouettes..],
                casters: &self.casters,
                caster_lights: &self.caster_lights[casters..],
                edges: &self.edges,
                positions: &self.positions,
                quads: &mut self.quads,
                counters: &mut self.counters[seat].counts,
            }
            .run(),
            "build_corners" => mirror::BuildCorners {
                view: &self.bundle.views[seat],
                quads: &self.quads,
                casters: &self.casters,
                caster_lights: &self.caster_lights[casters..],
                positions: &self.positions,
                outline_sides: &self.outline_sides[outlines..],
                vertex_edges: &self.vertex_edges,
                corners: &mut self.corners,
                counters: &mut self.counters[seat].counts,
            }
            .run(),
            "write_draw_args" => {
                mirror::WriteDrawArgs {
                    view: &self.bundle.views[seat],
                    counters: &self.counters[seat].counts,
                    draw_args: &mut self.draw_args[seat * DRAW_STRIDE..],
                }
                .run();
            }
            _ => panic!("no stage is named {stage}"),
        }
    }
}
