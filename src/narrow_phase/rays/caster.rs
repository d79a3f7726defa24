//! The shortest ray between two bodies.

use crate::geometry::{Feature, Mesh, Pose, Shape};
use crate::narrow_phase::rays::aim::Aim;
use crate::narrow_phase::rays::refine::{search_area, search_edge};
use crate::narrow_phase::rays::shadow::{Shadow, Side, View};
use crate::narrow_phase::rays::starts::{Origin, Outline, Starts, gaps_ahead, gaps_behind};
use crate::narrow_phase::rays::{Placement, RayConfig, Refinement, Senders};
use crate::sampling::{
    UnitStream, hemisphere_even, hemisphere_grid, square_lattice, triangle_even, triangle_thesis,
};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A body as a stretch of straight relative motion begins.
#[derive(Clone, Copy)]
pub(crate) struct Standing<'a> {
    pub(crate) shape: &'a Shape,
    pub(crate) pose: &'a Pose,
    /// What [`RayCaster::surface_points`] gave for the shape.
    pub(crate) points: &'a [DVec3],
}

/// The shortest ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RayTouch {
    /// Its length as a share of the relative motion, `0..=1`.
    pub(crate) fraction: f64,
    /// Its end on the second body, from the first body's bounding centre, both
    /// as the stretch begins.
    pub(crate) offset: DVec3,
    /// Unit normal, out of the second body.
    pub(crate) normal: DVec3,
    /// Features of the first and of the second body.
    pub(crate) features: [Feature; 2],
}

/// Casts the rays of all pairs; keeps its buffers from one to the next.
pub(crate) struct RayCaster {
    config: RayConfig,
    /// Starting points over the square, for aimed rays.
    lattice: Vec<DVec2>,
    /// Starting points on the unit hemisphere around +y, for the others.
    hemisphere: Vec<DVec3>,
    /// Unit vectors that turn the refinement from round to round.
    turns: Vec<DVec2>,
    ahead: Starts,
    behind: Starts,
    gaps: Vec<f64>,
    refined: Starts,
    depths: Vec<f64>,
}

/// A ray found to be the shortest so far.
#[derive(Clone, Copy)]
struct Shortest {
    at: DVec2,
    gap: f64,
    origin: Origin,
    /// Whether it was sent back by the second body.
    behind: bool,
}

/// How much shorter a ray sent back must be to be preferred, as a share of the pair's size.
///
/// Where two edges meet both bodies' rays find the same touch, and rounding
/// would choose between their normals.
const PREFERENCE: f64 = 1e-9;

impl RayCaster {
    pub(crate) fn new(config: RayConfig) -> Self {
        let first = first_rays(&config);
        let (lattice, hemisphere) = match config.placement {
            Placement::Aimed => (square_lattice(first, config.seed), Vec::new()),
            Placement::Thesis => (Vec::new(), hemisphere_grid(first)),
            Placement::Even => (Vec::new(), hemisphere_even(first, DVec3::Y)),
        };
        let mut stream = UnitStream::new(config.seed);
        let turns = (0..61)
            .map(|_| {
                let angle = stream.next() * TAU / 6.0;
                DVec2::new(libm::cos(angle), libm::sin(angle))
            })
            .collect();
        Self {
            config,
            lattice,
            hemisphere,
            turns,
            ahead: Starts::default(),
            behind: Starts::default(),
            gaps: Vec::new(),
            refined: Starts::default(),
            depths: Vec::new(),
        }
    }

    pub(crate) fn config(&self) -> &RayConfig {
        &self.config
    }

    /// Starting points on a shape that do not depend on the motion, in its own frame.
    pub(crate) fn surface_points(&self, shape: &Shape) -> Vec<DVec3> {
        let draw = match self.config.placement {
            Placement::Thesis => triangle_thesis,
            Placement::Even => triangle_even,
            Placement::Aimed => return Vec::new(),
        };
        let Some(mesh) = Mesh::of(shape) else {
            return Vec::new();
        };
        let mut points = Vec::with_capacity(mesh.triangles.len() * self.config.rays as usize);
        for (index, triangle) in mesh.triangles.iter().enumerate() {
            let corners = triangle.map(|vertex| mesh.vertices[vertex as usize]);
            // The thesis starts its generator afresh in every triangle.
            let seed = match self.config.placement {
                Placement::Thesis => self.config.seed,
                Placement::Even | Placement::Aimed => self.config.seed.wrapping_add(index as u64),
            };
            points.extend(draw(corners, self.config.rays, seed));
        }
        points
    }

