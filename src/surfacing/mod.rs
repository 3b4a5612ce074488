//! Whole programs from surfaces: a mesh or a profile is gone over in parallel vertical planes by a ball, tip output.
//!
//! [`surface`] makes the passes plane by plane (`slices`), puts them into the program's own decimals (`track`), looks at what came
//! out with other means (`proof`), joins them (`join`) and writes the program ([`crate::write::program`]), which is read back. What is
//! proved is what is written, rounding included. Source of the method: Dragoi 2009; the passes are its steps 4 to 17.

mod cut;
mod file;
mod join;
mod make;
mod planes;
mod profile;
mod proof;
mod slices;
mod surfaced;
mod track;

pub use file::{load as load_profile, schema as profile_schema};
pub use join::Pattern;
pub use make::surface;
pub use planes::{MOST_PLANES, Planes, offsets};
pub use profile::{Profile, ProfileCurve, ProfileError};
pub use proof::Proof;
pub use surfaced::Surfaced;

use crate::program::{Dialect, LengthUnit};
use crate::sim::Mesh;

/// What is gone over.
#[derive(Debug, Clone)]
pub enum Part {
    /// A closed solid, mm.
    Mesh(Mesh),
    /// A profile, the same in all planes.
    Profile(Profile),
}

/// What the heights of passes over a mesh are made from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Against {
    /// The whole mesh: the ball touches nothing beside the plane either.
    #[default]
    Mesh,
    /// The mesh's line in the plane alone, as the paper has it: right for parts that are the same in all planes.
    Profile,
}

/// How to go over a part. Lengths in mm, feeds in mm/min.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Which way the planes stand.
    pub planes: Planes,
    /// First and last plane; a mesh has its own, a profile its width.
    pub range: Option<(f64, f64)>,
    /// Largest distance of planes.
    pub step: f64,
    /// Radius of the ball.
    pub radius: f64,
    /// How deep passes may go into the part, and how far off it they may stay.
    pub tolerance: f64,
    /// What heights over a mesh are made from.
    pub against: Against,
    /// How passes follow each other.
    pub pattern: Pattern,
    /// Whether arcs are written, where the dialect holds them.
    pub arcs: bool,
    /// The tip never goes below; the lowest place of the part if not given.
    pub floor: Option<f64>,
    /// How far above the highest place of the part (or the floor) the tool goes across.
    pub clearance: f64,
    /// How far above a pass the plunge feed begins.
    pub approach: f64,
    /// Feed of passes.
    pub feed: f64,
    /// Feed of the way down to a pass.
    pub plunge: f64,
    /// Feed between passes; rapid when there is none.
    pub air: Option<f64>,
    /// The words around the path.
    pub words: Words,
}

/// What a program says besides its path.
#[derive(Debug, Clone, PartialEq)]
pub struct Words {
    /// The dialect, one of [`crate::write::program::WRITABLE`].
    pub dialect: Dialect,
    /// Unit of the program.
    pub units: LengthUnit,
    /// Name of the part.
    pub name: String,
    /// Name of the operation.
    pub operation: String,
    /// Number of the tool.
    pub tool: u32,
    /// Name of the tool; by its diameter if not given.
    pub tool_name: Option<String>,
    /// Spindle speed in revolutions a minute.
    pub spindle: Option<f64>,
    /// Whether to switch coolant on.
    pub coolant: bool,
}
