//! A small polytope once more, roughly and in one piece.

use super::{Edge, Polytope};
use glam::{DVec3, Vec4};

/// Sixteen bytes: four numbers in single precision by their bits, or four edges' bytes.
type Word = [u32; 4];

/// Coordinates of four vertices: all x, all y, all z.
pub(crate) type Row = [Vec4; 3];

/// Four faces: all x of their normals, all y, all z, and how far each lies from the centre.
pub(crate) type Planes = [Vec4; 4];

/// Vertices, faces and edges of a small polytope as seen from its centre, in single precision.
///
/// They fill some ten lines of cache in a row, where the polytope's own numbers fill thirty in several
/// places: what looks at many bodies once in a frame waits for memory longer than it counts. What is
/// found in it holds to within rounding of single precision, and is to be made sure of by the
/// polytope's own numbers.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Sketch {
    /// Rows, then planes, then edges.
    words: Vec<Word>,
    vertices: u8,
    faces: u8,
    edges: u8,
}

/// What an edge joins.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Joint {
    /// As in [`Edge`].
    pub(crate) vertices: [u8; 2],
    pub(crate) faces: [u8; 2],
}

impl Joint {
    /// What an edge joins, of which no number is beyond a byte.
    #[inline]
    pub(crate) fn of(edge: &Edge) -> Self {
        Self {
            vertices: edge.vertices.map(|vertex| vertex as u8),
            faces: edge.faces.map(|face| face as u8),
        }
    }

    #[inline]
    fn to_word(self) -> u32 {
        let ([from, to], [left, right]) = (self.vertices, self.faces);
        u32::from_le_bytes([from, to, left, right])
    }

    #[inline]
    fn from_word(word: u32) -> Self {
        let [from, to, left, right] = word.to_le_bytes();
        Self {
            vertices: [from, to],
            faces: [left, right],
        }
    }
}

/// Numbers of a few vertices, a bit for each.
pub(crate) type Bits = u32;

#[inline]
fn word(vector: Vec4) -> Word {
    vector.to_array().map(f32::to_bits)
}

#[inline]
fn vector(word: &Word) -> Vec4 {
    Vec4::from_array(word.map(f32::from_bits))
}

/// In single precision.
#[inline]
pub(crate) fn single(vector: DVec3) -> Vec4 {
    Vec4::new(vector.x as f32, vector.y as f32, vector.z as f32, 0.0)
}

/// Of four vectors all x, all y, all z and all w.
#[inline]
pub(crate) fn transposed([a, b, c, d]: [Vec4; 4]) -> [Vec4; 4] {
    let all = glam::Mat4::from_cols(a, b, c, d).transpose();
    [all.x_axis, all.y_axis, all.z_axis, all.w_axis]
}

/// Four vertices in a row.
#[inline]
pub(crate) fn row(vertices: [DVec3; 4]) -> Row {
    let [x, y, z, _] = transposed(vertices.map(single));
    [x, y, z]
}

/// Four faces, by their normals and distances.
#[inline]
pub(crate) fn planes(faces: [(DVec3, f64); 4]) -> Planes {
    transposed(faces.map(|(normal, height)| single(normal).with_w(height as f32)))
}

impl Sketch {
    /// Polytopes with more vertices, faces or edges are not small: of 18 points and more, or 32 where
    /// three edges meet at each.
    pub(crate) const VERTICES: usize = 32;
    pub(crate) const FACES: usize = 32;
    pub(crate) const EDGES: usize = 48;

    /// Beyond all faces: what fills up the last four of them.
    pub(crate) const NO_FACE: (DVec3, f64) = (DVec3::ZERO, f64::INFINITY);

    /// By how much less than the farthest vertex one may reach that counts as the
    /// [highest](Self::highest), as a share of the largest distance: two heights, each of three products of
    /// numbers that were rounded by 6e-8.
    pub(crate) const ERROR: f32 = 2e-6;

