//! This module refuses motions that would be cut into far too many pieces, before memory or time is spent on
//! them.

use super::Machining;
use super::tooling::statement_span;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::engagement::{MOST_PIECES, PathLinearizer};
use crate::number::format_significant_number;

impl Machining<'_> {
    /// Refuses the program if one of its first motions would be cut into more than [`MOST_PIECES`] pieces. `trace`
    /// cuts them as the run does, `take` tells which motions are cut, by the index of their cutter.
    ///
    /// # Errors
    /// Returns [`codes::TOO_MANY_PIECES`] for the first such motion.
    pub(super) fn refuse_too_many_pieces(
        &self,
        mut trace: PathLinearizer,
        motions: usize,
        take: &dyn Fn(usize) -> bool,
    ) -> Result<(), Failure> {
        for (number, motion) in self.program.motions().take(motions).enumerate() {
            trace.adopt_workpiece_frame(&motion);
            if !self.tooling.cutter_index(&motion).is_some_and(take) {
                continue;
            }
            let Some(pieces) = trace.find_too_many_pieces((number, &motion)) else { continue };
            let message = format!(
                "this motion would be cut into {} pieces, more than the {MOST_PIECES} that one may have",
                format_significant_number(pieces, 2, 0)
            );
            let at = statement_span(self.program, motion.last_statement());
            let found = Diagnostic::new(codes::TOO_MANY_PIECES, message);
            return Err(found.with_label(self.program.source(), at, "this motion").into());
        }
        Ok(())
    }
}
