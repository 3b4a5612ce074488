//! What comes out: the program, and what is known about it.

use super::SurfaceMillingOptions;
use super::pass_track::ProgramRounding;
use super::surface_proof::SurfaceProof;
use crate::program::MotionClass;
use crate::surface::profile::{Chain, UnreachablePart};
use crate::write::new_program::{DraftMove, DraftTool, ProgramDraft};

/// A ball's length in its own diameters, where a program has to say one.
const TOOL_LENGTH: f64 = 8.0;

/// A program over a part, proved and read back.
#[derive(Debug, Clone)]
pub struct SurfaceProgram {
    /// What the program does.
    pub draft: ProgramDraft,
    /// Its text.
    pub text: Vec<u8>,
    /// How far its passes are from the part.
    pub proof: SurfaceProof,
    /// How many planes have a pass.
    pub planes: usize,
    /// How many planes were asked for and meet nothing.
    pub empty: usize,
    /// How many passes.
    pub passes: usize,
    /// Distance of neighbouring planes, mm; 0 of a single one.
    pub spacing: f64,
    /// What of a profile the ball does not touch.
    pub unreached: Vec<UnreachablePart>,
    /// The middle plane: its offset, the part's line in it, and the tip's.
    pub figure: Option<(f64, Chain, Vec<Chain>)>,
}

impl SurfaceProgram {
    /// How long the tool cuts, mm.
    pub fn cutting_length_mm(&self) -> f64 {
        let moves = self.draft.moves.iter().zip(self.draft.moves.iter().skip(1));
        let cuts = moves.filter(|(_, to)| to.class == MotionClass::Cut);
        cuts.map(|(from, to)| (to.to - from.to).norm()).sum::<f64>() * self.draft.units.mm_per_unit()
    }

    /// How many motions cut.
    pub fn cutting_motion_count(&self) -> usize {
        self.draft.moves.iter().filter(|step| step.class == MotionClass::Cut).count()
    }

    /// Height of what stays between passes on level ground, mm.
    pub fn scallop_height_mm(&self, radius: f64) -> f64 {
        let half = (self.spacing / 2.0).min(radius);
        radius - (radius * radius - half * half).sqrt()
    }
}

/// The program around the motions.
pub(super) fn draft_program(
    options: &SurfaceMillingOptions,
    print: ProgramRounding,
    moves: Vec<DraftMove>,
) -> ProgramDraft {
    let words = &options.words;
    let diameter = print.round_length(2.0 * options.radius);
    let named = words.tool_name.clone();
    ProgramDraft {
        name: words.name.clone(),
        operation: words.operation.clone(),
        tool: DraftTool {
            number: words.tool,
            name: named.unwrap_or_else(|| format!("BALL_D{diameter}")),
            diameter,
            corner_radius: print.round_length(options.radius),
            length: print.round_length(TOOL_LENGTH * 2.0 * options.radius),
        },
        spindle: words.spindle,
        coolant: words.coolant,
        units: words.units,
        tolerance: print.round_length(options.tolerance),
        moves,
    }
}
