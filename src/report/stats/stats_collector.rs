//! This module makes the statistics of a program in a single pass.

use super::feed_rows::FeedRowCollector;
use super::totals::{MotionLengthAndTime, MotionTotals};
use super::{
    ClassStats, FrameStats, MachineTimeParts, MotionBoundingBox, OperationStats, PathShapeCounts,
    ProgramStats, ReportedRange, ResolvedLengthUnit, ToolStats,
};
use crate::program::geometry::MotionPath;
use crate::program::motion::{ActiveTool, CoordinateFrame, Motion};
use crate::program::record::{ToolData, ToolWord};
use crate::program::{LengthUnit, MotionClass, Program, Record, operation};
use crate::report::machine_time::{GroupTimer, MachineClock};
use crate::report::motion_measure::measure_motion;
use crate::setup::Setup;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The state while motions are processed.
struct StatsCollector<'p> {
    program: &'p Program,
    unit: LengthUnit,
    /// The time of one unit of length at rapid, s.
    rapid: Option<f64>,
    /// Whether it is a program for a lathe.
    turning: bool,
    totals: MotionTotals,
    classes: Vec<ClassStats>,
    feeds: FeedRowCollector,
    feed: Option<ReportedRange>,
    spindle_rpm: Option<ReportedRange>,
    keeps_surface_speed: bool,
    paths: PathShapeCounts,
    hole: Option<usize>,
    box_of_feed: Option<MotionBoundingBox>,
    box_of_all: Option<MotionBoundingBox>,
    frames: Vec<(Arc<CoordinateFrame>, FrameStats)>,
    frame: Option<(Arc<CoordinateFrame>, usize)>,
    tools: Vec<(ActiveTool, ToolStats)>,
    /// The places in `tools` of tools with a number and a name: mostly one.
    tools_called: BTreeMap<(Option<u32>, Option<String>), Vec<usize>>,
    tool: Option<(Arc<ActiveTool>, usize)>,
    operations: Vec<OperationStats>,
    timers: StatsTimers,
}

/// Timers with acceleration: of the whole program, and of each class, tool and operation. `none` is a timer
/// to which nothing is added.
struct StatsTimers {
    none: GroupTimer,
    whole: GroupTimer,
    classes: Vec<GroupTimer>,
    tools: Vec<GroupTimer>,
    operations: Vec<GroupTimer>,
    /// The number of motions so far.
    motions: usize,
}

impl StatsTimers {
    fn new(clock: &MachineClock) -> Self {
        let none = clock.start_timer();
        let (whole, empty) = (none.clone(), Vec::new());
        Self { none, whole, classes: empty.clone(), tools: empty.clone(), operations: empty, motions: 0 }
    }

    /// Adds a motion to the timers of the program and of its class, tool and operation.
    fn add_motion(&mut self, program: &Program, motion: &Motion, unit: LengthUnit, tool: Option<usize>) {
        if self.none.feed_seconds().is_none() {
            return;
        }
        let number = self.motions;
        self.motions += 1;
        let moved = measure_motion(motion, unit, None);
        let moved = (moved.length_mm, moved.feed_mm_min);
        self.whole.add_motion(program, motion, number, moved);
        let groups = [
            (&mut self.classes, Some(motion.class as usize)),
            (&mut self.tools, tool),
            (&mut self.operations, Some(motion.operation)),
        ];
        for (timers, index) in groups {
            let Some(index) = index else { continue };
            if timers.len() <= index {
                timers.resize(index + 1, self.none.clone());
            }
            if let Some(timer) = timers.get_mut(index) {
                timer.add_motion(program, motion, number, moved);
            }
        }
    }

    /// Puts the times of a group into its sums. A group without motions at feed takes no time.
    fn finish_group(&self, timers: &[GroupTimer], index: usize, totals: &mut MotionTotals) {
        finish_totals(timers.get(index).unwrap_or(&self.none), totals);
    }
}

/// Puts the times of the machine into sums, where they are known.
fn finish_totals(timer: &GroupTimer, totals: &mut MotionTotals) {
    totals.accelerated_seconds = timer.feed_seconds();
    timer.replace_rapid_seconds(&mut totals.rapid_seconds);
    totals.standing_seconds = timer.standing_seconds();
}

