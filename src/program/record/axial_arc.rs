//! This module reads arcs that say all about themselves in one record: CATIA's `HELICAL/`, and its drive arcs on
//! cylinders about any axis.

use super::{BadRecord, NumberRole, Record, bad_record, has_direction, read_group_numbers, read_number};
use crate::program::syntax::{FieldGroup, FieldKind, StatementField, StatementSyntax, fold_text};
use nalgebra::{Point3, Vector3};
use std::borrow::Cow;

/// An arc or helix with its end in the record. The direction in which it starts gives its sense.
#[derive(Debug, Clone, PartialEq)]
pub struct AxialArc {
    /// A point on the axis.
    pub center: Point3<f64>,
    /// The direction of the axis, which has no sense of its own; `None` if only the start direction tells it.
    pub axis: Option<Vector3<f64>>,
    /// The radius, if the record gives it.
    pub radius: Option<f64>,
    /// The direction in which it starts, if the record gives it; else an INDIRV does.
    pub start_direction: Option<Vector3<f64>>,
    /// The sweep with all turns in degrees, if the record gives it.
    pub sweep_degrees: Option<f64>,
    /// The number of turns, if the record gives it (ROUND).
    pub turns: Option<f64>,
    /// Whether `2,INTOF` is given: the sweep is more than 180 degrees. `None` for a record that does not say it.
    pub beyond_half: Option<bool>,
    /// The end.
    pub end: Point3<f64>,
}

/// Reads `HELICAL/CENTER,x,y,z,INDIRV,i,j,k,AXIS,i,j,k,PITCH,p,RADIUS,r,ANGLE,a,HEIGHT,h,ROUND,n,END,x,y,z`.
pub(super) fn read_helical(syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    let numbers = helical_numbers(syntax)?;
    let of = |word: &str, index: usize| {
        numbers.iter().find(|(found, at, _)| found == word && *at == index).map(|(_, _, value)| *value)
    };
    let three = |word: &str| Some(Vector3::new(of(word, 0)?, of(word, 1)?, of(word, 2)?));
    let direction = |word: &str| three(word).filter(has_direction);
    match (three("CENTER"), direction("AXIS"), direction("INDIRV"), three("END")) {
        (Some(center), Some(axis), Some(start), Some(end)) => Ok(Record::AxialArc(Box::new(AxialArc {
            center: center.into(),
            axis: Some(axis),
            radius: of("RADIUS", 0),
            start_direction: Some(start),
            sweep_degrees: of("ANGLE", 0),
            turns: of("ROUND", 0).or_else(|| match of("ANGLE", 0) {
                Some(_) => None,
                None => turns_of_rise(of("HEIGHT", 0)?, of("PITCH", 0)?),
            }),
            beyond_half: None,
            end: end.into(),
        }))),
        _ => {
            let problem = "HELICAL takes CENTER, INDIRV, AXIS and END with three numbers each";
            Err(bad_record(syntax.word.clone(), problem))
        }
    }
}

/// Returns the turns in which a helix rises by its height, where nothing else tells them.
fn turns_of_rise(height: f64, pitch: f64) -> Option<f64> {
    (height != 0.0 && pitch != 0.0).then(|| (height / pitch).abs())
}

/// Returns the numbers of a HELICAL: the word before each, its index behind that word, its value.
fn helical_numbers(syntax: &StatementSyntax<'_>) -> Result<Vec<(String, usize, f64)>, BadRecord> {
    let mut numbers = Vec::new();
    let (mut word, mut index) = (String::new(), 0);
    for field in &syntax.fields {
        match &field.kind {
            FieldKind::Text => {
                let text = fold_text(syntax.bytes_at(&field.at));
                if !text.starts_with(|first: char| first.is_ascii_alphabetic()) {
                    read_number(syntax, field)?;
                }
                (word, index) = (text.into_owned(), 0);
            }
            FieldKind::Empty => {}
            _ => {
                numbers.push((word.clone(), index, read_number(syntax, field)?));
                index += 1;
            }
        }
    }
    Ok(numbers)
}

/// Reads a drive arc that is not CATIA's common one of CIRCLE and LINE:
/// `TLON,GOFWD/(CYLNDR/c,axis,r),ON,(PLANE/PERPTO,(PLANE/...),(POINT/a),(POINT/end))`. Returns `None` if the record
/// has another form.
pub(super) fn read_cylinder_arc(syntax: &StatementSyntax<'_>) -> Result<Option<Record>, BadRecord> {
    let mut round = None;
    let mut end = None;
    let mut beyond_half = false;
    for field in &syntax.fields {
        match &field.kind {
            FieldKind::Group(group) => match group_word(syntax, group).as_ref() {
                "CYLNDR" | "CIRCLE" => round = Some(read_group_numbers(syntax, group)?),
                "LINE" => end = read_group_numbers(syntax, group)?.get(3..6).map(Vector3::from_column_slice),
                "PLANE" => end = last_point(syntax, group)?,
                _ => return Ok(None),
            },
            FieldKind::Text => {
                beyond_half |= fold_text(syntax.bytes_at(&field.at)) == "INTOF";
            }
            _ => {}
        }
    }
    let (Some(round), Some(end)) = (round, end) else { return Ok(None) };
    let (center, axis, radius) = match round.as_slice() {
        [x, y, z, r] => (Point3::new(*x, *y, *z), None, *r),
        [x, y, z, i, j, k, r] => (Point3::new(*x, *y, *z), Some(Vector3::new(*i, *j, *k)), *r),
        _ => return Ok(None),
    };
    if axis.is_some_and(|axis| !has_direction(&axis)) {
        return Err(bad_record(syntax.word.clone(), "the axis of the cylinder has no direction"));
    }
    Ok(Some(Record::AxialArc(Box::new(AxialArc {
        center,
        axis,
        radius: Some(radius),
        start_direction: None,
        sweep_degrees: None,
        turns: None,
        beyond_half: Some(beyond_half),
        end: end.into(),
    }))))
}

