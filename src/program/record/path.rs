//! This module reads points, arcs and splines.

use super::{
    BadRecord, NumberRole, Record, RecordReading, axial_arc, bad_record, has_direction, point_from_numbers,
    read_all_numbers, read_group_numbers, read_number, vector_from_numbers, wrong_count,
};
use crate::program::syntax::{FieldKind, StatementSyntax, fold_text};
use nalgebra::{Point3, Vector3};

/// A point with or without a tool axis. Without one, the axis in force stays (measured: 15,397 GOTOs with
/// three values in one file).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goto {
    /// The cutter location, in the file's unit and frame.
    pub point: Point3<f64>,
    /// The tool axis as printed (a unit vector up to its decimals).
    pub axis: Option<Vector3<f64>>,
}

/// The direction of an arc as its CIRCLE record gives it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArcSense {
    /// The record gives none; the dialect decides.
    OfDialect,
    /// `CLOCKWISE`, seen from the tip of the axis.
    Clockwise,
    /// `COUNTERCLOCKWISE`, seen from the tip of the axis.
    CounterClockwise,
}

/// An arc: `CIRCLE/cx,cy,cz,i,j,k[,r[,tolerance,0.5,diameter,corner]][,TIMES,n][,CLOCKWISE]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Circle {
    /// The centre.
    pub center: Point3<f64>,
    /// The axis as printed; its meaning for the direction depends on the dialect.
    pub axis: Vector3<f64>,
    /// The radius, if the dialect prints one.
    pub radius: Option<f64>,
    /// The direction as the record gives it.
    pub sense: ArcSense,
    /// `TIMES,n` of a helix: how often the direction of the end point is reached. So the sweep is the angle
    /// plus n - 1 turns.
    pub times: u32,
}

/// An arc: `MOVARC/cx,cy,cz,i,j,k,r,ANGLE,degrees`, or with `CENTER`, `AXIS`, `RADIUS` before their numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct MoveArc {
    /// The centre.
    pub center: Point3<f64>,
    /// The axis; the arc is right-hand about it.
    pub axis: Vector3<f64>,
    /// The radius.
    pub radius: f64,
    /// The sweep in degrees, positive, if the record gives it.
    pub sweep_degrees: Option<f64>,
    /// `TIMES,n`: how often the direction of the end point is reached.
    pub times: u32,
}

/// An arc: `TLON,GOFWD/(CIRCLE/cx,cy,cz,r),ON,[2,INTOF,](LINE/cx,cy,cz,ex,ey,ez)`.
#[derive(Debug, Clone, PartialEq)]
pub struct DriveArc {
    /// The centre.
    pub center: Point3<f64>,
    /// The radius.
    pub radius: f64,
    /// The end of the arc: the second point of the LINE.
    pub end: Point3<f64>,
    /// Whether `2,INTOF` is given: the sweep is more than 180 degrees (measured over 405 arcs: if and only
    /// if).
    pub beyond_half: bool,
}

/// Reads a record of this family.
pub(super) fn read_record(major: &str, syntax: &StatementSyntax<'_>) -> RecordReading {
    Some(match major {
        "GOTO" => read_goto(major, syntax),
        "FROM" => read_single_goto(major, syntax).map(|goto| Record::From(Box::new(goto))),
        // GOHOME without numbers, or with the name of a place: only the post knows where it is.
        "GOHOME" if syntax.count_numbers() == 0 => Ok(Record::GoHome(None)),
        // The number of a machine's home: GOHOME/2.
        "GOHOME" if syntax.fields.len() == 1 && is_home_number(syntax.number_at(0)) => {
            Ok(Record::GoHome(None))
        }
        "GOHOME" => read_single_goto(major, syntax).map(|goto| Record::GoHome(Some(Box::new(goto)))),
        "GODLTA" => {
            read_counted_numbers(major, syntax, "1, 3 or 6 numbers", |count| matches!(count, 1 | 3 | 6))
                .map(Record::GoDelta)
        }
        "CIRCLE" => read_circle(syntax),
        "MOVARC" => read_move_arc(syntax),
        "INDIRV" => read_vector(major, syntax).map(|vector| Record::StartDirection(Box::new(vector))),
        "HELICAL" => axial_arc::read_helical(syntax),
        "TLON,GOFWD" | "TLON,GOBACK" => read_drive_arc(major, syntax),
        "NURBS" => Ok(Record::Nurbs),
        "KNOT" => read_counted_numbers(major, syntax, "numbers", |count| count > 0).map(Record::Knot),
        "CNTRL" => read_vector(major, syntax).map(|at| Record::Control(Box::new(Point3::from(at)))),
        "RAPID" if syntax.fields.iter().all(|field| field.kind == FieldKind::Empty) => Ok(Record::Rapid),
        "RAPID" => Err(wrong_count(major, syntax, "no arguments", syntax.fields.len())),
        _ => return None,
    })
}

