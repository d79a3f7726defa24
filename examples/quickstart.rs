//! A ball flies past another and touches it on the way.
//!
//! `cargo run --example quickstart`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use feeler::{Body, CollisionWorld, Motion, Path, Sphere};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = CollisionWorld::default();
    world.insert(Body::fixed(Sphere::new(1.0)?, [0.0, 0.0, 0.0]))?;
    // Metres and seconds: 3 m at 1 m/s, past the other ball's centre at a distance of 1 m.
    let path = Path::line([3.0, 0.0, 1.0], [0.0, 0.0, 1.0])?;
    world.insert(Body::moving(Sphere::new(1.0)?, Motion::along(path, 1.0)?))?;

    for _frame in 0..72 {
        // Nobody lets the balls bounce: from the touch on they overlap.
        for contact in world.step(1.0 / 24.0)?.iter().filter(|c| c.is_touch()) {
            println!("They touch after {:.9} s", contact.time);
            println!("at {:.6}, normal {:.6}.", contact.point, contact.normal);
        }
    }
    Ok(())
}