pub(super) fn collect_stats(program: &Program, setup: &Setup, units: ResolvedLengthUnit) -> ProgramStats {
    let rapid = setup.machine.rapid_feed.map(|feed| 60.0 * units.unit.mm_per_unit() / feed.get());
    let totals = MotionTotals::new(rapid.is_some());
    let operations = operation::find_operations(program).into_iter();
    let clock = MachineClock::new(program, units.unit, setup);
    let mut all = StatsCollector {
        program,
        turning: program.is_turning(),
        unit: units.unit,
        rapid,
        totals,
        classes: MotionClass::ALL.map(|class| ClassStats { class, totals }).into(),
        feeds: FeedRowCollector::default(),
        feed: None,
        spindle_rpm: None,
        keeps_surface_speed: false,
        paths: PathShapeCounts::default(),
        hole: None,
        box_of_feed: None,
        box_of_all: None,
        frames: Vec::new(),
        frame: None,
        tools: Vec::new(),
        tools_called: BTreeMap::new(),
        tool: None,
        operations: operations
            .map(|operation| OperationStats { name: operation.name, tool: None, totals, feed: None })
            .collect(),
        timers: StatsTimers::new(&clock),
    };
    program.motions().for_each(|motion| all.add_motion(&motion));
    all.finish_times();
    let (bytes, lines) = count_bytes_and_lines(program);
    let unreadable = |record: &Record| matches!(record, Record::Unparsed | Record::Definition);
    ProgramStats {
        version: 1,
        file: program.source().name().to_owned(),
        bytes,
        lines,
        dialect: program.dialect().into(),
        units,
        file_units: None,
        statements: program.live_statements().count(),
        unreadable: program.live_statements().filter(|(_, statement)| unreadable(statement.record())).count(),
        totals: all.totals,
        machine_time: clock.time.as_ref().map(MachineTimeParts::from_time),
        classes: all.classes.into_iter().filter(|class| class.totals.motions > 0).collect(),
        feeds: all.feeds.into_rows(),
        feed: all.feed,
        spindle_rpm: all.spindle_rpm,
        spindle_keeps_surface_speed: all.keeps_surface_speed,
        paths: all.paths,
        box_of_feed: all.box_of_feed,
        box_of_all: all.box_of_all,
        frames: all.frames.into_iter().map(|(_, frame)| frame).collect(),
        tools: all.tools.into_iter().map(|(_, tool)| tool).collect(),
        operations: all.operations,
    }
}

