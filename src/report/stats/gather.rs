//! The one pass over a program that makes its statistics.

use super::feeds::Feeds;
use super::totals::{Measured, Totals};
use super::{Bounds, ClassStats, FrameStats, OperationStats, Paths, Range, Stats, ToolStats, Units};
use crate::program::geometry::Path;
use crate::program::motion::{Frame, Motion, Tool};
use crate::program::{LengthUnit, MotionClass, Program, Record, operation};
use crate::setup::Setup;
use std::sync::Arc;

/// What grows while motions go by.
struct Gathering<'p> {
    program: &'p Program,
    unit: LengthUnit,
    rapid: Option<f64>,
    totals: Totals,
    classes: Vec<ClassStats>,
    feeds: Feeds,
    feed: Option<Range>,
    spindle_rpm: Option<Range>,
    paths: Paths,
    hole: Option<usize>,
    box_of_feed: Option<Bounds>,
    box_of_all: Option<Bounds>,
    frames: Vec<(Arc<Frame>, FrameStats)>,
    frame: Option<(Arc<Frame>, usize)>,
    tools: Vec<(Tool, ToolStats)>,
    tool: Option<(Arc<Tool>, usize)>,
    operations: Vec<OperationStats>,
}

pub(super) fn gather(program: &Program, setup: &Setup, units: Units) -> Stats {
    let rapid = setup.machine.rapid_feed.map(|feed| 60.0 * units.unit.in_mm() / feed.get());
    let totals = Totals::new(rapid.is_some());
    let operations = operation::operations(program).into_iter();
    let mut all = Gathering {
        program,
        unit: units.unit,
        rapid,
        totals,
        classes: MotionClass::ALL.map(|class| ClassStats { class, totals }).into(),
        feeds: Feeds::default(),
        feed: None,
        spindle_rpm: None,
        paths: Paths::default(),
        hole: None,
        box_of_feed: None,
        box_of_all: None,
        frames: Vec::new(),
        frame: None,
        tools: Vec::new(),
        tool: None,
        operations: operations
            .map(|operation| OperationStats { name: operation.name, tool: None, totals, feed: None })
            .collect(),
    };
    program.motions().for_each(|motion| all.add(&motion));
    let (bytes, lines) = size(program);
    let unreadable = |record: &Record| matches!(record, Record::Unparsed | Record::Definition);
    Stats {
        version: 1,
        file: program.source().name().to_owned(),
        bytes,
        lines,
        dialect: program.dialect().into(),
        units,
        statements: program.live().count(),
        unreadable: program.live().filter(|(_, statement)| unreadable(statement.record())).count(),
        totals: all.totals,
        classes: all.classes.into_iter().filter(|class| class.totals.motions > 0).collect(),
        feeds: all.feeds.rows(),
        feed: all.feed,
        spindle_rpm: all.spindle_rpm,
        paths: all.paths,
        box_of_feed: all.box_of_feed,
        box_of_all: all.box_of_all,
        frames: all.frames.into_iter().map(|(_, frame)| frame).collect(),
        tools: all.tools.into_iter().map(|(_, tool)| tool).collect(),
        operations: all.operations,
    }
}

