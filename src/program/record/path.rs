//! Points, arcs and splines.

use super::{BadRecord, Reading, Record, Role, all_numbers, bad, number, point, vector, wrong_count};
use crate::program::syntax::{FieldKind, Group, Syntax};
use nalgebra::{Point3, Vector3};

/// A point with or without a tool axis. Without one the axis in force stays (measured: 15,397 three-value GOTOs in one file).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goto {
    /// Cutter location, in the file's unit and frame.
    pub point: Point3<f64>,
    /// Tool axis as printed (a unit vector up to its decimals).
    pub axis: Option<Vector3<f64>>,
}

/// What a CIRCLE record itself says of the sense of its arc.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArcSense {
    /// Nothing; the dialect decides.
    OfDialect,
    /// `CLOCKWISE`, seen from the tip of the axis.
    Clockwise,
    /// `COUNTERCLOCKWISE`.
    CounterClockwise,
}

/// `CIRCLE/cx,cy,cz,i,j,k[,r[,tolerance,0.5,diameter,corner]][,TIMES,n][,CLOCKWISE]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Circle {
    /// Centre.
    pub center: Point3<f64>,
    /// Axis as printed; its sense is the dialect's.
    pub axis: Vector3<f64>,
    /// Radius, where the dialect prints one.
    pub radius: Option<f64>,
    /// What the record says of the sense.
    pub sense: ArcSense,
    /// `TIMES,n` of a helix: how often the direction of the end point is reached.
    pub times: u32,
}

/// `MOVARC/cx,cy,cz,i,j,k,r,ANGLE,degrees`, or with `CENTER`, `AXIS`, `RADIUS` before their numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct MoveArc {
    /// Centre.
    pub center: Point3<f64>,
    /// Axis; the arc is right-hand about it.
    pub axis: Vector3<f64>,
    /// Radius.
    pub radius: f64,
    /// Sweep in degrees, positive, where the record gives it.
    pub sweep_degrees: Option<f64>,
}

/// `TLON,GOFWD/(CIRCLE/cx,cy,cz,r),ON,[2,INTOF,](LINE/cx,cy,cz,ex,ey,ez)`.
#[derive(Debug, Clone, PartialEq)]
pub struct DriveArc {
    /// Centre.
    pub center: Point3<f64>,
    /// Radius.
    pub radius: f64,
    /// End of the arc: the second point of the LINE.
    pub end: Point3<f64>,
    /// `2,INTOF`: the sweep is more than 180 degrees (measured over 405 arcs: if and only if).
    pub beyond_half: bool,
}

pub(super) fn read(major: &str, syntax: &Syntax<'_>) -> Reading {
    Some(match major {
        "GOTO" => goto(major, syntax),
        "FROM" => single(major, syntax).map(|goto| Record::From(Box::new(goto))),
        "GOHOME" if syntax.fields.is_empty() => Ok(Record::GoHome(None)),
        "GOHOME" => single(major, syntax).map(|goto| Record::GoHome(Some(Box::new(goto)))),
        "GODLTA" => {
            numbers_of(major, syntax, "1 or 3 numbers", |count| count == 1 || count == 3).map(Record::GoDelta)
        }
        "CIRCLE" => circle(syntax),
        "MOVARC" => move_arc(syntax),
        "INDIRV" => one_vector(major, syntax).map(|vector| Record::StartDirection(Box::new(vector))),
        "TLON,GOFWD" | "TLON,GOBACK" => drive_arc(major, syntax),
        "NURBS" => Ok(Record::Nurbs),
        "KNOT" => numbers_of(major, syntax, "numbers", |count| count > 0).map(Record::Knot),
        "CNTRL" => one_vector(major, syntax).map(|at| Record::Control(Box::new(Point3::from(at)))),
        "RAPID" if syntax.fields.iter().all(|field| field.kind == FieldKind::Empty) => Ok(Record::Rapid),
        "RAPID" => Err(wrong_count(major, syntax, "no arguments", syntax.fields.len())),
        _ => return None,
    })
}

/// A line of bare numbers: further points.
pub(super) fn numbers(syntax: &Syntax<'_>) -> Result<Record, BadRecord> {
    let numbers = all_numbers(syntax)?;
    if numbers.len() % 3 != 0 {
        return Err(wrong_count("a line of points", syntax, "3 numbers a point", numbers.len()));
    }
    Ok(Record::Points(numbers.into()))
}

fn goto(major: &str, syntax: &Syntax<'_>) -> Result<Record, BadRecord> {
    let numbers = all_numbers(syntax)?;
    match (numbers.len(), single_of(&numbers)) {
        (_, Some(goto)) => with_direction(goto, syntax).map(Record::Goto),
        (count, None) if count > 6 && count % 3 == 0 => Ok(Record::Points(numbers.into())),
        (count, None) => Err(wrong_count(major, syntax, "3 or 6 numbers (or several points)", count)),
    }
}

fn single(major: &str, syntax: &Syntax<'_>) -> Result<Goto, BadRecord> {
    let numbers = all_numbers(syntax)?;
    let goto =
        single_of(&numbers).ok_or_else(|| wrong_count(major, syntax, "3 or 6 numbers", numbers.len()))?;
    with_direction(goto, syntax)
}