impl StatsCollector<'_> {
    fn add_motion(&mut self, motion: &Motion) {
        MotionBoundingBox::include_motion(&mut self.box_of_all, motion);
        let measured = MotionLengthAndTime::from_motion(motion, self.unit, self.rapid);
        if !measured.moves {
            return;
        }
        self.totals.add_motion(&measured);
        if let Some(class) = self.classes.get_mut(motion.class as usize) {
            class.totals.add_motion(&measured);
        }
        self.count_path_shape(motion);
        self.count_frame_motion(motion);
        let tool = self.tool_index(motion);
        if let Some((_, stats)) = tool.and_then(|tool| self.tools.get_mut(tool)) {
            stats.totals.add_motion(&measured);
        }
        self.timers.add_motion(self.program, motion, self.unit, tool);
        let rate = if motion.rapid { None } else { self.add_feed_motion(motion, &measured) };
        if let Some(operation) = self.operations.get_mut(motion.operation) {
            operation.totals.add_motion(&measured);
            operation.tool = operation.tool.or(tool);
            if let Some(rate) = rate {
                ReportedRange::include_value(&mut operation.feed, rate);
            }
        }
    }

    /// Adds the times with the machine's acceleration.
    fn finish_times(&mut self) {
        let timers = &self.timers;
        finish_totals(&timers.whole, &mut self.totals);
        for (index, class) in self.classes.iter_mut().enumerate() {
            timers.finish_group(&timers.classes, index, &mut class.totals);
        }
        for (index, (_, tool)) in self.tools.iter_mut().enumerate() {
            timers.finish_group(&timers.tools, index, &mut tool.totals);
        }
        for (index, operation) in self.operations.iter_mut().enumerate() {
            timers.finish_group(&timers.operations, index, &mut operation.totals);
        }
    }

    /// Adds a motion at feed. Returns its feed in the file's unit per minute, if it is known.
    fn add_feed_motion(&mut self, motion: &Motion, measured: &MotionLengthAndTime) -> Option<f64> {
        MotionBoundingBox::include_motion(&mut self.box_of_feed, motion);
        match (motion.spindle_rpm(), motion.surface_rpm) {
            (Some(_), Some(surface)) => {
                self.keeps_surface_speed = true;
                ReportedRange::include_value(&mut self.spindle_rpm, surface.lowest);
                ReportedRange::include_value(&mut self.spindle_rpm, surface.highest);
            }
            (Some(rpm), None) => ReportedRange::include_value(&mut self.spindle_rpm, rpm),
            (None, _) => {}
        }
        let feed = motion.feed?;
        self.feeds.add_motion(feed, measured);
        // A move in inverse time that only turns the tool has no feed in units of length.
        let length = Some(measured.length).filter(|length| *length > 0.0);
        let rate = feed.mm_per_minute(self.unit, motion.spindle_rpm(), length)? / self.unit.mm_per_unit();
        ReportedRange::include_value(&mut self.feed, rate);
        Some(rate)
    }

    fn count_path_shape(&mut self, motion: &Motion) {
        match &motion.path {
            MotionPath::Arc(arc) if arc.rise.abs() > crate::program::geometry::SAME_POINT => {
                self.paths.helices += 1;
            }
            MotionPath::Arc(_) => self.paths.arcs += 1,
            MotionPath::Spline(_) => self.paths.splines += 1,
            MotionPath::Line => self.paths.lines += 1,
            MotionPath::Start => {}
        }
        let hole = motion.hole.as_ref().map(|(hole, _)| *hole);
        if hole.is_some() && hole != self.hole {
            self.paths.holes += 1;
            self.hole = hole;
        }
    }

    fn tool_index(&mut self, motion: &Motion) -> Option<usize> {
        let tool = motion.tool.as_ref()?;
        if let Some((last, index)) = &self.tool
            && Arc::ptr_eq(last, tool)
        {
            return Some(*index);
        }
        let called = self.tools_called.entry((tool.number, tool.name.clone())).or_default();
        let has_shape =
            |index: &usize| self.tools.get(*index).is_some_and(|(known, _)| known.data == tool.data);
        let index = called.iter().copied().find(has_shape).unwrap_or(self.tools.len());
        if index == self.tools.len() {
            called.push(index);
            let totals = MotionTotals::new(self.rapid.is_some());
            self.tools.push((tool.as_ref().clone(), describe_tool(tool, self.turning, totals)));
        }
        self.tool = Some((Arc::clone(tool), index));
        Some(index)
    }

    fn count_frame_motion(&mut self, motion: &Motion) {
        let Some(frame) = &motion.frame else { return };
        let index = match &self.frame {
            Some((last, index)) if Arc::ptr_eq(last, frame) => *index,
            _ => {
                let same = |known: &CoordinateFrame| known.origin == frame.origin && known.axes == frame.axes;
                let found = self.frames.iter().position(|(known, _)| same(known));
                found.unwrap_or_else(|| {
                    self.frames.push((Arc::clone(frame), self.describe_frame(frame)));
                    self.frames.len() - 1
                })
            }
        };
        self.frame = Some((Arc::clone(frame), index));
        if let Some((_, stats)) = self.frames.get_mut(index) {
            stats.motions += 1;
        }
    }

    fn describe_frame(&self, frame: &CoordinateFrame) -> FrameStats {
        let statement = self.program.statement(frame.statement);
        FrameStats {
            line: super::super::statement_line(self.program, statement),
            origin: frame.origin.into(),
            z_axis: frame.axes.column(2).into_owned().into(),
            motions: 0,
        }
    }
}

/// Describes a tool. The single number of a CUTTER is the diameter of the cutter in a milling program, and
/// the diameter of the nose in a `turning` program.
fn describe_tool(tool: &ActiveTool, turning: bool, totals: MotionTotals) -> ToolStats {
    let data = tool.data.as_ref();
    let nose = |data: &&ToolData| turning && data.word == ToolWord::Cutter && data.corner_radius.is_none();
    let of_cutter = data.filter(nose).and_then(|data| data.diameter).map(|diameter| diameter / 2.0);
    let nose_radius = data.and_then(|data| data.nose_radius).or(of_cutter);
    ToolStats {
        number: tool.number,
        name: tool.name.clone(),
        diameter: data.and_then(|data| data.diameter).filter(|_| nose_radius.is_none()),
        nose_radius,
        corner_radius: data.and_then(|data| data.corner_radius),
        length: data.and_then(|data| data.length),
        flute_length: data.and_then(|data| data.flute_length),
        taper_degrees: data.and_then(|data| data.taper_degrees),
        tip_degrees: data.and_then(|data| data.tip_degrees),
        totals,
    }
}

/// Counts bytes and lines. A chunk of bytes ends where a statement does, so a CRLF is never split.
fn count_bytes_and_lines(program: &Program) -> (u64, u64) {
    let (mut bytes, mut lines, mut open) = (0, 0, false);
    for piece in program.byte_chunks().filter(|piece| !piece.is_empty()) {
        bytes += piece.len() as u64;
        lines += memchr::memchr_iter(b'\n', piece).count() as u64;
        let lone = |&at: &usize| piece.get(at + 1) != Some(&b'\n');
        lines += memchr::memchr_iter(b'\r', piece).filter(lone).count() as u64;
        open = !piece.ends_with(b"\n") && !piece.ends_with(b"\r");
    }
    (bytes, lines + u64::from(open))
}
