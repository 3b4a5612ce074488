//! This module makes whole programs for surfaces: a ball mills a mesh or a profile in parallel vertical
//! planes, and the program moves its tip.
//!
//! [`make_surface_program`] makes the passes plane by plane (`plane_slices`), rounds them to the program's
//! own decimals (`pass_track`), checks them by an independent method (`surface_proof`), links them
//! (`pass_linking`) and writes the program ([`crate::write::new_program`]). The method is that of Dragoi
//! 2009; the passes are its steps 4 to 17.
//!
//! The proof covers what is written, with its rounding: passes are rounded first and then measured, and the
//! text is read back and must have exactly these motions. The proof does not use envelopes or lowered
//! cutters. It is the distance of the ball and of the shank above it from the part's own points or triangles.
//!
//! By default the heights over a mesh come from the whole mesh. A path that is right in its plane gouges
//! beside it wherever the part changes from plane to plane. The heights of the plane alone are for parts that
//! do not change; for all others the proof fails.

mod chain_cutting;
mod make_program;
mod pass_linking;
mod pass_planes;
mod pass_track;
mod plane_cost;
mod plane_slices;
mod profile_file;
mod section_profile;
mod surface_program;
mod surface_proof;
mod watched_planes;

pub use crate::surface::profile::{
    ArcPiece, Chain, ChainError, ChainPiece, ChordError, EllipseArc, LinePiece, NurbsCurve, NurbsError,
    Point, ProfilePlane, UnreachablePart,
};
pub use make_program::{make_surface_program, make_watched_surface_program};
pub use pass_linking::PassPattern;
pub use pass_planes::{MOST_PLANES, PassPlanes, plane_offsets};
pub use profile_file::{load_profile, profile_schema};
pub use section_profile::{ProfileCurve, SectionProfile, SectionProfileError};
pub use surface_program::SurfaceProgram;
pub use surface_proof::SurfaceProof;

use crate::program::{Dialect, LengthUnit};
use crate::stock::Mesh;

/// The part that is milled.
#[derive(Debug, Clone)]
pub enum SurfacePart {
    /// A closed solid, mm.
    Mesh(Mesh),
    /// A profile that is the same in all planes.
    Profile(SectionProfile),
}

/// The source of the heights of passes over a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PassHeights {
    /// The whole mesh: the ball does not touch anything beside the plane either.
    #[default]
    Mesh,
    /// The mesh's line in the plane alone, as in the paper. It is right for parts that are the same in all
    /// planes.
    Profile,
}

/// The options for milling a part; lengths are in mm, feeds in mm/min.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceMillingOptions {
    /// The direction of the planes.
    pub planes: PassPlanes,
    /// The first and the last plane; if not given, a mesh has its own range and a profile its width.
    pub range_mm: Option<(f64, f64)>,
    /// The largest distance of planes.
    pub step_mm: f64,
    /// The radius of the ball.
    pub radius_mm: f64,
    /// The largest depth of passes in the part, and their largest distance from it.
    pub tolerance_mm: f64,
    /// The source of the heights over a mesh.
    pub against: PassHeights,
    /// The pattern in which passes follow each other.
    pub pattern: PassPattern,
    /// Whether arcs are written, if the dialect has them.
    pub arcs: bool,
    /// The height below which the tip never goes; if not given, the lowest point of the part.
    pub floor_mm: Option<f64>,
    /// The height above the highest point of the part (or the floor) at which the tool goes across.
    pub clearance_mm: f64,
    /// The height above a pass at which the plunge feed begins.
    pub approach_mm: f64,
    /// The feed of passes.
    pub feed_mm_min: f64,
    /// The feed down to a pass.
    pub plunge_feed_mm_min: f64,
    /// The feed between passes; rapid if not given.
    pub air_feed_mm_min: Option<f64>,
    /// The words around the path.
    pub words: SurfaceProgramWords,
}

impl SurfaceMillingOptions {
    /// Returns the options for a ball over a part: the largest distance of planes, mm, the radius of the ball, mm,
    /// and the feed of passes, mm/min.
    ///
    /// Everything else is as the command has it if it is not told: zigzag passes along x over all of the part,
    /// within 0.01 mm of it, half the feed down from 2 mm above a pass, rapids 10 mm above the part, and no arcs.
    pub fn new(step_mm: f64, radius_mm: f64, feed_mm_min: f64, words: SurfaceProgramWords) -> Self {
        Self {
            planes: PassPlanes::ZX,
            range_mm: None,
            step_mm,
            radius_mm,
            tolerance_mm: 0.01,
            against: PassHeights::default(),
            pattern: PassPattern::ZigZag,
            arcs: false,
            floor_mm: None,
            clearance_mm: 10.0,
            approach_mm: 2.0,
            feed_mm_min,
            plunge_feed_mm_min: feed_mm_min / 2.0,
            air_feed_mm_min: None,
            words,
        }
    }
}

/// The parts of a program besides its path.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceProgramWords {
    /// The dialect, one of [`crate::write::new_program::WRITABLE`].
    pub dialect: Dialect,
    /// The unit of the program.
    pub units: LengthUnit,
    /// The name of the part.
    pub name: String,
    /// The name of the operation.
    pub operation: String,
    /// The number of the tool.
    pub tool: u32,
    /// The name of the tool; if not given, it is named by its diameter.
    pub tool_name: Option<String>,
    /// The spindle speed in revolutions per minute.
    pub spindle_rpm: Option<f64>,
    /// Whether coolant is switched on.
    pub coolant: bool,
}

impl SurfaceProgramWords {
    /// Returns the words of a program in millimetres for tool 1, without a spindle speed and without coolant.
    pub fn new(dialect: Dialect, name: impl Into<String>) -> Self {
        Self {
            dialect,
            units: LengthUnit::Mm,
            name: name.into(),
            operation: "SECTION".to_owned(),
            tool: 1,
            tool_name: None,
            spindle_rpm: None,
            coolant: false,
        }
    }
}
