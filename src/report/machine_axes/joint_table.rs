//! This module tabulates the values of all axes over a program.

use crate::machine::{
    AxisInterpolation, KinematicChain, MachineDynamics, ProgramPose, solve_program_poses, time_program,
};
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::presentation::text_format::format_table;
use crate::presentation::to_safe_line;
use crate::program::geometry::MotionPath;
use crate::program::{LengthUnit, Program};
use crate::report::statement_line;
use crate::report::text_format::{
    format_count, format_counted, format_duration, format_fixed, format_trimmed,
};
use std::fmt::Write as _;

/// The unit of rotary axes.
const DEGREES: &str = "deg";

/// The end of a motion on the machine.
#[derive(Debug, Clone, PartialEq)]
pub struct JointRow {
    /// The line of the statement that ends the motion; `None` if a step inserted it.
    pub line: Option<usize>,
    /// Whether the motion is a rapid.
    pub rapid: bool,
    /// The time at its end in s, from the start of the program; `None` from where it is not known.
    pub time: Option<f64>,
    /// Whether it is a motion, and not the first point, which only says where the tool stands.
    pub is_motion: bool,
    /// The tip in the workpiece frame, in the unit of length of the table.
    pub tip: [f64; 3],
    /// The tool axis there.
    pub axis: [f64; 3],
    /// The values of the axes in the unit of length of the table and in degrees, in the order of the machine; empty
    /// where the machine cannot reach the tool axis.
    pub joints: Vec<f64>,
    /// The angle to the pole in degrees, if the machine has rotary axes.
    pub pole_angle: Option<f64>,
    /// Whether the tool is at the pole.
    pub is_pole: bool,
    /// Whether the second rotary axis has changed to the other side of the pole.
    pub is_flip: bool,
    /// Whether a rotary axis has gone back by more than half a turn.
    pub is_rewind: bool,
    /// The names of the axes outside their limits.
    pub outside: Vec<String>,
    /// How far the tip leaves its line if all axes run evenly, in the unit of length of the table.
    pub sag: Option<f64>,
    /// The largest feed that the axes follow, in the unit of length of the table per minute; `None` where
    /// the tip stands.
    pub feed_limit: Option<f64>,
}

/// The values of all axes over a program.
#[derive(Debug, Clone, PartialEq)]
pub struct JointTable {
    /// The file's name.
    pub file: String,
    /// The unit of all lengths.
    pub length_unit: LengthUnit,
    /// Names and units of the axes, in the order of the machine.
    pub axes: Vec<(String, &'static str)>,
    /// The limits of these axes.
    pub limits: Vec<Option<[f64; 2]>>,
    /// The ends of all motions.
    pub rows: Vec<JointRow>,
    /// The sum of the steps of the rotary axes in degrees, from 0 on.
    pub rotary_way: f64,
    /// The time of the whole program in s, as far as it is known.
    pub seconds: f64,
}

impl JointTable {
    /// Computes the values of a program, in mm. `units` is the unit of the program.
    pub fn from_program(
        program: &Program,
        chain: &KinematicChain,
        dynamics: &MachineDynamics,
        units: LengthUnit,
    ) -> Self {
        let poses = solve_program_poses(program, chain, units);
        let time = time_program(program, units, dynamics);
        let axes: Vec<_> = chain.axes().iter().map(|axis| (axis.name.clone(), axis.value_unit())).collect();
        let mut rows = Vec::with_capacity(poses.len());
        let (mut before, mut clock): (Option<&ProgramPose>, _) = (None, Some(0.0));
        let (mut way, mut last) = (0.0, [0.0; 2]);
        let times = time.motions.iter().zip(&time.standing);
        for ((motion, pose), (seconds, standing)) in program.motions().zip(&poses).zip(times) {
            clock = clock.zip(*seconds).map(|(clock, seconds)| clock + seconds + standing);
            if let Some(chosen) = pose.chosen {
                way +=
                    chosen.joints.rotaries.iter().zip(last).map(|(to, from)| (to - from).abs()).sum::<f64>();
                last = chosen.joints.rotaries;
            }
            let from = before.filter(|_| motion.path != MotionPath::Start);
            let mut row = make_row(pose, from, chain, dynamics.interpolation);
            row.line = statement_line(program, program.statement(pose.statement));
            row.rapid = motion.rapid;
            row.is_motion = motion.path != MotionPath::Start;
            row.time = clock;
            rows.push(row);
            before = Some(pose);
        }
        Self {
            file: program.source().name().to_owned(),
            length_unit: LengthUnit::Mm,
            axes,
            limits: chain.axes().iter().map(|axis| axis.limits).collect(),
            rows,
            rotary_way: way,
            seconds: time.total(),
        }
    }

