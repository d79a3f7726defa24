//! Curves a body can follow.
//!
//! A caller gives points to fly through and tangents there (Hermite form), points
//! alone (Catmull–Rom) or control points; every two successive points make a
//! piece, a cubic Bézier curve; the pieces make a spline that is walked by distance flown, so that a body keeps its speed.

mod arc_length;
mod bezier;
mod builder;
mod catmull_rom;
#[cfg(feature = "serde")]
mod data;
mod fit;
mod fitter;
mod hermite;
mod hodograph;
mod jounce;
mod quadratic;
mod section;
mod span;
mod spline;
mod table;

pub use bezier::CubicBezier;
pub use spline::{Knots, Spline};
pub use table::{ArcLengthRow, ArcLengthTable};

pub(crate) use arc_length::Near;
pub(crate) use section::{Bending, Section, Sway};

#[cfg(feature = "serde")]
pub(crate) use data::{SplineData, SplineDataError};
