//! Points on the half of a sphere that faces the motion.

use crate::math::frame::orthonormal;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The thesis's grid in spherical coordinates on the unit hemisphere around `+y`.
///
/// `√count` steps of θ from 0 at the zenith towards 90° and as many of φ from
/// 0° to 360°, where `√count` is no integer the last step is cut short; the
/// zenith itself counts `√count` times, as it does there. One ray is the
/// foremost point.
///
/// Every other row is turned by half a turn against what §3.7 prints: with it
/// the contact points in the thesis's table 4.2 come out to the printed digits
/// in nine rows of twelve (not for 64, 100 and 400 rays), without it in five.
///
/// Source: the thesis, §3.7.
///
/// ```
/// use feeler::sampling::hemisphere_grid;
/// use glam::DVec3;
///
/// assert_eq!(hemisphere_grid(1), [DVec3::Y]);
/// assert_eq!(hemisphere_grid(81).len(), 81);
/// ```
#[must_use]
pub fn hemisphere_grid(count: u32) -> Vec<DVec3> {
    if count <= 1 {
        return vec![DVec3::Y; count as usize];
    }
    let steps = f64::from(count).sqrt();
    let rows = steps.ceil() as u32;
    let mut points = Vec::with_capacity((rows * rows) as usize);
    for row in 0..rows {
        let theta = f64::from(row) * FRAC_PI_2 / steps;
        let turned = if row % 2 == 0 { PI } else { 0.0 };
        for column in 0..rows {
            let phi = f64::from(column) * TAU / steps + turned;
            points.push(DVec3::new(
                libm::sin(theta) * libm::cos(phi),
                libm::cos(theta),
                libm::sin(theta) * libm::sin(phi),
            ));
        }
    }
    points
}

/// Turns points around `+y` to points around the unit vector `direction` as the
/// thesis does: about `z` by the direction's polar angle, then about `y` by its azimuth.
pub(crate) fn turn_zenith(direction: DVec3) -> impl Fn(DVec3) -> DVec3 {
    let across = direction.x.hypot(direction.z);
    let azimuth = if across > 0.0 {
        DVec3::new(direction.x / across, 0.0, direction.z / across)
    } else {
        DVec3::X
    };
    let x = direction.y * azimuth - across * DVec3::Y;
    let z = azimuth.cross(DVec3::Y);
    move |point| point.x * x + point.y * direction + point.z * z
}

/// `count` points spread evenly over the unit hemisphere around the unit vector
/// `direction`, each standing for the same share of the *disc* that the
/// hemisphere shows to the motion.
///
/// Equal shares of the disc are what rays along the motion need: seen from
/// ahead, no region is more crowded than another. The points lie on a spiral
/// turned by the golden angle from one to the next, the first nearest the
/// middle.
///
/// Source: Vogel, *A better way to construct the sunflower head* (1979).
///
/// ```
/// use feeler::sampling::hemisphere_even;
/// use glam::DVec3;
///
/// let points = hemisphere_even(100, DVec3::X);
/// assert!(points.iter().all(|p| p.x > 0.0 && (p.length() - 1.0).abs() < 1e-12));
/// ```
#[must_use]
pub fn hemisphere_even(count: u32, direction: DVec3) -> Vec<DVec3> {
    /// Cosine and sine of the golden angle `π(3 − √5)`.
    const TURN: (f64, f64) = (-0.737_368_878_078_319_6, 0.675_490_294_261_523_8);
    let (x, y) = orthonormal(direction);
    let (mut cos, mut sin) = (1.0, 0.0);
    let mut points = Vec::with_capacity(count as usize);
    for index in 0..count {
        // A single ray is the foremost point.
        let share = if count == 1 {
            0.0
        } else {
            (f64::from(index) + 0.5) / f64::from(count)
        };
        let radius = share.sqrt();
        points.push(radius * cos * x + radius * sin * y + (1.0 - share).sqrt() * direction);
        (cos, sin) = (cos * TURN.0 - sin * TURN.1, sin * TURN.0 + cos * TURN.1);
        // Repeated turning drifts off the unit circle by an ulp a step.
        let length = (cos * cos + sin * sin).sqrt();
        (cos, sin) = (cos / length, sin / length);
    }
    points
}
