//! Pieces on which the tool axis is not along z: fixed and tilted (3+2), or turning on the way.
//!
//! The piece is cut into legs on which the axis turns little ([`leg`]); over a column the sweep of a leg goes from the lowest
//! place of the solid's lower surface to the highest of its upper one, each found as the least value of a convex
//! function of time ([`search`]), and what overlaps of the legs is put together.
//!
//! **Error bound.** While the axis stands still, the only error is the search's: a tolerance `e = min(0.02 cell, 0.002 mm)`, of
//! which it takes a quarter, measured along z. A turning axis adds concave parts to the surface over a column: for a rigid motion
//! `f'' |n_z| = u.H u - n.(2 w x u + w x (w x r))`, with u the velocity of the column's point against the cutter, w the turn, H the
//! surface's curvature (not negative, the solid being convex) and r the distance from the tip. So a leg of way l, angle a
//! and reach r hides at most `a l + 1.5 r a^2` along the normal, half as much for the steps of a ball's sphere; legs are
//! made so many that this is below e/2. So material is left that is thinner than e along the normal, and none is removed that
//! the cutter did not reach, but for the rounding of heights.
//!
//! **Shares** relate to the tip's speed, as feeds do, so they exceed 1 where a turn moves the surface faster than the tip. Where the tip
//! stands still ([`pace`]) they relate to the fastest point of the flutes.

mod beside;
mod ground;
mod leg;
mod line;
mod search;
mod solid;
mod touch;

use super::partial::Partial;
use super::straight::Circumstances;
use crate::sim::Cutter;
use crate::sim::dexel::{Band, Layout};
use crate::sim::run::Piece;
use beside::{Beside, Guard, lowest};
use ground::Ground;
use leg::{Leg, Pose, Side, Turn};
use nalgebra::Vector3;
use search::{Ask, Passing, least};
use solid::Solid;
use std::ops::Range;
use touch::Touches;

/// Tips closer together than this (mm) stand still: below the resolution of any file.
const STILL: f64 = 1e-7;

/// Most legs of a piece.
const MOST: f64 = 4096.0;

/// A leg with what every column asks of it.
#[derive(Debug, Clone)]
struct Part {
    passing: Option<Passing>,
    ground: Ground,
    lowest: f64,
}

/// A piece with a tilted axis, made ready for any band of columns.
#[derive(Debug, Clone)]
pub(in crate::sim) struct Tilted {
    legs: Vec<(Leg, Solid)>,
    parts: Vec<Part>,
    touches: Touches,
    beside: Beside,
    guards: Vec<Guard>,
    tolerance: f64,
    rows: Range<usize>,
    layout: Layout,
}

/// Length of the way that shares relate to: the tip's, or, where it stands still, that of the outermost point of flutes of a radius and
/// a length.
pub(in crate::sim) fn pace(piece: &Piece, [radius, flutes]: [f64; 2]) -> f64 {
    let travel = (piece.to.point - piece.from.point).norm();
    if travel > STILL {
        return travel;
    }
    let angle = piece.from.axis.cross(&piece.to.axis).norm().atan2(piece.from.axis.dot(&piece.to.axis));
    angle * radius.hypot(flutes)
}

impl Tilted {
    /// A piece between two poses.
    pub fn new(piece: &Piece, cutter: &Cutter, layout: &Layout, around: Circumstances) -> Self {
        let base = Vector3::new(0.0, 0.0, layout.base);
        let [from, to] = [piece.from, piece.to].map(|place| Pose {
            tip: place.point.coords - base,
            axis: place.axis.try_normalize(1e-12).unwrap_or_else(Vector3::z),
        });
        let turn = Turn::new(from, to);
        let travel = to.tip - from.tip;
        let highest = around.highest - layout.base;
        let tolerance = (0.02 * layout.cell).min(0.002);
        let solid = Solid::of(&cutter.profile, reach(&from, &to, cutter.radius(), highest));
        let way = if solid.is_ball() {
            travel.dot(&from.axis).abs().max(travel.dot(&to.axis).abs())
        } else {
            travel.norm()
        };
        let far = solid.top().hypot(solid.radius());
        let hidden = turn.angle * way + 1.5 * far * turn.angle * turn.angle;
        let count = (hidden / (0.5 * tolerance)).sqrt().ceil().clamp(1.0, MOST);
        let legs = turn.legs(count as usize);
        let parts: Vec<Part> = legs
            .iter()
            .map(|leg| Part {
                passing: Passing::new(leg, &solid),
                ground: Ground::new(leg, solid.radius(), [0.0, solid.top()]),
                lowest: lowest(leg, &solid),
            })
            .collect();
        let low = |solid: &Solid| legs.iter().map(|leg| lowest(leg, solid)).fold(f64::INFINITY, f64::min);
        let guards: Vec<Guard> = cutter
            .collars
            .iter()
            .enumerate()
            .map(|(index, collar)| Guard { index, solid: Solid::collar(collar) })
            .filter(|guard| low(&guard.solid) < highest)
            .collect();
        let cuts = parts.iter().any(|part| part.lowest < highest);
        let mut rows = Range { start: usize::MAX, end: 0 };
        let mut widen = |ground: &Ground, margin: usize| {
            let more = ground.rows(layout);
            rows.start = rows.start.min(more.start.saturating_sub(margin));
            rows.end = rows.end.max((more.end + margin).min(layout.rows));
        };
        if cuts {
            // Beside the flank one row more is looked at.
            parts.iter().for_each(|part| widen(&part.ground, 2));
        }
        guards.iter().for_each(|guard| legs.iter().for_each(|leg| widen(&guard.ground(leg), 0)));
        let length = travel.norm();
        let direction = (length > STILL).then(|| travel / length);
        let along = direction.map_or(0.0, |direction| direction.dot(&from.axis));
        let [flank, start] = cutter.profile.flank_start();
        Self {
            touches: Touches {
                profile: cutter.profile.clone(),
                pace: (pace(piece, [cutter.radius(), cutter.flute_length()]) / count).max(1e-12),
                direction,
                cell: layout.cell,
                detail: around.detail,
                continues: around.continues,
            },
            beside: Beside {
                radius: flank.max(1e-9),
                slope: cutter.profile.taper().tan(),
                heights: [start, if cuts { solid.top() } else { start }],
                across: (1.0 - along * along).max(0.0).sqrt(),
                direction,
            },
            legs: legs.into_iter().map(|leg| (leg, solid.clone())).collect(),
            parts,
            guards,
            tolerance,
            rows: if rows.start < rows.end { rows } else { 0..0 },
            layout: *layout,
        }
    }

