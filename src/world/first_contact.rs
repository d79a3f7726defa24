//! The first contact of two bodies without a world.

use crate::error::{FirstContactError, StepError};
use crate::geometry::{Feature, Shape};
use crate::math::domain;
use crate::motion::{FrameMotion, Turning};
use crate::tolerance::{MAX_TIME_STEP, MIN_TIME_STEP};
use crate::world::pair::{Mover, PairEffort, Undecided, examine};
use crate::world::solver::Solver;
use crate::world::{Body, ContactKind, Method, balls};
use glam::DVec3;

/// A contact of a pair, before it is known which bodies these are in a world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairContact {
    /// When, as a share of the frame or horizon, in `0..=1`.
    pub fraction: f64,
    /// Where, in metres, with both bodies where they are at that time.
    pub point: DVec3,
    /// Unit normal, out of the second body towards the first.
    pub normal: DVec3,
    /// The parts that touch: of the first body, of the second.
    pub features: [Feature; 2],
    /// How it came about.
    pub kind: ContactKind,
}

impl PairContact {
    /// The point in the first body's own coordinates and in the second's, in metres.
    ///
    /// `horizon` is the one that was searched, in seconds.
    ///
    /// ```
    /// use feeler::{Body, Method, Motion, Sphere, first_contact};
    /// use glam::DVec3;
    ///
    /// let motion = Motion::free([3.0, 0.0, 0.0], [-1.0, 0.0, 0.0])?.spin([0.0, 0.0, 1.0], 2.0)?;
    /// let ball = Body::moving(Sphere::new(1.0)?, motion);
    /// let target = Body::fixed(Sphere::new(1.0)?, [0.0, 0.0, 0.0]);
    /// let contact = first_contact(&ball, &target, 2.0, &Method::default())?.expect("they meet");
    /// let [on_ball, on_target] = contact.local_points(&ball, &target, 2.0);
    /// assert!(on_target.distance(DVec3::X) < 1e-12);
    /// assert!((on_ball.length() - 1.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn local_points(&self, a: &Body, b: &Body, horizon: f64) -> [DVec3; 2] {
        let time = self.fraction * horizon;
        [a, b].map(|body| body.pose_after(time).local_point(self.point))
    }
}

/// First contact of two bodies within `horizon` seconds, without a world.
///
/// `a` is the first body whatever moves: the normal leads out of `b` towards
/// `a`, and where only one body sends rays it is `a`. Fractions count in
/// horizons. Both motions begin at once.
///
/// # Errors
/// As [`CollisionWorld::insert`](crate::CollisionWorld::insert),
/// [`CollisionWorld::new`](crate::CollisionWorld::new) and
/// [`CollisionWorld::step`](crate::CollisionWorld::step) for bodies, method and
/// horizon. [`FirstContactError::Undecided`] if bodies on curves or in rotation come or stay so near
/// to each other, without touching, that the search ran out of budget: they are proven
/// apart till then.
///
/// ```
/// use feeler::{Body, FirstContactError, Method, Motion, Sphere, first_contact};
///
/// let ball = Body::moving(Sphere::new(1.0)?, Motion::free([3.0, 0.0, 0.0], [-1.0, 0.0, 0.0])?);
/// let target = Body::fixed(Sphere::new(1.0)?, [0.0, 0.0, 0.0]);
/// let contact = first_contact(&ball, &target, 2.0, &Method::default())?;
/// assert_eq!(contact.map(|contact| contact.fraction), Some(0.5));
///
/// let never = first_contact(&ball, &target, -1.0, &Method::default());
/// assert!(matches!(never, Err(FirstContactError::Step(_))));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn first_contact(
    a: &Body,
    b: &Body,
    horizon: f64,
    method: &Method,
) -> Result<Option<PairContact>, FirstContactError> {
    if let Method::Rays(rays) = method {
        rays.checked()?;
    }
    let mut solver = Solver::new(*method);
    domain::within("horizon", horizon, MIN_TIME_STEP, MAX_TIME_STEP).map_err(StepError::from)?;
    let (turned_a, turned_b) = (a.check()?, b.check()?);
    if *method == Method::Exact
        && let (Some(a), Some(b)) = (flying_ball(a, horizon), flying_ball(b, horizon))
    {
        return Ok(balls::meet(a, b).map(|finding| finding.contact));
    }
    // Each where it stays: they are large to be copied.
    let frame_a = FrameMotion::new(a.motion(), 0.0, horizon);
    let frame_b = FrameMotion::new(b.motion(), 0.0, horizon);
    let [points_a, points_b] = [a, b].map(|body| solver.surface_points(body.shape()));
    let a = Mover::of(a, turned_a, &frame_a, &points_a);
    let b = Mover::of(b, turned_b, &frame_b, &points_b);
    let mut effort = PairEffort::default();
    let finding = examine(&mut solver, &a, &b, &mut effort);
    match finding {
        Ok(finding) => Ok(finding.map(|finding| finding.contact)),
        Err(Undecided { clear_until }) => Err(FirstContactError::Undecided { clear_until }),
    }
}

/// Flight and radius of a ball that follows no path and is not turned.
fn flying_ball(body: &Body, horizon: f64) -> Option<((DVec3, DVec3), f64)> {
    let (Shape::Sphere(ball), Turning::Not) = (body.shape(), body.motion().turning()) else {
        return None;
    };
    Some((body.motion().flight(0.0, horizon)?, ball.radius()))
}
