//! This module tells where the bound of a chip is not the certified one, or is wider than it could be.

use crate::diagnostic::{Diagnostic, DiagnosticCode, Failure, codes};
use crate::presentation::text_format::format_counted;
use crate::program::Program;
use crate::simulation_run::certified_shares::CertifiedShares;
use crate::transform::StepContext;

/// Reports what could not be certified. `shares` is `None` where nothing was.
pub(super) fn report_uncertified(shares: Option<&CertifiedShares>, context: &mut StepContext<'_>) {
    let Some(shares) = shares else {
        let message = "chips and loads are bounded by columns, which miss what is thinner than they are apart: a coordinate of the \
                       program is beyond a kilometre, or a body of the stock holds nothing";
        return add_finding(codes::NOT_CERTIFIED, message.to_owned(), context);
    };
    if shares.unbounded > 0 {
        let message = format!(
            "the chips and loads of {} are bounded by columns, which miss what is thinner than they are apart: their tools are \
             narrower above their widest place, or have inserts that do not cut in the middle",
            count_motions(shares.unbounded)
        );
        add_finding(codes::NOT_CERTIFIED, message, context);
    }
    if shares.has_columns {
        let message =
            "the stock is what another program left, in columns: a ridge between two of them is not in it";
        add_finding(codes::ASSUMPTION, message.to_owned(), context);
    }
    let wide = shares.count_wide_pieces();
    if wide > 0 {
        let message = format!(
            "the largest chips of {} are bounded less tightly than to 1 %: their feeds are safe, and may be lower than \
             they had to be",
            count_motions(wide)
        );
        add_finding(codes::WIDE_BOUND, message, context);
    }
}

/// Makes the error for a motion of which a point is above its certified bound.
pub(super) fn describe_refutation(program: &Program, motion: usize, context: &StepContext<'_>) -> Failure {
    let message = "a point of this motion cuts a thicker chip than its bound says; nothing is written";
    let span =
        program.motions().nth(motion).map(|motion| program.statement(motion.last_statement()).origin());
    debug_assert!(span.is_some(), "the motion was measured");
    let found = Diagnostic::new(codes::BOUND_REFUTED, message);
    let found = found.with_label(program.source(), span.unwrap_or_default(), "above its bound");
    context.label_step(found, "asked for by this step").into()
}

fn count_motions(count: usize) -> String {
    format_counted(count, "motion", "motions")
}

fn add_finding(code: DiagnosticCode, message: String, context: &mut StepContext<'_>) {
    let found = context.label_step(Diagnostic::new(code, message), "asked for by this step");
    context.findings.push(found);
}
