//! Orthonormal frames.

use glam::DVec3;

/// Two unit vectors that with the unit vector `direction` form a right-handed
/// orthonormal frame `(x, y, direction)`.
///
/// Without branches near the poles and continuous but for one half-plane; of another length the
/// frame is askew. Duff et al., *Building an Orthonormal Basis, Revisited* (2017).
pub(crate) fn orthonormal(direction: DVec3) -> (DVec3, DVec3) {
    let sign = 1.0_f64.copysign(direction.z);
    let a = -1.0 / (sign + direction.z);
    let b = direction.x * direction.y * a;
    let x = DVec3::new(
        1.0 + sign * direction.x * direction.x * a,
        sign * b,
        -sign * direction.x,
    );
    let y = DVec3::new(b, sign + direction.y * direction.y * a, -direction.y);
    (x, y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_frame_is_orthonormal_and_right_handed_for_every_direction() {
        let mut seen = 0;
        for i in -6..=6 {
            for j in -6..=6 {
                for k in -6..=6 {
                    let Some(z) =
                        DVec3::new(f64::from(i), f64::from(j), f64::from(k)).try_normalize()
                    else {
                        continue;
                    };
                    let (x, y) = orthonormal(z);
                    assert!((x.cross(y) - z).length() < 1e-15, "direction {z}");
                    assert!(x.dot(y).abs() < 1e-15 && (x.length() - 1.0).abs() < 1e-15);
                    seen += 1;
                }
            }
        }
        assert_eq!(seen, 13 * 13 * 13 - 1);
    }
}
