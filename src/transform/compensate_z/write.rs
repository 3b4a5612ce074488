//! Compensated passes, and what lies around them, in the CL text.

use super::passes::Pass;
use super::profile::sine;
use crate::diagnostic::Diagnostic;
use crate::program::geometry::Path;
use crate::program::motion::Motion;
use crate::program::record::{ArcSense, Circle};
use crate::program::{ArcRule, Program, Record, Statement};
use crate::surface::profile::{Chain, Piece, Plane};
use crate::transform::numbers::without_remark;
use crate::write::{Editor, copy_with_numbers};
use nalgebra::{Point3, Vector3};
use std::f64::consts::PI;

/// Why the statements of a path cannot be given other points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub(super) enum Unwritable {
    #[error("its point shares a statement with others, or is told by a record that says more than a point")]
    NoGoto,
    #[error("its arc or spline is told by records that cannot be moved")]
    Arc,
}

/// Writes points for one program.
pub(super) struct Writer<'a> {
    motions: &'a [Motion],
    mm: f64,
    circle: Option<Template>,
}

/// A CIRCLE that new ones are modelled on.
struct Template {
    statement: usize,
    has_radius: bool,
    /// 1 where the printed axis is right-hand, -1 where it is left-hand.
    hand: f64,
}

impl<'a> Writer<'a> {
    pub fn new(program: &Program, motions: &'a [Motion], mm: f64) -> Self {
        Self { motions, mm, circle: template(program) }
    }

    /// Whether arcs can be said.
    pub fn has_arcs(&self) -> bool {
        self.circle.is_some()
    }

    /// Whether a motion's statements can be given other points.
    ///
    /// # Errors
    /// [`Unwritable`].
    pub fn check(&self, program: &Program, index: usize) -> Result<(), Unwritable> {
        let motion = self.motions.get(index).ok_or(Unwritable::NoGoto)?;
        let last = motion.last_statement();
        let beside = [index.wrapping_sub(1), index + 1];
        let shares = |other: &usize| self.motions.get(*other).is_some_and(|other| other.last_statement() == last);
        if beside.iter().any(shares) || motion.hole.is_some() {
            return Err(Unwritable::NoGoto);
        }
        let record = program.statement(last).map(Statement::record);
        match (record, &motion.path) {
            (Some(Record::Goto(_) | Record::From(_)), _) => Ok(()),
            (Some(Record::GoHome(Some(_))), _) => Ok(()),
            (Some(Record::Points(_)), _) if motion.normal.is_some() => Ok(()),
            (Some(Record::DriveArc(_)), Path::Arc(_)) => Ok(()),
            (Some(Record::Control(_)), Path::Spline(_)) => Ok(()),
            (_, Path::Arc(_) | Path::Spline(_)) => Err(Unwritable::Arc),
            _ => Err(Unwritable::NoGoto),
        }
    }

    fn numbers(&self, point: Point3<f64>) -> Vec<(usize, f64)> {
        let at: [f64; 3] = (point / self.mm).coords.into();
        at.into_iter().enumerate().collect()
    }

    /// Gives a motion that stays another end; an arc whose ends no longer move alike becomes straight.
    ///
    /// # Errors
    /// When a statement does not read back, and for records that cannot be moved.
    pub fn move_end(
        &self,
        editor: &mut Editor,
        index: usize,
        end: Point3<f64>,
        start: Point3<f64>,
    ) -> Result<Result<(), Unwritable>, Box<Diagnostic>> {
        let Some(motion) = self.motions.get(index) else { return Ok(Ok(())) };
        let (by, from) = (end - motion.to.point * self.mm, start - motion.from.point * self.mm);
        let last = motion.last_statement();
        let moves = |by: Vector3<f64>| by.amax() > 1e-9;
        match &motion.path {
            Path::Line | Path::Start if moves(by) => {
                editor.set_numbers(last, &self.numbers(end))?;
            }
            Path::Arc(_) if moves(by) || moves(from) => {
                if let Err(why) = self.check(editor.program(), index) {
                    return Ok(Err(why));
                }
                if (by - from).amax() <= 1e-6 {
                    self.shift(editor, motion, by)?;
                } else if matches!(editor.program().statement(last).map(Statement::record), Some(Record::Goto(_))) {
                    drop_announced(editor, motion);
                    editor.set_numbers(last, &self.numbers(end))?;
                } else {
                    return Ok(Err(Unwritable::Arc));
                }
            }
            Path::Spline(_) if moves(by) || moves(from) => {
                if (by - from).amax() > 1e-6 {
                    return Ok(Err(Unwritable::Arc));
                }
                self.shift(editor, motion, by)?;
            }
            _ => {}
        }
        Ok(Ok(()))
    }

