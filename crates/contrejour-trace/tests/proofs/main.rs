//! The tracer against closed forms and one-dimensional integrals: blockers of known shape between a floor and a light.

mod blockers;
mod compare;
mod convergence;
mod disk_lights;
mod exact;
mod lights_cut_by_a_plane;
mod sphere_lights;
mod sun_lights;
