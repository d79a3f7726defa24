//! The frame loop of the thesis's program for two balls on curves, as its printed
//! points show it to have been.
//!
//! On curves the program did not do what the thesis describes; what the crate calls
//! the thesis's method, [`RayConfig::thesis`](feeler::RayConfig::thesis), follows the
//! text. This loop follows the program, so that its figures can be compared with. It is
//! a reconstruction: inferred from the points printed for scenes 7 to 9, as
//! nothing else is known of the program, and within 1 cm of them in scenes 7 and 9.
//!
//! - Tangents were not divided by 3 on the way from Hermite to Bézier. That is in
//!   the scene files, where paths with tangents three times as long stand.
//! - A body's place comes from a table of ten chords a piece (Table 2.1).
//! - Every other row of the grid on the hemisphere is turned by half a step.
//! - Rays in the plane of the paths never count, save the foremost one against a body at
//!   rest. Why, is not to be seen from the points.
//! - Two bodies that both move are looked at once they overlap as a frame begins, along
//!   their relative velocity there. What lies up to two frames ahead counts, and
//!   is reported where the bodies are as the frame begins.

use crate::accuracy::Touch;
use feeler::{ArcLengthTable, Body, Motion, Pose, Ray, RayCast, RayHit, Scene, Shape, Spline};
use glam::DVec3;

/// The first touch of the scene's first two bodies, which must be balls.
pub(crate) fn first_touch(scene: &Scene, rays: u32, frames: u64) -> Option<Touch> {
    let [a, b, ..] = scene.bodies.as_slice() else {
        return None;
    };
    let (a, b) = (Ball::new(&a.body)?, Ball::new(&b.body)?);
    // Who stands sends no rays.
    let (a, b) = if a.speed > 0.0 { (a, b) } else { (b, a) };
    let step = scene.time_step();
    let both_move = a.speed > 0.0 && b.speed > 0.0;
    (0..frames).find_map(|frame| {
        let time = frame as f64 * step;
        let end = (frame + 1) as f64 * step;
        let (from, to) = (a.place(time), b.place(time));
        let motion = if both_move {
            if from.distance(to) >= a.radius + b.radius {
                return None;
            }
            2.0 * step * (a.velocity(time) - b.velocity(time))
        } else {
            a.place(end) - from
        };
        let direction = motion.try_normalize()?;
        let normal_of_plane = direction.cross(to - from).normalize_or_zero();
        let hits = hemisphere(rays).filter_map(|point| {
            let offset = turn_zenith(direction, point);
            let foremost = offset.dot(direction) > 1.0 - 1e-12;
            let in_plane = offset.dot(normal_of_plane).abs() < 1e-9;
            if in_plane && (both_move || !foremost) {
                return None;
            }
            let ray = Ray::new(from + a.radius * offset, motion);
            match b.shape.first_hit_at(&Pose::at(to), &ray) {
                Some(RayHit::Surface(hit)) if hit.fraction <= 1.0 => Some((hit, ray)),
                _ => None,
            }
        });
        let (hit, ray) = hits.min_by(|x, y| x.0.fraction.total_cmp(&y.0.fraction))?;
        Some(Touch {
            time: if both_move {
                time
            } else {
                time + hit.fraction * step
            },
            point: ray.at(hit.fraction),
            normal: hit.normal,
        })
    })
}

/// A ball on its way.
struct Ball<'a> {
    shape: &'a Shape,
    radius: f64,
    motion: &'a Motion,
    /// In m/s.
    speed: f64,
    table: Option<(&'a Spline, ArcLengthTable)>,
}

impl<'a> Ball<'a> {
    fn new(body: &'a Body) -> Option<Self> {
        /// Rows a piece.
        const ROWS: usize = 10;
        let Shape::Sphere(sphere) = body.shape() else {
            return None;
        };
        let motion = body.motion();
        let spline = motion.path().and_then(|path| path.as_spline());
        let table = match spline {
            Some(spline) => Some((spline, ArcLengthTable::from_spline(spline, ROWS).ok()?)),
            None => None,
        };
        Some(Self {
            shape: body.shape(),
            radius: sphere.radius(),
            motion,
            speed: motion.velocity_after(0.0).length(),
            table,
        })
    }

    /// Where it is at `time`.
    fn place(&self, time: f64) -> DVec3 {
        let Some((spline, table)) = &self.table else {
            return self.motion.position_after(time);
        };
        let (piece, u) = table.locate(self.speed * time);
        spline.pieces()[piece].point(u)
    }

    /// Its velocity at `time`, estimated as the thesis does: from the path a little
    /// before and after.
    fn velocity(&self, time: f64) -> DVec3 {
        /// Metres before and after.
        const REACH: f64 = 0.01;
        let reach = REACH / self.speed;
        let around = self.place(time + reach) - self.place(time - reach);
        self.speed * around.normalize_or_zero()
    }
}

/// The program's grid on the unit hemisphere around `+y`: as the crate's
/// [`hemisphere_grid`](feeler::sampling::hemisphere_grid), but for the turn of every
/// other row.
fn hemisphere(count: u32) -> impl Iterator<Item = DVec3> {
    let steps = f64::from(count).sqrt();
    let rows = steps.ceil() as u32;
    (0..rows * rows).map(move |index| {
        let (row, column) = (index / rows, index % rows);
        let theta = f64::from(row) * 90.0 / steps;
        let phi = f64::from(2 * column + row % 2) * 180.0 / steps;
        let ((sin, cos), (across, along)) =
            (theta.to_radians().sin_cos(), phi.to_radians().sin_cos());
        DVec3::new(sin * along, cos, sin * across)
    })
}

/// A point around `+y` turned to lie around `direction`, as the crate turns its grid.
fn turn_zenith(direction: DVec3, point: DVec3) -> DVec3 {
    let azimuth = DVec3::new(direction.x, 0.0, direction.z).try_normalize();
    let azimuth = azimuth.unwrap_or(DVec3::X);
    let across = direction.dot(azimuth);
    let x = direction.y * azimuth - across * DVec3::Y;
    point.x * x + point.y * direction + point.z * azimuth.cross(DVec3::Y)
}
