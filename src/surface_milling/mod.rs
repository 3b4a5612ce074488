//! Whole programs from surfaces: a mesh or a profile is gone over in parallel vertical planes by a ball, tip output.
//!
//! [`make_surface_program`] makes the passes plane by plane (`plane_slices`), puts them into the program's own decimals (`pass_track`), looks at what came
//! out with other means (`surface_proof`), joins them (`pass_linking`) and writes the program ([`crate::write::new_program`]), which is read back. What is
//! proved is what is written, rounding included. Source of the method: Dragoi 2009; the passes are its steps 4 to 17.

mod chain_cutting;
mod make_program;
mod pass_linking;
mod pass_planes;
mod pass_track;
mod plane_slices;
mod profile_file;
mod section_profile;
mod surface_program;
mod surface_proof;

pub use make_program::make_surface_program;
pub use pass_linking::PassPattern;
pub use pass_planes::{MOST_PLANES, PassPlanes, plane_offsets};
pub use profile_file::{load_profile, profile_schema};
pub use section_profile::{ProfileCurve, SectionProfile, SectionProfileError};
pub use surface_program::SurfaceProgram;
pub use surface_proof::SurfaceProof;

use crate::program::{Dialect, LengthUnit};
use crate::sim::Mesh;

/// What is gone over.
#[derive(Debug, Clone)]
pub enum SurfacePart {
    /// A closed solid, mm.
    Mesh(Mesh),
    /// A profile, the same in all planes.
    Profile(SectionProfile),
}

/// What the heights of passes over a mesh are made from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PassHeights {
    /// The whole mesh: the ball touches nothing beside the plane either.
    #[default]
    Mesh,
    /// The mesh's line in the plane alone, as the paper has it: right for parts that are the same in all planes.
    Profile,
}

/// How to go over a part. Lengths in mm, feeds in mm/min.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceMillingOptions {
    /// Which way the planes stand.
    pub planes: PassPlanes,
    /// First and last plane; a mesh has its own, a profile its width.
    pub range: Option<(f64, f64)>,
    /// Largest distance of planes.
    pub step: f64,
    /// Radius of the ball.
    pub radius: f64,
    /// How deep passes may go into the part, and how far off it they may stay.
    pub tolerance: f64,
    /// What heights over a mesh are made from.
    pub against: PassHeights,
    /// How passes follow each other.
    pub pattern: PassPattern,
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
    pub words: SurfaceProgramWords,
}

/// What a program says besides its path.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceProgramWords {
    /// The dialect, one of [`crate::write::new_program::WRITABLE`].
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