/// Returns the last point among the fields of a plane: CATIA's check planes go through the end.
fn last_point(syntax: &StatementSyntax<'_>, plane: &FieldGroup) -> Result<Option<Vector3<f64>>, BadRecord> {
    let mut last = None;
    for field in &plane.fields {
        if let FieldKind::Group(group) = &field.kind
            && group_word(syntax, group) == "POINT"
            && let [x, y, z] = read_group_numbers(syntax, group)?.as_slice()
        {
            last = Some(Vector3::new(*x, *y, *z));
        }
    }
    Ok(last)
}

fn group_word<'t>(syntax: &StatementSyntax<'t>, group: &FieldGroup) -> Cow<'t, str> {
    fold_text(syntax.bytes_at(&group.word))
}

/// Returns the roles of the numbers of such an arc.
pub(super) fn number_roles(syntax: &StatementSyntax<'_>) -> Vec<NumberRole> {
    if syntax.fields.iter().any(|field| matches!(field.kind, FieldKind::Group(_))) {
        return nested_roles(syntax, &syntax.fields);
    }
    let numbers = helical_numbers(syntax).unwrap_or_default();
    let role = |(word, index, _): &(String, usize, f64)| {
        let component = (*index).min(2) as u8;
        match word.as_str() {
            "CENTER" | "END" => NumberRole::Point(component),
            "INDIRV" | "AXIS" => NumberRole::Direction(component),
            "PITCH" | "RADIUS" | "HEIGHT" => NumberRole::Length,
            _ => NumberRole::Plain,
        }
    };
    numbers.iter().map(role).collect()
}

/// Returns the roles of numbers in nested geometry: POINT, VECTOR, PLANE, LINE, CIRCLE, CYLNDR.
pub(super) fn nested_roles(syntax: &StatementSyntax<'_>, fields: &[StatementField]) -> Vec<NumberRole> {
    let mut roles = Vec::new();
    for field in fields {
        match &field.kind {
            FieldKind::Number(_) => roles.push(NumberRole::Plain),
            FieldKind::Group(group) => roles.extend(group_roles(syntax, group)),
            _ => {}
        }
    }
    roles
}

fn group_roles(syntax: &StatementSyntax<'_>, group: &FieldGroup) -> Vec<NumberRole> {
    let word = group_word(syntax, group);
    let count = group.fields.iter().filter(|field| field.number_value().is_some()).count();
    let mut next = 0;
    let mut own = || {
        let component = (next % 3) as u8;
        next += 1;
        match (word.as_ref(), next, count) {
            ("POINT" | "LINE", ..) | ("CIRCLE" | "CYLNDR", 1..=3, _) => NumberRole::Point(component),
            ("VECTOR", ..) | ("CYLNDR", 4..=6, 7) | ("PLANE", 1..=3, 4) => NumberRole::Direction(component),
            ("CIRCLE" | "CYLNDR" | "PLANE", ..) => NumberRole::Length,
            _ => NumberRole::Plain,
        }
    };
    let mut roles = Vec::new();
    for field in &group.fields {
        match &field.kind {
            FieldKind::Number(_) => roles.push(own()),
            FieldKind::Group(inner) => roles.extend(group_roles(syntax, inner)),
            _ => {}
        }
    }
    roles
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_nested_geometry_have_the_roles_of_their_words() {
        let text = "TLON,GOFWD/(CYLNDR/1,2,3,1,0,0,12),ON,(PLANE/PERPTO,(PLANE/(POINT/4,5,6),PERPTO,\
                    (VECTOR/0,0,1)),(POINT/7,8,9),(POINT/10,11,12))\n";
        let (record, syntax) = crate::parse::read_record(text.as_bytes()).unwrap();
        let roles = record.number_roles(&syntax);
        let letters: String = roles
            .iter()
            .map(|role| match role {
                NumberRole::Point(_) => 'p',
                NumberRole::Direction(_) => 'd',
                NumberRole::Length => 'l',
                _ => '?',
            })
            .collect();
        assert_eq!(letters, "pppdddlpppdddpppppp");
        assert!(matches!(record, Record::AxialArc(arc) if arc.end == Point3::new(10.0, 11.0, 12.0)));
    }
}
