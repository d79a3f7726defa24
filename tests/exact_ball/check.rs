//! One cast against the oracle.

use crate::draw::{Cast, Draw};
use crate::oracle::{Flight, Surface, answer};
use crate::twofold::dot;
use feeler::narrow_phase::exact::{Crossing, Touching, ball_crossing, ball_touch};
use feeler::{Feature, Shape};
use glam::DVec3;

/// The crossing, whose way in must be the touch.
pub(crate) fn cast(cast: &Cast) -> Option<Crossing> {
    let crossing = ball_crossing(
        &cast.ball,
        cast.position,
        &cast.shape,
        cast.orientation,
        cast.motion,
    );
    let touch = ball_touch(
        &cast.ball,
        cast.position,
        &cast.shape,
        cast.orientation,
        cast.motion,
    );
    // A touch at a fraction whose other end is beyond all numbers is no crossing.
    if let Some(crossing) = crossing {
        assert_eq!(touch, Some(crossing.enter), "{cast:?}");
    } else if let Some(touch) = touch {
        assert!(touch.fraction.abs() > 1e200, "{cast:?} {touch:?}");
    }
    crossing
}

/// What one cast came to.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Checked {
    pub(crate) hit: bool,
    /// Gap or overlap left at the touch, as a share of the pair's size.
    pub(crate) gap: f64,
    /// Off the right normal, in radians.
    pub(crate) turn: f64,
    /// Whether there was just one feature to be told.
    pub(crate) unique: bool,
}

pub(crate) fn size(cast: &Cast) -> f64 {
    cast.ball.radius() + cast.shape.centre().length() + cast.shape.max_dist()
}

/// Whether the plane of a touch holds the shape back and touches the ball, to within so many metres.
fn parts_within(input: &Cast, touch: &Touching, rounding: f64) -> bool {
    let centre = input.position + touch.fraction * input.motion;
    let summit = Draw::summit(&input.shape, input.orientation.conjugate() * touch.normal);
    let gap = touch.normal.dot(centre - input.orientation * summit) - input.ball.radius();
    gap.abs() <= rounding
}

/// Checks one cast against the oracle.
pub(crate) fn check(input: &Cast) -> Checked {
    let surface = Surface::of(&input.shape, input.orientation);
    let (got, want) = (cast(input), answer(input, surface.as_ref(), 0.0));
    let size = size(input);
    let about = || format!("{input:?}\ngot  {got:?}\nwant {want:?}");
    let graze = 1e-9 * size;
    let Some(got) = got else {
        if want.is_some() && input.ball.radius() > graze {
            let smaller = answer(input, surface.as_ref(), -graze);
            assert!(smaller.is_none(), "a miss: {}", about());
        }
        return Checked::default();
    };
    let truly = want.is_some();
    let Some(want) = want.or_else(|| answer(input, surface.as_ref(), graze)) else {
        panic!("a ghost: {}", about());
    };
    let speed = input.motion.length();
    let rounding = 1e-12 * size + 4.5 * f64::EPSILON * input.position.length();
    let flight = Flight::of(input, 0.0);
    let mut checked = Checked {
        hit: true,
        ..Checked::default()
    };
    let mut gap_at = |fraction: f64| {
        let centre = flight.at(fraction);
        let gap = match (&surface, &input.shape) {
            (Some(surface), _) => surface.distance(centre) - flight.radius.0,
            (None, Shape::Sphere(other)) => {
                dot(centre, centre).sqrt().0 - flight.radius.0 - other.radius()
            }
            _ => f64::NAN,
        };
        assert!(gap.abs() <= rounding, "{gap:e} m are left: {}", about());
        checked.gap = checked.gap.max(gap.abs() / size);
    };
    gap_at(got.enter.fraction);
    gap_at(got.leave);
    assert!(got.enter.fraction <= got.leave, "{}", about());
    // Fractions, which are as far off as the line grazes.
    let back = Cast {
        motion: -input.motion,
        ..input.clone()
    };
    let last = answer(&back, surface.as_ref(), 0.0);
    let ends = [
        (got.enter.fraction, want.enter, want.normal),
        (
            got.leave,
            want.leave,
            last.map_or(DVec3::ZERO, |last| last.normal),
        ),
    ];
    for (got, want, normal) in ends {
        let off = (got - want).abs() * normal.dot(input.motion).abs();
        let grazing = !truly || normal.dot(input.motion).abs() < 1e-6 * speed;
        assert!(
            grazing || off <= 4.0 * rounding,
            "off by {off:e} m: {}",
            about()
        );
    }
    let normal = got.enter.normal;
    assert!((normal.length() - 1.0).abs() < 1e-12, "{}", about());
    let steepness = -want.normal.dot(input.motion) / speed;
    checked.turn = normal.cross(want.normal).length();
    assert!(
        normal.dot(want.normal) > 0.0 || steepness < 1e-6,
        "{}",
        about()
    );
    if truly && steepness > 1e-4 {
        let allowed = 1e-6 + 64.0 * f64::EPSILON * input.position.length() / input.ball.radius();
        // Of faces that are nearly one plane rounding in the coordinates tells which is touched: then the
        // normal parts as well as the right one does.
        let rim = checked.turn > allowed;
        let allowed = allowed.max(checked.turn);
        assert!(
            !rim || parts_within(input, &got.enter, rounding),
            "turned by {:e}: {}",
            checked.turn,
            about()
        );
        let off = got.enter.point.distance(want.foot) * steepness;
        // On a sliver's edge the foot is as well known as the normal.
        let allowed = 16.0 * rounding + allowed * input.ball.radius().min(size);
        assert!(off <= allowed, "the point is off by {off:e} m: {}", about());
        assert_eq!(got.enter.features[0], Feature::Surface);
        if let Some(feature) = want.feature
            && !rim
        {
            checked.unique = true;
            assert_eq!(got.enter.features[1], feature, "{}", about());
        }
    } else {
        checked.turn = 0.0;
    }
    checked
}
