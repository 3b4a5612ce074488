//! This module writes a machine as a JSON document.

use crate::machine::{AxisKind, AxisMount, MachineAxis};
use crate::setup::MachineLimits;
use serde::Serialize;

/// Returns a machine as a JSON document, indented and with a line end. Lengths are in mm, angles in degrees, speeds of axes
/// per minute, their accelerations per s2 and jerks per s3; what is not known is `null`, as are the axes of a machine that
/// does not describe them. `file` is the name of the setup file.
///
/// `version` goes up when a reader of the old structure would fail. New keys may be added without that.
pub fn machine_to_json(machine: &MachineLimits, file: &str) -> String {
    crate::report::to_json_text(&MachineDocument {
        version: 1,
        file,
        name: machine.name.as_deref(),
        axes: machine.chain.as_ref().map(|chain| chain.axes().iter().map(AxisJson::from_axis).collect()),
        tcp: machine.tcp,
        max_feed_mm_min: machine.max_feed.map(|value| value.get()),
        rapid_feed_mm_min: machine.rapid_feed.map(|value| value.get()),
        max_acceleration_mm_s2: machine.max_acceleration.map(|value| value.get() / 60.0),
        path_jerk_mm_s3: machine.path_jerk.map(|value| value.get()),
        corner_constant_s: machine.corner_constant.map(|value| value.get()),
        tool_change_s: machine.tool_change.map(|value| value.get()),
        spindle_start_s: machine.spindle_start.map(|value| value.get()),
    })
}

#[derive(Serialize)]
struct MachineDocument<'a> {
    version: u32,
    file: &'a str,
    name: Option<&'a str>,
    axes: Option<Vec<AxisJson<'a>>>,
    tcp: Option<bool>,
    max_feed_mm_min: Option<f64>,
    rapid_feed_mm_min: Option<f64>,
    max_acceleration_mm_s2: Option<f64>,
    path_jerk_mm_s3: Option<f64>,
    corner_constant_s: Option<f64>,
    tool_change_s: Option<f64>,
    spindle_start_s: Option<f64>,
}

#[derive(Serialize)]
struct AxisJson<'a> {
    name: &'a str,
    mount: &'static str,
    kind: &'static str,
    direction: [f64; 3],
    point_mm: [f64; 3],
    limits: Option<[f64; 2]>,
    max_speed: f64,
    rapid: f64,
    acceleration: f64,
    jerk: Option<f64>,
}

impl<'a> AxisJson<'a> {
    fn from_axis(axis: &'a MachineAxis) -> Self {
        Self {
            name: &axis.name,
            mount: match axis.mount {
                AxisMount::Table => "table",
                AxisMount::Head => "head",
            },
            kind: match axis.kind {
                AxisKind::Linear => "linear",
                AxisKind::Rotary => "rotary",
            },
            direction: axis.direction.into_inner().into(),
            point_mm: axis.point.coords.into(),
            limits: axis.limits,
            max_speed: axis.max_speed,
            rapid: axis.rapid,
            acceleration: axis.acceleration,
            jerk: axis.jerk,
        }
    }
}
