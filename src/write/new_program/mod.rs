//! Whole programs, written new: what a program shall do, as text of a dialect that reads back as exactly that.
//!
//! A [`ProgramDraft`] says what is meant, in numbers that the dialect can print ([`round_coordinate`]). [`write_program()`] makes the text, one file for each
//! dialect after programs of these systems, and reads it back before anybody gets it.

mod catia;
mod creo;
mod draft;
mod nx;
mod read_back;

pub use draft::{DraftMove, DraftMoveKind, DraftTool, ProgramDraft};
pub use read_back::ReadBackError;

use crate::program::{Dialect, MotionClass};
use nalgebra::Point3;

/// The dialects that whole programs can be written in.
pub const WRITABLE: [Dialect; 3] = [Dialect::Nx, Dialect::Catia, Dialect::Creo];

/// Decimals of coordinates in a dialect's programs (measured; see [`WRITABLE`] for those that are written).
pub fn coordinate_decimals(dialect: Dialect) -> usize {
    match dialect {
        Dialect::Catia => 5,
        Dialect::Creo => 10,
        _ => 4,
    }
}

/// Whether the sense of an arc in a vertical plane is known in a dialect: measured in NX, told by INDIRV in CATIA. No arc of Creo's was ever
/// seen.
pub fn can_write_arcs(dialect: Dialect) -> bool {
    matches!(dialect, Dialect::Nx | Dialect::Catia)
}

/// A coordinate as the dialect prints it.
pub fn round_coordinate(value: f64, dialect: Dialect) -> f64 {
    round_to_decimals(value, coordinate_decimals(dialect))
}

/// A feed as the dialect prints it: with six decimals in Creo, four elsewhere.
pub fn round_feed(value: f64, dialect: Dialect) -> f64 {
    round_to_decimals(value, if dialect == Dialect::Creo { 6 } else { 4 })
}

fn round_to_decimals(value: f64, decimals: usize) -> f64 {
    let scale = 10f64.powi(decimals as i32);
    let rounded = (value * scale).round() / scale;
    // Minus zero would be printed as such.
    if rounded == 0.0 { 0.0 } else { rounded }
}

/// What the dialects have to say in their own words, in the order in which it is asked for.
trait DialectWriter {
    /// Everything up to the first motion.
    fn write_start(&mut self, draft: &ProgramDraft);
    /// What the next motions are for.
    fn write_class(&mut self, class: MotionClass);
    /// A new feed, for motions from here on.
    fn write_feed(&mut self, feed: f64);
    /// A rapid to a point.
    fn write_rapid(&mut self, to: Point3<f64>);
    /// A straight motion at feed.
    fn write_line(&mut self, to: Point3<f64>);
    /// An arc at feed.
    fn write_arc(&mut self, arc: &ArcMove);
    /// Everything after the last motion.
    fn write_end(&mut self, draft: &ProgramDraft) -> Vec<u8>;
}

/// An arc between two points.
struct ArcMove {
    from: Point3<f64>,
    to: Point3<f64>,
    centre: Point3<f64>,
    /// The sweep is counter-clockwise about it.
    axis: nalgebra::Vector3<f64>,
}

/// Writes a draft as a program of a dialect of [`WRITABLE`], NX for any other.
///
/// # Errors
/// [`ReadBackError`] when the text does not read back as the draft: numbers that the dialect cannot print, or names that it does not hold.
pub fn write_program(draft: &ProgramDraft, dialect: Dialect) -> Result<Vec<u8>, ReadBackError> {
    let mut writer: Box<dyn DialectWriter> = match dialect {
        Dialect::Catia => Box::new(catia::CatiaWriter::default()),
        Dialect::Creo => Box::new(creo::CreoWriter::default()),
        _ => Box::new(nx::NxWriter::default()),
    };
    writer.write_start(draft);
    let mut class = None;
    let mut feed = None;
    let mut at = None;
    for step in &draft.moves {
        if class != Some(step.class) {
            writer.write_class(step.class);
            class = Some(step.class);
        }
        if let Some(wanted) = step.way.feed()
            && feed != Some(wanted)
        {
            writer.write_feed(wanted);
            feed = Some(wanted);
        }
        match (&step.way, at) {
            (DraftMoveKind::Rapid, _) => writer.write_rapid(step.to),
            (DraftMoveKind::Arc { centre, axis, .. }, Some(from)) => {
                writer.write_arc(&ArcMove { from, to: step.to, centre: *centre, axis: *axis });
            }
            (DraftMoveKind::Line { .. } | DraftMoveKind::Arc { .. }, _) => writer.write_line(step.to),
        }
        at = Some(step.to);
    }
    let text = writer.write_end(draft);
    read_back::check_read_back(&text, draft, dialect)?;
    Ok(text)
}
