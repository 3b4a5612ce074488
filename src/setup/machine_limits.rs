//! This module holds the machine and its limits.

use super::machine_axes_text::{AxisText, check_chain};
use super::setup_reader::SetupReader;
use super::stock::FileRef;
use super::{Setup, YamlLocation};
use crate::diagnostic::{Failure, codes};
use crate::machine::{AxisInterpolation, FaultSearch, KinematicChain, MachineDynamics};
use crate::parameters::{FilePath, Finite, LengthUnit, NonNegative, Positive};
use crate::source::{Source, SourceReadError};
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::Path;
use std::sync::Arc;

/// How far the tip may be from its line where the setup does not say it, in mm.
const TIP_TOLERANCE_MM: f64 = 0.01;

/// The limits of a machine, and its axes. A limit that is not known is `None`, and does not apply.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MachineLimits {
    /// The name of the machine.
    pub name: Option<String>,
    /// The file that describes the machine; see [`Setup::read_machine_file`].
    pub file: Option<FileRef>,
    /// The highest programmed feed, in mm/min.
    pub max_feed: Option<Positive>,
    /// The speed of rapid motions, in mm/min.
    pub rapid_feed: Option<Positive>,
    /// The largest change of feed along the path, in (mm/min)/s.
    pub max_acceleration: Option<Positive>,
    /// The largest jerk along the path, in mm/s3.
    pub path_jerk: Option<Positive>,
    /// What a corner costs: seconds by the root of the change of the velocity in mm/s.
    pub corner_constant: Option<NonNegative>,
    /// The time of a tool change, in s.
    pub tool_change: Option<NonNegative>,
    /// The time until the spindle has its speed, in s.
    pub spindle_start: Option<NonNegative>,
    /// Whether the control keeps the tip on its line while rotary axes turn.
    pub tcp: Option<bool>,
    /// How far the tip may be from its line where it is not kept there, in mm.
    pub tip_tolerance: Option<Positive>,
    /// The axes.
    pub chain: Option<Arc<KinematicChain>>,
}

impl MachineLimits {
    /// Returns the limits of this machine, and those of `base` where this one has none.
    pub(super) fn override_base(self, base: Self) -> Self {
        Self {
            name: self.name.or(base.name),
            file: self.file.or(base.file),
            max_feed: self.max_feed.or(base.max_feed),
            rapid_feed: self.rapid_feed.or(base.rapid_feed),
            max_acceleration: self.max_acceleration.or(base.max_acceleration),
            path_jerk: self.path_jerk.or(base.path_jerk),
            corner_constant: self.corner_constant.or(base.corner_constant),
            tool_change: self.tool_change.or(base.tool_change),
            spindle_start: self.spindle_start.or(base.spindle_start),
            tcp: self.tcp.or(base.tcp),
            tip_tolerance: self.tip_tolerance.or(base.tip_tolerance),
            chain: self.chain.or(base.chain),
        }
    }
}

impl MachineLimits {
    /// Returns how the machine goes from pose to pose.
    pub fn interpolation(&self) -> AxisInterpolation {
        match self.tcp {
            Some(false) => AxisInterpolation::JointLinear,
            _ => AxisInterpolation::TipControlled,
        }
    }

    /// Returns the machine as faults of programs are looked for on it. `None` if its axes are not known.
    pub fn fault_search(&self) -> Option<FaultSearch<'_>> {
        Some(FaultSearch {
            chain: self.chain.as_deref()?,
            interpolation: self.interpolation(),
            tip_tolerance: self.tip_tolerance.map_or(TIP_TOLERANCE_MM, Positive::get),
        })
    }

    /// Returns what times depend on. `None` if neither axes nor what corners cost are known.
    pub fn dynamics(&self) -> Option<MachineDynamics> {
        if self.chain.is_none() && self.corner_constant.is_none() {
            return None;
        }
        Some(MachineDynamics {
            chain: self.chain.clone(),
            interpolation: self.interpolation(),
            acceleration: self.max_acceleration.map(|most| most.get() / 60.0),
            jerk: self.path_jerk.map(Positive::get),
            corner_constant: self.corner_constant.map_or(0.0, NonNegative::get),
            rapid_feed: self.rapid_feed.map(Positive::get),
            tool_change_s: self.tool_change.map_or(0.0, NonNegative::get),
            spindle_start_s: self.spindle_start.map_or(0.0, NonNegative::get),
        })
    }
}

