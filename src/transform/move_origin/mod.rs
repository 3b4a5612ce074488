//! `move_origin` moves, rotates or mirrors the path, by changing its points or its frame.

mod arc_sweeps;
mod axis_notation;
mod frame;
mod handedness_words;
mod lathe_plane;
mod move_parameters;
mod move_tracker;
mod moved_statements;
mod points;

use super::unit_slips::check_displacement;
use super::{SelectedStatements, StepContext, Transform, stale_records, unchanged_statements};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::program::Program;
use crate::recipe::OperationFilter;
pub use move_parameters::{DirectionSpec, MirrorSpec, RotationSpec, VectorSpec};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Moves, rotates or mirrors the path.
///
/// `mirror` is applied first, then `rotate`, then `translate`, each in the coordinates that the program
/// prints. At least one of them is needed.
///
/// With `change: points` (the default), every point, direction and arc axis gets new numbers: GOTO, FROM,
/// GOHOME, GODLTA, CIRCLE, MOVARC, INDIRV and TLON, TLAXIS, and the control points of splines. Cycle depths
/// are relative to their holes and stay. With `change: frame`, the points stay and the frame record changes
/// instead, so that the path is at the same place outside: NX `MSYS`, Creo `CSYS` and `CAMERA` (translation
/// only), CATIA's matrix in comments. The two are never combined.
///
/// A tool axis that the file leaves at its default (0,0,1) is written where the transform rotates it. A
/// mirror swaps the sense of arcs and the sides of CUTCOM. The spindle keeps its sense, so climb milling
/// becomes conventional milling, which is reported. Records that still describe the old position are
/// reported, because their new values would be guesses.
///
/// The step is not idempotent: a second run moves the path again. A transform that moves nothing changes no
/// byte.
///
/// ```yaml
/// version: 1
/// units: mm
/// steps:
///   - move_origin: { rotate: { axis: z, degrees: 90 }, translate: [250, 0, 0] }
/// ```
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MoveOrigin {
    /// The plane of the mirror: `x`, `y` or `z` (the plane normal to it, through the origin), or `{ normal:
    /// [1, 1, 0], through: [0, 0, 0] }`.
    #[schemars(extend("x-unit" = "none (a direction of any length)", "x-default" = "no mirror"))]
    pub mirror: Option<MirrorSpec>,
    /// The rotation: `{ axis: z, degrees: 90, about: [0, 0, 0] }`.
    #[schemars(extend("x-default" = "no rotation"))]
    pub rotate: Option<RotationSpec>,
    /// The displacement that is added to every point: `[x, y, z]`, in the recipe's unit.
    #[schemars(extend("x-unit" = "the recipe's unit", "x-default" = "no displacement"))]
    pub translate: Option<move_parameters::VectorSpec>,
    /// What gets new numbers: the points, or the frame in which they are printed.
    #[serde(default)]
    pub change: MoveOriginTarget,
    /// Which operations are meant; all of them when it is left out.
    #[serde(default)]
    #[schemars(extend("x-default" = "the whole program"))]
    pub r#where: OperationFilter,
}

impl MoveOrigin {
    /// Reports lengths that look like slips of units.
    fn check_slips(&self, context: &mut StepContext<'_>) {
        let mm_per_unit = context.units.mm_per_unit();
        let largest_mm = |spec: &move_parameters::VectorSpec| {
            spec.iter().map(|value| value.get().abs()).fold(0.0, f64::max) * mm_per_unit
        };
        if let Some(translate) = &self.translate {
            check_displacement(largest_mm(translate), &["translate"], context);
        }
        if let Some(about) = self.rotate.as_ref().and_then(|rotate| rotate.about.as_ref()) {
            check_displacement(largest_mm(about), &["rotate", "about"], context);
        }
        if let Some(mirror) = &self.mirror {
            check_displacement(mirror.through.amax() * mm_per_unit, &["mirror"], context);
        }
    }
}