/// Returns whether a number is that of a machine's home, which a post counts from 1.
fn is_home_number(number: Option<f64>) -> bool {
    number.is_some_and(|home| home.fract() == 0.0 && (1.0..10.0).contains(&home))
}

/// Reads a line of bare numbers as further points.
pub(super) fn read_points_line(syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    let numbers = read_all_numbers(syntax)?;
    if numbers.len() % 3 != 0 {
        return Err(wrong_count("a line of points", syntax, "3 numbers a point", numbers.len()));
    }
    Ok(Record::Points(numbers.into()))
}

/// Reads a GOTO with one or several points.
fn read_goto(major: &str, syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    let numbers = read_all_numbers(syntax)?;
    match (numbers.len(), goto_from_numbers(&numbers)) {
        (_, Some(goto)) => require_axis_direction(goto, syntax).map(Record::Goto),
        (count, None) if count > 6 && count % 3 == 0 => Ok(Record::Points(numbers.into())),
        (count, None) => Err(wrong_count(major, syntax, "3 or 6 numbers (or several points)", count)),
    }
}

/// Reads a record with one point.
fn read_single_goto(major: &str, syntax: &StatementSyntax<'_>) -> Result<Goto, BadRecord> {
    let numbers = read_all_numbers(syntax)?;
    let goto = goto_from_numbers(&numbers)
        .ok_or_else(|| wrong_count(major, syntax, "3 or 6 numbers", numbers.len()))?;
    require_axis_direction(goto, syntax)
}

/// Refuses a tool axis without length, because it gives no orientation to a post.
fn require_axis_direction(goto: Goto, syntax: &StatementSyntax<'_>) -> Result<Goto, BadRecord> {
    match goto.axis {
        Some(axis) if !has_direction(&axis) => {
            Err(bad_record(vector_range(syntax, 3), "the tool axis has no direction"))
        }
        _ => Ok(goto),
    }
}

/// Returns the point of three or six numbers.
fn goto_from_numbers(numbers: &[f64]) -> Option<Goto> {
    match numbers {
        [_, _, _] => point_from_numbers(numbers).map(|point| Goto { point, axis: None }),
        [_, _, _, axis @ ..] if axis.len() == 3 => {
            point_from_numbers(numbers).map(|point| Goto { point, axis: vector_from_numbers(axis) })
        }
        _ => None,
    }
}

/// Reads all fields as numbers and checks their count.
fn read_counted_numbers(
    major: &str,
    syntax: &StatementSyntax<'_>,
    takes: &str,
    fits: impl Fn(usize) -> bool,
) -> Result<Box<[f64]>, BadRecord> {
    let numbers = read_all_numbers(syntax)?;
    if !fits(numbers.len()) {
        return Err(wrong_count(major, syntax, takes, numbers.len()));
    }
    Ok(numbers.into())
}

/// Reads a record of three numbers as a vector.
pub(super) fn read_vector(major: &str, syntax: &StatementSyntax<'_>) -> Result<Vector3<f64>, BadRecord> {
    let numbers = read_counted_numbers(major, syntax, "3 numbers", |count| count == 3)?;
    vector_from_numbers(&numbers).ok_or_else(|| wrong_count(major, syntax, "3 numbers", numbers.len()))
}

/// Reads a CIRCLE: numbers by position, and words for the direction and the turns.
fn read_circle(syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    let mut numbers = Vec::with_capacity(syntax.fields.len());
    let mut sense = ArcSense::OfDialect;
    let mut times = 1;
    let mut fields = syntax.fields.iter().peekable();
    while let Some(field) = fields.next() {
        match &field.kind {
            FieldKind::Text => match fold_text(syntax.bytes_at(&field.at)).as_ref() {
                "CLOCKWISE" | "CLW" => sense = ArcSense::Clockwise,
                "COUNTERCLOCKWISE" | "CCLW" => sense = ArcSense::CounterClockwise,
                "TIMES" => times = read_turn_count(syntax, fields.next(), field)?,
                _ => return Err(unexpected_field(syntax, field, numbers.len() < 7)),
            },
            FieldKind::Empty if fields.peek().is_none() => {}
            _ => numbers.push(read_number(syntax, field)?),
        }
    }
    let (Some(center), Some(axis)) =
        (point_from_numbers(&numbers), numbers.get(3..).and_then(vector_from_numbers))
    else {
        return Err(wrong_count(
            "CIRCLE",
            syntax,
            "a centre, an axis and further numbers (6 or more)",
            numbers.len(),
        ));
    };
    if !has_direction(&axis) {
        return Err(bad_record(vector_range(syntax, 3), "the axis of the arc has no direction"));
    }
    let radius = numbers.get(6).copied();
    Ok(Record::Circle(Box::new(Circle { center, axis, radius, sense, times })))
}

