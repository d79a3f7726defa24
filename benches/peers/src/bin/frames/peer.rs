//! The same frame as a user of parry writes it.

use super::crowd::{DT, Kind, Mote};
use super::single;
use parry3d::bounding_volume::Aabb;
use parry3d::math::{Pose, Rotation, Vector};
use parry3d::partitioning::{Bvh, BvhWorkspace};
use parry3d::query::{Ray, ShapeCastOptions, cast_shapes};
use parry3d::shape::SharedShape;
use std::hint::black_box;

/// A body in single precision.
pub(crate) struct Grain {
    shape: SharedShape,
    pose: Pose,
    velocity: Vector,
    /// Around the shape as it is turned, from its position.
    around: Aabb,
}

/// What is kept from frame to frame.
pub(crate) struct Peer {
    bvh: Bvh,
    workspace: BvhWorkspace,
    pairs: Vec<(u32, u32)>,
    pub(crate) grains: Vec<Grain>,
    /// Whether all move; if not, the others are inserted once and pairs among them left out.
    all_move: bool,
}

impl Peer {
    pub(crate) fn new(kind: Kind, motes: &[Mote]) -> Self {
        let grain = |mote: &Mote| {
            let turn = [mote.turn.x, mote.turn.y, mote.turn.z, mote.turn.w];
            let turn = Rotation::from_array(turn.map(|part| part as f32));
            Grain {
                around: mote
                    .shape
                    .compute_aabb(&Pose::from_parts(Vector::ZERO, turn)),
                shape: mote.shape.clone(),
                pose: Pose::from_parts(single(mote.place), turn),
                velocity: single(mote.velocity),
            }
        };
        let mut peer = Self {
            bvh: Bvh::default(),
            workspace: BvhWorkspace::default(),
            pairs: Vec::new(),
            grains: motes.iter().map(grain).collect(),
            all_move: kind != Kind::Still,
        };
        for (index, grain) in (0..).zip(&peer.grains) {
            if grain.velocity == Vector::ZERO {
                let around = &grain.around;
                let place = grain.pose.translation;
                let aabb = Aabb::new(around.mins + place, around.maxs + place);
                peer.bvh.insert_or_update_partially(aabb, index, 0.0);
            }
        }
        peer
    }

    /// Takes over where bodies are.
    pub(crate) fn follow(&mut self, motes: &[Mote]) {
        for (grain, mote) in self.grains.iter_mut().zip(motes) {
            grain.pose.translation = single(mote.place);
            grain.velocity = single(mote.velocity);
        }
    }

    /// Pairs looked at, and hits.
    pub(crate) fn step(&mut self) -> (usize, usize) {
        let dt = DT as f32;
        for (index, grain) in (0..).zip(&self.grains) {
            if grain.velocity == Vector::ZERO {
                continue;
            }
            let from = grain.pose.translation;
            let to = from + grain.velocity * dt;
            let (low, high) = (from.min(to), from.max(to));
            let aabb = Aabb::new(low + grain.around.mins, high + grain.around.maxs);
            // Changes are noted only where there is a margin.
            let margin = if self.all_move { 0.0 } else { 1e-6 };
            self.bvh.insert_or_update_partially(aabb, index, margin);
        }
        self.bvh.refit(&mut self.workspace);
        self.bvh.optimize_incremental(&mut self.workspace);
        let pairs = &mut self.pairs;
        pairs.clear();
        let mut found = |a, b| pairs.push((a, b));
        if self.all_move {
            self.bvh
                .traverse_bvtt_single_tree::<false>(&mut self.workspace, &mut found);
        } else {
            self.bvh
                .traverse_bvtt_single_tree::<true>(&mut self.workspace, &mut found);
        }
        let options = ShapeCastOptions::with_max_time_of_impact(dt);
        let grains = &self.grains;
        let cast = |&&(a, b): &&(u32, u32)| {
            let (a, b) = (&grains[a as usize], &grains[b as usize]);
            cast_shapes(
                &a.pose, a.velocity, &*a.shape, &b.pose, b.velocity, &*b.shape, options,
            )
            .is_ok_and(|hit| black_box(hit).is_some())
        };
        (pairs.len(), pairs.iter().filter(cast).count())
    }

    /// The first body along a ray.
    pub(crate) fn cast_ray(&self, ray: &Ray) -> Option<(u32, f32)> {
        self.bvh.cast_ray(ray, f32::MAX, |leaf, best| {
            let grain = &self.grains[leaf as usize];
            grain.shape.cast_ray(&grain.pose, ray, best, true)
        })
    }
}