/// What `move_origin` changes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MoveOriginTarget {
    /// The points, directions and axes.
    #[default]
    Points,
    /// The frame record (MSYS, CSYS, CAMERA, CATIA's matrix).
    Frame,
}

/// This step moves the path up by an inch.
///
/// ```
/// use clsmith::parameters::Finite;
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::{MoveOrigin, run_steps};
///
/// let up = [0.0, 0.0, 25.4].map(|value| Finite::new(value).expect("it is finite"));
/// let step = MoveOrigin { translate: Some(up), ..MoveOrigin::default() };
/// let program = parse(&Source::new("part.cls", b"GOTO/1.0000,2.0000,-4.0000\n".to_vec())?, None).program;
/// let outcome = run_steps(&[&step], LengthUnit::Mm, &Setup::default(), program)?;
/// assert_eq!(outcome.program.to_bytes(), b"GOTO/1.0000,2.0000,21.4000\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl Transform for MoveOrigin {
    /// Returns whether a parameter is a length. A rotation about the origin has none.
    fn measures(&self) -> bool {
        let is_length = |triple: &move_parameters::VectorSpec| triple.iter().any(|value| value.get() != 0.0);
        self.translate.as_ref().is_some_and(is_length)
            || self.rotate.as_ref().and_then(|rotate| rotate.about.as_ref()).is_some_and(is_length)
            || self.mirror.as_ref().is_some_and(|mirror| mirror.through.norm() > 0.0)
    }

    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure> {
        if self.mirror.is_none() && self.rotate.is_none() && self.translate.is_none() {
            return Err(context.step_failure("none of `mirror`, `rotate` and `translate` is given; add one, for example `translate: [10, 0, 0]`", &[]));
        }
        self.check_slips(context);
        let file = context.file_length_unit(&program);
        let place = move_parameters::compose_affine(
            self.mirror.as_ref(),
            self.rotate.as_ref(),
            self.translate.as_ref(),
            context.units,
            file,
        );
        let scope = SelectedStatements::select(&self.r#where, &program, "operation", context);
        if scope.is_empty() || place.is_identity() {
            return Ok(program);
        }
        if self.change == MoveOriginTarget::Frame {
            return frame::move_frames(program, &place, &scope, context);
        }
        let mut found = StepContext {
            findings: Vec::new(),
            reports: Vec::new(),
            shares: crate::simulation_run::KnownShares::default(),
            ..*context
        };
        if place.has_mirror() {
            found.findings.push(mirrored_spindle_finding(&found));
        }
        stale_records::report_stale_after_move(&program, &place, &mut found);
        unchanged_statements::report_unchanged_statements(
            &program,
            |statement| scope.contains(statement),
            "moved",
            &mut found,
        );
        let shift = lathe_plane::check_lathe_plane(&program, &place, &scope, context).map_err(|refusal| {
            context.statement_failure(refusal.message, &program, refusal.statement, refusal.label)
        })?;
        found.findings.extend(shift);
        let found = found.findings;
        let sweeps = arc_sweeps::collect_sweeps(&program);
        let program = points::move_points(program, &place, &scope, context)?;
        arc_sweeps::check_sweeps(&program, &sweeps)
            .map_err(|place| context.source_finding(ROUNDED_ARC, &program, place, "the arc ends here"))?;
        context.findings.extend(found);
        Ok(program)
    }
}

const ROUNDED_ARC: &str = "this arc is so short that its ends coincide when they are rounded to the file's decimals, and it would be \
                           read as a full turn. Quarter turns and mirrors in x, y or z do not round";

fn mirrored_spindle_finding(context: &StepContext<'_>) -> Diagnostic {
    let message =
        "the spindle keeps its sense, so climb milling becomes conventional milling in the mirrored path";
    context.step_finding(codes::NOT_CHANGED, message, &["mirror"], "mirrored here").with_help(
        "Check feeds, finish and thread sense; mirror the model in the CAM system to get a path that climbs.",
    )
}
