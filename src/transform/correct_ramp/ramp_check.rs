//! Ramps judged before any recipe: what an indexable cutter of the setup does not survive, and what would mend it.

use super::parameters::{CorrectRamp, ImpossibleRampHandling, PlungeHandling};
use super::ramp_correction::LengtheningMethod;
use super::report::{CorrectRampReport, RampOutcome, RampReport};
use crate::diagnostic::{Diagnostic, codes};
use crate::parameters::Positive;
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::program::geometry::MotionPath;

use crate::program::{LengthUnit, MotionClass, Program};
use crate::setup::Setup;
use crate::transform::run_steps;

/// Levels that are nearer to each other than this are one, mm.
const SAME_LEVEL: f64 = 1e-3;

/// Finds the ramps of a program that are too short or too steep for the inserts that the setup says. Each finding says what
/// `correct_ramp` would do: longer legs, a lower start (compression), or how many layers.
///
/// Without inserts in the setup nothing is judged. The depth of cut is taken from the program: the largest step from one
/// level of cuts to the next lower one in an operation.
pub fn check_ramps(program: &Program, setup: &Setup, unit: LengthUnit) -> Vec<Diagnostic> {
    if setup.tools.iter().all(|entry| entry.insert.is_none()) {
        return Vec::new();
    }
    let depth_mm = find_level_step_mm(program, unit);
    let step = CorrectRamp {
        depth_of_cut: depth_mm.and_then(Positive::new),
        // A check must not stop at a ramp that cannot be corrected. It reports that one like the others.
        if_impossible: ImpossibleRampHandling::Keep,
        plunges: PlungeHandling::Correct,
        ..CorrectRamp::default()
    };
    let tried = run_steps(&[&step], LengthUnit::Mm, setup, program.clone());
    let outcome = match tried {
        Ok(outcome) => outcome,
        // What stands in the way of judging ramps is worth a note, and no reason to refuse the program.
        Err(failure) => {
            return failure.into_findings().into_iter().map(|found| note_unjudged(&found)).collect();
        }
    };
    let reports = outcome.reports.iter().filter_map(|report| report.downcast_ref::<CorrectRampReport>());
    let bad = reports.flat_map(|report| &report.ramps).filter(|ramp| ramp.outcome != RampOutcome::Fits);
    let proposals: Vec<(u64, String)> =
        bad.map(|ramp| (ramp.line, propose_correction(ramp, depth_mm, unit))).collect();
    let of_ramps = outcome.findings.into_iter().filter(|found| {
        [codes::RAMP_OUT_OF_LIMITS, codes::RAMP_KEPT, codes::RAMP_IMPOSSIBLE].contains(&found.code)
    });
    of_ramps
        .map(|found| with_proposal(found, &proposals))
        // The step only ran on a copy of the program, so its number would point to no step of a recipe.
        .map(|found| Diagnostic { step: None, ..found })
        .collect()
}

fn note_unjudged(found: &Diagnostic) -> Diagnostic {
    let message = format!("the ramps of this program cannot be judged: {}", found.message);
    let mut note = Diagnostic::new(codes::NO_INSERTS, message);
    note.labels.clone_from(&found.labels);
    note
}

fn with_proposal(found: Diagnostic, proposals: &[(u64, String)]) -> Diagnostic {
    let line = found.labels.first().map(|label| label.source.line_column(label.span.start).0 as u64);
    match proposals.iter().find(|(at, _)| Some(*at) == line) {
        Some((_, proposal)) if found.code == codes::RAMP_OUT_OF_LIMITS => found.with_help(proposal.clone()),
        _ => found,
    }
}

/// What `correct_ramp` would do to a ramp, in words.
fn propose_correction(ramp: &RampReport, depth_mm: Option<f64>, unit: LengthUnit) -> String {
    let depth = depth_mm.map_or_else(String::new, |depth| {
        let depth = DisplayUnits::from_mm(unit).tell_fixed(ColumnUnit::Length, depth, 3);
        format!(" (depth of cut {depth}, from the program's levels)")
    });
    let mut how = Vec::new();
    match ramp.lengthened {
        LengtheningMethod::No => {}
        LengtheningMethod::WidenedHelix => how.push("a wider helix".to_owned()),
        LengtheningMethod::OverHole => how.push("an entry over the drilled hole".to_owned()),
        _ => how.push("longer legs".to_owned()),
    }
    match (ramp.compression < 1.0, ramp.passes > 1) {
        (true, false) => how.push(format!("a lower start{depth}; compression suffices, one layer is enough")),
        (true, true) => how.push(format!(
            "a lower start{depth} and {} layers; compression alone does not suffice",
            ramp.passes
        )),
        (false, true) => how.push(format!("{} layers", ramp.passes)),
        (false, false) => {}
    }
    if how.is_empty() {
        return "A step `correct_ramp` cannot mend it; enter over a drilled hole, or take a cutter that cuts in its middle.".to_owned();
    }
    format!("A step `correct_ramp` mends it: {}.", how.join(", "))
}

/// The largest step from one level of cuts to the next lower one within an operation, mm.
fn find_level_step_mm(program: &Program, unit: LengthUnit) -> Option<f64> {
    let mut levels: Vec<(usize, f64)> = program
        .motions()
        .filter(|motion| motion.class == MotionClass::Cut && motion.path != MotionPath::Start)
        .filter(|motion| (motion.from.point.z - motion.to.point.z).abs() * unit.mm_per_unit() < SAME_LEVEL)
        .map(|motion| (motion.operation, motion.to.point.z * unit.mm_per_unit()))
        .collect();
    levels.sort_by(|(a, from), (b, to)| a.cmp(b).then(to.total_cmp(from)));
    let steps = levels.iter().zip(levels.iter().skip(1)).filter(|((a, _), (b, _))| a == b);
    let steps = steps.map(|((_, upper), (_, lower))| upper - lower).filter(|step| *step > SAME_LEVEL);
    // A_p of the paper is the largest depth of cut, so a ramp that begins above it begins in the air at every
    // level.
    steps.reduce(f64::max)
}