/// A tool axis of no length tells no post how the tool stands.
fn with_direction(goto: Goto, syntax: &Syntax<'_>) -> Result<Goto, BadRecord> {
    match goto.axis {
        Some(axis) if !has_direction(&axis) => {
            Err(bad(vector_place(syntax, 3), "the tool axis has no direction"))
        }
        _ => Ok(goto),
    }
}

/// Whether a printed vector is long enough to have a direction.
pub(crate) fn has_direction(vector: &Vector3<f64>) -> bool {
    let length = vector.norm();
    length > 1e-6 && length.is_finite()
}

fn single_of(numbers: &[f64]) -> Option<Goto> {
    match numbers {
        [_, _, _] => point(numbers).map(|point| Goto { point, axis: None }),
        [_, _, _, axis @ ..] if axis.len() == 3 => {
            point(numbers).map(|point| Goto { point, axis: vector(axis) })
        }
        _ => None,
    }
}

fn numbers_of(
    major: &str,
    syntax: &Syntax<'_>,
    takes: &str,
    fits: impl Fn(usize) -> bool,
) -> Result<Box<[f64]>, BadRecord> {
    let numbers = all_numbers(syntax)?;
    if !fits(numbers.len()) {
        return Err(wrong_count(major, syntax, takes, numbers.len()));
    }
    Ok(numbers.into())
}

pub(super) fn one_vector(major: &str, syntax: &Syntax<'_>) -> Result<Vector3<f64>, BadRecord> {
    let numbers = numbers_of(major, syntax, "3 numbers", |count| count == 3)?;
    vector(&numbers).ok_or_else(|| wrong_count(major, syntax, "3 numbers", numbers.len()))
}

fn circle(syntax: &Syntax<'_>) -> Result<Record, BadRecord> {
    let mut numbers = Vec::new();
    let mut sense = ArcSense::OfDialect;
    let mut times = 1;
    let mut fields = syntax.fields.iter().peekable();
    while let Some(field) = fields.next() {
        match &field.kind {
            FieldKind::Text => match crate::program::syntax::folded(syntax.bytes(&field.at)).as_str() {
                "CLOCKWISE" | "CLW" => sense = ArcSense::Clockwise,
                "COUNTERCLOCKWISE" | "CCLW" => sense = ArcSense::CounterClockwise,
                "TIMES" => times = times_of(syntax, fields.next(), field)?,
                _ => return Err(unexpected(syntax, field, numbers.len() < 7)),
            },
            FieldKind::Empty if fields.peek().is_none() => {}
            _ => numbers.push(number(syntax, field)?),
        }
    }
    let (Some(center), Some(axis)) = (point(&numbers), numbers.get(3..).and_then(vector)) else {
        return Err(wrong_count(
            "CIRCLE",
            syntax,
            "a centre, an axis and further numbers (6 or more)",
            numbers.len(),
        ));
    };
    if !has_direction(&axis) {
        return Err(bad(vector_place(syntax, 3), "the axis of the arc has no direction"));
    }
    let radius = numbers.get(6).copied();
    Ok(Record::Circle(Box::new(Circle { center, axis, radius, sense, times })))
}

fn times_of(
    syntax: &Syntax<'_>,
    field: Option<&crate::program::syntax::Field>,
    word: &crate::program::syntax::Field,
) -> Result<u32, BadRecord> {
    let Some(field) = field else {
        return Err(bad(word.at.clone(), "TIMES wants the number of turns after it"));
    };
    let turns = number(syntax, field)?;
    if turns.fract() != 0.0 || !(1.0..=10_000.0).contains(&turns) {
        return Err(bad(field.at.clone(), "the number of turns is a whole number from 1 to 10000"));
    }
    Ok(turns as u32)
}

/// The place of the three fields from `at` on.
pub(super) fn vector_place(syntax: &Syntax<'_>, at: usize) -> std::ops::Range<usize> {
    match (syntax.fields.get(at), syntax.fields.get(at + 2)) {
        (Some(first), Some(last)) => first.at.start..last.at.end,
        _ => syntax.word.clone(),
    }
}

fn unexpected(syntax: &Syntax<'_>, field: &crate::program::syntax::Field, number_wanted: bool) -> BadRecord {
    let text = String::from_utf8_lossy(syntax.bytes(&field.at)).into_owned();
    if number_wanted {
        BadRecord { at: field.at.clone(), problem: format!("`{text}` is not a number"), is_number: true }
    } else {
        bad(field.at.clone(), format!("`{text}` is not expected here"))
    }
}