/// Reads the number of turns after TIMES.
fn read_turn_count(
    syntax: &StatementSyntax<'_>,
    field: Option<&crate::program::syntax::StatementField>,
    word: &crate::program::syntax::StatementField,
) -> Result<u32, BadRecord> {
    let Some(field) = field else {
        return Err(bad_record(word.at.clone(), "TIMES wants the number of turns after it"));
    };
    let turns = read_number(syntax, field)?;
    if turns.fract() != 0.0 || !(1.0..=10_000.0).contains(&turns) {
        return Err(bad_record(field.at.clone(), "the number of turns is a whole number from 1 to 10000"));
    }
    Ok(turns as u32)
}

/// Returns the place of the three fields from `at` on.
pub(super) fn vector_range(syntax: &StatementSyntax<'_>, at: usize) -> std::ops::Range<usize> {
    match (syntax.fields.get(at), syntax.fields.get(at + 2)) {
        (Some(first), Some(last)) => first.at.start..last.at.end,
        _ => syntax.word.clone(),
    }
}

/// Makes a bad record for a field that does not belong there.
fn unexpected_field(
    syntax: &StatementSyntax<'_>,
    field: &crate::program::syntax::StatementField,
    number_wanted: bool,
) -> BadRecord {
    let text = String::from_utf8_lossy(syntax.bytes_at(&field.at)).into_owned();
    if number_wanted {
        BadRecord { at: field.at.clone(), problem: format!("`{text}` is not a number"), is_number: true }
    } else {
        bad_record(field.at.clone(), format!("`{text}` is not expected here"))
    }
}

/// Reads a MOVARC: numbers by position, or by the words before them.
fn read_move_arc(syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    let places = move_arc_numbers(syntax)?;
    let of = |part: MoveArcPart| places.iter().find(|(found, _)| *found == part).map(|(_, value)| *value);
    let three = |part: fn(u8) -> MoveArcPart| Some([of(part(0))?, of(part(1))?, of(part(2))?]);
    let times = match of(MoveArcPart::Times) {
        None => 1,
        Some(times) if times.fract() == 0.0 && (1.0..=10_000.0).contains(&times) => times as u32,
        Some(_) => {
            let problem = "the number of turns is a whole number from 1 to 10000";
            return Err(bad_record(syntax.word.clone(), problem));
        }
    };
    match (three(MoveArcPart::Center), three(MoveArcPart::Axis), of(MoveArcPart::Radius)) {
        (Some(center), Some(axis), Some(radius)) if has_direction(&Vector3::from(axis)) => {
            let (center, axis) = (Point3::from(center), Vector3::from(axis));
            let sweep_degrees = of(MoveArcPart::Angle);
            Ok(Record::MoveArc(Box::new(MoveArc { center, axis, radius, sweep_degrees, times })))
        }
        _ => Err(wrong_count("MOVARC", syntax, "a centre, an axis and a radius (7 numbers)", places.len())),
    }
}

/// What a number of a MOVARC is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum MoveArcPart {
    Center(u8),
    Axis(u8),
    Radius,
    Angle,
    Times,
    /// The tolerance of the arc, a length.
    Tolerance,
    /// A number behind a word that is not known. It has no effect on the arc.
    Other,
}

