//! `convert_units` converts a program between millimetres and inches.

mod statement_pass;
mod unit_conversion;
mod unit_words;

use super::{StepContext, Transform, stale_records, unchanged_statements};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::program::{LengthUnit, Program, Record};
use crate::write::ProgramEditor;
use schemars::JsonSchema;
use serde::Deserialize;
use unit_conversion::UnitConversion;

/// Converts a program to millimetres or inches.
///
/// Everything with a length is converted: points, radii, tool shapes, cycle distances, tolerances, boxes and
/// the origins of frames. Angles, directions, knots, counts and times stay. Feeds change with their words:
/// `MMPM` and `IPM` swap, and so do `MMPR` and `IPR`. PERMIN and feeds without a word change their value, and
/// inverse-time feeds stay. Surface speeds change with their words (`SMM`, `SFM`). The unit record is
/// rewritten in the file's own spelling. From millimetres to inches, numbers get two decimals more (up to
/// eight), so that converting back gives the same points within 0.0001 mm.
///
/// The old unit is the one that the file states. A file that states none needs `from`. No unit record is
/// added to such a file.
///
/// The step is idempotent where the file states its unit: a program that already has the unit is left
/// unchanged. A file that states no unit is refused if its feeds already name the new unit.
///
/// ```yaml
/// version: 1
/// steps:
///   # A file that states its unit needs no `from`.
///   - convert_units: { from: mm, to: inch }
/// ```
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConvertUnits {
    /// The unit that the program will have.
    pub to: LengthUnit,
    /// The unit that the program has now. It is only needed where the file does not state it (NX, CATIA), and
    /// an error where the file states another.
    #[schemars(extend("x-default" = "what the file states"))]
    pub from: Option<LengthUnit>,
}

impl ConvertUnits {
    /// Makes the step for a file that states its unit.
    pub fn new(to: LengthUnit) -> Self {
        Self { to, from: None }
    }
}

/// This step makes a program in inches of one in millimetres.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::{ConvertUnits, run_steps};
///
/// let part = b"UNITS/MM\nFEDRAT/MMPM,508.\nGOTO/25.4,0.,0.\n";
/// let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
/// let step = ConvertUnits::new(LengthUnit::Inch);
/// let outcome = run_steps(&[&step], LengthUnit::Mm, &Setup::default(), program)?;
/// let text = String::from_utf8(outcome.program.to_bytes())?;
/// assert!(text.contains("FEDRAT/IPM,20."), "{text}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl Transform for ConvertUnits {
    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure> {
        let stated = self.check_stated_unit(&program, context)?;
        let Some(from) = stated.or(self.from) else {
            let finding = context.step_finding(
                codes::STEP_FAILED,
                "the file does not state the unit of its lengths, and neither does the step",
                &[],
                "asked for here",
            );
            return Err(finding.with_help(
                "Add `from: mm` or `from: inch`. Feeds in MMPM or IPM and the sizes of the tools show which one is right.",
            ).into());
        };
        if from == self.to {
            return Ok(program);
        }
        if stated.is_none() && program.feed_length_unit() == Some(self.to) {
            let finding = context.step_finding(
                codes::STEP_FAILED,
                "the feeds of this file already name the new unit, so the file seems to be converted",
                &["from"],
                "the step assumes that it is not",
            );
            return Err(finding.with_help(
                "A second conversion would put every point off by a factor of 25.4. If the lengths really are in the old unit, give the feeds \
                 its words first, by a `rewrite` step.",
            ).into());
        }
        let mut found = StepContext {
            findings: Vec::new(),
            reports: Vec::new(),
            shares: crate::simulation_run::KnownShares::default(),
            ..*context
        };
        if stated.is_none() {
            found.findings.push(unsaid_unit_finding(&found, self.to));
        }
        stale_records::report_stale_after_conversion(&program, &mut found);
        unchanged_statements::report_unchanged_statements(&program, |_| true, "converted", &mut found);
        let found = found.findings;
        let conversion = UnitConversion { from, to: self.to };
        let mut editor = ProgramEditor::new(program, context.step);
        editor.set_extra_decimals(conversion.extra_decimals());
        statement_pass::convert_statements(&mut editor, conversion, context)?;
        context.findings.extend(found);
        editor.finish()
    }
}

impl ConvertUnits {
    /// Returns the unit that the file states. All its unit records and the step must agree.
    fn check_stated_unit(
        &self,
        program: &Program,
        context: &StepContext<'_>,
    ) -> Result<Option<LengthUnit>, Failure> {
        let mut stated = None;
        for (id, statement) in program.live_statements() {
            let Record::Units(unit) = statement.record() else { continue };
            if stated.is_some_and(|before| before != *unit) {
                let message = "the file changes its unit between statements, so it is not clear which lengths have which unit";
                return Err(context.statement_failure(message, program, id, "another unit than before"));
            }
            if self.from.is_some_and(|from| from != *unit) {
                let message = "`from` names another unit than the file itself; remove `from`, or correct it";
                return Err(context.statement_failure(message, program, id, "the file's unit"));
            }
            stated = Some(*unit);
        }
        Ok(stated)
    }
}

fn unsaid_unit_finding(context: &StepContext<'_>, to: LengthUnit) -> Diagnostic {
    let name = match to {
        LengthUnit::Mm => "millimetres",
        LengthUnit::Inch => "inches",
    };
    let message =
        format!("the file has no unit record, so nothing in it says that its lengths are {name} now");
    context
        .step_finding(codes::NOT_CHANGED, message, &["to"], "converted here")
        .with_help("Tell the post, or check that it takes the unit from the words of the feeds (MMPM, IPM).")
}
