//! A stretch of one cubic, and bounds on what it does there.

use crate::curve::CubicBezier;
use crate::curve::jounce::jounce;
use glam::DVec3;

/// The velocity over a stretch of a cubic, as a quadratic Bézier curve of its own.
///
/// All it bounds follows from the hull of its three control points: a quadratic
/// Bézier curve is their weighted mean, with weights that are not negative.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Section {
    /// Control points of the derivative by the cubic's parameter.
    velocity: [DVec3; 3],
    /// How far the parameter goes; negative if the stretch is passed backwards.
    width: f64,
    /// 1, or −1 if it is passed backwards.
    sense: f64,
}

impl Section {
    /// The stretch of `curve` between two parameters, passed from the first to the
    /// second, which is `forward` if the second is greater.
    pub(crate) fn of(curve: &CubicBezier, [u_from, u_to]: [f64; 2], forward: bool) -> Self {
        let [v0, v1, v2] = curve.velocity();
        let mix = |u: f64, a: DVec3, b: DVec3| (1.0 - u) * a + u * b;
        // The blossom: what is linear in each of two parameters, and the curve
        // where both are the same.
        let blossom = |a: f64, b: f64| mix(b, mix(a, v0, v1), mix(a, v1, v2));
        Self {
            velocity: [
                blossom(u_from, u_from),
                blossom(u_from, u_to),
                blossom(u_to, u_to),
            ],
            width: u_to - u_from,
            sense: if forward { 1.0 } else { -1.0 },
        }
    }

    /// Unit tangents at both ends, in the direction of flight; zero in a cusp.
    pub(crate) fn end_tangents(&self) -> [DVec3; 2] {
        [self.velocity[0], self.velocity[2]].map(|v| self.sense * v.normalize_or_zero())
    }

    /// A cone around all tangents, in the direction of flight; none if they have no
    /// direction in common, as beside a cusp.
    pub(crate) fn tangents(&self) -> Option<TangentCone> {
        let units = self
            .velocity
            .map(|velocity| self.sense * velocity.normalize_or_zero());
        let axis = (units[0] + units[1] + units[2]).try_normalize()?;
        // A control point that vanishes adds nothing to any mean.
        let cosine = units
            .into_iter()
            .filter(|unit| *unit != DVec3::ZERO)
            .map(|unit| unit.dot(axis))
            .fold(1.0, f64::min);
        // Some ulp wider than computed.
        let cosine = cosine - 8.0 * f64::EPSILON;
        (cosine > 0.0).then(|| TangentCone {
            axis,
            cosine,
            sine: ((1.0 - cosine) * (1.0 + cosine)).sqrt(),
        })
    }

    /// An upper bound on the curvature, per metre; infinite beside a cusp.
    ///
    /// With the velocity's control points `w` and the parameter `x` over the
    /// stretch, `v × v' = 2(x̄² w0×w1 + x̄x w0×w2 + x² w1×w2)` with `x̄ = 1 − x`:
    /// a quadratic Bézier curve again, no larger than its control points. The
    /// curvature is its size over `|v|³`, and `|v|` is at least the least
    /// share of a control point along the axis of the cone of tangents.
    pub(crate) fn curvature(&self) -> f64 {
        self.tangents()
            .map_or(f64::INFINITY, |cone| self.curvature_within(&cone))
    }

    fn curvature_within(&self, cone: &TangentCone) -> f64 {
        let [a, b, c] = self.velocity;
        let slowest = cone.slowest(&self.velocity);
        // Over the stretch, both by its own parameter: one width in v', none in
        // the velocities here, which are by the cubic's.
        let cross = a
            .cross(b)
            .length()
            .max(0.5 * a.cross(c).length())
            .max(b.cross(c).length());
        let bound = 2.0 * cross / (self.width.abs() * slowest * slowest * slowest);
        // 0/0 of a straight stretch that halts: nothing is known.
        if bound.is_nan() {
            f64::INFINITY
        } else {
            bound * (1.0 + 32.0 * f64::EPSILON)
        }
    }

    /// An upper bound of the fourth derivative by arc length, per cubic metre; infinite beside a cusp.
    pub(crate) fn jounce(&self) -> f64 {
        jounce(&self.velocity, self.width)
    }

