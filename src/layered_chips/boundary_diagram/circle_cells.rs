//! This module divides the circle of angles into cells and records for each cell what is certain about a
//! curve during an interval of time.

use crate::layered_chips::interval::IntervalF64;
use crate::layered_chips::trig_polynomial::{AngleSinCos, TrigPolynomial};
use std::f64::consts::TAU;

/// The number of cells at the beginning.
const CELLS: usize = 16;

/// The angle at which the first cell begins, radians. It avoids the angles at which the roots of simple
/// motions are.
const BEGIN: f64 = 0.1234;

/// The most cells. A curve that needs more stays uncertain, and shorter intervals of time have to decide.
const MOST: usize = 160;

/// The knowledge about a curve on a cell, valid for every angle and time in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum CellKnowledge {
    /// The curve is positive.
    Positive,
    /// The curve is negative.
    Negative,
    /// The curve rises with the angle.
    Rises,
    /// The curve falls with the angle.
    Falls,
    /// Nothing is known yet.
    Nothing,
}

/// A cell of the circle: its angles, their sines and cosines, and the knowledge about the curve on it.
#[derive(Debug, Clone, Copy)]
struct AngleCell {
    x: IntervalF64,
    angle: AngleSinCos<IntervalF64>,
    known: CellKnowledge,
}

impl AngleCell {
    fn new(lo: f64, hi: f64) -> Self {
        let x = IntervalF64 { lo, hi };
        Self { x, angle: AngleSinCos::from_interval(x), known: CellKnowledge::Nothing }
    }
}

/// A bracket around a root: between the angles `lo` and `hi`, the curve is zero exactly once at each time of
/// the interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RootBracket {
    /// An angle before the root, radians. The curve has one sign there all the time.
    pub lo: f64,
    /// An angle behind the root, radians. The curve has the other sign there all the time. It may exceed a
    /// full turn.
    pub hi: f64,
    /// Whether the curve rises with the angle at the root.
    pub rising: bool,
}

/// The roots of a curve during an interval of time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CurveRoots {
    /// The brackets of the roots in the order of their angles.
    pub brackets: Vec<RootBracket>,
    /// Whether the curve is positive everywhere, if it has no root.
    pub positive: bool,
}

/// The cells of the circle for one curve.
#[derive(Debug, Clone)]
pub(super) struct CircleCells(Vec<AngleCell>);

impl CircleCells {
    /// Makes the first cells, on which nothing is known yet.
    pub(super) fn new() -> Self {
        let border = |index: usize| BEGIN + TAU * index as f64 / CELLS as f64;
        Self((0..CELLS).map(|index| AngleCell::new(border(index), border(index + 1))).collect())
    }

    /// Examines the cells on which nothing is known, and bisects them down to `finest` radians.
    ///
    /// Knowledge from a longer interval of time stays valid for a shorter one within it. On cells of which
    /// the slope is known, the sign may become known too.
    pub(super) fn classify_cells(&mut self, curve: &TrigPolynomial<IntervalF64>, finest: f64) {
        let mut done: Vec<AngleCell> = Vec::with_capacity(self.0.len() + 8);
        let mut waiting: Vec<AngleCell> = std::mem::take(&mut self.0);
        waiting.reverse();
        while let Some(mut cell) = waiting.pop() {
            if cell.known.certain_sign().is_none() {
                cell.known = classify_cell(curve, &cell).or_previous(cell.known);
            }
            let wide = cell.x.hi - cell.x.lo > finest && done.len() + waiting.len() < MOST;
            if cell.known == CellKnowledge::Nothing && wide {
                let middle = cell.x.middle();
                waiting.push(AngleCell::new(middle, cell.x.hi));
                waiting.push(AngleCell::new(cell.x.lo, middle));
                continue;
            }
            match done.last_mut() {
                // Neighbouring cells with the same sign are merged, because nothing more will be asked about
                // them.
                Some(last) if cell.known.certain_sign().is_some() && last.known == cell.known => {
                    last.x.hi = cell.x.hi
                }
                _ => done.push(cell),
            }
        }
        self.0 = done;
    }