fn move_arc(syntax: &Syntax<'_>) -> Result<Record, BadRecord> {
    let mut numbers = Vec::new();
    let mut sweep_degrees = None;
    let mut fields = syntax.fields.iter();
    while let Some(field) = fields.next() {
        match &field.kind {
            FieldKind::Text => match crate::program::syntax::folded(syntax.bytes(&field.at)).as_str() {
                "CENTER" | "AXIS" | "RADIUS" => {}
                "ANGLE" => match fields.next() {
                    Some(angle) => sweep_degrees = Some(number(syntax, angle)?),
                    None => return Err(bad(field.at.clone(), "ANGLE wants degrees after it")),
                },
                _ => return Err(unexpected(syntax, field, numbers.len() < 7)),
            },
            _ => numbers.push(number(syntax, field)?),
        }
    }
    match (point(&numbers), numbers.get(3..).and_then(vector), numbers.get(6)) {
        (Some(center), Some(axis), Some(&radius)) if has_direction(&axis) => {
            Ok(Record::MoveArc(Box::new(MoveArc { center, axis, radius, sweep_degrees })))
        }
        _ => Err(wrong_count("MOVARC", syntax, "a centre, an axis and a radius (7 numbers)", numbers.len())),
    }
}

fn drive_arc(major: &str, syntax: &Syntax<'_>) -> Result<Record, BadRecord> {
    let (mut circle, mut line, mut beyond_half) = (None, None, false);
    for field in &syntax.fields {
        match &field.kind {
            FieldKind::Group(group) => match syntax.bytes(&group.word).to_ascii_uppercase().as_slice() {
                b"CIRCLE" => circle = Some(group_numbers(syntax, group)?),
                b"LINE" => line = Some(group_numbers(syntax, group)?),
                _ => return Ok(Record::Other),
            },
            FieldKind::Text => beyond_half |= syntax.bytes(&field.at).eq_ignore_ascii_case(b"INTOF"),
            _ => {}
        }
    }
    let (Some(circle), Some(line)) = (circle, line) else { return Ok(Record::Other) };
    match (point(&circle), circle.get(3), line.get(3..).and_then(point)) {
        (Some(center), Some(&radius), Some(end)) if circle.len() == 4 && line.len() == 6 => {
            Ok(Record::DriveArc(Box::new(DriveArc { center, radius, end, beyond_half })))
        }
        _ => Err(wrong_count(
            major,
            syntax,
            "(CIRCLE/ 4 numbers) and (LINE/ 6 numbers)",
            circle.len() + line.len(),
        )),
    }
}

fn group_numbers(syntax: &Syntax<'_>, group: &Group) -> Result<Vec<f64>, BadRecord> {
    group.fields.iter().map(|field| number(syntax, field)).collect()
}

pub(super) fn roles(record: &Record, count: usize) -> Vec<Role> {
    let points = |count: usize| (0..count).map(|index| Role::Point((index % 3) as u8)).collect::<Vec<_>>();
    match record {
        Record::Goto(goto) => with_axis(goto.axis.is_some()),
        Record::From(goto) | Record::GoHome(Some(goto)) => with_axis(goto.axis.is_some()),
        Record::Points(numbers) if is_contact(numbers) => [with_axis(true), directions()].concat(),
        Record::Points(numbers) if is_poses(numbers) => with_axis(true).repeat(numbers.len() / 6),
        Record::Points(_) | Record::Control(_) => points(count),
        Record::GoDelta(numbers) if numbers.len() == 3 => vec![Role::Step(0), Role::Step(1), Role::Step(2)],
        Record::GoDelta(_) => vec![Role::Length],
        Record::StartDirection(_) => directions(),
        Record::DriveArc(_) => [points(3), vec![Role::Length], points(6)].concat(),
        Record::Circle(circle) => {
            let lengths = count.saturating_sub(6 + usize::from(circle.times > 1));
            let mut roles = [points(3), arc_axis()].concat();
            // centre, axis, radius, tolerance, 0.5, diameter, corner radius: the 0.5 is no length.
            roles.extend((0..lengths).map(|index| if index == 2 { Role::Plain } else { Role::Length }));
            roles
        }
        Record::MoveArc(_) => [points(3), arc_axis(), vec![Role::Length]].concat(),
        _ => Vec::new(),
    }
}

/// Whether the numbers of a long GOTO are a point, a tool axis and a contact normal: two unit vectors after the point.
pub(crate) fn is_contact(numbers: &[f64]) -> bool {
    numbers.len() == 9 && [3, 6].iter().all(|&at| numbers.get(at..).is_some_and(is_unit))
}

/// Whether the numbers are points with axes: every second triple is a unit vector.
pub(crate) fn is_poses(numbers: &[f64]) -> bool {
    numbers.len().is_multiple_of(6) && numbers.chunks(6).all(|pose| pose.get(3..).is_some_and(is_unit))
}

fn is_unit(numbers: &[f64]) -> bool {
    vector(numbers).is_some_and(|vector| (vector.norm() - 1.0).abs() < 1e-3)
}

fn with_axis(axis: bool) -> Vec<Role> {
    let mut roles = vec![Role::Point(0), Role::Point(1), Role::Point(2)];
    if axis {
        roles.extend(directions());
    }
    roles
}

fn directions() -> Vec<Role> {
    vec![Role::Direction(0), Role::Direction(1), Role::Direction(2)]
}

fn arc_axis() -> Vec<Role> {
    vec![Role::ArcAxis(0), Role::ArcAxis(1), Role::ArcAxis(2)]
}
