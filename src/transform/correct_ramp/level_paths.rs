//! This module holds what an operation cuts at one level, sorted in squares, so that a ramp only looks at what is near.

use super::ramp::is_sensible;
use geo::{BoundingRect, ConvexHull, Coord, Intersects, Line, LineString, MultiPoint, Rect, Simplify};
use nalgebra::Point2;
use std::collections::HashMap;

/// Chords within this distance of a path (mm) replace it.
const CHORD_TOLERANCE: f64 = 0.01;

/// The number of squares along the longer side of a level. Lines are long or many, so that few squares suffice.
const SQUARES: f64 = 128.0;

/// The lines of paths at one level.
#[derive(Debug, Clone, Default)]
pub(super) struct LevelPaths {
    /// The lines in the order of the paths, and whether each continues the one before it.
    lines: Vec<(Line, bool)>,
    squares: HashMap<[i64; 2], Vec<u32>>,
    side_mm: f64,
    /// The vertices of the convex hull of all points.
    hull: Vec<Point2<f64>>,
}

impl LevelPaths {
    /// Sorts paths across the tool axis, in mm. The time is that of reading them.
    pub(super) fn new(paths: &[Vec<Point2<f64>>]) -> Self {
        let mut lines = Vec::new();
        for path in paths {
            let whole: LineString = path.iter().map(|point| Coord { x: point.x, y: point.y }).collect();
            // The time for buffers grows with the number of points, and dense paths have many more than their
            // shape needs.
            let whole = whole.simplify(CHORD_TOLERANCE);
            // A coordinate that belongs to no machine would be far from every ramp.
            let is_near =
                |line: &Line| [line.start, line.end].iter().all(|at| is_sensible(at.x) && is_sensible(at.y));
            let numbered = whole.lines().enumerate().filter(|(_, line)| is_near(line));
            lines.extend(numbered.map(|(index, line)| (line, index > 0)));
        }
        let ends = lines.iter().flat_map(|(line, _): &(Line, bool)| [line.start, line.end]);
        let size = ends.collect::<LineString>().bounding_rect();
        let side_mm = size.map_or(0.0, |size| size.width().max(size.height())) / SQUARES;
        let hull = find_hull(paths);
        let mut found = Self { lines, squares: HashMap::new(), side_mm: side_mm.max(1.0), hull };
        for index in 0..found.lines.len() {
            found.enter_line(index);
        }
        found
    }

    fn enter_line(&mut self, index: usize) {
        let Some((line, _)) = self.lines.get(index).copied() else { return };
        let side = self.side_mm;
        for square in self.squares_of(&line.bounding_rect()) {
            let [x, y] = square.map(|at| at as f64 * side);
            let around = Rect::new(Coord { x, y }, Coord { x: x + side, y: y + side });
            if line.intersects(&around) {
                self.squares.entry(square).or_default().push(index as u32);
            }
        }
    }

    /// Returns the squares that a rectangle touches.
    fn squares_of(&self, area: &Rect) -> impl Iterator<Item = [i64; 2]> + use<> {
        let side = self.side_mm;
        let range = |low: f64, high: f64| (low / side).floor() as i64..=(high / side).floor() as i64;
        let (columns, rows) = (range(area.min().x, area.max().x), range(area.min().y, area.max().y));
        rows.flat_map(move |row| columns.clone().map(move |column| [column, row]))
    }

    /// Returns the lines that touch a rectangle, in their order. Lines that continue each other are joined.
    pub(super) fn lines_within(&self, area: &Rect) -> Vec<LineString> {
        // A wide area has more squares than the level, whose squares are then gone through instead.
        let count = (area.width() / self.side_mm + 1.0) * (area.height() / self.side_mm + 1.0);
        let mut near: Vec<u32> = if count > self.squares.len() as f64 {
            (0..self.lines.len() as u32).collect()
        } else {
            self.squares_of(area).filter_map(|square| self.squares.get(&square)).flatten().copied().collect()
        };
        near.sort_unstable();
        near.dedup();
        let mut joined: Vec<LineString> = Vec::new();
        let mut last = None;
        for index in near {
            let Some((line, continues)) = self.lines.get(index as usize) else { continue };
            if !line.intersects(area) {
                continue;
            }
            match joined.last_mut().filter(|_| *continues && last.is_some_and(|last: u32| last + 1 == index))
            {
                Some(open) => open.0.push(line.end),
                None => joined.push(LineString::new(vec![line.start, line.end])),
            }
            last = Some(index);
        }
        joined
    }

    /// Returns the vertices of the convex hull of the paths.
    pub(super) fn hull(&self) -> &[Point2<f64>] {
        &self.hull
    }
}

/// Returns the vertices of the convex hull of paths. Numbers of an implausible size are left out.
fn find_hull(paths: &[Vec<Point2<f64>>]) -> Vec<Point2<f64>> {
    let sensible = paths.iter().flatten().filter(|point| is_sensible(point.x) && is_sensible(point.y));
    let all: MultiPoint = sensible.map(|point| geo::Point::new(point.x, point.y)).collect();
    all.convex_hull().exterior().coords().map(|at| Point2::new(at.x, at.y)).collect()
}
