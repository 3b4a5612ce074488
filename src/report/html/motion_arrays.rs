//! This module makes arrays of a program for the page: its path, its feeds, what it cuts, and its rows in the
//! listing.

use super::array_encoding::PageArray;
use super::listing::NONE;
use super::page_tools::PageTool;
use crate::engagement::PathLinearizer;
use crate::program::geometry::Pose;
use crate::program::motion::{ActiveTool, Motion};
use crate::program::operation::find_operations;
use crate::program::{LengthUnit, MotionClass, Program};
use crate::report::comparison::ComparisonSubject;
use crate::report::machine_time::MachineClock;
use crate::report::motion_measure::measure_motion;
use crate::report::simulation::{MotionRow, SimulationReport};
use crate::report::table::{ColumnUnit, DisplayUnits};
use crate::setup::Setup;
use crate::simulation_run::find_machine_path;
use std::sync::Arc;

/// The largest distance between chords and their arcs in the drawing, mm.
pub(super) const CHORD_MM: f64 = 0.02;

/// A flag of motions: it is a rapid.
const RAPID: u8 = 1;
/// A flag of motions: it does not begin where the previous one ended. Its first vertex is its start.
const JUMPS: u8 = 2;
/// A flag of motions: it is a crash, which the page draws in red.
const CRASH: u8 = 4;

