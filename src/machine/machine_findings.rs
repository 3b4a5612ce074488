//! This module says what a machine cannot do with a program, as findings: each with its line, value and limit, and what
//! would mend it.

use super::kinematic_chain::KinematicChain;
use super::machine_axis::{AxisKind, MachineAxis};
use super::motion_faults::{FaultSearch, MotionFault, MotionFaultKind};
use crate::diagnostic::{Diagnostic, DiagnosticCode, codes};
use crate::engagement::FOLLOWED_HEIGHT_MM;
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::program::{LengthUnit, Program};

/// Finds what a machine cannot do with a program, in the order of its motions. `unit` is the unit of the program's
/// lengths; the findings tell theirs in it.
pub fn find_machine_findings(
    program: &Program,
    search: &FaultSearch<'_>,
    unit: LengthUnit,
) -> Vec<Diagnostic> {
    let units = DisplayUnits::from_mm(unit);
    let faults = search.find_faults(program, unit);
    faults.iter().map(|fault| tell_fault(fault, program, search, units)).collect()
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
    program: &Program,
    search: &FaultSearch<'_>,
    units: DisplayUnits,
) -> Diagnostic {
    let (code, magnitude) = rank_fault(&fault.kind, search.chain);
    let (message, label) = word_fault(&fault.kind, search, units);
    let span = program.statement(fault.statement).origin();
    Diagnostic::new(code, message).with_label(program.source(), span, label).with_magnitude(magnitude)
}

/// Returns the message of a fault and the text at its place.
fn word_fault(kind: &MotionFaultKind, search: &FaultSearch<'_>, units: DisplayUnits) -> (String, String) {
    let axis_at = |place: usize| search.chain.axes().get(place);
    let name_at = |place: usize| axis_at(place).map_or("an axis", |axis: &MachineAxis| axis.name.as_str());
    let length = |value: f64, decimals: usize| units.tell_fixed(ColumnUnit::Length, value, decimals);
    let feed_per_minute = |value: f64, decimals| units.tell_fixed(ColumnUnit::FeedPerMinute, value, decimals);
    let tolerance = || units.tell_trimmed(ColumnUnit::Length, search.tip_tolerance, 6);
    let first = search.chain.rotary_axes().next();
    let first_name = first.map_or("an axis", |axis| axis.name.as_str());
    match *kind {
        MotionFaultKind::Unreachable => {
            ("the machine cannot give the tool this axis".to_owned(), "out of reach".to_owned())
        }
        MotionFaultKind::BeyondLimit { axis, value, limit } => {
            let name = name_at(axis);
            let is_linear = axis_at(axis).is_some_and(|axis| axis.kind == AxisKind::Linear);
            let [stands, beyond, most] = if is_linear {
                let most = units.tell_trimmed(ColumnUnit::Length, limit, 4);
                [length(value, 3), length((value - limit).abs(), 3), most]
            } else {
                [
                    format!("{value:.3} deg"),
                    format!("{:.3} deg", (value - limit).abs()),
                    format!("{limit} deg"),
                ]
            };
            let message = format!("{name} would stand at {stands}, {beyond} beyond its limit of {most}");
            (message, format!("{name} {stands}, limit {most}"))
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
            let (sag, most) = (length(sag, 4), tolerance());
            let message = format!("the tip leaves its line by {sag}, and {most} are allowed");
            (message, format!("{sag} between this point and the one before"))
        }
        MotionFaultKind::AxisSwing { swing, distance } => {
            let height = units.tell_trimmed(ColumnUnit::Length, FOLLOWED_HEIGHT_MM, 1);
            let (distance, most) = (length(distance, 3), tolerance());
            let message = format!(
                "the rotary axes take the tool axis {swing:.3} deg beside the shortest turn: {height} above the tip \
                 that is {distance}, and {most} are allowed"
            );
            (message, format!("{swing:.3} deg between this point and the one before"))
        }
        MotionFaultKind::TooFast { axis, feed, most } => {
            let (name, feed, most) = (name_at(axis), feed_per_minute(feed, 0), feed_per_minute(most, 1));
            (
                format!("{name} cannot follow the feed of {feed}, but at most {most}"),
                format!("at most {most} by {name}"),
            )
        }
    }
}
