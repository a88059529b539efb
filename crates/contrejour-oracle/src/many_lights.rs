//! The silhouettes of one mesh for thousands of lights: flat lists, and floats where a bound lets them decide.

use crate::facing::lit;
use crate::silhouette::{OracleEdge, OracleTopology};

/// Finds what [`OracleTopology`] finds, some hundred times faster.
///
/// Facing is decided in `f64` where the determinant lies beyond a bound of its rounding error, else by [`lit`].
#[derive(Debug)]
pub struct ManyLights {
    faces: Vec<FaceFloats>,
    corners: Vec<[[f32; 3]; 3]>,
    edges: Vec<FlatEdge>,
    /// The faces of all edges, one edge after the other.
    incidences: Vec<Incidence>,
    /// Whose sign each face without area takes (`None`: that of an unlit face), and whether negated.
    partners: Vec<(usize, Option<usize>, bool)>,
}

#[derive(Debug)]
struct FlatEdge {
    low: u32,
    high: u32,
    /// Past its last face among the incidences.
    end: usize,
}

#[derive(Debug)]
struct Incidence {
    face: u32,
    /// Whether the face runs from the lower to the higher vertex.
    along: bool,
}

/// What the determinant `n (L - w a)` with `n = (b - a) x (c - a)` needs of a face.
#[derive(Debug)]
struct FaceFloats {
    a: [f64; 3],
    normal: [f64; 3],
    /// For each component of the normal the magnitudes of its two products, added up.
    sizes: [f64; 3],
}

/// Each of the determinant's six products goes through at most eight operations: three differences, two
/// multiplications, three additions. An operation's relative error is at most u = 2^-53, so the determinant's error is
/// below 8.0001 u S, where S is the sum of the products' magnitudes. The computed S has gone through as many
/// operations, so 16 u of it covers the error and its own.
///
/// Nothing underflows and nothing overflows: `f32` numbers are multiples of 2^-149 below 2^128, so what is not zero
/// lies between 2^-447 and 2^394.
const ERROR_SHARE: f64 = 16.0 * (f64::EPSILON / 2.0);

impl ManyLights {
    /// Flattens the lists of a mesh.
    pub fn new(topology: &OracleTopology) -> Self {
        let corners: Vec<_> = topology.corners_of_faces().collect();
        let mut edges = Vec::new();
        let mut incidences = Vec::new();
        for (&(low, high), faces) in &topology.edges {
            incidences.extend(faces.iter().map(|&(face, along)| Incidence { face: face as u32, along }));
            edges.push(FlatEdge { low, high, end: incidences.len() });
        }
        Self {
            faces: corners.iter().map(FaceFloats::new).collect(),
            corners,
            edges,
            incidences,
            partners: topology.partners.iter().map(|(&face, &(other, negated))| (face, other, negated)).collect(),
        }
    }

    /// The three positions of each face.
    pub fn corners(&self) -> &[[[f32; 3]; 3]] {
        &self.corners
    }

    /// As [`OracleTopology::lit_faces`].
    ///
    /// # Panics
    ///
    /// As [`lit`].
    pub fn lit_faces(&self, light: [f32; 4], mirrored: bool) -> Vec<bool> {
        let floats = light.map(f64::from);
        let sign = if mirrored { -1.0 } else { 1.0 };
        let is_lit = |(face, &[a, b, c]): (&FaceFloats, &[[f32; 3]; 3])| {
            let (determinant, error) = face.determinant(floats);
            if determinant.abs() > error {
                sign * determinant > 0.0
            } else {
                // Without a product that is not zero the determinant is exactly zero.
                error > 0.0 && lit(a, b, c, light, mirrored)
            }
        };
        self.faces.iter().zip(&self.corners).map(is_lit).collect()
    }

    /// The silhouette that follows from the faces that are lit, by ascending (low, high) vertex.
    pub fn silhouette(&self, lit_faces: &[bool]) -> Vec<OracleEdge> {
        // Faces without area take the signs of faces with area.
        let mut is_lit = lit_faces.to_vec();
        for &(face, other, negated) in &self.partners {
            is_lit[face] = other.is_some_and(|other| lit_faces[other]) != negated;
        }
        let mut silhouette = Vec::new();
        let mut begin = 0;
        for &FlatEdge { low, high, end } in &self.edges {
            let faces = &self.incidences[begin..end];
            begin = end;
            let left = faces.iter().filter(|incidence| is_lit[incidence.face as usize] == incidence.along).count();
            let edge = OracleEdge { low, high, left: left as i32, right: (faces.len() - left) as i32 };
            if edge.multiplicity() != 0 {
                silhouette.push(edge);
            }
        }
        silhouette
    }
}

