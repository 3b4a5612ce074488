//! This module reads the axes of a machine and says what is wrong with them, where it stands.

use super::YamlLocation;
use super::setup_reader::SetupReader;
use crate::diagnostic::codes;
use crate::machine::{AxisKind, AxisMount, ChainFault, KinematicChain, MachineAxis};
use crate::parameters::{Finite, Positive};
use nalgebra::{Point3, Unit, Vector3};
use schemars::JsonSchema;
use serde::Deserialize;

/// The length below which a direction is none.
const SHORTEST_DIRECTION: f64 = 1e-9;

/// An axis as it is written. Lengths are in the file's unit, angles in degrees.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Axis")]
pub(super) struct AxisText {
    /// Its name, as on the machine: X, C.
    #[schemars(length(min = 1))]
    name: String,
    /// Whether it moves along its direction or turns about it.
    kind: AxisKindText,
    /// The direction of its own motion at positive values, or of the line about which it turns right-handed. An axis
    /// of the table moves or turns the workpiece: if the table goes to -x at X+, it is [-1, 0, 0].
    direction: [Finite; 3],
    /// A point on the line about which a rotary axis turns: from the zero of the workpiece, or for an axis of the head
    /// from the tip, tool included.
    point: Option<[Finite; 3]>,
    /// Least and largest value. A linear axis without limits has any travel, a rotary axis without limits turns without
    /// end.
    limits: Option<[Finite; 2]>,
    /// The largest speed at feed, per minute.
    max_speed: Positive,
    /// The speed at rapid, per minute.
    rapid: Positive,
    /// The acceleration, per s2.
    acceleration: Positive,
    /// The jerk, per s3; without it, accelerations change at once.
    jerk: Option<Positive>,
}

/// What an axis does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum AxisKindText {
    /// It moves along its direction.
    Linear,
    /// It turns about its direction.
    Rotary,
}

/// Makes the chain of its axes. Returns `None` if it has a fault, which the reader then holds.
pub(super) fn check_chain(
    table: Vec<AxisText>,
    head: Vec<AxisText>,
    tool_axis: Option<[Finite; 3]>,
    reader: &mut SetupReader,
    place: &YamlLocation,
) -> Option<KinematicChain> {
    let lists = [(table, AxisMount::Table, "table"), (head, AxisMount::Head, "head")];
    let (mut axes, mut places) = (Vec::new(), Vec::new());
    let mut sound = true;
    for (list, mount, key) in lists {
        let list_place = place.at_key(key);
        for (index, axis) in list.into_iter().enumerate() {
            let at = list_place.at_index(index);
            let known: Vec<&str> = axes.iter().map(|axis: &MachineAxis| axis.name.as_str()).collect();
            sound &= check_name(&axis, &known, reader, &at);
            match axis.check_axis(mount, reader, &at) {
                Some(axis) => {
                    axes.push(axis);
                    places.push(at);
                }
                None => sound = false,
            }
        }
    }
    let tool_axis = tool_axis.map_or(Some(Vector3::z_axis()), |axis| {
        find_direction(axis, "the tool axis has no direction", reader, || place.at_key("tool_axis"))
    })?;
    if !sound {
        return None;
    }
    KinematicChain::new(axes, tool_axis)
        .map_err(|fault| tell_chain_fault(&fault, &places, reader, place))
        .ok()
}

fn check_name(axis: &AxisText, known: &[&str], reader: &mut SetupReader, at: &YamlLocation) -> bool {
    let name = axis.name.trim();
    if name.is_empty() {
        reader.add_fault(
            || at.at_key("name"),
            "an axis has no name",
            "empty",
            "Name it as the machine does: X, C.",
        );
        return false;
    }
    if known.contains(&name) {
        let message = format!("two axes are named `{name}`");
        reader.add_fault(
            || at.at_key("name"),
            message,
            "named again here",
            "Every axis has a name of its own.",
        );
        return false;
    }
    true
}

fn find_direction(
    numbers: [Finite; 3],
    message: &str,
    reader: &mut SetupReader,
    place: impl FnOnce() -> YamlLocation,
) -> Option<Unit<Vector3<f64>>> {
    let direction = Unit::try_new(Vector3::from(numbers.map(Finite::get)), SHORTEST_DIRECTION);
    let direction = direction.filter(|direction| direction.iter().all(|part| part.is_finite()));
    if direction.is_none() {
        let help = "Give a vector with a length: [0, 0, 1] is along z.";
        reader.add_fault(place, message, "this vector has no direction", help);
    }
    direction
}

