//! This module divides what cuts at one moment into the nodes of sums: along the edge and around the axis.

use crate::certified_engagement::{ContactSection, ContourElement, SectionRow};

/// The places and weights of the Gauss-Legendre rule of five points between -1 and 1.
pub(super) const ARC_NODES: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Two points between 0 and 1, of equal weights, that integrate cubic functions.
pub(super) const PAIR: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// The longest arc over which forces are summed at once, radians: where they are sines and cosines, and where they are
/// powers of a chip or change with runout.
const SMOOTH_ARC_RAD: f64 = 1.1;
const ROUGH_ARC_RAD: f64 = 0.12;

/// The largest turns of the normal within a node: of means, and of rotations; radians.
const MEAN_TURN_RAD: f64 = 0.2;
const TURNING_TURN_RAD: f64 = 0.1;
/// The largest lag within a node of rotations, radians: of teeth that all cut in all of an arc, and of teeth with runout, which
/// begin to cut within it.
const MOST_LAG_RAD: f64 = 0.1;
const ROUGH_LAG_RAD: f64 = 0.015;
/// The most nodes of one row.
const MOST_NODES: f64 = 400.0;

/// A part of the edge, with the values of its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct EdgeNode {
    /// The number of its row in the section.
    pub row: usize,
    /// Its length along the meridian, mm.
    pub length_mm: f64,
    /// Its distance from the axis, mm.
    pub radius_mm: f64,
    /// The sine and the cosine of the normal's angle from straight down.
    pub sin: f64,
    pub cos: f64,
    /// What makes its share ([`ContactSection::share_parts`]).
    pub share: [f64; 3],
    /// By how much its middle lags behind the tip, radians.
    pub lag_rad: f64,
    /// The height of its middle above the tip, mm.
    pub height_mm: f64,
    /// Half of the height between its ends, mm.
    pub half_height_mm: f64,
    /// By how much the tool bends somewhere for 1 N here, mm; 0 where nobody asks.
    pub give_mm_per_n: f64,
    /// Half of the lag between its ends.
    pub half_lag_rad: f64,
}

impl EdgeNode {
    fn at(section: &ContactSection, row: usize, element: &ContourElement, parameter: f64) -> Self {
        let ([radius_mm, height_mm], [sin, up]) = (element.point(parameter), element.normal(parameter));
        Self {
            row,
            length_mm: 0.0,
            radius_mm,
            sin,
            cos: -up,
            share: section.share_parts(element, parameter),
            lag_rad: 0.0,
            height_mm,
            half_height_mm: 0.0,
            give_mm_per_n: 0.0,
            half_lag_rad: 0.0,
        }
    }

    /// Returns the node with so much of the parameter's range, whose middle it has.
    fn over(self, element: &ContourElement, [from, to]: [f64; 2]) -> Self {
        let half_height_mm = (element.point(to)[1] - element.point(from)[1]).abs() / 2.0;
        Self { length_mm: (to - from) * element.length_per_unit(), half_height_mm, ..self }
    }
}

/// Returns the nodes of each row for means, in which no lag counts.
pub(super) fn list_mean_nodes(
    section: &ContactSection,
) -> impl Iterator<Item = (&SectionRow, Vec<EdgeNode>)> {
    section.rows.iter().enumerate().map(move |(number, row)| {
        let [from, to] = row.range;
        let is_alike = matches!(row.element, ContourElement::Line { normal: [_, up], .. } if up.abs() < 1e-12)
            && section.spin == [0.0; 2];
        let whole = (to - from) * row.element.length_per_unit();
        if is_alike {
            let node = EdgeNode::at(section, number, &row.element, (from + to) / 2.0);
            return (row, vec![node.over(&row.element, row.range)]);
        }
        let count = count_for_turn(&row.element, to - from, MEAN_TURN_RAD);
        let part = (to - from) / count;
        let places = (0..count as usize)
            .flat_map(|number| PAIR.map(|at| from + part * (number as f64 + at)))
            .map(|at| EdgeNode {
                length_mm: whole / count / 2.0,
                ..EdgeNode::at(section, number, &row.element, at)
            });
        (row, places.collect())
    })
}

/// Returns the nodes of all rows for the rotation of teeth whose edges lag by so much per mm of height. `is_smooth` says that
/// they have no runout.
pub(super) fn list_turning_nodes(
    section: &ContactSection,
    lag_rad_per_mm: f64,
    is_smooth: bool,
) -> Vec<EdgeNode> {
    let most_lag = if is_smooth { MOST_LAG_RAD } else { ROUGH_LAG_RAD };
    let mut nodes = Vec::new();
    for (number, row) in section.rows.iter().enumerate() {
        let [from, to] = row.range;
        let lag_at = |at: f64| row.element.point(at)[1] * lag_rad_per_mm;
        let lags = ((lag_at(to) - lag_at(from)).abs() / most_lag).ceil();
        let count = count_for_turn(&row.element, to - from, TURNING_TURN_RAD).max(lags).min(MOST_NODES);
        let part = (to - from) / count;
        for index in 0..count as usize {
            let (low, high) = (from + part * index as f64, from + part * (index + 1) as f64);
            let [first, last] = [lag_at(low), lag_at(high)];
            let node = EdgeNode::at(section, number, &row.element, (low + high) / 2.0);
            nodes.push(EdgeNode {
                lag_rad: (first + last) / 2.0,
                half_lag_rad: (last - first).abs() / 2.0,
                ..node.over(&row.element, [low, high])
            });
        }
    }
    nodes
}

fn count_for_turn(element: &ContourElement, range: f64, most: f64) -> f64 {
    match element {
        ContourElement::Line { .. } => 1.0,
        ContourElement::Arc { .. } => (range / most).ceil().max(1.0),
    }
}

/// Returns the arcs of a row in pieces over which a rule of five points is exact enough. `is_smooth` says that forces are
/// sines and cosines within arcs.
pub(super) fn split_arcs(row: &SectionRow, is_smooth: bool) -> impl Iterator<Item = [f64; 2]> {
    let most = if is_smooth { SMOOTH_ARC_RAD } else { ROUGH_ARC_RAD };
    row.arcs.iter().flat_map(move |[from, to]| {
        let count = ((to - from) / most).ceil().max(1.0);
        let (from, part) = (*from, (to - from) / count);
        (0..count as usize)
            .map(move |number| [from + part * number as f64, from + part * (number + 1) as f64])
    })
}
