//! This module finds the records that new arcs are modelled on.

use crate::diagnostic::Failure;
use crate::program::record::{ArcSense, Circle};
use crate::program::{ArcRule, Program, Record, StatementId};
use crate::surface::profile::{ArcPiece, ChainPiece, Point, ProfilePlane};
use crate::transform::statement_numbers::{copy_statement, major_word, pair_with_indices};
use crate::write::ProgramEditor;
use nalgebra::{Point3, Vector3};

/// The records with which a file states an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ArcTemplate {
    /// CIRCLE and GOTO.
    Circle {
        statement: StatementId,
        has_radius: bool,
        /// It is 1 where the printed axis is right-handed, and -1 where it is left-handed.
        hand: f64,
    },
    /// CATIA's INDIRV and TLON, with AUTOPS before them where the file has that.
    Drive { auto: Option<StatementId>, direction: StatementId, drive: StatementId },
}

/// Returns the records of the first arc whose sense of rotation is known. Returns `None` if the file has
/// none.
pub(super) fn find_arc_template(program: &Program) -> Option<ArcTemplate> {
    let hand = match program.dialect().arc_rule() {
        ArcRule::LeftHand => -1.0,
        ArcRule::RightHand => 1.0,
        ArcRule::ByWord | ArcRule::FromTangent => return find_drive_template(program),
    };
    let plain = |circle: &Circle| circle.times <= 1 && circle.sense == ArcSense::OfDialect;
    program.live_statements().find_map(|(statement, found)| match found.record() {
        Record::Circle(circle) if plain(circle) => {
            Some(ArcTemplate::Circle { statement, has_radius: circle.radius.is_some(), hand })
        }
        _ => None,
    })
}

/// Returns the first TLON of half a turn or less. It has ten numbers and no INTOF.
fn find_drive_template(program: &Program) -> Option<ArcTemplate> {
    let (mut auto, mut direction, mut drive) = (None, None, None);
    for (statement, found) in program.live_statements() {
        let text = program.statement_text(found);
        let place = match found.record() {
            Record::StartDirection(_) => &mut direction,
            Record::DriveArc(arc)
                if !arc.beyond_half && crate::parse::statement_numbers(text).len() == 10 =>
            {
                &mut drive
            }
            Record::Known if major_word(text) == "AUTOPS" => &mut auto,
            _ => continue,
        };
        place.get_or_insert(statement);
    }
    Some(ArcTemplate::Drive { auto, direction: direction?, drive: drive? })
}

impl ArcTemplate {
    /// Inserts an arc of half a turn or less before a statement. Returns whether a GOTO must follow that
    /// states the end of the arc.
    ///
    /// # Errors
    /// Returns an error if a new statement does not read back.
    pub(super) fn insert_arc(
        &self,
        editor: &mut ProgramEditor,
        arc: &ArcPiece,
        plane: &ProfilePlane,
        mm_per_unit: f64,
        before: StatementId,
    ) -> Result<bool, Failure> {
        let space = |point: Point| plane.to_space(point);
        let displacement =
            |u: f64, z: f64| (space(Point::new(u, z)) - space(Point::default())).map(zero_out_rounding);
        let place = |point: Point3<f64>| -> [f64; 3] { (point / mm_per_unit).coords.into() };
        let centre = place(space(arc.centre));
        match *self {
            Self::Circle { statement, has_radius, hand } => {
                // A rotation from +u towards +z is right-handed about u x z.
                let axis =
                    displacement(1.0, 0.0).cross(&displacement(0.0, 1.0)) * (arc.sweep_rad.signum() * hand);
                let mut numbers = pair_with_indices(0, centre);
                numbers.extend(pair_with_indices(3, <[f64; 3]>::from(axis.map(zero_out_rounding))));
                if has_radius {
                    numbers.push((6, arc.radius_mm / mm_per_unit));
                }
                editor.insert_before(before, &copy_statement(editor, statement, &numbers))?;
                Ok(true)
            }
            Self::Drive { auto, direction, drive } => {
                let tangent = ChainPiece::Arc(*arc).direction_at(0.0);
                let tangent: Vector3<f64> = displacement(tangent.u, tangent.z).normalize();
                let mut numbers = pair_with_indices(0, centre);
                numbers.push((3, arc.radius_mm / mm_per_unit));
                numbers.extend(pair_with_indices(4, centre));
                numbers.extend(pair_with_indices(7, place(space(ChainPiece::Arc(*arc).end()))));
                if let Some(auto) = auto {
                    editor.insert_before(before, &copy_statement(editor, auto, &[]))?;
                }
                editor.insert_before(
                    before,
                    &copy_statement(
                        editor,
                        direction,
                        &pair_with_indices(0, <[f64; 3]>::from(tangent.map(zero_out_rounding))),
                    ),
                )?;
                editor.insert_before(before, &copy_statement(editor, drive, &numbers))?;
                Ok(false)
            }
        }
    }
}

/// Replaces rounding noise by zero, because the number would otherwise be printed as zero with a sign.
fn zero_out_rounding(part: f64) -> f64 {
    if part.abs() < 1e-9 { 0.0 } else { part }
}