impl FaceFloats {
    fn new(corners: &[[f32; 3]; 3]) -> Self {
        let [a, b, c] = corners.map(|corner| corner.map(f64::from));
        let [p, q] = [b, c].map(|corner| [0, 1, 2].map(|axis| corner[axis] - a[axis]));
        let products = [(1, 2), (2, 0), (0, 1)].map(|(y, z)| (p[y] * q[z], p[z] * q[y]));
        let normal = products.map(|(first, second)| first - second);
        Self { a, normal, sizes: products.map(|(first, second)| first.abs() + second.abs()) }
    }

    /// The determinant, and what it is off by at most.
    fn determinant(&self, [x, y, z, w]: [f64; 4]) -> (f64, f64) {
        let Self { a, normal, sizes } = self;
        let r = [x - w * a[0], y - w * a[1], z - w * a[2]];
        let determinant = normal[0] * r[0] + normal[1] * r[1] + normal[2] * r[2];
        let size = sizes[0] * r[0].abs() + sizes[1] * r[1].abs() + sizes[2] * r[2].abs();
        (determinant, ERROR_SHARE * size)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    type Vector = [f32; 3];

    fn coordinate() -> impl Strategy<Value = f32> {
        let any_finite = any::<u32>().prop_map(f32::from_bits).prop_filter("finite", |value| value.is_finite());
        prop_oneof![any_finite, -1.0_f32..1.0, (-3..4_i8).prop_map(f32::from), Just(0.0)]
    }

    fn vector() -> impl Strategy<Value = Vector> {
        [coordinate(), coordinate(), coordinate()]
    }

    /// A light in the plane of three corners but for rounding, and some steps of the last place away.
    fn near_plane([a, b, c]: [Vector; 3], s: f64, t: f64, w: f32, steps: [i32; 3]) -> [f32; 4] {
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let [a, b, c] = [a, b, c].map(|corner| f64::from(corner[axis]));
            let exact = (f64::from(w) * a + s * (b - a) + t * (c - a)) as f32;
            let moved = f32::from_bits(exact.to_bits().wrapping_add_signed(steps[axis]));
            if moved.is_finite() { moved } else { 1.0 }
        });
        [x, y, z, w]
    }

    fn soup() -> impl Strategy<Value = (Vec<Vector>, Vec<[u32; 3]>)> {
        let corner = 0..12_u32;
        (prop::collection::vec(vector(), 12), prop::collection::vec([corner.clone(), corner.clone(), corner], 1..30))
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

        #[test]
        fn equals_the_definition(
            (positions, triangles) in soup(),
            (s, t) in prop_oneof![(-2.0..2.0, -2.0..2.0), (-2..3_i8, -2..3_i8).prop_map(|(s, t)| (s.into(), t.into()))],
            w in prop_oneof![Just(0.0_f32), Just(1.0)],
            steps in prop_oneof![Just([0; 3]), [-2..3_i32, -2..3_i32, -2..3_i32]],
            mirrored in any::<bool>(),
        ) {
            let light = near_plane(triangles[0].map(|corner| positions[corner as usize]), s, t, w, steps);
            let topology = OracleTopology::new(&positions, &triangles);
            let many = ManyLights::new(&topology);
            let lit_faces = many.lit_faces(light, mirrored);
            prop_assert_eq!(&lit_faces, &topology.lit_faces(light, mirrored));
            prop_assert_eq!(many.silhouette(&lit_faces), topology.silhouette(light, mirrored));
        }
    }

    #[test]
    fn floats_without_the_bound_are_wrong() {
        // A direction along an edge lies in the plane exactly, and products of three numbers of 24 bits are rounded.
        let mut wrong = 0;
        for step in 1..100_u16 {
            let [b, c] = [[0.37, 0.81, 0.59], [0.73, -0.19, 0.43]]
                .map(|corner| corner.map(|x: f32| (x * f32::from(step)).sin()));
            let corners = [[0.0; 3], b, c];
            let [x, y, z] = b;
            let (determinant, error) = FaceFloats::new(&corners).determinant([x, y, z, 0.0].map(f64::from));
            assert!(!lit(corners[0], b, c, [x, y, z, 0.0], false) && determinant.abs() <= error);
            wrong += u32::from(determinant > 0.0);
        }
        assert!(wrong > 10, "{wrong}");
    }
}
