//! This module holds the integer grid on which areas are cut.

use i_overlay::i_float::int::point::IntPoint;

/// The finest step as a power of two, in mm: 2^-20, about 1e-6. Multiplying by a power of two is exact, so
/// boundaries at binary fractions of a millimetre are exact.
const FINEST: i32 = -20;

/// The coarsest step as a power of two, in mm: 2^-13, about 1e-4. It reaches 65 m to each side of a box.
const COARSEST: i32 = -13;

/// The largest coordinate in steps. Twice as much would overflow the cross products of [`i_overlay`].
const FARTHEST: f64 = ((1 << 30) - 1) as f64;

/// A grid that gives points in a layer as whole numbers of steps from an origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AreaGrid {
    origin: [f64; 2],
    step: f64,
}

impl AreaGrid {
    /// Makes a grid around a box (corners with the lowest and highest coordinates, mm) that reaches half the
    /// box's larger side beyond it. Its steps are 2^-20 mm for boxes up to a metre, and double with every
    /// doubling of the size. Returns `None` for boxes of more than 130 m and for boxes that are not finite.
    pub fn around_box(low: [f64; 2], high: [f64; 2]) -> Option<Self> {
        let ([x0, y0], [x1, y1]) = (low, high);
        let half = ((x1 - x0).max(y1 - y0) / 2.0).max(0.0);
        let steps = (FINEST..=COARSEST).map(|power| 2f64.powi(power));
        let step = { steps }.find(|step| half <= FARTHEST / 2.0 * step)?;
        let origin = [f64::midpoint(x0, x1), f64::midpoint(y0, y1)].map(|at| (at / step).round() * step);
        origin.iter().all(|at| at.is_finite()).then_some(Self { origin, step })
    }

    /// Returns the length of a step, mm.
    pub fn step_mm(&self) -> f64 {
        self.step
    }

    /// Returns the coordinates of a point of the grid, mm.
    pub(super) fn point_in_mm(&self, point: IntPoint) -> [f64; 2] {
        let [x0, y0] = self.origin;
        [x0 + f64::from(point.x) * self.step, y0 + f64::from(point.y) * self.step]
    }

    /// Adds the grid points nearest to the vertices of a boundary, each once. Parts beyond the grid are cut
    /// off. A boundary with a number that is not finite gets no points.
    pub(super) fn add_grid_points(&self, border: &[[f64; 2]], points: &mut Vec<IntPoint>) {
        let [x0, y0] = self.origin;
        let start = points.len();
        let on_grid = |[x, y]: &[f64; 2]| [(x - x0) / self.step, (y - y0) / self.step];
        let mut add = |[x, y]: [f64; 2]| {
            // This rounds to the nearest step and is quicker than `round`, which is a function call on many
            // processors.
            let point = [x, y].map(|at| (at + 0.5f64.copysign(at)) as i32).into();
            if points.get(start..).and_then(<[_]>::last) != Some(&point) {
                points.push(point);
            }
        };
        let largest = border.iter().flat_map(on_grid).fold(0.0, |most: f64, at| {
            // `max` would ignore a value that is not a number.
            if at.is_nan() { f64::INFINITY } else { most.max(at.abs()) }
        });
        if largest <= FARTHEST {
            border.iter().for_each(|place| add(on_grid(place)));
        } else if largest < f64::INFINITY {
            let mut within: Vec<[f64; 2]> = border.iter().map(on_grid).collect();
            for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
                within = clip_at_grid_side(&within, axis, sign);
            }
            within.into_iter().for_each(&mut add);
        }
        let again = points.get(start..).is_some_and(|all| all.len() > 1 && all.first() == all.last());
        if again {
            points.pop();
        }
    }
}

/// Returns a boundary without the part beyond one side of the grid (Sutherland and Hodgman's algorithm). The
/// result may run back and forth along that side.
fn clip_at_grid_side(border: &[[f64; 2]], axis: usize, sign: f64) -> Vec<[f64; 2]> {
    // The distance beyond the side, in steps.
    let beyond = |&[x, y]: &[f64; 2]| sign * (if axis == 0 { x } else { y }) - FARTHEST;
    let mut kept = Vec::with_capacity(border.len());
    let ends = border.iter().skip(1).chain(border.first());
    for (from, to) in border.iter().zip(ends) {
        let (a, b) = (beyond(from), beyond(to));
        if a <= 0.0 {
            kept.push(*from);
        }
        if (a <= 0.0) != (b <= 0.0) {
            let share = a / (a - b);
            let ([x0, y0], [x1, y1]) = (*from, *to);
            let [x, y] = [x0 + (x1 - x0) * share, y0 + (y1 - y0) * share];
            kept.push(if axis == 0 { [sign * FARTHEST, y] } else { [x, sign * FARTHEST] });
        }
    }
    kept
}
