//! Scene files of contrejour: cameras, meshes, materials, lights and shadow settings.