    /// Upper bounds of how the angular velocity of a body that keeps `up` upright changes with the distance
    /// flown; none beside a cusp, and where the stretch may go straight up.
    ///
    /// With the velocity's height `z` and its level share `h`, the heading turns by `g/(h²|v|)` a metre, where
    /// `g = (h × h')·up`, and the climb by `(h·y)/(|h||v|³)` about the level axis across `h`, where
    /// `y = z'h − zh'`. Both `g` and `y` are quadratic Bézier curves again, and the derivatives of those rates
    /// by distance are bounded term by term.
    pub(crate) fn sway(&self, up: DVec3) -> Option<Sway> {
        let rate = 1.0 / self.width.abs();
        let heights = self.velocity.map(|velocity| velocity.dot(up));
        let [a, b, c] = self.velocity;
        let [za, zb, zc] = heights;
        let [ha, hb, hc] = [a - za * up, b - zb * up, c - zc * up];
        let least = |[a, b, c]: [DVec3; 3]| {
            let axis = a + b + c;
            axis.dot(a).min(axis.dot(b)).min(axis.dot(c)) / axis.length()
        };
        let (slowest, levelest) = (least([a, b, c]), least([ha, hb, hc]));
        // NaN, of an axis that vanishes, is none.
        if slowest.is_nan() || slowest <= 0.0 || levelest.is_nan() || levelest <= 0.0 {
            return None;
        }
        let (zt, ht) = ((za - zb) + (zc - zb), (ha - hb) + (hc - hb));
        let change = 2.0 * rate * (b - a).length().max((c - b).length());
        let most = |ab: f64, ac: f64, bc: f64| 2.0 * rate * ab.max(0.5 * ac).max(bc);
        let most_twice = |a: f64, b: f64, c: f64| 2.0 * rate * rate * a.max(b).max(c);
        let cross = |h: DVec3, k: DVec3| h.cross(k).length();
        let g = most(cross(ha, hb), cross(ha, hc), cross(hb, hc));
        let g_change = most_twice(cross(ht, ha), cross(ht, hb), cross(ht, hc));
        let skew = |(z, h): (f64, DVec3), (w, k): (f64, DVec3)| (z * k - w * h).length();
        let (at_a, at_b, at_c, twice) = ((za, ha), (zb, hb), (zc, hc), (zt, ht));
        let y = most(skew(at_a, at_b), skew(at_a, at_c), skew(at_b, at_c));
        let y_change = most_twice(skew(twice, at_a), skew(twice, at_b), skew(twice, at_c));
        let (v, h) = (1.0 / slowest, 1.0 / levelest);
        let heading = (g_change + g * change * (2.0 * h + v)) * (h * v) * (h * v);
        let climb = (y_change + 2.0 * y * g * h * h + 3.0 * y * change * v) * (v * v) * (v * v);
        let sway = Sway {
            up,
            heading: heading * (1.0 + 64.0 * f64::EPSILON),
            climb: climb * (1.0 + 64.0 * f64::EPSILON),
        };
        (sway.heading + sway.climb).is_finite().then_some(sway)
    }

    /// What bounds the share of the curvature along any vector; none beside a cusp.
    pub(crate) fn bending(&self) -> Option<Bending> {
        let cone = self.tangents()?;
        let curvature = self.curvature_within(&cone);
        let [a, b, c] = self.velocity;
        let slowest = cone.slowest(&self.velocity);
        let change = (b - a).length().max((c - b).length());
        (curvature < f64::INFINITY).then_some(Bending {
            velocity: self.velocity,
            slowest,
            change,
            width: self.width.abs(),
            curvature,
        })
    }
}

/// How much the angular velocity changes at most of a body that keeps upright.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sway {
    /// Unit vector.
    pub(crate) up: DVec3,
    /// About up.
    pub(crate) heading: f64,
    /// About level axes.
    pub(crate) climb: f64,
}

impl Sway {
    /// Of what does not turn, or evenly.
    pub(crate) const NONE: Self = Self {
        up: DVec3::ZERO,
        heading: 0.0,
        climb: 0.0,
    };

    /// Whatever about.
    pub(crate) fn most(&self) -> f64 {
        self.heading + self.climb
    }

    /// How much the cross product of angular velocity and a vector changes at most.
    pub(crate) fn across(&self, direction: DVec3) -> f64 {
        self.heading * self.up.cross(direction).length() + self.climb * direction.length()
    }

    /// By time, in frames, at `speed` metres per frame.
    pub(crate) fn at_speed(self, speed: f64) -> Self {
        Self {
            heading: speed * speed * self.heading,
            climb: speed * speed * self.climb,
            ..self
        }
    }
}

/// How much a stretch of a cubic bends at most.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bending {
    velocity: [DVec3; 3],
    /// The velocity is at least this, by the parameter.
    slowest: f64,
    /// Its control points differ by this at most.
    change: f64,
    width: f64,
    /// Per metre.
    curvature: f64,
}

impl Bending {
    /// An upper bound on the share of the curvature along a vector, per metre and in the vector's
    /// length.
    ///
    /// With the unit tangent `T = v/|v|`, the curvature vector is `(v' − (v'·T) T)/|v|²`: where
    /// neither velocity nor its change has a share along the vector, there is none.
    pub(crate) fn along(&self, direction: DVec3) -> f64 {
        let [a, b, c] = self.velocity.map(|velocity| velocity.dot(direction));
        let change = (b - a).abs().max((c - b).abs());
        let tangent = a.abs().max(b.abs()).max(c.abs()) / self.slowest;
        let bound =
            2.0 * (change + tangent * self.change) / (self.width * self.slowest * self.slowest);
        // Of a NaN the other is taken.
        let bound = bound.min(self.curvature * direction.length());
        bound * (1.0 + 32.0 * f64::EPSILON)
    }
}

/// Unit vectors within some angle, less than a right one, of an axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TangentCone {
    axis: DVec3,
    cosine: f64,
    sine: f64,
}

impl TangentCone {
    /// The least share along the axis of velocities in the cone.
    fn slowest(&self, velocities: &[DVec3; 3]) -> f64 {
        let [a, b, c] = velocities.map(|velocity| velocity.dot(self.axis).abs());
        a.min(b).min(c)
    }

    /// The least sine of the angle between a vector in the cone and the line along
    /// the unit vector `direction`.
    pub(crate) fn least_aside(&self, direction: DVec3) -> f64 {
        let cosine = self.axis.dot(direction).abs();
        let sine = self.axis.cross(direction).length();
        (sine * self.cosine - cosine * self.sine - 8.0 * f64::EPSILON).max(0.0)
    }
}
