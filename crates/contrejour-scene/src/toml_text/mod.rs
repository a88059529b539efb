//! Reading TOML so that every complaint has its line.

mod read_camera;
mod read_light;
mod read_mesh;
mod read_scene;
mod read_shadow;
mod section;
mod value;

pub(crate) use read_scene::read_scene;

#[cfg(test)]
mod tests;