impl Gathering<'_> {
    fn add(&mut self, motion: &Motion) {
        Bounds::extend(&mut self.box_of_all, motion);
        let measured = Measured::of(motion, self.unit, self.rapid);
        if !measured.moves {
            return;
        }
        self.totals.add(&measured);
        if let Some(class) = self.classes.get_mut(motion.class as usize) {
            class.totals.add(&measured);
        }
        self.shape(motion);
        self.frame(motion);
        let tool = self.tool(motion);
        if let Some((_, stats)) = tool.and_then(|tool| self.tools.get_mut(tool)) {
            stats.totals.add(&measured);
        }
        let rate = if motion.rapid { None } else { self.at_feed(motion, &measured) };
        if let Some(operation) = self.operations.get_mut(motion.operation) {
            operation.totals.add(&measured);
            operation.tool = operation.tool.or(tool);
            if let Some(rate) = rate {
                Range::extend(&mut operation.feed, rate);
            }
        }
    }

    /// A motion at feed; gives its feed in the file's unit per minute.
    fn at_feed(&mut self, motion: &Motion, measured: &Measured) -> Option<f64> {
        Bounds::extend(&mut self.box_of_feed, motion);
        if let Some(rpm) = motion.spindle_rpm() {
            Range::extend(&mut self.spindle_rpm, rpm);
        }
        let feed = motion.feed?;
        self.feeds.add(feed, measured);
        // Of a move in inverse time that only turns the tool there is no feed in length.
        let length = Some(measured.length).filter(|length| *length > 0.0);
        let rate = feed.mm_per_minute(self.unit, motion.spindle_rpm(), length)? / self.unit.in_mm();
        Range::extend(&mut self.feed, rate);
        Some(rate)
    }

    fn shape(&mut self, motion: &Motion) {
        match &motion.path {
            Path::Arc(arc) if arc.rise.abs() > crate::program::geometry::SAME_POINT => {
                self.paths.helices += 1;
            }
            Path::Arc(_) => self.paths.arcs += 1,
            Path::Spline(_) => self.paths.splines += 1,
            Path::Line => self.paths.lines += 1,
            Path::Start => {}
        }
        let hole = motion.hole.as_ref().map(|(hole, _)| *hole);
        if hole.is_some() && hole != self.hole {
            self.paths.holes += 1;
            self.hole = hole;
        }
    }

    fn tool(&mut self, motion: &Motion) -> Option<usize> {
        let tool = motion.tool.as_ref()?;
        if let Some((last, index)) = &self.tool
            && Arc::ptr_eq(last, tool)
        {
            return Some(*index);
        }
        let same =
            |known: &Tool| known.number == tool.number && known.name == tool.name && known.data == tool.data;
        let index = self.tools.iter().position(|(known, _)| same(known)).unwrap_or(self.tools.len());
        if index == self.tools.len() {
            let totals = Totals::new(self.rapid.is_some());
            self.tools.push((tool.as_ref().clone(), described(tool, totals)));
        }
        self.tool = Some((Arc::clone(tool), index));
        Some(index)
    }

    fn frame(&mut self, motion: &Motion) {
        let Some(frame) = &motion.frame else { return };
        let index = match &self.frame {
            Some((last, index)) if Arc::ptr_eq(last, frame) => *index,
            _ => {
                let same = |known: &Frame| known.origin == frame.origin && known.axes == frame.axes;
                let found = self.frames.iter().position(|(known, _)| same(known));
                found.unwrap_or_else(|| {
                    self.frames.push((Arc::clone(frame), self.described_frame(frame)));
                    self.frames.len() - 1
                })
            }
        };
        self.frame = Some((Arc::clone(frame), index));
        if let Some((_, stats)) = self.frames.get_mut(index) {
            stats.motions += 1;
        }
    }

    fn described_frame(&self, frame: &Frame) -> FrameStats {
        let statement = self.program.statement(frame.statement);
        FrameStats {
            line: statement.and_then(|statement| super::super::line_of(self.program, statement)),
            origin: frame.origin.into(),
            z_axis: frame.axes.column(2).into_owned().into(),
            motions: 0,
        }
    }
}

fn described(tool: &Tool, totals: Totals) -> ToolStats {
    let data = tool.data.as_ref();
    ToolStats {
        number: tool.number,
        name: tool.name.clone(),
        diameter: data.and_then(|data| data.diameter),
        corner_radius: data.and_then(|data| data.corner_radius),
        length: data.and_then(|data| data.length),
        flute_length: data.and_then(|data| data.flute_length),
        taper_degrees: data.and_then(|data| data.taper_degrees),
        tip_degrees: data.and_then(|data| data.tip_degrees),
        totals,
    }
}

/// Bytes and lines. A piece ends where a statement does, so a CRLF never stands in two.
fn size(program: &Program) -> (u64, u64) {
    let (mut bytes, mut lines, mut open) = (0, 0, false);
    for piece in program.pieces().filter(|piece| !piece.is_empty()) {
        bytes += piece.len() as u64;
        lines += memchr::memchr_iter(b'\n', piece).count() as u64;
        let lone = |&at: &usize| piece.get(at + 1) != Some(&b'\n');
        lines += memchr::memchr_iter(b'\r', piece).filter(lone).count() as u64;
        open = !piece.ends_with(b"\n") && !piece.ends_with(b"\r");
    }
    (bytes, lines + u64::from(open))
}