    /// Returns the table with its lengths in another unit.
    #[must_use]
    pub fn shown_in(mut self, unit: LengthUnit) -> Self {
        let factor = self.length_unit.mm_per_unit() / unit.mm_per_unit();
        self.length_unit = unit;
        let is_length: Vec<bool> = self.axes.iter().map(|(_, unit)| *unit != DEGREES).collect();
        for (((_, name), limits), _) in
            self.axes.iter_mut().zip(&mut self.limits).zip(&is_length).filter(|(_, is_length)| **is_length)
        {
            *name = ColumnUnit::Length.symbol(unit);
            *limits = limits.map(|limits| limits.map(|limit| limit * factor));
        }
        for row in &mut self.rows {
            row.tip = row.tip.map(|value| value * factor);
            let lengths = row.joints.iter_mut().zip(&is_length).filter(|(_, is_length)| **is_length);
            lengths.for_each(|(value, _)| *value *= factor);
            row.sag = row.sag.map(|sag| sag * factor);
            row.feed_limit = row.feed_limit.map(|feed| feed * factor);
        }
        self
    }

    /// Returns the units that its lengths are in, for printing.
    pub(super) fn display_units(&self) -> DisplayUnits {
        DisplayUnits::unconverted(self.length_unit)
    }

    /// Returns a summary for people: what happens, and how far each axis goes.
    pub fn to_text(&self) -> String {
        let count = |what: fn(&JointRow) -> bool| {
            format_count(self.rows.iter().filter(|row| what(row)).count() as u64)
        };
        let sag = self.rows.iter().filter_map(|row| row.sag).fold(0.0, f64::max);
        let mut out = format!("{}\n", to_safe_line(&self.file));
        let _ = writeln!(
            out,
            "  {}, {}, rotary axes go {} deg",
            format_counted(self.rows.iter().filter(|row| row.is_motion).count(), "motion", "motions"),
            format_duration(self.seconds),
            format_fixed(self.rotary_way, 1)
        );
        let _ = writeln!(
            out,
            "  {} at the pole, {} to its other side, {} rewinds, {} outside limits, {} out of reach",
            count(|row| row.is_pole),
            count(|row| row.is_flip),
            count(|row| row.is_rewind),
            count(|row| !row.outside.is_empty()),
            count(|row| row.joints.is_empty())
        );
        let _ = writeln!(
            out,
            "  without control of the tip it would leave its line by {}\n",
            self.display_units().tell_fixed(ColumnUnit::Length, sag, 4)
        );
        let mut table = vec![["axis", "least", "largest", "limits"].map(str::to_owned).to_vec()];
        for (index, ((name, unit), limits)) in self.axes.iter().zip(&self.limits).enumerate() {
            let values = self.rows.iter().filter_map(|row| row.joints.get(index).copied());
            let range = values.fold(None, |range: Option<[f64; 2]>, value| {
                Some(range.map_or([value; 2], |[low, high]| [low.min(value), high.max(value)]))
            });
            let [low, high] = match range {
                Some(range) => {
                    range.map(|value| format!("{} {unit}", format_fixed(value, self.decimals_of(unit))))
                }
                None => ["-", "-"].map(str::to_owned),
            };
            let limits = limits.map_or("none".to_owned(), |limits| {
                limits.map(|limit| format_trimmed(limit, self.decimals_of(unit))).join(" to ")
            });
            table.push(vec![to_safe_line(name), low, high, limits]);
        }
        out.push_str(&format_table(&table));
        out
    }
}

impl JointTable {
    /// Returns how many decimals people see of a value.
    fn decimals_of(&self, unit: &str) -> usize {
        if unit == DEGREES { 3 } else { self.display_units().decimals(ColumnUnit::Length, 3) }
    }
}

fn make_row(
    pose: &ProgramPose,
    before: Option<&ProgramPose>,
    chain: &KinematicChain,
    interpolation: AxisInterpolation,
) -> JointRow {
    let joints = before.and_then(|before| pose.motion_from(before, chain));
    let name = |place: usize| chain.axes().get(place).map(|axis| axis.name.clone());
    let side = |pose: &ProgramPose| pose.chosen.map_or(0, |chosen| chosen.side);
    let feed_limit = joints.as_ref().and_then(|joints| {
        let (least, length) = (joints.axis_demand(interpolation).least_s, joints.tip_length_mm());
        (least > 0.0 && length > 0.0).then(|| 60.0 * length / least)
    });
    JointRow {
        line: None,
        rapid: false,
        time: None,
        is_motion: true,
        tip: pose.tip.into(),
        axis: pose.axis.into(),
        joints: pose
            .chosen
            .map(|chosen| chain.order_values(&chosen.joints.linears, &chosen.joints.rotaries))
            .unwrap_or_default(),
        pole_angle: chain.pole_angle_deg(&pose.axis),
        is_pole: pose.chosen.is_some_and(|chosen| chosen.is_pole),
        is_flip: chain.has_pole() && before.is_some_and(|before| side(before) * side(pose) < 0),
        is_rewind: joints
            .as_ref()
            .is_some_and(|joints| joints.rotary_steps().iter().any(|step| step.abs() > 180.0 + 1e-9)),
        outside: pose
            .chosen
            .map(|chosen| chain.find_axes_outside(&chosen.joints).into_iter().filter_map(name).collect())
            .unwrap_or_default(),
        sag: joints.as_ref().map(|joints| joints.tip_sag_mm()),
        feed_limit,
    }
}
