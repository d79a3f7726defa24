//! Straight casts between shapes with flat faces, against brute force.

mod bodies;
mod cases;
mod oracle;
mod random;
