//! This module reads a written program back: it must mean what the draft means, and nothing else.

use super::{DraftMove, DraftMoveKind, ProgramDraft};
use crate::parse::parse;
use crate::program::geometry::{CircularArc, MotionPath};
use crate::program::motion::Motion;
use crate::program::{Dialect, Program};
use crate::source::Source;
use std::fmt;

/// The largest relative difference of coordinates. They are printed exactly as they were rounded, so only the
/// arithmetic of `f64` may differ.
const SAME: f64 = 1e-9;

/// The largest difference of an arc's radii at its ends, in units of the last decimal; the coordinates are
/// rounded.
const ARC_SLACK: f64 = 4.0;

/// A program does not read back as it was intended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadBackError {
    /// The number of the motion, from 1; 0 for the program as a whole.
    pub motion: usize,
    /// The difference.
    pub reason: String,
}

impl fmt::Display for ReadBackError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "motion {}: {}", self.motion, self.reason)
    }
}

impl std::error::Error for ReadBackError {}

/// Checks that a text means what a draft means.
pub(super) fn check_read_back(
    text: &[u8],
    draft: &ProgramDraft,
    dialect: Dialect,
) -> Result<(), ReadBackError> {
    let whole = |reason: String| ReadBackError { motion: 0, reason };
    // In a name, a line end would begin a statement, a comma a field, and a dollar sign a comment.
    let breaks = |c: char| !(c.is_ascii_graphic() || c == ' ') || matches!(c, ',' | '$');
    if let Some(name) =
        [&draft.name, &draft.operation, &draft.tool.name].into_iter().find(|name| name.contains(breaks))
    {
        return Err(whole(format!("`{}` is no name that a program can hold", name.escape_debug())));
    }
    let source =
        Source::new("the written program", text.to_vec()).map_err(|error| whole(error.to_string()))?;
    // The dialect is not given, because the text itself must show it.
    let parsed = parse(&source, None);
    if let Some(found) = parsed.diagnostics.first() {
        return Err(whole(format!("{}: {}", found.code, found.message)));
    }
    let program: Program = parsed.program;
    if program.dialect() != dialect {
        return Err(whole(format!("it reads as {}", program.dialect())));
    }
    let mut motions = program.motions();
    let mut count = 0;
    for (index, meant) in draft.moves.iter().enumerate() {
        let Some(motion) = motions.next() else { break };
        let slack = ARC_SLACK * 10f64.powi(-(super::coordinate_decimals(dialect) as i32));
        check_motion(meant, &motion, slack)
            .map_err(|found| ReadBackError { motion: index + 1, reason: found.to_string() })?;
        count += 1;
    }
    if count != draft.moves.len() || motions.next().is_some() {
        return Err(whole(format!("{} motions were meant, others were read", draft.moves.len())));
    }
    match motions.take_problems().first() {
        Some(problem) => Err(whole(format!("{:?}", problem.kind))),
        None => Ok(()),
    }
}

/// The difference between a motion that was read back and the intended one. Lengths are in the file's unit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
enum MotionDifference {
    #[error("it ends {0} from where it should")]
    End(f64),
    #[error("rapid or feed, the other was meant")]
    RapidOrFeed,
    #[error("feed {read:?}, {meant} was meant")]
    Feed { read: Option<f64>, meant: f64 },
    #[error("the arc turns otherwise: {0:?}")]
    Arc(Box<CircularArc>),
    #[error("the arc ends {0} off its circle")]
    ArcEnd(f64),
    #[error("another kind of path: {0:?}")]
    Path(MotionPath),
}

/// Compares a motion with the intended one.
fn check_motion(meant: &DraftMove, motion: &Motion, slack: f64) -> Result<(), MotionDifference> {
    let off = (motion.to.point - meant.to).norm();
    if off.is_nan() || off > SAME * (1.0 + meant.to.coords.norm()) {
        return Err(MotionDifference::End(off));
    }
    if motion.rapid != (meant.way == DraftMoveKind::Rapid) {
        return Err(MotionDifference::RapidOrFeed);
    }
    let feed = motion.feed.map(|feed| feed.value);
    if let Some(meant) = meant.way.feed()
        && !feed.is_some_and(|feed| (feed - meant).abs() <= SAME * (1.0 + meant))
    {
        return Err(MotionDifference::Feed { read: feed, meant });
    }
    match (&meant.way, &motion.path) {
        (DraftMoveKind::Arc { centre, axis, .. }, MotionPath::Arc(arc)) => {
            let turned = arc.axis.dot(axis);
            let off = (arc.center - centre).norm();
            // The axis has seven decimals, but the points that define the plane only have four.
            if off > SAME * (1.0 + centre.coords.norm()) || turned < 0.99 || arc.sweep > 3.2 {
                return Err(MotionDifference::Arc(arc.clone()));
            }
            let end = arc.end_deviation(motion.to.point);
            if end > slack { Err(MotionDifference::ArcEnd(end)) } else { Ok(()) }
        }
        (DraftMoveKind::Rapid | DraftMoveKind::Line { .. }, MotionPath::Line | MotionPath::Start) => Ok(()),
        (_, path) => Err(MotionDifference::Path(path.clone())),
    }
}
