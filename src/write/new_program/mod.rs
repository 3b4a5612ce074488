//! This module writes whole new programs in the text of a dialect, which reads back as exactly the intended
//! program.
//!
//! A [`ProgramDraft`] holds the intended program in numbers that the dialect can print
//! ([`round_coordinate`]). [`write_program()`] makes the text and reads it back before anyone gets it. There
//! is one file for each dialect, made after programs of these systems.

mod catia;
mod creo;
mod draft;
mod nx;
mod read_back;

pub use draft::{DraftMove, DraftMoveKind, DraftTool, ProgramDraft};
pub use read_back::ReadBackError;

use crate::program::{Dialect, MotionClass};
use nalgebra::Point3;

/// The dialects in which whole programs can be written.
pub const WRITABLE: [Dialect; 3] = [Dialect::Nx, Dialect::Catia, Dialect::Creo];

/// Returns the decimals of coordinates in a dialect's programs (measured; see [`WRITABLE`] for the dialects
/// that are written).
pub(crate) fn coordinate_decimals(dialect: Dialect) -> usize {
    match dialect {
        Dialect::Catia => 5,
        Dialect::Creo => 10,
        _ => 4,
    }
}

/// Returns whether the direction of an arc in a vertical plane is known in a dialect. It is measured in NX
/// and given by INDIRV in CATIA. No arc of Creo was ever seen.
pub fn can_write_arcs(dialect: Dialect) -> bool {
    matches!(dialect, Dialect::Nx | Dialect::Catia)
}

/// Returns a coordinate as the dialect prints it.
pub fn round_coordinate(value: f64, dialect: Dialect) -> f64 {
    round_to_decimals(value, coordinate_decimals(dialect))
}

/// Returns a feed as the dialect prints it: with six decimals in Creo, four elsewhere.
pub(crate) fn round_feed(value: f64, dialect: Dialect) -> f64 {
    round_to_decimals(value, if dialect == Dialect::Creo { 6 } else { 4 })
}

/// Rounds a value to a number of decimals.
fn round_to_decimals(value: f64, decimals: usize) -> f64 {
    let scale = 10f64.powi(decimals as i32);
    let rounded = (value * scale).round() / scale;
    // Minus zero would be printed with its sign.
    if rounded == 0.0 { 0.0 } else { rounded }
}

/// The words of a dialect, in the order in which they are written.
trait DialectWriter {
    /// Writes everything up to the first motion.
    fn write_start(&mut self, draft: &ProgramDraft);
    /// Writes the class of the next motions.
    fn write_class(&mut self, class: MotionClass);
    /// Writes a new feed for the following motions.
    fn write_feed(&mut self, feed: f64);
    /// Writes a rapid to a point.
    fn write_rapid(&mut self, to: Point3<f64>);
    /// Writes a straight motion at feed.
    fn write_line(&mut self, to: Point3<f64>);
    /// Writes an arc at feed.
    fn write_arc(&mut self, arc: &ArcMove);
    /// Writes everything after the last motion and returns the text.
    fn write_end(&mut self, draft: &ProgramDraft) -> Vec<u8>;
}

/// An arc between two points.
struct ArcMove {
    from: Point3<f64>,
    to: Point3<f64>,
    centre: Point3<f64>,
    /// The unit vector about which the sweep is counter-clockwise.
    axis: nalgebra::Vector3<f64>,
}

/// Writes a draft as a program of a dialect of [`WRITABLE`], or of NX for any other dialect.
///
/// ```
/// use clsmith::program::{Dialect, LengthUnit, MotionClass};
/// use clsmith::write::new_program::{DraftMove, DraftMoveKind, DraftTool, ProgramDraft, write_program};
/// use nalgebra::Point3;
///
/// let draft = ProgramDraft {
///     name: "PLATE".to_owned(),
///     operation: "SLOT".to_owned(),
///     tool: DraftTool {
///         number: 3,
///         name: "EM10".to_owned(),
///         diameter: 10.0,
///         corner_radius: 0.0,
///         length: 75.0,
///     },
///     spindle: Some(5000.0),
///     coolant: false,
///     units: LengthUnit::Mm,
///     tolerance: 0.01,
///     moves: vec![
///         DraftMove {
///             to: Point3::new(0.0, 0.0, 5.0),
///             way: DraftMoveKind::Rapid,
///             class: MotionClass::Rapid,
///         },
///         DraftMove {
///             to: Point3::new(40.0, 0.0, 5.0),
///             way: DraftMoveKind::Line { feed: 800.0 },
///             class: MotionClass::Cut,
///         },
///     ],
/// };
/// let text = String::from_utf8(write_program(&draft, Dialect::Nx)?)?;
/// assert!(text.contains("FEDRAT/MMPM,800.0000\nGOTO/40.0000,0.0000,5.0000"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns a [`ReadBackError`] if the text does not read back as the draft, because of numbers that the
/// dialect cannot print or names that it cannot hold.
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
        // The first motion has no start, so it cannot be an arc.
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