    /// Moves all points of a motion's statements.
    fn shift(&self, editor: &mut Editor, motion: &Motion, by: Vector3<f64>) -> Result<(), Box<Diagnostic>> {
        for statement in motion.statements.clone() {
            let program = editor.program();
            let Some(found) = program.statement(statement).filter(|found| found.is_live()) else { continue };
            if !is_motion(found.record()) {
                continue;
            }
            let text = program.text(found);
            let values: Vec<f64> = crate::parse::numbers(text).into_iter().map(|(_, value)| value).collect();
            let roles = crate::parse::roles(found.record(), text);
            let edits = crate::transform::numbers::change_triples(&values, &roles, |role, point| {
                matches!(role, crate::program::Role::Point(0)).then(|| point + by / self.mm)
            });
            editor.set_numbers(statement, &edits)?;
        }
        Ok(())
    }

    /// Writes a compensated pass over the statements of the old one. What stands between them stays, and comes after the new points
    /// whose contacts came before it.
    ///
    /// # Errors
    /// When a statement does not read back; `Ok(Err)` when there is no GOTO to model new ones on.
    pub fn pass(
        &self,
        editor: &mut Editor,
        pass: &Pass,
        path: &Chain,
        (radius, contact): (f64, bool),
    ) -> Result<Result<(), Unwritable>, Box<Diagnostic>> {
        let Some(goto) = self.goto(editor.program(), pass) else { return Ok(Err(Unwritable::NoGoto)) };
        let breaks = self.breaks(pass, path, if contact { radius } else { 0.0 });
        let forward = if path.end().u >= path.start().u { 1.0 } else { -1.0 };
        let mut pieces = halves(path).into_iter().peekable();
        let mut reached = f64::NEG_INFINITY;
        let count = pass.motions.len();
        for (place, (index, until)) in pass.motions.clone().zip(breaks).enumerate() {
            let Some(motion) = self.motions.get(index) else { continue };
            let mut own: Vec<Piece> = Vec::new();
            while let Some(piece) = pieces.peek() {
                reached = reached.max(piece.end().u * forward);
                if reached > until + 1e-9 && place + 1 < count {
                    break;
                }
                own.extend(pieces.next());
            }
            self.replace(editor, motion, &own, &pass.plane, goto)?;
        }
        Ok(Ok(()))
    }

    /// A GOTO of one point that new ones are modelled on: of the pass, else the nearest before or after it in its operation.
    fn goto(&self, program: &Program, pass: &Pass) -> Option<usize> {
        let is_goto = |index: &usize| {
            let found = self.motions.get(*index).and_then(|motion| program.statement(motion.last_statement()));
            found.is_some_and(|found| found.is_live() && matches!(found.record(), Record::Goto(_)))
        };
        let own = pass.motions.clone().find(is_goto);
        let before = || (0..pass.motions.start).rev().find(is_goto);
        let after = || (pass.motions.end..self.motions.len()).find(is_goto);
        let index = own.or_else(before).or_else(after)?;
        self.motions.get(index).map(Motion::last_statement)
    }

    /// How far along the pass the tip has come (in the path's direction) when the contact reaches the end of each motion.
    fn breaks(&self, pass: &Pass, path: &Chain, radius: f64) -> Vec<f64> {
        let forward = if path.end().u >= path.start().u { 1.0 } else { -1.0 };
        let flat = |point: Point3<f64>| pass.plane.flat(point * self.mm);
        let all = self.motions.get(pass.motions.clone()).unwrap_or_default();
        let mut reached = f64::NEG_INFINITY;
        let mut breaks = Vec::with_capacity(all.len());
        for (index, motion) in all.iter().enumerate() {
            let (from, at) = (flat(motion.from.point), flat(motion.to.point));
            let to = all.get(index + 1).map_or(at, |next| flat(next.to.point));
            let lean = if to == at { sine(from, at, at) * 2.0 } else { sine(from, at, to) };
            reached = reached.max((at.u - radius * lean) * forward);
            breaks.push(reached);
        }
        breaks
    }

