//! What is certain about a curve on cells of the circle during an interval of time.

use crate::chips::interval::Interval;
use crate::chips::trig::{Angle, Trig};
use std::f64::consts::TAU;

/// Cells that the circle begins with.
const CELLS: usize = 16;

/// Where they begin, radians: away from the angles at which roots of tidy motions lie.
const BEGIN: f64 = 0.1234;

/// Cells at most; a curve that needs more is left uncertain for shorter times to decide.
const MOST: usize = 160;

/// What is known of a curve on a cell, at every angle and time in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Known {
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
struct Cell {
    x: Interval,
    angle: Angle<Interval>,
    known: Known,
}

impl Cell {
    fn new(lo: f64, hi: f64) -> Self {
        let x = Interval { lo, hi };
        Self { x, angle: Angle::over(x), known: Known::Nothing }
    }
}

/// A root: in the angles `lo..=hi`, at each time of the interval, the curve is zero exactly once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    /// Before it, radians; the curve has one sign there all the time.
    pub lo: f64,
    /// Behind it; the curve has the other sign there all the time. May be beyond a full turn.
    pub hi: f64,
    /// Whether the curve rises with the angle.
    pub rising: bool,
}

/// A curve's roots during an interval of time.
#[derive(Debug, Clone, PartialEq)]
pub struct Roots {
    /// In the order of their angles.
    pub brackets: Vec<Bracket>,
    /// Where there is none, whether the curve is positive everywhere.
    pub positive: bool,
}

/// The circle in cells, for one curve.
#[derive(Debug, Clone)]
pub struct Cells(Vec<Cell>);

impl Cells {
    /// Nothing is known yet.
    pub fn new() -> Self {
        let border = |index: usize| BEGIN + TAU * index as f64 / CELLS as f64;
        Self((0..CELLS).map(|index| Cell::new(border(index), border(index + 1))).collect())
    }

    /// Looks at the cells of which nothing is known and halves them down to `finest` radians.
    ///
    /// What was certain for a longer time stays so; of cells whose slope is known, the sign may become so.
    pub fn look(&mut self, curve: &Trig<Interval>, finest: f64) {
        let mut done: Vec<Cell> = Vec::with_capacity(self.0.len() + 8);
        let mut waiting: Vec<Cell> = std::mem::take(&mut self.0);
        waiting.reverse();
        while let Some(mut cell) = waiting.pop() {
            if cell.known.sign().is_none() {
                cell.known = known(curve, &cell).or(cell.known);
            }
            let wide = cell.x.hi - cell.x.lo > finest && done.len() + waiting.len() < MOST;
            if cell.known == Known::Nothing && wide {
                let middle = cell.x.middle();
                waiting.push(Cell::new(middle, cell.x.hi));
                waiting.push(Cell::new(cell.x.lo, middle));
                continue;
            }
            match done.last_mut() {
                // Of what has one sign nothing more will be asked.
                Some(last) if cell.known.sign().is_some() && last.known == cell.known => {
                    last.x.hi = cell.x.hi
                }
                _ => done.push(cell),
            }
        }
        self.0 = done;
    }

    /// The roots, when everything is certain.
    pub fn roots(&self, curve: &Trig<Interval>) -> Option<Roots> {
        let first = self.0.iter().position(|cell| cell.known.sign().is_some())?;
        let (before, behind) = self.0.split_at_checked(first)?;
        let turned = before.iter().map(|cell| (cell, TAU));
        let mut cells = behind.iter().map(|cell| (cell, 0.0)).chain(turned);
        let positive = cells.next().and_then(|(cell, _)| cell.known.sign())?;
        let mut found = Found { positive, run: None, brackets: Vec::new() };
        for (cell, turn) in cells {
            let (lo, hi) = (cell.x.lo + turn, cell.x.hi + turn);
            let rising = match cell.known {
                Known::Nothing => return None,
                Known::Positive | Known::Negative => {
                    found.sign(cell.known == Known::Positive)?;
                    continue;
                }
                known => known == Known::Rises,
            };
            match &mut found.run {
                Some(run) if run.rising == rising => run.hi = hi,
                run => {
                    // The slope changes its sign at this very angle: the curve's sign there decides about the run before.
                    if run.is_some() {
                        let border = Angle::over(Interval::point(lo));
                        found.sign(curve.value(&border).sign()? > 0)?;
                    }
                    found.run = Some(Bracket { lo, hi, rising });
                }
            }
        }
        found.sign(positive)?;
        Some(Roots { brackets: found.brackets, positive })
    }

    /// The least box around the cells of which nothing is known; `None` if there is none.
    pub fn unknown(&self) -> Option<Interval> {
        let unknown = self.0.iter().filter(|cell| cell.known == Known::Nothing).map(|cell| cell.x);
        unknown.reduce(|a, b| Interval { lo: a.lo.min(b.lo), hi: a.hi.max(b.hi) })
    }
}

/// What a walk around the circle has found.
struct Found {
    /// Sign of the curve at the last place where it is known.
    positive: bool,
    /// Cells since then, in which the curve only rises or only falls.
    run: Option<Bracket>,
    brackets: Vec<Bracket>,
}

impl Found {
    /// The sign is known here; `None` when that cannot be.
    fn sign(&mut self, positive: bool) -> Option<()> {
        let run = self.run.take();
        if positive != self.positive {
            self.brackets.push(run.filter(|run| run.rising == positive)?);
            self.positive = positive;
        }
        Some(())
    }
}

impl Known {
    /// What was known before, where there is nothing new.
    fn or(self, before: Self) -> Self {
        if self == Self::Nothing { before } else { self }
    }

    fn sign(self) -> Option<bool> {
        match self {
            Self::Positive => Some(true),
            Self::Negative => Some(false),
            _ => None,
        }
    }
}

fn known(curve: &Trig<Interval>, cell: &Cell) -> Known {
    let told = |value: Interval, slope: Interval| match (value.sign(), slope.sign()) {
        (Some(1), _) => Known::Positive,
        (Some(_), _) => Known::Negative,
        (None, Some(1)) => Known::Rises,
        (None, Some(_)) => Known::Falls,
        (None, None) => Known::Nothing,
    };
    let quick = told(curve.value(&cell.angle), curve.slope(&cell.angle));
    if quick.sign().is_some() {
        return quick;
    }
    // Taylor's formula about the middle, whose error goes with the square of the cell: near a fold value and slope are both small.
    let middle = Interval::point(cell.x.middle());
    let (centre, offset) = (Angle::over(middle), cell.x - middle);
    let bend = curve.bend(&cell.angle);
    let slope = curve.slope(&centre);
    let square = Interval { lo: 0.0, hi: 0.5 * offset.magnitude() * offset.magnitude() * (1.0 + 1e-15) };
    let close = told(curve.value(&centre) + slope * offset + bend * square, slope + bend * offset);
    close.or(quick)
}
