//! Signs of faces: by exact arithmetic, and by a bare test in 32-bit floats.

use contrejour_layout::{CasterLight, Face};
use contrejour_mesh::TopologyAwareMesh;
use contrejour_oracle::lit;

/// The sign of every face of a caster by exact arithmetic, `true` where it is lit.
#[derive(Clone, Debug, PartialEq)]
pub(in super::super) struct FaceSigns(pub Vec<bool>);

impl FaceSigns {
    pub fn exact(mesh: &TopologyAwareMesh, light: &CasterLight) -> Self {
        let light_object = light.light_object.map(f32::from_bits);
        let is_lit = |face: &Face| {
            let [a, b, c] = mesh.corners(face);
            lit(a, b, c, light_object, light.mirrored == 1)
        };
        Self(mesh.faces.iter().map(is_lit).collect())
    }
}

/// Lit bits as a shader without any care finds them: the determinant in 32-bit floats.
pub(in super::super) fn bare_lit(mesh: &TopologyAwareMesh, light: &CasterLight) -> Vec<u32> {
    let [x, y, z, w] = light.light_object.map(f32::from_bits);
    let sign = if light.mirrored == 1 { -1.0 } else { 1.0 };
    lit_words(mesh.faces.iter().map(|face| {
        let [a, b, c] = mesh.corners(face).map(glam::Vec3::from);
        sign * (b - a).cross(c - a).dot(glam::Vec3::new(x, y, z) - w * a) > 0.0
    }))
}

/// Bits in words, as the stages keep them.
fn lit_words(lit: impl ExactSizeIterator<Item = bool>) -> Vec<u32> {
    let mut words = vec![0; lit.len().div_ceil(32)];
    for (face, is_lit) in lit.enumerate() {
        words[face / 32] |= u32::from(is_lit) << (face % 32);
    }
    words
}

/// Whether a face's bit is set.
fn is_set(words: &[u32], face: usize) -> bool {
    words[face / 32] >> (face % 32) & 1 == 1
}

/// Faces whose bit is wrong in any of some words.
pub(in super::super) fn wrong_signs(exact: &FaceSigns, found: &[&[u32]]) -> u64 {
    let is_wrong = |&(face, is_lit): &(usize, &bool)| found.iter().any(|words| is_set(words, face) != *is_lit);
    exact.0.iter().enumerate().filter(is_wrong).count() as u64
}

#[cfg(test)]
mod tests {
    use contrejour_mesh::BuildOptions;

    use super::*;

    /// A tetrahedron of random corners, and a light so near the plane of its first face that floats may not tell the side.
    fn hard_case(random: &mut fastrand::Rng) -> (TopologyAwareMesh, CasterLight) {
        let positions = [(); 4].map(|()| [(); 3].map(|()| random.f32()));
        let faces = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
        let mesh = TopologyAwareMesh::build(&positions, &faces, &BuildOptions::default()).expect("a good mesh");
        let [a, b, c, _] = positions.map(glam::Vec3::from);
        let [x, y, z] = (a + 3.0 * (b - a) - 2.5 * (c - a)).to_array().map(f32::to_bits);
        (mesh, CasterLight { light_object: [x, y, z, 1.0_f32.to_bits()], casts: 1, ..CasterLight::default() })
    }

    #[test]
    fn one_wrong_bit_is_one_error_however_many_have_it() {
        let (mesh, light) = hard_case(&mut fastrand::Rng::with_seed(1));
        let exact = FaceSigns::exact(&mesh, &light);
        let right = lit_words(exact.0.iter().copied());
        assert_eq!(wrong_signs(&exact, &[&right, &right]), 0);
        for face in 0..4 {
            let wrong = [right[0] ^ 1 << face];
            assert_eq!(wrong_signs(&exact, &[&right, &wrong]), 1);
            assert_eq!(wrong_signs(&exact, &[&wrong, &wrong]), 1);
        }
        assert_eq!(wrong_signs(&exact, &[&[right[0] ^ 1], &[right[0] ^ 2]]), 2);
    }

    #[test]
    fn the_bare_test_is_right_where_it_is_easy_and_wrong_somewhere() {
        let mut random = fastrand::Rng::with_seed(1);
        let wrong = |(mesh, light): &(TopologyAwareMesh, CasterLight)| {
            wrong_signs(&FaceSigns::exact(mesh, light), &[&bare_lit(mesh, light)])
        };
        let all: u64 = (0..100).map(|_| wrong(&hard_case(&mut random))).sum();
        assert!(all > 0, "the suite must see the fault that it guards against");
        let (mesh, mut light) = hard_case(&mut random);
        light.light_object = [9.0_f32, -7.0, 8.0, 1.0].map(f32::to_bits);
        for mirrored in [0, 1] {
            light.mirrored = mirrored;
            assert_eq!(wrong(&(mesh.clone(), light)), 0);
        }
    }
}
