//! Straight casts between shapes with flat faces, against brute force.

mod bodies;
mod oracle;
mod random;