    /// The sketch of a polytope that is complete but for this; an empty one of one that is not small.
    pub(super) fn of(polytope: &Polytope) -> Self {
        let (vertices, edges) = (polytope.vertices(), polytope.edges());
        let faces = polytope.face_normals().len();
        if vertices.len() > Self::VERTICES || faces > Self::FACES || edges.len() > Self::EDGES {
            return Self::default();
        }
        let centre = polytope.centre();
        let first = vertices.first().copied().unwrap_or(centre);
        // What is left over repeats the first vertex, which changes nothing.
        let rows = vertices.chunks(4).flat_map(|four| {
            let at = |lane| four.get(lane).copied().unwrap_or(first) - centre;
            row(std::array::from_fn(at)).map(word)
        });
        let plane = |(&normal, offset): (&DVec3, &f64)| (normal, offset - normal.dot(centre));
        let faces_of: Vec<(DVec3, f64)> =
            (polytope.face_normals().iter().zip(polytope.face_offsets()))
                .map(plane)
                .collect();
        let planes = faces_of.chunks(4).flat_map(|four| {
            let at = |lane| four.get(lane).copied().unwrap_or(Self::NO_FACE);
            planes(std::array::from_fn(at)).map(word)
        });
        let bytes = |edge: &Edge| Joint::of(edge).to_word();
        let joints = edges
            .chunks(4)
            .map(|four| std::array::from_fn(|lane| four.get(lane).map_or(0, bytes)));
        let mut words: Vec<Word> = rows.chain(planes).chain(joints).collect();
        words.shrink_to_fit();
        Self {
            words,
            vertices: vertices.len() as u8,
            faces: faces as u8,
            edges: edges.len() as u8,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    pub(crate) fn vertex_count(&self) -> usize {
        usize::from(self.vertices)
    }

    pub(crate) fn face_count(&self) -> usize {
        usize::from(self.faces)
    }

    /// The vertices, four by four; the last four are filled up with the first vertex.
    #[inline]
    pub(crate) fn rows(&self) -> impl Iterator<Item = Row> {
        let end = 3 * self.vertex_count().div_ceil(4);
        let words = self.words.get(..end).unwrap_or_default();
        words
            .as_chunks()
            .0
            .iter()
            .map(|row: &[Word; 3]| row.each_ref().map(vector))
    }

    /// The faces, four by four; the last four are filled up with [`NO_FACE`](Self::NO_FACE).
    #[inline]
    pub(crate) fn planes(&self) -> impl Iterator<Item = Planes> {
        let begin = 3 * self.vertex_count().div_ceil(4);
        let end = begin + 4 * self.face_count().div_ceil(4);
        let words = self.words.get(begin..end).unwrap_or_default();
        words
            .as_chunks()
            .0
            .iter()
            .map(|four: &[Word; 4]| four.each_ref().map(vector))
    }

    /// What the edges join, four by four.
    #[inline]
    fn edges(&self) -> &[Word] {
        let begin = 3 * self.vertex_count().div_ceil(4) + 4 * self.face_count().div_ceil(4);
        self.words.get(begin..).unwrap_or_default()
    }

    /// What the edges join, in the order of their numbers.
    #[inline]
    pub(crate) fn joints(&self) -> impl Iterator<Item = Joint> {
        let edges = self.edges().as_flattened().get(..usize::from(self.edges));
        let edges = edges.unwrap_or_default().iter();
        edges.copied().map(Joint::from_word)
    }

    /// What an edge joins.
    #[inline]
    pub(crate) fn joint(&self, edge: u8) -> Option<Joint> {
        let word = self.edges().as_flattened().get(usize::from(edge));
        word.copied().map(Joint::from_word)
    }

    /// How far it reaches from the centre along a unit vector, to within half of
    /// [`ERROR`](Self::ERROR).
    #[inline]
    pub(crate) fn reach(&self, direction: DVec3) -> f32 {
        let [x, y, z, _] = single(direction).to_array().map(Vec4::splat);
        let most = self.rows().fold(Vec4::NEG_INFINITY, |most, [xs, ys, zs]| {
            most.max(x * xs + y * ys + z * zs)
        });
        most.max_element()
    }

    /// All vertices that may be farthest along a unit vector to within `margin`, and perhaps some
    /// that are not.
    #[inline]
    pub(crate) fn highest(&self, direction: DVec3, margin: f32) -> Bits {
        let [x, y, z, _] = single(direction).to_array().map(Vec4::splat);
        let mut heights = [Vec4::NEG_INFINITY; Self::VERTICES / 4];
        let mut most = Vec4::NEG_INFINITY;
        for (height, [xs, ys, zs]) in heights.iter_mut().zip(self.rows()) {
            *height = x * xs + y * ys + z * zs;
            most = most.max(*height);
        }
        let floor = Vec4::splat(most.max_element() - margin);
        let rows = self.vertex_count().div_ceil(4);
        let mut bits = 0;
        for (number, height) in heights.iter().enumerate().take(rows) {
            bits |= height.cmpge(floor).bitmask() << (4 * number);
        }
        // Those that fill up the last row do not count.
        bits & (Bits::MAX >> (Self::VERTICES - self.vertex_count().clamp(1, Self::VERTICES)))
    }

    /// Reads a number from each line of cache that the vertices fill, so that all of them are there.
    #[inline]
    pub(crate) fn read_vertices(&self) -> u32 {
        let words = self.words.get(..3 * self.vertex_count().div_ceil(4));
        read(words.unwrap_or_default())
    }

    /// The same of all that there is.
    #[inline]
    pub(crate) fn read(&self) -> u32 {
        read(&self.words)
    }
}

#[inline]
fn read(words: &[Word]) -> u32 {
    let of_lines = words.iter().step_by(64 / size_of::<Word>());
    of_lines
        .chain(words.last())
        .fold(0, |sum, word| sum ^ word[0])
}

/// The numbers of the bits that are set, ascending.
#[inline]
pub(crate) fn numbers(mut bits: Bits) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        (bits != 0).then(|| {
            let number = bits.trailing_zeros();
            bits &= bits - 1;
            number
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on a spiral around a sphere, far from the origin.
    fn hull(count: u32) -> Polytope {
        let points = (0..count).map(|index| {
            let z = f64::from(2 * index + 1) / f64::from(count) - 1.0;
            let (y, x) = (2.4 * f64::from(index)).sin_cos();
            (1.0 - z * z).sqrt() * DVec3::new(x, y, 0.0) + z * DVec3::Z + DVec3::splat(100.0)
        });
        Polytope::from_points(points).unwrap()
    }

    #[test]
    fn holds_what_the_polytope_holds() {
        for count in 4..=18 {
            let hull = hull(count);
            let Some(sketch) = hull.sketch() else {
                assert!(hull.edges().len() > Sketch::EDGES, "{count}");
                continue;
            };
            let rows: Vec<f32> = (sketch.rows())
                .flat_map(|[x, y, z]| transposed([x, y, z, Vec4::ZERO]))
                .flat_map(|vertex| [vertex.x, vertex.y, vertex.z])
                .collect();
            for (index, &vertex) in hull.vertices().iter().enumerate() {
                let local = (vertex - hull.centre()).as_vec3().to_array();
                assert_eq!(rows[3 * index..][..3], local);
            }
            let planes: Vec<Vec4> = sketch.planes().flat_map(transposed).collect();
            for ((plane, &normal), offset) in planes
                .iter()
                .zip(hull.face_normals())
                .zip(hull.face_offsets())
            {
                assert_eq!(plane.truncate(), normal.as_vec3());
                let height = offset - normal.dot(hull.centre());
                assert!((f64::from(plane.w) - height).abs() < 1e-6);
            }
            assert_eq!(planes.len(), hull.face_normals().len().next_multiple_of(4));
            let joints: Vec<Joint> = sketch.joints().collect();
            assert_eq!(joints.len(), hull.edges().len());
            for (joint, edge) in joints.iter().zip(hull.edges()) {
                assert_eq!(joint.vertices.map(u32::from), edge.vertices);
                assert_eq!(joint.faces.map(u32::from), edge.faces);
            }
        }
    }

    #[test]
    fn finds_the_highest() {
        for count in [4, 5, 12, 17] {
            let hull = hull(count);
            let sketch = hull.sketch().unwrap();
            let mut many = 0;
            for step in 0..500 {
                let step = f64::from(step);
                let direction =
                    DVec3::new((0.7 * step).sin(), (1.1 * step).cos(), 0.3 * (step).sin());
                let direction = direction.normalize();
                let height =
                    |index: u32| (hull.vertices()[index as usize] - hull.centre()).dot(direction);
                let top = (0..hull.vertices().len() as u32)
                    .map(height)
                    .fold(-9.0, f64::max);
                for margin in [0.0, 0.2] {
                    let found = sketch.highest(direction, margin + Sketch::ERROR);
                    for index in 0..hull.vertices().len() as u32 {
                        let below = top - height(index);
                        let is_in = found >> index & 1 == 1;
                        assert!(is_in || below > f64::from(margin), "{index}");
                        assert!(!is_in || below < f64::from(margin) + 1e-5, "{index}");
                    }
                    many += u32::from(numbers(found).count() > 1);
                }
                assert!((f64::from(sketch.reach(direction)) - top).abs() < 1e-6);
            }
            assert!(many > 0);
        }
    }
}
