//! Where the shadows of two bodies overlap.

use crate::narrow_phase::rays::shadow::Shadow;
use glam::DVec2;

/// The part of the plane across the motion where a ray can start on one body
/// and end on the other, mapped from the square `[−1, 1]²`.
///
/// A grazing pair's shadows overlap in a sliver; rays spread over the whole
/// body would miss it, however many they are.
pub(super) enum Aim {
    /// Two discs, the second's centre on the view's x axis.
    Lens {
        radii: [f64; 2],
        centre_b: f64,
        min: f64,
        max: f64,
    },
    /// Any two shapes: where the rectangles around their shadows overlap.
    Rectangle {
        min: DVec2,
        max: DVec2,
        /// What is this far outside may be on the border.
        slack: f64,
    },
}

impl Aim {
    /// None if the shadows lie apart: no ray can connect the two bodies.
    pub(super) fn new(a: &Shadow<'_>, b: &Shadow<'_>) -> Option<Self> {
        // A shadow of no width, a triangle's seen edge-on, still is one.
        let slack = a.slack() + b.slack();
        if let (Some(radius_a), Some(radius_b)) = (a.disc(), b.disc()) {
            let centre_b = b.centre.x - a.centre.x;
            let (min, max) = (
                f64::max(-radius_a, centre_b - radius_b),
                radius_a.min(centre_b + radius_b),
            );
            return (min <= max + slack).then_some(Self::Lens {
                radii: [radius_a, radius_b],
                centre_b,
                min: min.min(max),
                max,
            });
        }
        let (min, max) = (a.min.max(b.min), a.max.min(b.max));
        min.cmple(max + slack).all().then_some(Self::Rectangle {
            min: min.min(max),
            max,
            slack,
        })
    }

    /// The point of the plane for a point of the square.
    pub(super) fn point(&self, at: DVec2) -> DVec2 {
        match self {
            Self::Lens {
                radii,
                centre_b,
                min,
                max,
            } => {
                let x = 0.5 * (min + max) + 0.5 * (max - min) * at.x;
                let height = |radius: f64, x: f64| f64::max((radius - x) * (radius + x), 0.0);
                let y = at.y * f64::min(height(radii[0], x), height(radii[1], x - centre_b)).sqrt();
                DVec2::new(x, y)
            }
            Self::Rectangle { min, max, .. } => 0.5 * (*min + *max) + 0.5 * (*max - *min) * at,
        }
    }

    /// Adds [`point`](Self::point) for each of many.
    pub(super) fn points(&self, lattice: &[DVec2], xs: &mut Vec<f64>, ys: &mut Vec<f64>) {
        let before = xs.len();
        // One array after the other, so that the compiler does several points at a time.
        match *self {
            Self::Lens {
                radii,
                centre_b,
                min,
                max,
            } => {
                let (middle, half) = (0.5 * (min + max), 0.5 * (max - min));
                xs.extend(lattice.iter().map(|at| middle + half * at.x));
                let height = |radius: f64, x: f64| f64::max((radius - x) * (radius + x), 0.0);
                ys.extend(lattice.iter().zip(&xs[before..]).map(|(at, &x)| {
                    at.y * f64::min(height(radii[0], x), height(radii[1], x - centre_b)).sqrt()
                }));
            }
            Self::Rectangle { min, max, .. } => {
                let (middle, half) = (0.5 * (min + max), 0.5 * (max - min));
                xs.extend(lattice.iter().map(|at| middle.x + half.x * at.x));
                ys.extend(lattice.iter().map(|at| middle.y + half.y * at.y));
            }
        }
    }

    /// The point of the square for a point of the plane; the inverse of [`point`](Self::point).
    pub(super) fn square(&self, point: DVec2) -> DVec2 {
        let middle = self.point(DVec2::ZERO);
        let x = match self {
            Self::Lens { min, max, .. } => share(point.x - middle.x, 0.5 * (max - min)),
            Self::Rectangle { min, max, .. } => share(point.x - middle.x, 0.5 * (max.x - min.x)),
        };
        let height = self.point(DVec2::new(x, 1.0)).y - middle.y;
        DVec2::new(x, share(point.y - middle.y, height))
    }

    /// The part of the segment that lies over the aim, as shares of the segment.
    ///
    /// The vertex that is the farthest to one side lies on the border, and
    /// rounding must not put it outside.
    pub(super) fn clip(&self, from: DVec2, to: DVec2) -> Option<(f64, f64)> {
        let (min, max) = match self {
            Self::Lens { .. } => return Some((0.0, 1.0)),
            Self::Rectangle { min, max, slack } => (*min - *slack, *max + *slack),
        };
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let along = to[axis] - from[axis];
            if along.abs() > 0.0 {
                let (a, b) = (
                    (min[axis] - from[axis]) / along,
                    (max[axis] - from[axis]) / along,
                );
                enter = enter.max(a.min(b));
                leave = leave.min(a.max(b));
            } else if from[axis] < min[axis] || from[axis] > max[axis] {
                return None;
            }
        }
        (enter <= leave).then_some((enter, leave))
    }
}

/// `part` as a share of `whole`, within the square; in the middle where there is nothing to share.
fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 {
        (part / whole).clamp(-1.0, 1.0)
    } else {
        0.0
    }
}