/// Returns the numbers of a MOVARC with what each is. Numbers that no word governs go on where the numbers
/// before them ended.
fn move_arc_numbers(syntax: &StatementSyntax<'_>) -> Result<Vec<(MoveArcPart, f64)>, BadRecord> {
    let position = |index: u8| match index {
        0..=2 => MoveArcPart::Center(index),
        3..=5 => MoveArcPart::Axis(index - 3),
        6 => MoveArcPart::Radius,
        _ => MoveArcPart::Other,
    };
    let mut numbers = Vec::new();
    let (mut next, mut single) = (0, None);
    for field in &syntax.fields {
        match &field.kind {
            FieldKind::Text if single.is_some_and(|part| part != MoveArcPart::Other) => {
                read_number(syntax, field)?;
            }
            FieldKind::Text => match fold_text(syntax.bytes_at(&field.at)).as_ref() {
                "CENTER" => (next, single) = (0, None),
                "AXIS" | "NORMAL" => (next, single) = (3, None),
                "RADIUS" => (next, single) = (6, None),
                "ANGLE" => single = Some(MoveArcPart::Angle),
                "TIMES" => single = Some(MoveArcPart::Times),
                "TOLER" => single = Some(MoveArcPart::Tolerance),
                // Where a coordinate is wanted, a word is a slip. A word behind the radius is passed on.
                word if next < 7 || !word.starts_with(|first: char| first.is_ascii_alphabetic()) => {
                    return Err(unexpected_field(syntax, field, next < 7));
                }
                _ => single = Some(MoveArcPart::Other),
            },
            FieldKind::Empty => {}
            _ => {
                let value = read_number(syntax, field)?;
                let part = single.take().unwrap_or_else(|| {
                    next = (next + 1).min(8);
                    position(next - 1)
                });
                numbers.push((part, value));
            }
        }
    }
    match single {
        Some(MoveArcPart::Angle) => Err(bad_record(syntax.word.clone(), "ANGLE wants degrees after it")),
        _ => Ok(numbers),
    }
}

/// Returns the roles of the numbers of a MOVARC.
fn move_arc_roles(syntax: &StatementSyntax<'_>) -> Vec<NumberRole> {
    let role = |part: MoveArcPart| match part {
        MoveArcPart::Center(index) => NumberRole::Point(index),
        MoveArcPart::Axis(index) => NumberRole::ArcAxis(index),
        MoveArcPart::Radius | MoveArcPart::Tolerance => NumberRole::Length,
        MoveArcPart::Angle | MoveArcPart::Times | MoveArcPart::Other => NumberRole::Plain,
    };
    move_arc_numbers(syntax).unwrap_or_default().into_iter().map(|(part, _)| role(part)).collect()
}

