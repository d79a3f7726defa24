//! Planes between two shapes that turn.

use super::flight::{Flight, Instant};
use super::parting::Parted;
use super::turning::{across_edges, of_features};
use super::window::Window;
use crate::geometry::{Cuboid, Sphere};
use crate::narrow_phase::distance::Separator;
use glam::{DMat3, DVec3};

/// A pair of shapes, and planes between them however they stand.
pub(super) trait Planes {
    /// Whether it is these planes that tell whether two bodies touch that are near.
    const DECIDES: bool;

    /// Turns both shapes anew.
    fn turn(&mut self, a: &Instant<'_>, b: &Instant<'_>);

    /// A plane between them where `between` leads from B's position to A's; none if they overlap and
    /// nothing tells which way out.
    fn part(&mut self, between: DVec3) -> Option<Parted>;

    /// The plane of the features that the last one was found by, where both are turned anew; none if there is none.
    fn same(&mut self, a: &Instant<'_>, b: &Instant<'_>, between: DVec3) -> Option<Parted> {
        self.turn(a, b);
        self.part(between)
    }

    /// How a plane across `normal` turns with the features that it was found by, in radians per
    /// frame.
    fn turning(&self, window: &Window<'_, '_>, normal: DVec3) -> DVec3;
}

/// The plane across the nearest points of any two shapes.
pub(super) struct Nearest<'a> {
    separator: Separator<'a>,
}

impl<'a> Nearest<'a> {
    pub(super) fn new(a: &Flight<'a>, b: &Flight<'a>, time: f64) -> Self {
        let [turned_a, turned_b] = [a, b].map(|flight| flight.pose_at(time).orientation);
        Self {
            separator: Separator::new(a.shape, turned_a, b.shape, turned_b),
        }
    }
}

impl Planes for Nearest<'_> {
    const DECIDES: bool = true;

    fn turn(&mut self, a: &Instant<'_>, b: &Instant<'_>) {
        self.separator.turn(a.pose.orientation, b.pose.orientation);
    }

    fn part(&mut self, between: DVec3) -> Option<Parted> {
        let found = self.separator.separation(between, 1e-9)?;
        Some(Parted {
            normal: found.normal,
            gap: found.gap,
            distance: found.distance,
        })
    }

    fn turning(&self, window: &Window<'_, '_>, normal: DVec3) -> DVec3 {
        of_features(window, self.separator.nearest_vertices(), normal)
    }
}

/// Which of two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    First,
    Second,
}

/// A ball and a box.
pub(super) struct TurningBall {
    radius: f64,
    half: DVec3,
    /// Of the box.
    rotation: DMat3,
    ball: Place,
    /// Whether a corner is nearest.
    corner: bool,
}

impl TurningBall {
    pub(super) fn new(ball: &Sphere, cuboid: &Cuboid, place: Place) -> Self {
        Self {
            radius: ball.radius(),
            half: cuboid.half_extents(),
            rotation: DMat3::IDENTITY,
            ball: place,
            corner: false,
        }
    }
}

impl Planes for TurningBall {
    const DECIDES: bool = false;

    #[inline]
    fn turn(&mut self, a: &Instant<'_>, b: &Instant<'_>) {
        self.rotation = match self.ball {
            Place::First => b.rotation,
            Place::Second => a.rotation,
        };
    }

    #[inline]
    fn part(&mut self, between: DVec3) -> Option<Parted> {
        let sense = match self.ball {
            Place::First => 1.0,
            Place::Second => -1.0,
        };
        let local = self.rotation.transpose() * (sense * between);
        let beyond = (local.abs() - self.half).max(DVec3::ZERO);
        self.corner = beyond.cmpgt(DVec3::ZERO).all();
        let height = beyond.length();
        let gap = height - self.radius;
        (height > 0.0 && height < f64::INFINITY).then(|| Parted {
            normal: self.rotation * (beyond.copysign(local) * (sense / height)),
            gap,
            distance: gap,
        })
    }

    #[inline]
    fn turning(&self, window: &Window<'_, '_>, normal: DVec3) -> DVec3 {
        match (self.corner, self.ball) {
            (true, _) => DVec3::ZERO,
            (false, Place::First) => window.b.spin.cross(normal),
            (false, Place::Second) => window.a.spin.cross(normal),
        }
    }
}

/// Across what the widest gap of two boxes lies.
#[derive(Debug, Clone, Copy)]
enum Axis {
    A(usize),
    B(usize),
    Edges(usize, usize),
}

/// Two boxes: the widest of the gaps along fifteen axes. Where two boxes are apart one of them is.
pub(super) struct TurningBoxes {
    half: [[f64; 3]; 2],
    rotations: [DMat3; 2],
    axis: Axis,
}

