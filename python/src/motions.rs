//! The motions of a program as arrays.

use crate::columns::{column, rows_of_three};
use clsmith::program::MotionClass;
use clsmith::program::motion::Motion;
use clsmith::report::stats::ResolvedLengthUnit;
use clsmith::source::Source;
use clsmith::{LengthUnit, Program};
use memchr::memchr2_iter;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use std::sync::Arc;

/// The names of the kinds of motions, in the order of their numbers.
pub(crate) fn kind_names() -> Vec<String> {
    MotionClass::ALL.iter().map(MotionClass::to_string).collect()
}

/// Motions, one a row; lengths are in the unit of the file.
#[pyclass(frozen, module = "clsmith")]
pub(crate) struct Motions {
    /// Where each ends, (n, 3).
    #[pyo3(get)]
    points: Py<PyArray2<f64>>,
    /// The tool axes at the ends, (n, 3), from the tip into the holder.
    #[pyo3(get)]
    axes: Py<PyArray2<f64>>,
    /// Lengths of the paths, along arcs and splines.
    #[pyo3(get)]
    lengths: Py<PyArray1<f64>>,
    /// Feeds as programmed; NaN for rapids and where none is in force.
    #[pyo3(get)]
    feeds: Py<PyArray1<f64>>,
    /// The same in mm/min; NaN also where speed or length would be needed and are not known.
    #[pyo3(get)]
    feeds_mm_min: Py<PyArray1<f64>>,
    /// Spindle speeds in rev/min; NaN where it stands or is not known.
    #[pyo3(get)]
    spindles: Py<PyArray1<f64>>,
    /// Kinds, as indices in `clsmith.KINDS`.
    #[pyo3(get)]
    kinds: Py<PyArray1<u8>>,
    /// Whether each is a rapid.
    #[pyo3(get)]
    rapids: Py<PyArray1<bool>>,
    /// Lines of the file that was read, from 1, of the statements that end the motions; 0 for inserted ones.
    #[pyo3(get)]
    lines: Py<PyArray1<i64>>,
    /// Indices of these statements.
    #[pyo3(get)]
    statements: Py<PyArray1<i64>>,
    /// Operations, as indices in `Program.operations`.
    #[pyo3(get)]
    operations: Py<PyArray1<i64>>,
    /// Numbers of the tools; -1 where there is none.
    #[pyo3(get)]
    tools: Py<PyArray1<i64>>,
    /// How many there are.
    #[pyo3(get)]
    count: usize,
    program: Arc<Program>,
    starts: PyOnceLock<Py<PyArray2<f64>>>,
}

#[pymethods]
impl Motions {
    /// Where each begins, (n, 3); for the first point of a program, to which no path leads, that point. They are collected
    /// when they are first asked for, since mostly each is where the motion before has ended.
    #[getter]
    fn starts(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        let collect = || {
            let starts = py.detach(|| {
                let mut starts = Vec::with_capacity(self.count);
                self.program.motions().for_each_motion(|motion| starts.push(motion.from.point.coords.into()));
                starts
            });
            rows_of_three(py, starts)
        };
        Ok(self.starts.get_or_try_init(py, collect)?.clone_ref(py))
    }

    fn __len__(&self) -> usize {
        self.count
    }

    fn __repr__(&self) -> String {
        format!("<Motions, {} rows>", self.count)
    }
}

impl Motions {
    pub(crate) fn collect(py: Python<'_>, program: &Arc<Program>) -> PyResult<Self> {
        let lists = py.detach(|| MotionLists::from_program(program));
        Ok(Self {
            count: lists.kinds.len(),
            points: rows_of_three(py, lists.points)?,
            axes: rows_of_three(py, lists.axes)?,
            lengths: column(py, lists.lengths),
            feeds: column(py, lists.feeds),
            feeds_mm_min: column(py, lists.feeds_mm_min),
            spindles: column(py, lists.spindles),
            kinds: column(py, lists.kinds),
            rapids: column(py, lists.rapids),
            lines: column(py, lists.lines),
            statements: column(py, lists.statements),
            operations: column(py, lists.operations),
            tools: column(py, lists.tools),
            program: Arc::clone(program),
            starts: PyOnceLock::new(),
        })
    }
}