    /// Returns the roots if everything is certain, else `None`.
    pub(super) fn isolate_roots(&self, curve: &TrigPolynomial<IntervalF64>) -> Option<CurveRoots> {
        // The scan begins at a cell with a known sign and goes once around the circle.
        let first = self.0.iter().position(|cell| cell.known.certain_sign().is_some())?;
        let (before, behind) = self.0.split_at_checked(first)?;
        let turned = before.iter().map(|cell| (cell, TAU));
        let mut cells = behind.iter().map(|cell| (cell, 0.0)).chain(turned);
        let positive = cells.next().and_then(|(cell, _)| cell.known.certain_sign())?;
        let mut found = RootScan { positive, run: None, brackets: Vec::new() };
        for (cell, turn) in cells {
            let (lo, hi) = (cell.x.lo + turn, cell.x.hi + turn);
            let rising = match cell.known {
                CellKnowledge::Nothing => return None,
                CellKnowledge::Positive | CellKnowledge::Negative => {
                    found.record_sign(cell.known == CellKnowledge::Positive)?;
                    continue;
                }
                known => known == CellKnowledge::Rises,
            };
            match &mut found.run {
                Some(run) if run.rising == rising => run.hi = hi,
                run => {
                    // The slope changes its sign at this angle, so the curve's sign here decides whether the
                    // run before contains a root.
                    if run.is_some() {
                        let border = AngleSinCos::from_interval(IntervalF64::from_point(lo));
                        found.record_sign(curve.value_at(&border).sign()? > 0)?;
                    }
                    found.run = Some(RootBracket { lo, hi, rising });
                }
            }
        }
        found.record_sign(positive)?;
        Some(CurveRoots { brackets: found.brackets, positive })
    }

    /// Returns the smallest interval of angles around the cells on which nothing is known, or `None` if there
    /// are none.
    pub(super) fn unknown_angles(&self) -> Option<IntervalF64> {
        let unknown = self.0.iter().filter(|cell| cell.known == CellKnowledge::Nothing).map(|cell| cell.x);
        unknown.reduce(|a, b| IntervalF64 { lo: a.lo.min(b.lo), hi: a.hi.max(b.hi) })
    }
}

/// The state of a scan around the circle.
struct RootScan {
    /// The sign of the curve at the last angle where it is known.
    positive: bool,
    /// The cells since then, in which the curve only rises or only falls.
    run: Option<RootBracket>,
    brackets: Vec<RootBracket>,
}

impl RootScan {
    /// Records that the sign is known at this angle. A change of sign closes a run in a bracket; `None` means
    /// that no root can explain the change.
    fn record_sign(&mut self, positive: bool) -> Option<()> {
        let run = self.run.take();
        if positive != self.positive {
            self.brackets.push(run.filter(|run| run.rising == positive)?);
            self.positive = positive;
        }
        Some(())
    }
}

impl CellKnowledge {
    /// Returns this knowledge, or the earlier one if nothing new is known.
    fn or_previous(self, before: Self) -> Self {
        if self == Self::Nothing { before } else { self }
    }

    /// Returns whether the curve is certainly positive (`true`) or negative (`false`).
    fn certain_sign(self) -> Option<bool> {
        match self {
            Self::Positive => Some(true),
            Self::Negative => Some(false),
            _ => None,
        }
    }
}

/// Finds what is certain about a curve on a cell, from enclosures of its value and its slope.
fn classify_cell(curve: &TrigPolynomial<IntervalF64>, cell: &AngleCell) -> CellKnowledge {
    let told = |value: IntervalF64, slope: IntervalF64| match (value.sign(), slope.sign()) {
        (Some(1), _) => CellKnowledge::Positive,
        (Some(_), _) => CellKnowledge::Negative,
        (None, Some(1)) => CellKnowledge::Rises,
        (None, Some(_)) => CellKnowledge::Falls,
        (None, None) => CellKnowledge::Nothing,
    };
    let quick = told(curve.value_at(&cell.angle), curve.derivative_at(&cell.angle));
    if quick.certain_sign().is_some() {
        return quick;
    }
    // Near a fold both value and slope are small. Taylor's formula about the middle, f(m) + f'(m) d + f'' d^2
    // / 2, has an error that falls with the square of the cell's width.
    let middle = IntervalF64::from_point(cell.x.middle());
    let (centre, offset) = (AngleSinCos::from_interval(middle), cell.x - middle);
    let bend = curve.second_derivative_at(&cell.angle);
    let slope = curve.derivative_at(&centre);
    let square = IntervalF64 { lo: 0.0, hi: 0.5 * offset.magnitude() * offset.magnitude() * (1.0 + 1e-15) };
    let close = told(curve.value_at(&centre) + slope * offset + bend * square, slope + bend * offset);
    close.or_previous(quick)
}
