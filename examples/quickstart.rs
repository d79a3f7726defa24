//! A ball flies past another and touches it on the way.
//!
//! `cargo run --example quickstart`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use feeler::{Body, CollisionWorld, Motion, Path, Sphere};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = CollisionWorld::default();
    // Metres and seconds. The ball's path leads past the target, 1 m beside its centre.
    let target = world.insert(Body::fixed(Sphere::new(1.0)?, [0.0, 0.0, 0.0]))?;
    let path = Path::line([3.0, 0.0, 1.0], [0.0, 0.0, 1.0])?;
    let ball = world.insert(Body::moving(Sphere::new(1.0)?, Motion::along(path, 1.0)?))?;
    println!("{target} stands, {ball} moves at 1 m/s");

    for _frame in 0..72 {
        for contact in world.step(1.0 / 24.0)? {
            println!(
                "after {:.6} s {} touches {} at {:.6}, normal {:.6}",
                contact.time, contact.a, contact.b, contact.point, contact.normal
            );
        }
    }
    Ok(())
}
