//! This module tells where the bound of a chip is not the certified one, or is wider than it could be.

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::program::Program;
use crate::simulation_run::certified_shares::CertifiedShares;
use crate::transform::StepContext;

/// Reports what could not be certified. `shares` is `None` for stock of which only columns are known.
pub(super) fn report_uncertified(shares: Option<&CertifiedShares>, context: &mut StepContext<'_>) {
    let Some(shares) = shares else {
        let message = "chips are bounded by columns, which miss what is thinner than they are apart: the stock is a mesh, \
                       or what another program left";
        return add_finding(codes::NOT_CERTIFIED, message.to_owned(), context);
    };
    if shares.unbounded > 0 {
        let message = format!(
            "the chips of {} are bounded by columns, which miss what is thinner than they are apart: their tools are \
             narrower above their widest place",
            count_motions(shares.unbounded)
        );
        add_finding(codes::NOT_CERTIFIED, message, context);
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
    if count == 1 { "1 motion".to_owned() } else { format!("{count} motions") }
}

fn add_finding(code: crate::diagnostic::DiagnosticCode, message: String, context: &mut StepContext<'_>) {
    let found = context.label_step(Diagnostic::new(code, message), "asked for by this step");
    context.findings.push(found);
}