    /// Rows that the piece can change.
    pub fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    /// Removes what the piece sweeps from a band.
    pub fn sweep(&self, band: &mut Band) -> Partial {
        let mut partial = Partial::new();
        let (first, end) =
            (self.rows.start.max(band.first_row), self.rows.end.min(band.first_row + band.rows()));
        let mut ranges: Vec<Range<usize>> = Vec::with_capacity(self.parts.len());
        let mut spans = Vec::new();
        for row in first..end {
            for guard in &self.guards {
                for (leg, _) in &self.legs {
                    let depth = guard.depth(leg, band, &self.layout, row, self.tolerance);
                    if depth > self.layout.cell.min(0.05) {
                        partial.touch(guard.index, depth);
                    }
                }
            }
            ranges.clear();
            ranges.extend(self.parts.iter().map(|part| part.ground.columns(row, &self.layout)));
            let from = ranges.iter().map(|range| range.start).min().unwrap_or(0);
            let to =
                ranges.iter().filter(|range| !range.is_empty()).map(|range| range.end).max().unwrap_or(0);
            for column in from..to {
                self.column(band, [column, row], &ranges, &mut spans, &mut partial);
            }
        }
        for (leg, _) in &self.legs {
            let share = self.beside.graze(leg, band, &self.layout, f64::from(partial.graze));
            partial.graze = partial.graze.max(share as f32);
        }
        partial
    }

    /// Cuts one column.
    fn column(
        &self,
        band: &mut Band,
        [column, row]: [usize; 2],
        ranges: &[Range<usize>],
        spans: &mut Vec<[f64; 2]>,
        partial: &mut Partial,
    ) {
        let index = (row - band.first_row) * band.columns + column;
        let Some((top, low)) = band.top.get(index).zip(band.low.get(index)) else { return };
        if *top == f32::NEG_INFINITY {
            return;
        }
        let top = f64::from(*top);
        let floor = if band.is_deep(index) {
            band.intervals(index).last().map_or(0.0, |[low, _]| f64::from(low))
        } else {
            f64::from(*low)
        };
        let place = self.layout.center(column, row);
        spans.clear();
        for (((leg, solid), part), range) in self.legs.iter().zip(&self.parts).zip(ranges) {
            if part.lowest >= top || !range.contains(&column) {
                continue;
            }
            if let Some(span) = self.span(leg, solid, part, place, [floor, top]) {
                join(spans, span);
            }
        }
        for [from, to] in spans.iter() {
            band.cut(index, *from as f32, *to as f32, |low, top| {
                let taken = [f64::from(low), f64::from(top)];
                if taken[1] - taken[0] < self.tolerance / 4.0 {
                    // A film that rounding left is no contact.
                    partial.removed += taken[1] - taken[0];
                } else {
                    self.touches.add(place, taken, &self.legs, partial);
                }
            });
        }
    }

    /// What a leg takes out of a column whose material is between two heights.
    fn span(
        &self,
        leg: &Leg,
        solid: &Solid,
        part: &Part,
        place: [f64; 2],
        [floor, top]: [f64; 2],
    ) -> Option<[f64; 2]> {
        let tolerance = self.tolerance / 4.0;
        let passing = part.passing.as_ref();
        let lower = Ask { side: Side::Lower, enough: floor, useless: top - tolerance, tolerance };
        let found = least(leg, solid, passing, place, lower)?;
        if found.other >= top {
            return Some([found.value, f64::INFINITY]);
        }
        let upper = Ask { side: Side::Upper, enough: -top, useless: -floor - tolerance, tolerance };
        let other = least(leg, solid, passing, place, upper)?;
        Some([found.value.min(other.other), -other.value])
    }
}

/// Height above the tip up to which the cutter can meet material below a height.
fn reach(from: &Pose, to: &Pose, radius: f64, highest: f64) -> f64 {
    let rise = from.axis.z.min(to.axis.z);
    // Between two axes that look up, all look up as steeply.
    if rise < 0.05 {
        return f64::INFINITY;
    }
    ((highest - from.tip.z.min(to.tip.z) + radius) / rise).max(0.0)
}

/// Adds an interval to some that do not touch.
fn join(spans: &mut Vec<[f64; 2]>, [mut low, mut high]: [f64; 2]) {
    spans.retain(|[from, to]| {
        let apart = *to < low || *from > high;
        if !apart {
            (low, high) = (low.min(*from), high.max(*to));
        }
        apart
    });
    spans.push([low, high]);
}
