//! This module says what a machine cannot do with a program, as findings: each with its line, value and limit, and what
//! would mend it.

use super::kinematic_chain::KinematicChain;
use super::machine_axis::{AxisKind, MachineAxis};
use super::motion_faults::{FaultSearch, MotionFault, MotionFaultKind};
use crate::diagnostic::{Diagnostic, DiagnosticCode, codes};
use crate::engagement::FOLLOWED_HEIGHT_MM;
use crate::program::{LengthUnit, Program};
use std::collections::BTreeMap;

/// The largest number of findings of one code. The worst ones are told, and how many more there are.
const MOST_OF_CODE: usize = 100;

/// Finds what a machine cannot do with a program.
pub fn find_machine_findings(
    program: &Program,
    search: &FaultSearch<'_>,
    units: LengthUnit,
) -> Vec<Diagnostic> {
    let mut groups: BTreeMap<DiagnosticCode, Vec<(f64, usize, MotionFault)>> = BTreeMap::new();
    for (number, fault) in search.find_faults(program, units).into_iter().enumerate() {
        let (code, magnitude) = rank_fault(&fault.kind, search.chain);
        groups.entry(code).or_default().push((magnitude, number, fault));
    }
    let mut found = Vec::new();
    for (code, mut group) in groups {
        let more = group.len().saturating_sub(MOST_OF_CODE);
        group.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        group.truncate(MOST_OF_CODE);
        group.sort_by_key(|(_, number, _)| *number);
        for (magnitude, number, fault) in group {
            found.push((number, tell_fault(&fault, code, magnitude, program, search)));
        }
        if more > 0 {
            let message = format!("{more} more motions with {code}, each less than those that are told");
            found.push((usize::MAX, Diagnostic::new(code, message)));
        }
    }
    found.sort_by_key(|(number, _)| *number);
    found.into_iter().map(|(_, finding)| finding).collect()
}

/// Returns the code of a fault and how bad it is beside others of this code.
fn rank_fault(kind: &MotionFaultKind, chain: &KinematicChain) -> (DiagnosticCode, f64) {
    match *kind {
        MotionFaultKind::Unreachable => (codes::AXIS_UNREACHABLE, 0.0),
        MotionFaultKind::BeyondLimit { axis, value, limit } => {
            let is_linear = chain.axes().get(axis).is_some_and(|axis| axis.kind == AxisKind::Linear);
            let code = if is_linear { codes::TRAVEL_EXCEEDED } else { codes::ROTARY_LIMIT_EXCEEDED };
            (code, (value - limit).abs())
        }
        MotionFaultKind::NearPole { step, speed, .. } => {
            (codes::NEAR_POLE, speed.unwrap_or_default().max(step.abs()))
        }
        MotionFaultKind::Flip { steps } => (codes::ROTARY_FLIP, steps[0].abs().max(steps[1].abs())),
        MotionFaultKind::Rewind { step, is_at_feed: true, .. } => (codes::REWIND_IN_CUT, step.abs()),
        MotionFaultKind::Rewind { step, .. } => (codes::REWIND_IN_AIR, step.abs()),
        MotionFaultKind::TipError { sag } => (codes::TIP_ERROR, sag),
        MotionFaultKind::AxisSwing { swing, .. } => (codes::AXIS_SWING, swing),
        MotionFaultKind::TooFast { feed, most, .. } => (codes::AXIS_TOO_SLOW, feed / most),
    }
}

fn tell_fault(
    fault: &MotionFault,
    code: DiagnosticCode,
    magnitude: f64,
    program: &Program,
    search: &FaultSearch<'_>,
) -> Diagnostic {
    let (message, label) = word_fault(&fault.kind, search);
    let span = program.statement(fault.statement).origin();
    Diagnostic::new(code, message).with_label(program.source(), span, label).with_magnitude(magnitude)
}

/// Returns the message of a fault and the text at its place.
fn word_fault(kind: &MotionFaultKind, search: &FaultSearch<'_>) -> (String, String) {
    let axis_at = |place: usize| search.chain.axes().get(place);
    let name_at = |place: usize| axis_at(place).map_or("an axis", |axis: &MachineAxis| axis.name.as_str());
    let unit_at = |place: usize| axis_at(place).map_or("", MachineAxis::value_unit);
    let first = search.chain.rotary_axes().next();
    let first_name = first.map_or("an axis", |axis| axis.name.as_str());
    match *kind {
        MotionFaultKind::Unreachable => {
            ("the machine cannot give the tool this axis".to_owned(), "out of reach".to_owned())
        }
        MotionFaultKind::BeyondLimit { axis, value, limit } => {
            let (name, unit) = (name_at(axis), unit_at(axis));
            let beyond = (value - limit).abs();
            let message = format!(
                "{name} would stand at {value:.3} {unit}, {beyond:.3} {unit} beyond its limit of {limit} {unit}"
            );
            (message, format!("{name} {value:.3}, limit {limit}"))
        }
        MotionFaultKind::NearPole { angle, step, speed } => {
            let most = first.map_or(0.0, |axis| axis.max_speed);
            let asked = match speed {
                Some(speed) => format!(": the feed asks {speed:.0} deg/min of it, and it makes {most:.0}"),
                None => String::new(),
            };
            let message = format!(
                "the tool passes {angle:.3} deg from the pole, where {first_name} turns by {step:.1} deg{asked}"
            );
            (message, format!("{first_name} turns by {step:.1} deg"))
        }
        MotionFaultKind::Flip { steps: [first_step, second_step] } => {
            let second = search.chain.rotary_axes().nth(1).map_or("the other", |axis| axis.name.as_str());
            let message = format!(
                "{second} changes to the other side of the pole: {first_name} by {first_step:.1} deg, {second} by {second_step:.1} deg"
            );
            (message, format!("{second} flips"))
        }
        MotionFaultKind::Rewind { axis, step, is_at_feed } => {
            let (name, place) = (name_at(axis), if is_at_feed { "in the cut" } else { "at rapid" });
            (
                format!("{name} goes back by {step:.1} deg {place}, because its limit is near"),
                format!("{name} {step:.1} deg"),
            )
        }
        MotionFaultKind::TipError { sag } => {
            let most = search.tip_tolerance;
            let message = format!("the tip leaves its line by {sag:.4} mm, and {most} mm are allowed");
            (message, format!("{sag:.4} mm between this point and the one before"))
        }
        MotionFaultKind::AxisSwing { swing, distance } => {
            let most = search.tip_tolerance;
            let message = format!(
                "the rotary axes take the tool axis {swing:.3} deg beside the shortest turn: {FOLLOWED_HEIGHT_MM} mm above the tip \
                 that is {distance:.3} mm, and {most} mm are allowed"
            );
            (message, format!("{swing:.3} deg between this point and the one before"))
        }
        MotionFaultKind::TooFast { axis, feed, most } => {
            let name = name_at(axis);
            (
                format!("{name} cannot follow the feed of {feed:.0} mm/min, but at most {most:.1} mm/min"),
                format!("at most {most:.1} mm/min by {name}"),
            )
        }
    }
}
