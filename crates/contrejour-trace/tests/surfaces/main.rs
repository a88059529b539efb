//! Rays leave surfaces without hitting them, and pass through none, at coordinates from 1e-3 to 1e6.

mod closed_bodies;
mod convex_bodies;
mod floor_and_wall;
mod placed;
mod shapes;
