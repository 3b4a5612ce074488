//! This module holds the result: the program and what is known about it.

use super::SurfaceMillingOptions;
use super::pass_track::ProgramRounding;
use super::surface_proof::SurfaceProof;
use crate::program::MotionClass;
use crate::surface::profile::{Chain, UnreachablePart};
use crate::write::new_program::{DraftMove, DraftTool, ProgramDraft};

/// The length of a ball-end mill in diameters, for dialects that need a length.
const TOOL_LENGTH: f64 = 8.0;

/// A program over a part, proved and read back.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct SurfaceProgram {
    /// The motions and words of the program.
    pub draft: ProgramDraft,
    /// The text of the program.
    pub text: Vec<u8>,
    /// The proved distances of its passes from the part.
    pub proof: SurfaceProof,
    /// The number of planes that have a pass.
    pub planes: usize,
    /// The number of planes that were asked for and do not meet the part.
    pub empty: usize,
    /// The number of passes.
    pub passes: usize,
    /// The distance of neighbouring planes, mm; 0 for a single plane.
    pub spacing_mm: f64,
    /// The parts of a profile that the ball does not touch.
    pub unreached: Vec<UnreachablePart>,
    /// The middle plane: its offset, the part's line in it, and the tip's.
    pub figure: Option<(f64, Chain, Vec<Chain>)>,
}

impl SurfaceProgram {
    /// Returns the length of all cuts, mm.
    pub fn cutting_length_mm(&self) -> f64 {
        let moves = self.draft.moves.iter().zip(self.draft.moves.iter().skip(1));
        let cuts = moves.filter(|(_, to)| to.class == MotionClass::Cut);
        cuts.map(|(from, to)| (to.to - from.to).norm()).sum::<f64>() * self.draft.units.mm_per_unit()
    }

    /// Returns the number of motions that cut.
    pub fn cutting_motion_count(&self) -> usize {
        self.draft.moves.iter().filter(|step| step.class == MotionClass::Cut).count()
    }

    /// Returns the height of the scallops between passes on level ground, mm.
    pub fn scallop_height_mm(&self, radius_mm: f64) -> f64 {
        // Two circles of radius R at the distance s cross R - sqrt(R^2 - (s / 2)^2) above their lowest
        // points.
        let half = (self.spacing_mm / 2.0).min(radius_mm);
        radius_mm - (radius_mm * radius_mm - half * half).sqrt()
    }
}

/// Puts the program's words around the motions.
pub(super) fn draft_program(
    options: &SurfaceMillingOptions,
    print: ProgramRounding,
    moves: Vec<DraftMove>,
) -> ProgramDraft {
    let words = &options.words;
    let diameter = print.round_length(2.0 * options.radius_mm);
    let named = words.tool_name.clone();
    ProgramDraft {
        name: words.name.clone(),
        operation: words.operation.clone(),
        tool: DraftTool {
            number: words.tool,
            name: named.unwrap_or_else(|| format!("BALL_D{diameter}")),
            diameter,
            corner_radius: print.round_length(options.radius_mm),
            length: print.round_length(TOOL_LENGTH * 2.0 * options.radius_mm),
        },
        spindle: words.spindle_rpm,
        coolant: words.coolant,
        units: words.units,
        tolerance: print.round_length(options.tolerance_mm),
        moves,
    }
}
