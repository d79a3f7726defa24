//! The shortest ray between two bodies.

use crate::geometry::{Mesh, Shape};
use crate::narrow_phase::rays::aim::Aim;
use crate::narrow_phase::rays::crossings::{Crossing, Crossings};
use crate::narrow_phase::rays::facing::{Facing, PREFERENCE, RayTouch, Shortest, Standing};
use crate::narrow_phase::rays::refine::{search_area, search_edge};
use crate::narrow_phase::rays::shadow::{Shadow, Side, View};
use crate::narrow_phase::rays::starts::{Origin, Outline, Starts, gaps_ahead, gaps_behind};
use crate::narrow_phase::rays::{Placement, RayConfig, Refinement, Senders};
use crate::sampling::{
    UnitStream, hemisphere_even, hemisphere_grid, square_lattice, triangle_even, triangle_thesis,
};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

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
    crossings: Crossings,
}

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
            crossings: Crossings::default(),
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
        let facing = Facing {
            view,
            shadow_a: &shadow_a,
            shadow_b: &shadow_b,
            aim: &aim,
            outlines: &outlines,
            touch,
            longest: length,
        };

        self.place(&facing, (a, b));
        *rays += (self.ahead.len() + self.behind.len()) as u64;
        let best = self.cast_all(&facing);
        let best = self.refine(&facing, best, rays);
        if let Some(crossing) = self.cross(&facing, (a, b), best, rays) {
            return facing.touch_of_edges(&crossing);
        }
        facing.touch(best?)
    }

    /// The shortest ray between two edges, if it is shorter than all others.
    fn cross(
        &mut self,
        facing: &Facing<'_>,
        (a, b): (Standing<'_>, Standing<'_>),
        best: Option<Shortest>,
        rays: &mut u64,
    ) -> Option<Crossing> {
        let [outline_a, outline_b] = facing.outlines;
        let any = outline_a.edges() > 0 && outline_b.edges() > 0;
        if !any || self.config.placement != Placement::Aimed {
            return None;
        }
        // Where a vertex is as near, it is the vertex that touches.
        let limit = best.map_or(facing.longest, |best| match best.origin {
            Origin::Vertex(_) => best.gap - PREFERENCE * facing.size(),
            Origin::Area | Origin::Edge { .. } => best.gap - facing.rounding(),
        });
        let directions = [a.pose, b.pose].map(|pose| pose.local_direction(facing.view.z));
        self.crossings.shortest(
            [(outline_a, a.shape), (outline_b, b.shape)],
            directions,
            facing.aim,
            (facing.touch, limit),
            |start, end| facing.is_in_front(false, start) && facing.is_in_front(true, end),
            rays,
        )
    }

    /// Fills in where the first rays start.
    fn place(&mut self, facing: &Facing<'_>, (a, b): (Standing<'_>, Standing<'_>)) {
        self.ahead.clear();
        self.behind.clear();
        let both = self.config.senders == Senders::Both;
        let [outline_a, outline_b] = facing.outlines;
        match self.config.placement {
            Placement::Aimed => {
                // Those that a ball touches by come first: what is longer than they is passed over.
                self.ahead
                    .push_faces(facing.shadow_a, facing.shadow_b, facing.aim);
                self.ahead
                    .push_aimed(&self.lattice, facing.aim, facing.shadow_a);
                let each = (self.config.rays / 32).clamp(1, 8);
                self.ahead.push_vertices(outline_a, Some(facing.aim));
                match facing.shadow_b.ball() {
                    Some(ball) => self.ahead.push_tangents(outline_a, facing.aim, ball, 1.0),
                    None => self.ahead.push_edges(outline_a, facing.aim, each),
                }
                if both {
                    self.behind.push_vertices(outline_b, Some(facing.aim));
                    match facing.shadow_a.ball() {
                        Some(ball) => self.behind.push_tangents(outline_b, facing.aim, ball, -1.0),
                        None => self.behind.push_edges(outline_b, facing.aim, each),
                    }
                }
            }
            Placement::Thesis | Placement::Even => {
                let hemisphere = &self.hemisphere;
                facing.push_surface(&mut self.ahead, a, hemisphere, DVec3::ZERO, 1.0);
                self.ahead.push_vertices(outline_a, None);
                if both {
                    let centre = facing.shadow_b.centre;
                    facing.push_surface(&mut self.behind, b, hemisphere, centre, -1.0);
                    self.behind.push_vertices(outline_b, None);
                }
                if self.config.placement == Placement::Even {
                    let each = f64::from(self.config.rays).sqrt().ceil() as u32;
                    self.ahead.push_edges(outline_a, facing.aim, each);
                    if both {
                        self.behind.push_edges(outline_b, facing.aim, each);
                    }
                }
            }
        }
    }

    /// Casts the first rays and finds the shortest, and the shortest from an edge.
    fn cast_all(&mut self, facing: &Facing<'_>) -> [Option<Shortest>; 2] {
        let (mut best, mut best_edge) = (None::<Shortest>, None::<Shortest>);
        let (mut shortest, margin) = (f64::INFINITY, PREFERENCE * facing.size());
        // Where the body faces the other is where these were put.
        let aimed = self.config.placement == Placement::Aimed;
        for behind in [false, true] {
            let starts = if behind { &self.behind } else { &self.ahead };
            if behind {
                gaps_behind(starts, facing.shadow_a, &mut self.gaps);
            } else {
                gaps_ahead(starts, facing.shadow_b, &mut self.gaps);
            }
            let surface = starts.surface();
            for (index, &gap) in self.gaps.iter().enumerate() {
                let beaten = shortest < gap - margin;
                // Most rays are longer than one before them.
                if beaten && index < surface {
                    continue;
                }
                // A NaN, a miss, fails the comparison.
                if gap >= -facing.touch {
                    let origin = starts.origin(index);
                    let found = Shortest {
                        at: DVec2::new(starts.xs[index], starts.ys[index]),
                        gap,
                        origin,
                        behind,
                    };
                    let is_in_front = || {
                        let start = found.at.extend(starts.zs[index]);
                        aimed && index < surface || facing.is_in_front(behind, start)
                    };
                    if beaten && !matches!(origin, Origin::Edge { .. }) || !is_in_front() {
                        continue;
                    }
                    facing.keep_shorter(&mut best, found);
                    shortest = best.map_or(shortest, |best| best.gap);
                    if matches!(origin, Origin::Edge { .. }) {
                        facing.keep_shorter(&mut best_edge, found);
                    }
                }
            }
        }
        [best, best_edge]
    }

    /// Sends further rays around the shortest.
    fn refine(
        &self,
        facing: &Facing<'_>,
        [best, best_edge]: [Option<Shortest>; 2],
        rays: &mut u64,
    ) -> Option<Shortest> {
        let mut best = best?;
        // Of two balls the aimed ray that none is shorter than was among the first.
        let balls = facing.shadow_a.disc().is_some() && facing.shadow_b.disc().is_some();
        let found = balls && self.config.placement == Placement::Aimed;
        if found || self.config.refinement == Refinement::None {
            return Some(best);
        }
        let first = first_rays(&self.config);
        let mut budget = match self.config.placement {
            Placement::Aimed => self.config.rays - first,
            Placement::Thesis | Placement::Even => self.config.rays,
        };
        if let Some(edge) = best_edge
            && edge.origin.is_open()
        {
            let share = budget / 2;
            budget -= share;
            if let Some(found) = refine_edge(facing, edge, share, rays) {
                let mut kept = Some(best);
                facing.keep_shorter(&mut kept, found);
                best = kept?;
            }
        }
        let radius = 1.0 / f64::from(first).sqrt();
        let start = (facing.aim.square(best.at), best.gap);
        let (at, gap) = search_area(start, radius, budget, &self.turns, |point| {
            *rays += 1;
            let point = facing.aim.point(point);
            let start = facing.shadow_a.depth(Side::Far, point);
            facing.valid(facing.shadow_b.depth(Side::Near, point) - start)
        });
        if gap < best.gap - facing.rounding() {
            best = Shortest {
                at: facing.aim.point(at),
                gap,
                origin: Origin::Area,
                behind: false,
            };
        }
        Some(facing.polish(best, rays))
    }
}

/// Sends further rays along an edge, around the shortest from it.
fn refine_edge(
    facing: &Facing<'_>,
    start: Shortest,
    budget: u32,
    rays: &mut u64,
) -> Option<Shortest> {
    let Origin::Edge { edge, at, between } = start.origin else {
        return None;
    };
    let (from, to) = facing.outlines[usize::from(start.behind)].edge(edge)?;
    let (at, gap) = search_edge((at, start.gap), between, budget, |at| {
        *rays += 1;
        let point = from.lerp(to, at);
        facing.valid(if start.behind {
            point.z - facing.shadow_a.depth(Side::Far, point.truncate())
        } else {
            facing.shadow_b.depth(Side::Near, point.truncate()) - point.z
        })
    });
    let origin = Origin::Edge { edge, at, between };
    Some(Shortest {
        at: from.lerp(to, at).truncate(),
        gap,
        origin,
        ..start
    })
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