/// The arrays of a program. Unless a field says otherwise, they have a value for each motion. First points
/// are no motions, because no path leads to them.
#[derive(Debug, Default)]
pub(super) struct PageMotionArrays {
    /// Vertices of the path, mm from `origin` in the workpiece frame.
    pub vertices: Vec<[f32; 3]>,
    /// The direction of the tool's axis at each vertex.
    pub axes: Vec<[f32; 3]>,
    /// The number of vertices up to the end of each motion.
    pub ends: Vec<u32>,
    /// The flags [`RAPID`], [`JUMPS`] and [`CRASH`].
    pub flags: Vec<u8>,
    /// The index of the motion's class in [`MotionClass::ALL`].
    pub class: Vec<u8>,
    /// The index of the operation in `operations`.
    pub operation: Vec<u16>,
    /// The index of the tool in `tools`.
    pub tool: Vec<u16>,
    /// The first row of the motion's statement in the listing, or [`NONE`].
    pub row: Vec<u32>,
    /// Length, mm.
    pub length: Vec<f32>,
    /// The time in s; 0 if it is not known.
    pub seconds: Vec<f32>,
    /// The feed in mm/min; NaN in rapids and if it is not known.
    pub feed: Vec<f32>,
    /// The loads of the simulation: name, unit, and a value for each motion, which is NaN if it is not known.
    pub loads: Vec<(&'static str, ColumnUnit, Vec<f32>)>,
    /// How each motion differs from the one before or after ([`super::motion_change::PageMotionChange`]).
    pub change: Vec<u8>,
    /// The corresponding motion of the other program, or [`NONE`].
    pub pair: Vec<u32>,
    /// The tools.
    pub tools: Vec<PageTool>,
    /// The names of the operations.
    pub operations: Vec<String>,
    /// For each statement, the motion that ends at it, or [`NONE`]. If several end there, it is the first
    /// one.
    pub ended_by: Vec<u32>,
    /// The index of the statement that ends each motion.
    pub statement: Vec<u32>,
    /// While the arrays are made, the tool of the last motion and its index.
    last_tool: Option<(Option<Arc<ActiveTool>>, u16)>,
}

/// A quantity: its name, its unit, and the function that takes its value from the row of a motion.
type PageLoadColumn = (&'static str, ColumnUnit, fn(&MotionRow) -> Option<f64>);

/// The quantities of a simulation that charts show.
const LOADS: [PageLoadColumn; 7] = [
    ("chip", ColumnUnit::Length, |row| row.chip_thickness_mm),
    ("removal", ColumnUnit::RemovalRate, |row| row.peak_removal_rate_mm3_min),
    ("force", ColumnUnit::Force, |row| row.force_n),
    ("torque", ColumnUnit::Torque, |row| row.torque_nm),
    ("power", ColumnUnit::Power, |row| row.power_kw),
    ("deflection", ColumnUnit::Length, MotionRow::deflection_mm),
    ("stress", ColumnUnit::Stress, MotionRow::bending_stress_mpa),
];

impl PageMotionArrays {
    /// Makes the arrays of a program. `rows` holds the row of each of its statements in the listing, and
    /// `origin` is the point in mm from which the vertices count.
    pub(super) fn from_program(
        subject: &ComparisonSubject<'_>,
        program: &Program,
        simulated: Option<&SimulationReport>,
        rows: &[u32],
        origin: [f64; 3],
    ) -> Self {
        let units = subject.resolve_length_unit(program).unit;
        let rapid = subject.rapid_feed_mm_min();
        let mut side = Self {
            operations: find_operations(program).into_iter().map(|operation| operation.name).collect(),
            ended_by: vec![NONE; program.statements().len()],
            ..Self::default()
        };
        side.reserve_motions(program.statements().len());
        let machine = find_machine_path(program, subject.setup, units);
        let clock = MachineClock::new(program, units, subject.setup);
        let mut trace =
            PathLinearizer::new(units.mm_per_unit(), CHORD_MM, f64::INFINITY).with_machine_path(machine);
        let mut steps = Vec::new();
        // The frame of the first motion is the workpiece frame, even if that motion is a first point.
        for (number, motion) in program.motions().enumerate() {
            trace.adopt_workpiece_frame(&motion);
            if motion.path == crate::program::geometry::MotionPath::Start {
                continue;
            }
            steps.clear();
            trace.append_pieces((number, &motion), 0, &mut steps);
            side.push_path(&steps, motion.rapid, origin);
            side.push_measures(&motion, units, rapid, &clock);
            side.push_motion_facts(&motion, rows, (subject.setup, units));
        }
        side.last_tool = None;
        if let Some(rows) = simulated.map(|simulated| &simulated.motions.rows) {
            for (flags, _) in side.flags.iter_mut().zip(rows).filter(|(_, row)| row.is_crash) {
                *flags |= CRASH;
            }
            for (name, unit, value) in LOADS {
                if rows.iter().any(|row| value(row).is_some()) {
                    let shown =
                        |row: &MotionRow| row.cut_load(value(row)).map_or(f32::NAN, |value| value as f32);
                    let values = rows.iter().map(shown);
                    side.loads.push((name, unit, values.collect()));
                }
            }
        }
        side
    }

    /// Makes room for motions, mostly one of each statement: arrays that grow by doubling are copied again and again, and
    /// a browser never gives back what they have left.
    fn reserve_motions(&mut self, count: usize) {
        self.vertices.reserve(count);
        self.axes.reserve(count);
        self.ends.reserve(count);
        self.flags.reserve(count);
        self.class.reserve(count);
        self.operation.reserve(count);
        self.tool.reserve(count);
        self.row.reserve(count);
        self.length.reserve(count);
        self.seconds.reserve(count);
        self.feed.reserve(count);
        self.statement.reserve(count);
    }

    // A browser compiles a function anew, and better, once it was called often. It does not do so inside of a call that
    // goes on: so the work on each motion is not part of the loop over a million of them.
    #[inline(never)]
    fn push_measures(
        &mut self,
        motion: &Motion,
        units: LengthUnit,
        rapid: Option<f64>,
        clock: &MachineClock,
    ) {
        let measured = measure_motion(motion, units, rapid);
        self.length.push(measured.length_mm as f32);
        let seconds = clock.motion_seconds(self.seconds.len(), measured.seconds);
        self.seconds.push(seconds.unwrap_or(0.0) as f32);
        let feed = measured.feed_mm_min.filter(|_| !motion.rapid);
        self.feed.push(feed.map_or(f32::NAN, |feed| feed as f32));
    }

    #[inline(never)]
    fn push_path(&mut self, steps: &[crate::engagement::MotionPiece], rapid: bool, origin: [f64; 3]) {
        let mut flags = if rapid { RAPID } else { 0 };
        for (index, step) in steps.iter().enumerate() {
            let from = to_drawing_vertex(&step.piece.from, origin);
            // Nearly every motion begins where the one before it has ended. Without a second copy of that
            // point, a straight motion needs one vertex instead of two.
            let axis = to_drawing_axis(&step.piece.from);
            // A tool that turns on the spot goes on from there, so only its place matters.
            if index == 0 && self.vertices.last() != Some(&from) {
                flags |= JUMPS;
                self.vertices.push(from);
                self.axes.push(axis);
            }
            self.vertices.push(to_drawing_vertex(&step.piece.to, origin));
            self.axes.push(to_drawing_axis(&step.piece.to));
        }
        self.flags.push(flags);
        self.ends.push(self.vertices.len() as u32);
    }

    #[inline(never)]
    fn push_motion_facts(&mut self, motion: &Motion, rows: &[u32], (setup, units): (&Setup, LengthUnit)) {
        let statement = motion.last_statement();
        self.class.push(class_index(motion.class));
        self.operation.push(u16::try_from(motion.operation).unwrap_or(u16::MAX));
        let tool = self.find_tool(motion.tool.as_ref(), setup, units);
        self.tool.push(tool);
        debug_assert!(statement.index() < rows.len(), "the rows belong to this program");
        self.row.push(rows.get(statement.index()).copied().unwrap_or(NONE));
        if let Some(place) = self.ended_by.get_mut(statement.index()).filter(|place| **place == NONE) {
            *place = self.statement.len() as u32;
        }
        self.statement.push(statement.index() as u32);
    }

    /// Returns the index of a tool, which is new or one of those before.
    fn find_tool(&mut self, active: Option<&Arc<ActiveTool>>, setup: &Setup, units: LengthUnit) -> u16 {
        // A tool mostly stays for many motions.
        let is_last = |last: &Option<Arc<ActiveTool>>| match (last, active) {
            (Some(last), Some(active)) => Arc::ptr_eq(last, active),
            (last, active) => last.is_none() && active.is_none(),
        };
        if let Some((_, index)) = self.last_tool.as_ref().filter(|(last, _)| is_last(last)) {
            return *index;
        }
        let called = active.map(|tool| tool.display_name()).unwrap_or_default();
        let tool = self.tools.iter().rposition(|tool| tool.name == called).unwrap_or_else(|| {
            let known = active.map(|tool| PageTool::from_active_tool(tool, setup, units));
            self.tools.push(known.unwrap_or_default());
            self.tools.len() - 1
        });
        let index = u16::try_from(tool).unwrap_or(u16::MAX);
        self.last_tool = Some((active.cloned(), index));
        index
    }

    /// Returns the vertices of a motion, including its start.
    pub(super) fn motion_vertices(&self, motion: usize) -> &[[f32; 3]] {
        let end = self.ends.get(motion).map_or(0, |end| *end as usize);
        let start =
            motion.checked_sub(1).and_then(|before| self.ends.get(before)).map_or(0, |end| *end as usize);
        let jumps = self.flags.get(motion).is_some_and(|flags| flags & JUMPS != 0);
        let first = if jumps { start } else { start.saturating_sub(1) };
        self.vertices.get(first..end).unwrap_or_default()
    }

    /// Returns the arrays with their names, in the units that a reader sees. Names begin with `prefix`.
    pub(super) fn into_arrays(self, prefix: &str, units: DisplayUnits) -> Vec<(String, PageArray)> {
        let shown = |unit: ColumnUnit, values: Vec<f32>| PageArray::F32(show_values(units, unit, values));
        let vertices = |axis: usize| {
            let values = self.vertices.iter().filter_map(|vertex| vertex.get(axis).copied());
            shown(ColumnUnit::Length, values.collect())
        };
        let mut all = vec![
            ("x", vertices(0)),
            ("y", vertices(1)),
            ("z", vertices(2)),
            ("ends", PageArray::Growing(self.ends)),
            ("flags", PageArray::U8(self.flags)),
            ("class", PageArray::U8(self.class)),
            ("operation", PageArray::U16(self.operation)),
            ("tool", PageArray::U16(self.tool)),
            ("row", PageArray::Growing(self.row)),
            ("length", shown(ColumnUnit::Length, self.length)),
            ("seconds", PageArray::F32(self.seconds)),
            ("feed", shown(ColumnUnit::FeedPerMinute, self.feed)),
            ("change", PageArray::U8(self.change)),
            ("pair", PageArray::Growing(self.pair)),
        ];
        let tilted = |axis: &[f32; 3]| axis[0].abs().max(axis[1].abs()) > 1e-6;
        // Upright tools need no axes in the page.
        if self.axes.iter().any(tilted) {
            for (name, index) in [("i", 0), ("j", 1), ("k", 2)] {
                let values = self.axes.iter().filter_map(|axis| axis.get(index).copied());
                all.push((name, PageArray::F32(values.collect())));
            }
        }
        all.extend(self.loads.into_iter().map(|(name, unit, values)| (name, shown(unit, values))));
        all.into_iter().map(|(name, array)| (format!("{prefix}.{name}"), array)).collect()
    }
}

/// Converts values to the units that a reader sees.
pub(super) fn show_values(units: DisplayUnits, unit: ColumnUnit, mut values: Vec<f32>) -> Vec<f32> {
    values.iter_mut().for_each(|value| *value = units.convert(unit, f64::from(*value)) as f32);
    values
}

fn to_drawing_vertex(place: &Pose, [x, y, z]: [f64; 3]) -> [f32; 3] {
    [place.point.x - x, place.point.y - y, place.point.z - z].map(|value| value as f32)
}

fn to_drawing_axis(place: &Pose) -> [f32; 3] {
    [place.axis.x, place.axis.y, place.axis.z].map(|value| value as f32)
}

fn class_index(class: MotionClass) -> u8 {
    MotionClass::ALL.iter().position(|other| *other == class).unwrap_or(0) as u8
}
