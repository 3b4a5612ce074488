//! This module joins slabs to segments of time between events, in which the roots of the curves are functions
//! of time.

use super::circle_cells::RootBracket;
use super::time_slabs::{DiagramSlab, DiagramSlabs, TopologyEvent};
use crate::layered_chips::section_family::{DiagramCurve, SectionFamily};
use std::f64::consts::TAU;

/// Two roots that are closer than this (radians) at the boundary of two slabs are the same. Different roots
/// only come closer to each other at a fold.
const SAME: f64 = 1e-6;

/// A root through a whole segment of time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RootTrack {
    /// The curve that the root belongs to.
    pub curve: DiagramCurve,
    /// Whether the curve rises with the angle at the root.
    pub rising: bool,
    /// The brackets of the root, one for each slab.
    brackets: Vec<RootBracket>,
}

/// A segment of time from one event to the next. Within it roots neither appear nor disappear, and do not
/// cross.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TimeSegment {
    /// The beginning and the end.
    pub t: [f64; 2],
    /// The end of each of its slabs.
    ends: Vec<f64>,
    /// The roots of the edge, bottom and top curves.
    pub tracks: Vec<RootTrack>,
}

impl TimeSegment {
    /// Returns the angle of a track at a time, radians. It is on the same turn of the circle as the track's
    /// bracket.
    pub(crate) fn track_angle_at(&self, family: &SectionFamily, track: &RootTrack, t: f64) -> f64 {
        let slab = self.ends.partition_point(|end| *end < t).min(track.brackets.len().saturating_sub(1));
        let Some(bracket) = track.brackets.get(slab) else { return 0.0 };
        family.curve_at(track.curve, t).find_root(bracket.lo, bracket.hi, track.rising)
    }

    fn from_slab(slab: &DiagramSlab) -> Self {
        let tracks: Vec<RootTrack> = [DiagramCurve::Edge, DiagramCurve::Bottom, DiagramCurve::Top]
            .into_iter()
            .zip(&slab.roots)
            .flat_map(|(curve, roots)| {
                roots.brackets.iter().map(move |bracket| RootTrack {
                    curve,
                    rising: bracket.rising,
                    brackets: vec![*bracket],
                })
            })
            .collect();
        Self { t: slab.t, ends: vec![slab.t[1]], tracks }
    }

    /// Extends the segment by the next slab; returns that slab unchanged if its roots differ.
    fn try_extend(&mut self, family: &SectionFamily, next: Self) -> Result<(), Self> {
        if self.tracks.len() != next.tracks.len() {
            return Err(next);
        }
        let t = self.t[1];
        let here: Vec<f64> = self.tracks.iter().map(|track| self.track_angle_at(family, track, t)).collect();
        let there: Vec<f64> = next.tracks.iter().map(|track| next.track_angle_at(family, track, t)).collect();
        // Each track continues in the nearest root of the same curve and direction, and each root is used
        // once.
        let mut left: Vec<usize> = (0..there.len()).collect();
        let mut order = Vec::with_capacity(here.len());
        for (track, angle) in self.tracks.iter().zip(&here) {
            let fits = |index: &usize| {
                let other = next.tracks.get(*index).zip(there.get(*index));
                other.is_some_and(|(other, there)| {
                    other.curve == track.curve
                        && other.rising == track.rising
                        && angular_distance(*angle, *there) < SAME
                })
            };
            let Some(place) = left.iter().position(fits) else { return Err(next) };
            order.push(left.swap_remove(place));
        }
        for ((track, index), angle) in self.tracks.iter_mut().zip(order).zip(here) {
            let Some(other) = next.tracks.get(index) else { continue };
            for bracket in &other.brackets {
                // Move the bracket to the same turn of the circle as the track.
                let turns = ((angle - 0.5 * (bracket.lo + bracket.hi)) / TAU).round() * TAU;
                track.brackets.push(RootBracket {
                    lo: bracket.lo + turns,
                    hi: bracket.hi + turns,
                    ..*bracket
                });
            }
        }
        self.t[1] = next.t[1];
        self.ends.extend(next.ends);
        Ok(())
    }
}

/// Returns the distance of two angles on the circle, radians.
pub(crate) fn angular_distance(a: f64, b: f64) -> f64 {
    let d = (a - b).rem_euclid(TAU);
    d.min(TAU - d)
}

/// Joins slabs to segments. Each event between two segments shrinks to its middle, and the segments are
/// extended up to it.
///
/// Returns the segments and the events at their boundaries. Of several events next to each other one is kept:
/// an open one before a fold, and a fold before one elsewhere.
pub(crate) fn join_slabs(
    family: &SectionFamily,
    slabs: DiagramSlabs,
) -> (Vec<TimeSegment>, Vec<TopologyEvent>) {
    let mut stretches: Vec<TimeSegment> = Vec::new();
    let mut events: Vec<TopologyEvent> = Vec::new();
    let mut waiting = slabs.events.into_iter().peekable();
    for slab in slabs.slabs {
        let mut met: Vec<TopologyEvent> = Vec::new();
        while let Some(event) = waiting.next_if(|event| event.t < slab.t[0]) {
            met.push(event);
        }
        let next = TimeSegment::from_slab(&slab);
        let next = match (stretches.last_mut(), met.is_empty()) {
            (Some(last), true) => match last.try_extend(family, next) {
                Ok(()) => continue,
                Err(next) => next,
            },
            _ => next,
        };
        begin_segment(&mut stretches, next, &met, &mut events);
    }
    let rest: Vec<TopologyEvent> = waiting.collect();
    if let Some(last) = stretches.last_mut() {
        last.t[1] = 1.0;
    }
    events.extend(strongest_event(&rest));
    (stretches, events)
}

/// Starts a new segment after the events that were met.
fn begin_segment(
    stretches: &mut Vec<TimeSegment>,
    mut next: TimeSegment,
    met: &[TopologyEvent],
    events: &mut Vec<TopologyEvent>,
) {
    let event = strongest_event(met);
    let t = match (stretches.last_mut(), event) {
        (None, _) => 0.0,
        (Some(_), None) => next.t[0],
        (Some(last), Some(_)) => 0.5 * (last.t[1] + next.t[0]),
    };
    if let Some(last) = stretches.last_mut() {
        last.t[1] = t;
    }
    next.t[0] = t;
    events.extend(event.map(|event| TopologyEvent { t, ..event }));
    stretches.push(next);
}

/// Returns the event with the highest rank: open, then fold, then elsewhere.
fn strongest_event(met: &[TopologyEvent]) -> Option<TopologyEvent> {
    use super::time_slabs::EventProof;
    let rank = |event: &&TopologyEvent| match event.proof {
        EventProof::Open { .. } => 2,
        EventProof::Fold { .. } => 1,
        EventProof::Elsewhere => 0,
    };
    met.iter().max_by_key(rank).copied()
}