    /// The shortest ray between two bodies, if it is no longer than `motion`.
    ///
    /// `between` leads from the first bounding centre to the second, `motion` is
    /// the first body's relative to the second's. Bodies up to `touch` metres
    /// deep in each other count as touching. Adds the rays cast to `rays`.
    pub(crate) fn shortest_ray(
        &mut self,
        (a, b): (Standing<'_>, Standing<'_>),
        between: DVec3,
        motion: DVec3,
        touch: f64,
        rays: &mut u64,
    ) -> Option<RayTouch> {
        let length = motion.length();
        let direction = motion / length;
        if !direction.is_finite() || !between.is_finite() {
            // No motion, or one too short to have a direction.
            return None;
        }
        let view = View::along(direction, between);
        let centre_b = view.coordinates(between);
        let shadow_a = Shadow::new(a.shape, a.pose, view, DVec3::ZERO);
        let shadow_b = Shadow::new(b.shape, b.pose, view, centre_b);
        let aim = Aim::new(&shadow_a, &shadow_b)?;
        let outlines = [
            Outline::new(a.shape, a.pose, view, DVec3::ZERO),
            Outline::new(b.shape, b.pose, view, centre_b),
        ];
        let scene = Scene {
            view,
            shadow_a,
            shadow_b,
            aim,
            outlines,
            touch,
            longest: length,
        };

        self.place(&scene, (a, b));
        *rays += (self.ahead.len() + self.behind.len()) as u64;
        let best = self.cast_all(&scene);
        let best = self.refine(&scene, best, rays)?;
        scene.touch(best)
    }

    /// Fills in where the first rays start.
    fn place(&mut self, scene: &Scene<'_>, (a, b): (Standing<'_>, Standing<'_>)) {
        self.ahead.clear();
        self.behind.clear();
        let both = self.config.senders == Senders::Both;
        let [outline_a, outline_b] = &scene.outlines;
        match self.config.placement {
            Placement::Aimed => {
                let points = self.lattice.iter().map(|&at| scene.aim.point(at));
                self.ahead.push_plane(points);
                scene
                    .shadow_a
                    .far(&self.ahead.xs, &self.ahead.ys, &mut self.depths);
                self.ahead.zs.copy_from_slice(&self.depths);
                let each = (self.config.rays / 32).clamp(1, 8);
                self.ahead.push_vertices(outline_a, Some(&scene.aim));
                self.ahead.push_edges(outline_a, &scene.aim, each);
                if both {
                    self.behind.push_vertices(outline_b, Some(&scene.aim));
                    self.behind.push_edges(outline_b, &scene.aim, each);
                }
            }
            Placement::Thesis | Placement::Even => {
                let hemisphere = &self.hemisphere;
                scene.push_surface(&mut self.ahead, a, hemisphere, DVec3::ZERO, 1.0);
                self.ahead.push_vertices(outline_a, None);
                if both {
                    let centre = scene.shadow_b.centre;
                    scene.push_surface(&mut self.behind, b, hemisphere, centre, -1.0);
                    self.behind.push_vertices(outline_b, None);
                }
                if self.config.placement == Placement::Even {
                    let each = f64::from(self.config.rays).sqrt().ceil() as u32;
                    self.ahead.push_edges(outline_a, &scene.aim, each);
                    if both {
                        self.behind.push_edges(outline_b, &scene.aim, each);
                    }
                }
            }
        }
    }

    /// Casts the first rays and finds the shortest, and the shortest from an edge.
    fn cast_all(&mut self, scene: &Scene<'_>) -> [Option<Shortest>; 2] {
        let (mut best, mut best_edge) = (None::<Shortest>, None::<Shortest>);
        for behind in [false, true] {
            let starts = if behind { &self.behind } else { &self.ahead };
            if behind {
                gaps_behind(starts, &scene.shadow_a, &mut self.gaps);
            } else {
                gaps_ahead(starts, &scene.shadow_b, &mut self.gaps);
            }
            for (index, &gap) in self.gaps.iter().enumerate() {
                // A NaN, a miss, fails the comparison.
                if gap >= -scene.touch {
                    let origin = starts.origin(index);
                    let found = Shortest {
                        at: DVec2::new(starts.xs[index], starts.ys[index]),
                        gap,
                        origin,
                        behind,
                    };
                    scene.keep_shorter(&mut best, found);
                    if matches!(origin, Origin::Edge { .. }) {
                        scene.keep_shorter(&mut best_edge, found);
                    }
                }
            }
        }
        [best, best_edge]
    }

