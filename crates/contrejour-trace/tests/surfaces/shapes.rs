//! Meshes around the origin, of half side or radius 1.

use std::f64::consts::PI;

use glam::DVec3;

#[derive(Clone)]
pub struct Shape {
    pub positions: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

impl Shape {
    /// A grid of quads over the unit square, each of two triangles, put in place by `place`.
    pub fn grid(columns: u32, rows: u32, place: impl Fn(f64, f64) -> DVec3) -> Self {
        let at = |i, j| place(f64::from(i) / f64::from(columns), f64::from(j) / f64::from(rows));
        let positions = (0..=rows).flat_map(|j| (0..=columns).map(move |i| (i, j)));
        let positions = positions.map(|(i, j)| at(i, j).to_array().map(|x| x as f32)).collect();
        let vertex = |i: u32, j: u32| j * (columns + 1) + i;
        let triangles = (0..rows)
            .flat_map(|j| (0..columns).map(move |i| (i, j)))
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
                [[a, b, c], [a, c, d]]
            })
            .collect();
        Self { positions, triangles }
    }

    /// A sphere whose last meridian is the first, bit for bit.
    pub fn sphere() -> Self {
        let (columns, rows) = (24, 12);
        Self::grid(columns, rows, |u, v| {
            let (turn, polar) = (2.0 * PI * (u % 1.0), PI * v);
            // Exactly one point at each pole.
            let across = if v == 0.0 || v == 1.0 { 0.0 } else { polar.sin() };
            DVec3::new(across * turn.cos(), polar.cos(), across * turn.sin())
        })
        .without_flat_faces()
    }

    /// A cube of 6 x 6 quads a side.
    pub fn cube() -> Self {
        let sides = [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z];
        sides
            .map(|out| {
                let across = DVec3::new(out.y, out.z, out.x);
                let up = out.cross(across);
                Self::grid(6, 6, |u, v| out + (2.0 * u - 1.0) * across + (2.0 * v - 1.0) * up)
            })
            .into_iter()
            .fold(Self { positions: vec![], triangles: vec![] }, Self::and)
    }

    /// Both.
    pub fn and(mut self, other: Self) -> Self {
        let first = self.positions.len() as u32;
        self.positions.extend(other.positions);
        self.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|vertex| first + vertex)));
        self
    }

    /// Grown or shrunk, then moved, in `f32` as meshes come.
    pub fn baked(mut self, size: f64, offset: DVec3) -> Self {
        for position in &mut self.positions {
            *position = (DVec3::from(position.map(f64::from)) * size + offset).to_array().map(|x| x as f32);
        }
        self
    }

    fn without_flat_faces(mut self) -> Self {
        let corner = |vertex: u32| self.positions[vertex as usize];
        self.triangles.retain(|&[a, b, c]| corner(a) != corner(b) && corner(b) != corner(c) && corner(c) != corner(a));
        self
    }
}