impl AxisText {
    /// Converts the axis. Returns `None` if it has a fault.
    fn check_axis(
        self,
        mount: AxisMount,
        reader: &mut SetupReader,
        at: &YamlLocation,
    ) -> Option<MachineAxis> {
        let name = self.name.trim().to_owned();
        let direction = {
            let message = format!("the direction of {name} is no direction");
            find_direction(self.direction, &message, reader, || at.at_key("direction"))
        };
        let kind = match self.kind {
            AxisKindText::Linear => AxisKind::Linear,
            AxisKindText::Rotary => AxisKind::Rotary,
        };
        let point = check_point(self.point, kind, &name, reader, at);
        let scale = if kind == AxisKind::Linear { reader.units.mm_per_unit() } else { 1.0 };
        let limits = self.limits.map(|limits| limits.map(|limit| limit.get() * scale));
        if let Some([low, high]) = limits
            && low >= high
        {
            let message = format!("the limits of {name} are crossed: {low} is not below {high}");
            reader.add_fault(
                || at.at_key("limits"),
                message,
                "crossed",
                "Write the least value first: [low, high].",
            );
            return None;
        }
        Some(MachineAxis {
            name,
            mount,
            kind,
            direction: direction?,
            point: point?,
            limits,
            max_speed: self.max_speed.get() * scale,
            rapid: self.rapid.get() * scale,
            acceleration: self.acceleration.get() * scale,
            jerk: self.jerk.map(|jerk| jerk.get() * scale),
        })
    }
}

/// Returns the point of an axis in mm.
fn check_point(
    point: Option<[Finite; 3]>,
    kind: AxisKind,
    name: &str,
    reader: &mut SetupReader,
    at: &YamlLocation,
) -> Option<Point3<f64>> {
    match (point, kind) {
        (Some(point), AxisKind::Rotary) => {
            Some(Point3::from(point.map(|part| reader.length_mm(part.get(), || at.at_key("point")))))
        }
        (None, AxisKind::Linear) => Some(Point3::origin()),
        (None, AxisKind::Rotary) => {
            let message = format!("the rotary axis {name} has no point");
            let help = "Add `point: [x, y, z]`, a point on the line about which it turns: from the zero of the \
                        workpiece, or for an axis of the head from the tip, tool included.";
            let keys = [(at.clone(), "`point` is missing")];
            reader.add_key_fault(codes::MISSING_KEY, message, help, &keys);
            None
        }
        (Some(_), AxisKind::Linear) => {
            let message = format!("the linear axis {name} has a point");
            let help = "Remove it: where a linear axis lies makes no difference.";
            reader.add_key_fault(
                codes::BAD_VALUE,
                message,
                help,
                &[(at.at_key("point"), "not for a linear axis")],
            );
            None
        }
    }
}

/// Says why axes are no machine, at those that are to blame.
fn tell_chain_fault(
    fault: &ChainFault,
    places: &[YamlLocation],
    reader: &mut SetupReader,
    machine: &YamlLocation,
) {
    let at = |index: usize| places.get(index).unwrap_or(machine);
    let direction = |index: usize| at(index).at_key("direction");
    let (message, help, keys): (String, &str, Vec<(YamlLocation, &str)>) = match fault {
        ChainFault::LinearCount(count) => (
            format!("the machine has {count} linear axes, and three bring the tip to every point"),
            "List every linear axis under `table` or `head`, also those that other axes carry.",
            vec![(machine.clone(), "in this machine")],
        ),
        ChainFault::ThirdRotary(index) => (
            "the machine has more than two rotary axes".to_owned(),
            "Two rotary axes give every direction; leave out the one that the control holds still.",
            vec![(at(*index).at_key("kind"), "the third one")],
        ),
        ChainFault::LinearsInPlane([x, y, z]) => (
            "the three linear axes lie in one plane".to_owned(),
            "Look at their directions: the tip must be able to leave the plane of any two of them.",
            vec![
                (direction(*z), "in the plane of both others"),
                (direction(*x), "one"),
                (direction(*y), "and two"),
            ],
        ),
        ChainFault::RotariesParallel([first, second]) => (
            "the two rotary axes are parallel, so that the tool reaches one cone of directions only"
                .to_owned(),
            "Look at their directions; give one axis alone if the machine has no second one.",
            vec![(direction(*second), "parallel"), (direction(*first), "to this one")],
        ),
        ChainFault::RotaryAlongTool(index) => (
            "the rotary axis next to the tool lies along the tool, and only turns it about itself".to_owned(),
            "Look at its direction, and at `tool_axis`; leave it out if CL data never asks for it.",
            vec![(direction(*index), "along the tool")],
        ),
    };
    reader.add_key_fault(codes::BAD_VALUE, message, help, &keys);
}