    /// Sends further rays around the shortest.
    fn refine(
        &mut self,
        scene: &Scene<'_>,
        [best, best_edge]: [Option<Shortest>; 2],
        rays: &mut u64,
    ) -> Option<Shortest> {
        let mut best = best?;
        if self.config.refinement == Refinement::None {
            return Some(best);
        }
        let first = first_rays(&self.config);
        let mut budget = match self.config.placement {
            Placement::Aimed => self.config.rays - first,
            Placement::Thesis | Placement::Even => self.config.rays,
        };
        if let Some(edge) = best_edge {
            let share = budget / 2;
            budget -= share;
            if let Some(found) = self.refine_edge(scene, edge, share, rays) {
                let mut kept = Some(best);
                scene.keep_shorter(&mut kept, found);
                best = kept?;
            }
        }
        let radius = 1.0 / f64::from(first).sqrt();
        let Self {
            refined,
            depths,
            gaps,
            turns,
            ..
        } = self;
        let (at, gap) = search_area(
            (scene.aim.square(best.at), best.gap),
            radius,
            budget,
            turns,
            |points| {
                *rays += points.len() as u64;
                refined.clear();
                refined.push_plane(points.iter().map(|&point| scene.aim.point(point)));
                scene.shadow_a.far(&refined.xs, &refined.ys, depths);
                refined.zs.copy_from_slice(depths);
                gaps_ahead(refined, &scene.shadow_b, gaps);
                std::array::from_fn(|index| scene.valid(gaps.get(index).copied()))
            },
        );
        if gap < best.gap - scene.rounding() {
            best = Shortest {
                at: scene.aim.point(at),
                gap,
                origin: Origin::Area,
                behind: false,
            };
        }
        Some(scene.polish(best, rays))
    }

    fn refine_edge(
        &mut self,
        scene: &Scene<'_>,
        start: Shortest,
        budget: u32,
        rays: &mut u64,
    ) -> Option<Shortest> {
        let Origin::Edge { edge, at, between } = start.origin else {
            return None;
        };
        let (from, to) = scene.outlines[usize::from(start.behind)].edge(edge)?;
        let Self { refined, gaps, .. } = self;
        let (at, gap) = search_edge((at, start.gap), between, budget, |at| {
            *rays += 1;
            refined.clear();
            refined.push(from.lerp(to, at), start.origin);
            if start.behind {
                gaps_behind(refined, &scene.shadow_a, gaps);
            } else {
                gaps_ahead(refined, &scene.shadow_b, gaps);
            }
            scene.valid(gaps.first().copied())
        });
        let origin = Origin::Edge { edge, at, between };
        Some(Shortest {
            at: from.lerp(to, at).truncate(),
            gap,
            origin,
            ..start
        })
    }
}

/// Two bodies seen along their relative motion.
struct Scene<'a> {
    view: View,
    shadow_a: Shadow<'a>,
    shadow_b: Shadow<'a>,
    aim: Aim,
    outlines: [Outline<'a>; 2],
    touch: f64,
    /// Length of the motion.
    longest: f64,
}

