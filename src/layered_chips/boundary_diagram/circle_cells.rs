//! What is certain about a curve on cells of the circle during an interval of time.

use crate::layered_chips::interval::IntervalF64;
use crate::layered_chips::trig_polynomial::{AngleSinCos, TrigPolynomial};
use std::f64::consts::TAU;

/// Cells that the circle begins with.
const CELLS: usize = 16;

/// Where they begin, radians: away from the angles at which roots of tidy motions lie.
const BEGIN: f64 = 0.1234;

/// Cells at most; a curve that needs more is left uncertain for shorter times to decide.
const MOST: usize = 160;

/// What is known of a curve on a cell, at every angle and time in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum CellKnowledge {
    /// It is positive.
    Positive,
    /// It is negative.
    Negative,
    /// It rises with the angle.
    Rises,
    /// It falls with the angle.
    Falls,
    /// Nothing yet.
    Nothing,
}

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

/// A root: in the angles `lo..=hi`, at each time of the interval, the curve is zero exactly once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RootBracket {
    /// Before it, radians; the curve has one sign there all the time.
    pub lo: f64,
    /// Behind it; the curve has the other sign there all the time. May be beyond a full turn.
    pub hi: f64,
    /// Whether the curve rises with the angle.
    pub rising: bool,
}

/// A curve's roots during an interval of time.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveRoots {
    /// In the order of their angles.
    pub brackets: Vec<RootBracket>,
    /// Where there is none, whether the curve is positive everywhere.
    pub positive: bool,
}

/// The circle in cells, for one curve.
#[derive(Debug, Clone)]
pub struct CircleCells(Vec<AngleCell>);

impl CircleCells {
    /// Nothing is known yet.
    pub fn new() -> Self {
        let border = |index: usize| BEGIN + TAU * index as f64 / CELLS as f64;
        Self((0..CELLS).map(|index| AngleCell::new(border(index), border(index + 1))).collect())
    }

    /// Looks at the cells of which nothing is known and halves them down to `finest` radians.
    ///
    /// What was certain for a longer time stays so; of cells whose slope is known, the sign may become so.
    pub fn classify_cells(&mut self, curve: &TrigPolynomial<IntervalF64>, finest: f64) {
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
                // Of what has one sign nothing more will be asked.
                Some(last) if cell.known.certain_sign().is_some() && last.known == cell.known => {
                    last.x.hi = cell.x.hi
                }
                _ => done.push(cell),
            }
        }
        self.0 = done;
    }

    /// The roots, when everything is certain.
    pub fn isolate_roots(&self, curve: &TrigPolynomial<IntervalF64>) -> Option<CurveRoots> {
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
                    // The slope changes its sign at this very angle: the curve's sign there decides about the run before.
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

    /// The least box around the cells of which nothing is known; `None` if there is none.
    pub fn unknown_angles(&self) -> Option<IntervalF64> {
        let unknown = self.0.iter().filter(|cell| cell.known == CellKnowledge::Nothing).map(|cell| cell.x);
        unknown.reduce(|a, b| IntervalF64 { lo: a.lo.min(b.lo), hi: a.hi.max(b.hi) })
    }
}

/// What a walk around the circle has found.
struct RootScan {
    /// Sign of the curve at the last place where it is known.
    positive: bool,
    /// Cells since then, in which the curve only rises or only falls.
    run: Option<RootBracket>,
    brackets: Vec<RootBracket>,
}

impl RootScan {
    /// The sign is known here; `None` when that cannot be.
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
    /// What was known before, where there is nothing new.
    fn or_previous(self, before: Self) -> Self {
        if self == Self::Nothing { before } else { self }
    }

    fn certain_sign(self) -> Option<bool> {
        match self {
            Self::Positive => Some(true),
            Self::Negative => Some(false),
            _ => None,
        }
    }
}

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
    // Taylor's formula about the middle, whose error goes with the square of the cell: near a fold value and slope are both small.
    let middle = IntervalF64::from_point(cell.x.middle());
    let (centre, offset) = (AngleSinCos::from_interval(middle), cell.x - middle);
    let bend = curve.second_derivative_at(&cell.angle);
    let slope = curve.derivative_at(&centre);
    let square = IntervalF64 { lo: 0.0, hi: 0.5 * offset.magnitude() * offset.magnitude() * (1.0 + 1e-15) };
    let close = told(curve.value_at(&centre) + slope * offset + bend * square, slope + bend * offset);
    close.or_previous(quick)
}