/// Reads a drive arc of CATIA; other drive motions are passed on as they are.
fn read_drive_arc(major: &str, syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    let (mut circle, mut line, mut beyond_half) = (None, None, false);
    for field in &syntax.fields {
        match &field.kind {
            FieldKind::Group(group) => match syntax.bytes_at(&group.word).to_ascii_uppercase().as_slice() {
                b"CIRCLE" => circle = Some(read_group_numbers(syntax, group)?),
                b"LINE" => line = Some(read_group_numbers(syntax, group)?),
                _ => return read_other_drive_arc(syntax),
            },
            FieldKind::Text => beyond_half |= syntax.bytes_at(&field.at).eq_ignore_ascii_case(b"INTOF"),
            _ => {}
        }
    }
    let (Some(circle), Some(line)) = (circle, line) else { return read_other_drive_arc(syntax) };
    // A circle with its axis, as a cylinder has it.
    if circle.len() == 7 && line.len() == 6 {
        return read_other_drive_arc(syntax);
    }
    match (point_from_numbers(&circle), circle.get(3), line.get(3..).and_then(point_from_numbers)) {
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

/// Reads a drive motion that is not CATIA's common arc. One that is no arc at all is passed on, and a check says
/// that points may be missing.
fn read_other_drive_arc(syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    axial_arc::read_cylinder_arc(syntax).map(|arc| arc.unwrap_or(Record::Other))
}

/// Returns the roles of the numbers of this family.
pub(super) fn number_roles(record: &Record, syntax: &StatementSyntax<'_>) -> Vec<NumberRole> {
    let count = syntax.count_numbers();
    let points =
        |count: usize| (0..count).map(|index| NumberRole::Point((index % 3) as u8)).collect::<Vec<_>>();
    match record {
        Record::Goto(goto) => goto_roles(goto.axis.is_some()),
        Record::From(goto) | Record::GoHome(Some(goto)) => goto_roles(goto.axis.is_some()),
        Record::Points(numbers) if has_contact_normal(numbers) => {
            [goto_roles(true), direction_roles()].concat()
        }
        Record::Points(numbers) if has_tool_axes(numbers) => goto_roles(true).repeat(numbers.len() / 6),
        Record::Points(_) | Record::Control(_) => points(count),
        Record::GoDelta(numbers) if numbers.len() >= 3 => {
            let step = vec![NumberRole::Step(0), NumberRole::Step(1), NumberRole::Step(2)];
            if numbers.len() == 6 { [step, direction_roles()].concat() } else { step }
        }
        Record::GoDelta(_) => vec![NumberRole::Length],
        Record::StartDirection(_) => direction_roles(),
        Record::DriveArc(_) => {
            syntax.fields.iter().flat_map(|field| drive_arc_roles(syntax, field)).collect()
        }
        Record::Circle(circle) => {
            let lengths = count.saturating_sub(6 + usize::from(circle.times > 1));
            let mut roles = [points(3), arc_axis_roles()].concat();
            // The numbers are centre, axis, radius, tolerance, 0.5, diameter and corner radius; the 0.5 is
            // not a length.
            roles.extend(
                (0..lengths).map(|index| if index == 2 { NumberRole::Plain } else { NumberRole::Length }),
            );
            roles
        }
        Record::MoveArc(_) => move_arc_roles(syntax),
        _ => Vec::new(),
    }
}

/// Returns the roles of CATIA's drive arc: centre and radius in one group, centre and end in the other, and
/// perhaps between them the 2 of `ON,2,INTOF`, which is a count.
fn drive_arc_roles(
    syntax: &StatementSyntax<'_>,
    field: &crate::program::syntax::StatementField,
) -> Vec<NumberRole> {
    let points = |count: usize| (0..count).map(|index| NumberRole::Point((index % 3) as u8));
    match &field.kind {
        FieldKind::Number(_) => vec![NumberRole::Plain],
        FieldKind::Group(group) if syntax.bytes_at(&group.word).eq_ignore_ascii_case(b"CIRCLE") => {
            points(3).chain([NumberRole::Length]).collect()
        }
        FieldKind::Group(_) => points(6).collect(),
        _ => Vec::new(),
    }
}

/// Returns whether the numbers of a long GOTO are a point, a tool axis and a contact normal, that is, whether
/// two unit vectors follow the point.
pub(crate) fn has_contact_normal(numbers: &[f64]) -> bool {
    numbers.len() == 9 && [3, 6].iter().all(|&at| numbers.get(at..).is_some_and(is_unit_vector))
}

/// Returns whether the numbers are points with axes, that is, whether every second triple is a unit vector.
pub(crate) fn has_tool_axes(numbers: &[f64]) -> bool {
    numbers.len().is_multiple_of(6) && numbers.chunks(6).all(|pose| pose.get(3..).is_some_and(is_unit_vector))
}

fn is_unit_vector(numbers: &[f64]) -> bool {
    vector_from_numbers(numbers).is_some_and(|vector| (vector.norm() - 1.0).abs() < 1e-3)
}

/// Returns the roles of a point with or without its tool axis.
pub(crate) fn goto_roles(axis: bool) -> Vec<NumberRole> {
    let mut roles = Vec::new();
    add_goto_roles(axis, &mut roles);
    roles
}

/// Adds the roles of a GOTO to a list.
pub(crate) fn add_goto_roles(axis: bool, into: &mut Vec<NumberRole>) {
    use NumberRole::{Direction, Point};
    into.extend([Point(0), Point(1), Point(2)]);
    if axis {
        into.extend([Direction(0), Direction(1), Direction(2)]);
    }
}

/// Returns the roles of a unit vector.
fn direction_roles() -> Vec<NumberRole> {
    vec![NumberRole::Direction(0), NumberRole::Direction(1), NumberRole::Direction(2)]
}

/// Returns the roles of an arc's axis.
fn arc_axis_roles() -> Vec<NumberRole> {
    vec![NumberRole::ArcAxis(0), NumberRole::ArcAxis(1), NumberRole::ArcAxis(2)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_an_intersection_is_no_coordinate() {
        for (on, plain) in [("ON", 0), ("ON,2,INTOF", 1)] {
            let text = format!("TLON,GOFWD/(CIRCLE/1.,2.,3.,4.),{on},(LINE/1.,2.,3.,5.,2.,3.)\n");
            let (record, syntax) = crate::parse::read_record(text.as_bytes()).unwrap();
            let roles = record.number_roles(&syntax);
            assert_eq!(roles.iter().filter(|role| **role == NumberRole::Plain).count(), plain, "{roles:?}");
            assert_eq!(roles.last(), Some(&NumberRole::Point(2)));
            assert_eq!(roles.len(), 10 + plain);
        }
    }
}