impl Scene<'_> {
    /// Starting points on a body's surface, not depending on the other body.
    fn push_surface(
        &self,
        starts: &mut Starts,
        body: Standing<'_>,
        hemisphere: &[DVec3],
        centre: DVec3,
        side: f64,
    ) {
        if let Shape::Sphere(sphere) = body.shape {
            let turn = crate::sampling::turn_zenith(side * self.view.z);
            for &point in hemisphere {
                let point = self.view.coordinates(sphere.radius() * turn(point));
                starts.push(centre + point, Origin::Area);
            }
        }
        let shape_centre = body.shape.centre();
        for &point in body.points {
            let point = self
                .view
                .coordinates(body.pose.direction(point - shape_centre));
            starts.push(centre + point, Origin::Area);
        }
    }

    fn size(&self) -> f64 {
        self.shadow_a.size + self.shadow_b.size
    }

    /// Differences of gaps below this are rounding.
    fn rounding(&self) -> f64 {
        4.0 * f64::EPSILON * (self.size() + self.shadow_b.centre.z.abs())
    }

    /// A gap that a ray can have, or NaN.
    fn valid(&self, gap: Option<f64>) -> f64 {
        gap.filter(|&gap| gap >= -self.touch).unwrap_or(f64::NAN)
    }

    fn keep_shorter(&self, best: &mut Option<Shortest>, found: Shortest) {
        let margin = |best: &Shortest| match (best.behind, found.behind) {
            (false, true) => -PREFERENCE * self.size(),
            (true, false) => PREFERENCE * self.size(),
            _ => 0.0,
        };
        if best
            .as_ref()
            .is_none_or(|best| found.gap < best.gap + margin(best))
        {
            *best = Some(found);
        }
    }

    /// The ray between a ball and the face of the other body that the shortest
    /// ray so far leads to, if it is shorter still.
    ///
    /// The ball touches that face with the point whose normal opposes it. Where
    /// the ball nearly slides along the face, this point lies at the rim of its
    /// shadow, and rays that close in on it from the middle come too slowly.
    fn polish(&self, mut best: Shortest, rays: &mut u64) -> Shortest {
        let (ball, behind) = match (self.shadow_a.disc(), self.shadow_b.disc()) {
            (Some(_), None) => (&self.shadow_a, false),
            (None, Some(_)) => (&self.shadow_b, true),
            _ => return best,
        };
        // A better ray may lead to the face beside; a few are enough.
        for _ in 0..4 {
            let Some((far_a, near_b)) = self.ends(best) else {
                break;
            };
            let (x, y) = (best.at.x, best.at.y);
            let (normal, _) = if behind {
                self.shadow_a.surface_at(x, y, far_a, Side::Far)
            } else {
                self.shadow_b.surface_at(x, y, near_b, Side::Near)
            };
            let start = ball.centre - ball.size * self.view.coordinates(normal);
            let other = [&self.shadow_b, &self.shadow_a][usize::from(behind)];
            let span = other.span(start.x, start.y);
            let ahead = |(near, far)| {
                if behind {
                    start.z - far
                } else {
                    near - start.z
                }
            };
            let gap = self.valid(span.map(ahead));
            *rays += 1;
            // NaN is a miss.
            if gap.is_nan() || gap >= best.gap {
                break;
            }
            best = Shortest {
                at: start.truncate(),
                gap,
                origin: Origin::Area,
                behind,
            };
        }
        best
    }

    /// What the shortest ray tells about the touch.
    fn touch(&self, best: Shortest) -> Option<RayTouch> {
        let fraction = best.gap.max(0.0) / self.longest;
        // NaN fails the comparison as well.
        if fraction <= 1.0 {
            let (x, y) = (best.at.x, best.at.y);
            let (far_a, near_b) = self.ends(best)?;
            let (normal_a, surface_a) = self.shadow_a.surface_at(x, y, far_a, Side::Far);
            let (normal_b, surface_b) = self.shadow_b.surface_at(x, y, near_b, Side::Near);
            let (normal, features) = if best.behind {
                (-normal_a, [surface_a, best.origin.feature(surface_b)])
            } else {
                (normal_b, [best.origin.feature(surface_a), surface_b])
            };
            let offset = self.view.vector(DVec3::new(x, y, near_b));
            Some(RayTouch {
                fraction,
                offset,
                normal,
                features,
            })
        } else {
            None
        }
    }

    /// Depths of the ray's two ends.
    fn ends(&self, best: Shortest) -> Option<(f64, f64)> {
        let (x, y) = (best.at.x, best.at.y);
        if best.behind {
            let (_, far) = self.shadow_a.span(x, y)?;
            Some((far, far + best.gap))
        } else {
            let (near, _) = self.shadow_b.span(x, y)?;
            Some((near - best.gap, near))
        }
    }
}

/// How many of the rays are not kept for refinement.
fn first_rays(config: &RayConfig) -> u32 {
    match (config.placement, config.refinement) {
        // Fewer than a round of refinement needs are better spent at once.
        (Placement::Aimed, Refinement::AroundShortest) if config.rays >= 10 => {
            config.rays.div_ceil(4)
        }
        _ => config.rays,
    }
}