    /// Puts pieces in the place of a motion.
    fn replace(
        &self,
        editor: &mut Editor,
        motion: &Motion,
        pieces: &[Piece],
        plane: &Plane,
        goto: usize,
    ) -> Result<(), Box<Diagnostic>> {
        let last = motion.last_statement();
        let simple = matches!(motion.path, Path::Line)
            && matches!(editor.program().statement(last).map(Statement::record), Some(Record::Goto(_)));
        let (put_in, kept) = match pieces.split_last() {
            Some((Piece::Line(line), rest)) if simple => (rest, Some(line.to)),
            _ => (pieces, None),
        };
        for piece in put_in {
            self.insert(editor, piece, plane, goto, motion.statements.start)?;
        }
        match kept {
            Some(end) => editor.set_numbers(last, &self.numbers(plane.space(end)))?,
            None => {
                drop_announced(editor, motion);
                editor.delete(last);
            }
        }
        Ok(())
    }

    fn insert(
        &self,
        editor: &mut Editor,
        piece: &Piece,
        plane: &Plane,
        goto: usize,
        before: usize,
    ) -> Result<(), Box<Diagnostic>> {
        if let (Piece::Arc(arc), Some(template)) = (piece, &self.circle) {
            let up = plane.space(crate::surface::profile::Point::new(0.0, 1.0)) - plane.space(Default::default());
            let along = plane.space(crate::surface::profile::Point::new(1.0, 0.0)) - plane.space(Default::default());
            // From +u towards +z is right-hand about u x z.
            let axis = along.cross(&up) * (arc.sweep.signum() * template.hand);
            let axis = axis.map(|part| if part.abs() < 1e-9 { 0.0 } else { part });
            let mut numbers = self.numbers(plane.space(arc.centre));
            let printed: [f64; 3] = axis.into();
            numbers.extend(printed.into_iter().enumerate().map(|(index, value)| (3 + index, value)));
            if template.has_radius {
                numbers.push((6, arc.radius / self.mm));
            }
            let text = copy(editor, template.statement, &numbers);
            editor.insert_before(before, &text)?;
        }
        let text = copy(editor, goto, &self.numbers(plane.space(piece.end())));
        editor.insert_before(before, &text)
    }
}

/// The pieces, arcs of more than half a turn in two.
fn halves(path: &Chain) -> Vec<Piece> {
    let halve = |piece: &Piece| match piece {
        Piece::Arc(arc) if arc.sweep.abs() > PI => vec![piece.part(0.0, 0.5), piece.part(0.5, 1.0)],
        _ => vec![*piece],
    };
    path.pieces().iter().flat_map(halve).collect()
}

fn copy(editor: &Editor, statement: usize, numbers: &[(usize, f64)]) -> Vec<u8> {
    let program = editor.program();
    let Some(found) = program.statement(statement) else { return Vec::new() };
    copy_with_numbers(&without_remark(program.text(found)), found.record(), numbers, editor.style())
}

/// Takes out what announces an arc or spline.
fn drop_announced(editor: &mut Editor, motion: &Motion) {
    for statement in motion.statements.clone().rev().skip(1) {
        let found = editor.program().statement(statement);
        if found.is_some_and(|found| found.is_live() && is_motion(found.record()) && *found.record() != Record::Rapid) {
            editor.delete(statement);
        }
    }
}

fn is_motion(record: &Record) -> bool {
    matches!(
        record,
        Record::Goto(_)
            | Record::Circle(_)
            | Record::MoveArc(_)
            | Record::StartDirection(_)
            | Record::DriveArc(_)
            | Record::Nurbs
            | Record::Knot(_)
            | Record::Control(_)
            | Record::Rapid
    )
}

/// The first CIRCLE of the file whose sense is known.
fn template(program: &Program) -> Option<Template> {
    let hand = match program.dialect().arc_rule() {
        ArcRule::LeftHand => -1.0,
        ArcRule::RightHand => 1.0,
        ArcRule::ByWord | ArcRule::FromTangent => return None,
    };
    let plain = |circle: &Circle| circle.times <= 1 && circle.sense == ArcSense::OfDialect;
    program.live().find_map(|(statement, found)| match found.record() {
        Record::Circle(circle) if plain(circle) => {
            Some(Template { statement, has_radius: circle.radius.is_some(), hand })
        }
        _ => None,
    })
}