/// The same as lists, which arrays take over.
struct MotionLists {
    points: Vec<[f64; 3]>,
    axes: Vec<[f64; 3]>,
    lengths: Vec<f64>,
    feeds: Vec<f64>,
    feeds_mm_min: Vec<f64>,
    spindles: Vec<f64>,
    kinds: Vec<u8>,
    rapids: Vec<bool>,
    lines: Vec<i64>,
    statements: Vec<i64>,
    operations: Vec<i64>,
    tools: Vec<i64>,
}

impl MotionLists {
    fn from_program(program: &Program) -> Self {
        let unit = ResolvedLengthUnit::from_program(program, None).unit;
        // Most statements of a long program make a motion, and memory that is reserved and not written costs nothing.
        let mut lists = Self::with_capacity(program.statements().len());
        let mut lines = LineCursor { source: program.source(), offset: 0, line: 1 };
        program.motions().for_each_motion(|motion| {
            lists.add(motion, unit);
            let ending = program.statement(motion.last_statement()).origin();
            let line = if ending.is_empty() { 0 } else { lines.line_of(ending.start as usize) };
            lists.lines.push(line);
        });
        lists
    }

    fn with_capacity(count: usize) -> Self {
        Self {
            points: Vec::with_capacity(count),
            axes: Vec::with_capacity(count),
            lengths: Vec::with_capacity(count),
            feeds: Vec::with_capacity(count),
            feeds_mm_min: Vec::with_capacity(count),
            spindles: Vec::with_capacity(count),
            kinds: Vec::with_capacity(count),
            rapids: Vec::with_capacity(count),
            lines: Vec::with_capacity(count),
            statements: Vec::with_capacity(count),
            operations: Vec::with_capacity(count),
            tools: Vec::with_capacity(count),
        }
    }

    fn add(&mut self, motion: &Motion, unit: LengthUnit) {
        self.points.push(motion.to.point.coords.into());
        self.axes.push(motion.to.axis.into());
        let (length, rpm) = (motion.length(), motion.spindle_rpm());
        let feed = motion.feed.filter(|_| !motion.rapid);
        self.lengths.push(length);
        self.feeds.push(feed.map_or(f64::NAN, |feed| feed.value));
        let in_mm = feed.and_then(|feed| feed.mm_per_minute(unit, rpm, Some(length)));
        self.feeds_mm_min.push(in_mm.unwrap_or(f64::NAN));
        self.spindles.push(rpm.unwrap_or(f64::NAN));
        let kind = MotionClass::ALL.iter().position(|kind| *kind == motion.class);
        self.kinds.push(kind.map_or(u8::MAX, |kind| kind as u8));
        self.rapids.push(motion.rapid);
        self.statements.push(motion.last_statement().index() as i64);
        self.operations.push(motion.operation as i64);
        let tool = motion.tool.as_deref().and_then(|tool| tool.number);
        self.tools.push(tool.map_or(-1, i64::from));
    }
}

/// Counts lines from one place to the next; places mostly go forwards.
struct LineCursor<'s> {
    source: &'s Source,
    offset: usize,
    line: i64,
}

impl LineCursor<'_> {
    fn line_of(&mut self, offset: usize) -> i64 {
        let bytes = self.source.bytes();
        if offset < self.offset {
            (self.offset, self.line) = (0, 1);
        }
        let between = bytes.get(self.offset..offset).unwrap_or_default();
        for at in memchr2_iter(b'\n', b'\r', between) {
            // CRLF is one line end; its LF counts.
            let is_pair = between.get(at) == Some(&b'\r') && bytes.get(self.offset + at + 1) == Some(&b'\n');
            self.line += i64::from(!is_pair);
        }
        self.offset = offset;
        self.line
    }
}