/// Squared sine between two edges below which what is across both is left out.
const PARALLEL: f64 = 1e-20;

impl TurningBoxes {
    pub(super) fn new(a: &Cuboid, b: &Cuboid) -> Self {
        Self {
            half: [a.half_extents().to_array(), b.half_extents().to_array()],
            rotations: [DMat3::IDENTITY; 2],
            axis: Axis::A(0),
        }
    }
}

impl Planes for TurningBoxes {
    const DECIDES: bool = false;

    #[inline]
    fn turn(&mut self, a: &Instant<'_>, b: &Instant<'_>) {
        self.rotations = [a.rotation, b.rotation];
    }

    fn part(&mut self, between: DVec3) -> Option<Parted> {
        const NEXT: [usize; 3] = [1, 2, 0];
        const LAST: [usize; 3] = [2, 0, 1];
        let [of_a, of_b] = &self.rotations;
        let [a, b] = &self.half;
        // All in A's axes; columns are B's.
        let to_a = of_a.transpose();
        let turn = (to_a * *of_b).to_cols_array_2d();
        let size = turn.map(|column| column.map(f64::abs));
        let offset = (to_a * between).to_array();
        let (mut best, mut axis, mut normal) = (f64::NEG_INFINITY, Axis::A(0), DVec3::X);
        for i in 0..3 {
            let reach = a[i] + (b[0] * size[0][i] + b[1] * size[1][i] + b[2] * size[2][i]);
            let gap = offset[i].abs() - reach;
            if gap > best {
                (best, axis) = (gap, Axis::A(i));
                normal = of_a.col(i) * 1.0_f64.copysign(offset[i]);
            }
        }
        for j in 0..3 {
            let column = turn[j];
            let height = column[0] * offset[0] + column[1] * offset[1] + column[2] * offset[2];
            let reach = b[j] + (a[0] * size[j][0] + a[1] * size[j][1] + a[2] * size[j][2]);
            let gap = height.abs() - reach;
            if gap > best {
                (best, axis) = (gap, Axis::B(j));
                normal = of_b.col(j) * 1.0_f64.copysign(height);
            }
        }
        let mut edges = None;
        for j in 0..3 {
            for i in 0..3 {
                let (k, l) = (NEXT[i], LAST[i]);
                let (across, beyond) = (turn[j][k], turn[j][l]);
                let square = across * across + beyond * beyond;
                let height = offset[l] * across - offset[k] * beyond;
                let reach = a[k] * size[j][l]
                    + a[l] * size[j][k]
                    + b[NEXT[j]] * size[LAST[j]][i]
                    + b[LAST[j]] * size[NEXT[j]][i];
                // By the sine between the edges too long.
                let gap = height.abs() - reach;
                let wider = if best > 0.0 {
                    gap > 0.0 && gap * gap > best * best * square
                } else {
                    gap > 0.0
                };
                if wider && square > PARALLEL {
                    best = gap / square.sqrt();
                    edges = Some((i, j, height));
                }
            }
        }
        if let Some((i, j, height)) = edges {
            let cross = of_a.col(i).cross(of_b.col(j));
            axis = Axis::Edges(i, j);
            normal = cross.normalize_or(normal) * 1.0_f64.copysign(height);
        }
        self.axis = axis;
        best.is_finite().then_some(Parted {
            normal,
            gap: best,
            distance: best,
        })
    }

    #[inline]
    fn same(&mut self, a: &Instant<'_>, b: &Instant<'_>, between: DVec3) -> Option<Parted> {
        self.turn(a, b);
        let [of_a, of_b] = &self.rotations;
        let axis = match self.axis {
            Axis::A(i) => of_a.col(i),
            Axis::B(j) => of_b.col(j),
            Axis::Edges(i, j) => (of_a.col(i).cross(of_b.col(j))).try_normalize()?,
        };
        let height = axis.dot(between);
        let reach = |rotation: &DMat3, half: &[f64; 3]| {
            half[0] * axis.dot(rotation.x_axis).abs()
                + half[1] * axis.dot(rotation.y_axis).abs()
                + half[2] * axis.dot(rotation.z_axis).abs()
        };
        let gap = height.abs() - reach(of_a, &self.half[0]) - reach(of_b, &self.half[1]);
        Some(Parted {
            normal: axis * 1.0_f64.copysign(height),
            gap,
            distance: gap,
        })
    }

    #[inline]
    fn turning(&self, window: &Window<'_, '_>, normal: DVec3) -> DVec3 {
        match self.axis {
            Axis::A(_) => window.a.spin.cross(normal),
            Axis::B(_) => window.b.spin.cross(normal),
            Axis::Edges(i, j) => {
                let edges = [self.rotations[0].col(i), self.rotations[1].col(j)];
                across_edges(window, edges, normal)
            }
        }
    }
}
