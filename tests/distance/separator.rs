//! The bounds of a kept pair.

use crate::case::*;
use crate::oracle;
use feeler::narrow_phase::distance::Separator;
use feeler::{Pose, overlap};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Both bounds hold, and lie as close as was asked for.
fn check(case: &Case, separator: &mut Separator, tolerance: f64, label: &str) {
    let between = case.pose_a.position - case.pose_b.position;
    let (a, b) = case.bodies();
    let distance = oracle::nearest(&a, &b).distance - a.radius - b.radius;
    let exact = case.exact();
    let Some(found) = separator.separation(between, tolerance) else {
        assert!(
            distance <= exact,
            "{label}: {distance:e} apart, but no answer"
        );
        return;
    };
    assert!(
        (found.normal.length() - 1.0).abs() < 1e-14,
        "{label}: {found:?}"
    );
    assert!(
        found.gap <= distance + exact,
        "{label}: {distance:e} apart, {found:?}"
    );
    assert!(
        found.distance >= distance - exact,
        "{label}: {distance:e} apart, {found:?}"
    );
    let slack = exact + tolerance * found.distance;
    assert!(found.distance - found.gap <= slack, "{label}: {found:?}");
    let along = oracle::gap(&a, &b, found.normal);
    assert!(
        (found.gap - along).abs() <= exact,
        "{label}: {along:e} along {found:?}"
    );
    assert!(
        (separator.gap(between, found.normal) - along).abs() <= exact,
        "{label}"
    );
}

#[test]
fn bounds_hold_while_a_pair_flies_and_turns() {
    let mut rng = ChaCha8Rng::seed_from_u64(30);
    for (kind_a, name_a) in LABELS.iter().enumerate() {
        for (kind_b, name_b) in LABELS.iter().enumerate() {
            let mut checked = 0;
            for index in 0..cases(5) {
                let a = shape(&mut rng, kind_a, 1.0, DVec3::ONE);
                let b = shape(&mut rng, kind_b, 1.0, DVec3::ONE);
                let start = placed(&mut rng, a, b, DVec3::ZERO);
                let (axis, rate) = (direction(&mut rng), log_uniform(&mut rng, 1e-3, 1.0));
                let drift = 0.1 * vector(&mut rng);
                let tolerance = log_uniform(&mut rng, 1e-12, 0.1);
                let (from_a, from_b) = (start.pose_a, start.pose_b);
                let (a, b) = (start.a.clone(), start.b.clone());
                let mut kept = Separator::new(&a, from_a.orientation, &b, from_b.orientation);
                for step in 0..30 {
                    let turn = DQuat::from_axis_angle(axis, rate * f64::from(step));
                    let pose_a = Pose::new(
                        from_a.position + f64::from(step) * drift,
                        turn * from_a.orientation,
                    );
                    let case = Case {
                        a: a.clone(),
                        pose_a,
                        b: b.clone(),
                        pose_b: from_b,
                    };
                    // Distances of what overlaps are not the oracle's business.
                    if overlap(&case.a, &case.pose_a, &case.b, &case.pose_b).is_some() {
                        continue;
                    }
                    checked += 1;
                    let (near, far) = (case.with_gap(1e-9), case.with_gap(3.0));
                    let case = [case, near, far]
                        .into_iter()
                        .nth(step as usize % 3)
                        .unwrap();
                    if step % 4 == 0 {
                        // Overlap in between.
                        let _ = kept.separation(DVec3::ZERO, tolerance);
                    }
                    kept.turn(case.pose_a.orientation, case.pose_b.orientation);
                    let label = format!("{name_a} {name_b} {index}.{step}");
                    check(&case, &mut kept, tolerance, &label);
                }
            }
            assert!(checked > 15 * cases(5), "lopsided: {checked} apart");
        }
    }
}