impl Setup {
    /// Reads the file of the machine if the setup names one: a setup file whose `machine` counts where this setup says
    /// nothing. `read` gets the path as seen from where clsmith runs.
    ///
    /// # Errors
    /// Returns [`codes::MACHINE_FILE`] where the file is named, or the faults of the file.
    pub fn read_machine_file(
        mut self,
        read: impl FnOnce(&Path) -> Result<Arc<Source>, SourceReadError>,
    ) -> Result<Self, Failure> {
        let Some(file) = &self.machine.file else { return Ok(self) };
        let source = read(&file.path).map_err(|reason| {
            let message = format!("the machine file `{}` cannot be read: {reason}", file.written);
            file.make_finding(codes::MACHINE_FILE, message)
        })?;
        let named = Self::load(&source)?.machine;
        if let Some(next) = &named.file {
            let message = format!("the machine file `{}` names another machine file", file.written);
            return Err(next.make_finding(codes::MACHINE_FILE, message).into());
        }
        self.machine = self.machine.override_base(named);
        Ok(self)
    }
}

/// The machine: limits along the path, and its axes, in the file's unit. Axes stand in two chains, told with all axes
/// at 0, where the workpiece frame and the frame of the machine are the same and the tip stands at the zero of the
/// workpiece.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Machine")]
pub(super) struct MachineText {
    /// A setup file whose `machine` counts where this one has no value, relative to this file's folder.
    file: Option<FilePath>,
    /// The name of the machine.
    name: Option<String>,
    /// The highest programmed feed, in the file's unit per minute.
    max_feed: Option<Positive>,
    /// The speed of rapid motions, in the file's unit per minute. Where the axes are known, their own rapids count.
    rapid_feed: Option<Positive>,
    /// The largest change of feed along the path, in the file's unit per minute and second. With 1000, the
    /// machine needs 3 s from standstill to a feed of 3000. It holds before the accelerations of the axes.
    max_acceleration: Option<Positive>,
    /// The largest jerk along the path, in the file's unit per s3.
    path_jerk: Option<Positive>,
    /// What a corner costs: seconds by the root of the change of the velocity in mm/s, whatever the unit of the file.
    /// 0.0087 was measured on one machine: 31 ms at a corner of 90 degrees at 576 mm/min. `clsmith setup
    /// measure-time` finds it from timed blocks.
    corner_constant: Option<NonNegative>,
    /// The time of a tool change in s, from the last motion with one tool to the first with the next.
    tool_change: Option<NonNegative>,
    /// The time in s until the spindle has its speed, each time that it is switched on.
    spindle_start: Option<NonNegative>,
    /// Whether the control keeps the tip on its programmed line while rotary axes turn (TCP, RTCP, TRAORI). Without,
    /// all axes run evenly and the tip leaves the line; simulations follow it there. It is `true` when it is left out.
    tcp: Option<bool>,
    /// How far the tip may be from its line without `tcp` before `check` says so; 0.01 mm when it is left out.
    tip_tolerance: Option<Positive>,
    /// The direction from the tip to the spindle with all axes at 0; [0, 0, 1] when it is left out.
    tool_axis: Option<[Finite; 3]>,
    /// The axes between the workpiece and the frame, from the workpiece on.
    table: Option<Vec<AxisText>>,
    /// The axes between the frame and the tool, from the frame on.
    head: Option<Vec<AxisText>>,
}

impl MachineText {
    /// Converts the limits to millimetres. Only numbers near the largest `f64` leave the range in the
    /// conversion, and these limit nothing. Faults of axes go to the reader.
    pub(super) fn check_limits(self, reader: &mut SetupReader, place: &YamlLocation) -> MachineLimits {
        let units: LengthUnit = reader.units;
        let to_mm = |value: Option<Positive>| {
            value.and_then(|value| Positive::new(value.get() * units.mm_per_unit()))
        };
        let chain = match (self.table, self.head) {
            (None, None) => None,
            (table, head) => check_chain(
                table.unwrap_or_default(),
                head.unwrap_or_default(),
                self.tool_axis,
                reader,
                place,
            ),
        };
        MachineLimits {
            name: self.name,
            file: self.file.map(|file| FileRef::new(&file, place.at_key("file"))),
            max_feed: to_mm(self.max_feed),
            rapid_feed: to_mm(self.rapid_feed),
            max_acceleration: to_mm(self.max_acceleration),
            path_jerk: to_mm(self.path_jerk),
            corner_constant: self.corner_constant,
            tool_change: self.tool_change,
            spindle_start: self.spindle_start,
            tcp: self.tcp,
            tip_tolerance: to_mm(self.tip_tolerance),
            chain: chain.map(Arc::new),
        }
    }
}
