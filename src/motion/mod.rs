//! How bodies move.

mod path;

pub use path::Path;
