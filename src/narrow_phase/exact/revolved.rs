//! The solids that bodies fill as they turn.

use super::flight::{Flight, Instant};
use super::window::Window;
use crate::motion::Turning;
use glam::DVec3;

/// Steps towards the direction in which two solids are farthest apart.
const ROUNDS: u32 = 24;

/// A gap is good enough that is such a share of the widest there can be.
const GOOD: f64 = 0.9;

/// When solids are looked at: after many steps, and then again and again as long as it pays.
///
/// Who spins fast, jumps in a cusp or flies tiny laps is followed turn for turn only where the other is
/// within reach.
pub(super) struct Patience {
    steps: u32,
    limit: u32,
}

impl Patience {
    pub(super) const NEW: Self = Self {
        steps: 0,
        limit: Self::STEPS,
    };

    const STEPS: u32 = 16;

    /// One step more; whether it is time to look, which next comes after twice as many.
    pub(super) fn is_over(&mut self) -> bool {
        self.steps += 1;
        let over = self.steps >= self.limit;
        if over {
            self.steps = 0;
            self.limit = self.limit.saturating_mul(2).max(Self::STEPS);
        }
        over
    }

    /// It paid: at the next step again.
    pub(super) fn paid(&mut self) {
        self.limit = 1;
    }
}

/// The direction in which what two bodies fill is about as far apart as can be, out of B towards A,
/// and how far; none if no gap was found.
///
/// A body that spins fills a solid of revolution about its axis, one that does not turn itself, and any other the
/// ball about its hub. `towards` is a first guess.
///
/// Source: Gilbert, *An Iterative Procedure for Computing the Minimum of a Quadratic Form on a Convex Set*
/// (1966).
pub(super) fn apart(
    (a, b): (&Flight<'_>, &Flight<'_>),
    window: &Window<'_, '_>,
    towards: DVec3,
) -> Option<(DVec3, f64)> {
    let lowest = |normal: DVec3| {
        let of_a = lowest_ever(a, window.a.instant, normal);
        window.offset + of_a - lowest_ever(b, window.b.instant, -normal)
    };
    let rounding = 64.0 * f64::EPSILON * (window.offset.length() + a.reach + b.reach);
    let mut point = lowest(towards);
    let mut best = None;
    let mut widest = 0.0;
    for _ in 0..ROUNDS {
        let length = point.length();
        let normal = point / length;
        let least = lowest(normal);
        let gap = normal.dot(least) - window.radii - rounding;
        if gap > widest {
            (best, widest) = (Some((normal, gap)), gap);
        }
        let way = least - point;
        let share = -point.dot(way) / way.length_squared();
        // NaN, where nothing is left to gain or the solids share the point.
        if widest > GOOD * (length - window.radii) || share.is_nan() || share <= 0.0 {
            break;
        }
        point += share.min(1.0) * way;
    }
    best
}

/// From the hub to the point that lies least far along a unit vector of all that the core ever fills.
fn lowest_ever(flight: &Flight<'_>, instant: &Instant<'_>, normal: DVec3) -> DVec3 {
    let spin = match flight.motion.turning() {
        Turning::Not => return instant.lowest(normal),
        Turning::Facing(_) => return -flight.arm * normal,
        Turning::Spin(spin) => spin,
    };
    let axis = spin.axis();
    let own_axis = flight.orientation.conjugate() * axis;
    let along = normal.dot(axis);
    let aside = normal - along * axis;
    let sine = aside.length();
    let (mut least, mut place) = (f64::INFINITY, (0.0, 0.0));
    flight.each_vertex(|vertex| {
        let offset = vertex - flight.hub;
        let height = offset.dot(own_axis);
        let radius = (offset - height * own_axis).length();
        let low = height * along - radius * sine;
        if low < least {
            (least, place) = (low, (height, radius));
        }
    });
    let (height, radius) = place;
    let out = if sine > 0.0 {
        aside / sine
    } else {
        DVec3::ZERO
    };
    height * axis - radius * out
}
