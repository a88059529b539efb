//! The techniques that smoothies are compared with do what their literature says: each converges where it should, and
//! each comes near the truth on the built-in scenes and on real meshes.

mod everywhere;
mod filters;
pub mod judged_scene;
mod percentage_closer;
mod variance;

use contrejour_tests::harness::{gpu_trial, mesh_trial};
use libtest_mimic::Trial;

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("peers::many_samples_of_pcss_are_the_truth", |_| percentage_closer::many_samples_are_the_truth()),
        gpu_trial("peers::small_kernels_are_the_hard_shadow", |_| percentage_closer::small_kernels_are_hard()),
        gpu_trial("peers::filters_are_their_sums", |_| filters::filters_are_their_sums()),
        gpu_trial("peers::strong_warps_are_pcf", |_| variance::strong_warps_are_pcf()),
        gpu_trial("peers::two_depths_need_no_warp", |_| variance::two_depths_need_no_warp()),
        gpu_trial("peers::variance_soft_shadows_are_near_the_truth", |_| variance::soft_shadows_are_near_the_truth()),
        gpu_trial("peers::halves_are_nearly_floats", |_| everywhere::halves_are_nearly_floats()),
        gpu_trial("peers::all_come_near_the_truth", |_| everywhere::all_come_near_the_truth()),
        mesh_trial("peers::real_meshes", |_, folder| everywhere::real_meshes(folder)),
    ]
}
