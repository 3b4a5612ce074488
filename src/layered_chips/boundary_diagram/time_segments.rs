//! Stretches of time from one event to the next, with the curves' roots as functions of time.

use super::circle_cells::RootBracket;
use super::time_slabs::{DiagramSlab, DiagramSlabs, TopologyEvent};
use crate::layered_chips::section_family::{DiagramCurve, SectionFamily};
use std::f64::consts::TAU;

/// Two roots closer than this (radians) at a border of slabs are one. Only at a fold two different ones come nearer.
const SAME: f64 = 1e-6;

/// A root through a stretch.
#[derive(Debug, Clone, PartialEq)]
pub struct RootTrack {
    /// Which curve's.
    pub curve: DiagramCurve,
    /// Whether the curve rises with the angle.
    pub rising: bool,
    /// One for each slab.
    brackets: Vec<RootBracket>,
}

/// From one event to the next: within it, roots neither come nor go, and do not cross.
#[derive(Debug, Clone, PartialEq)]
pub struct TimeSegment {
    /// Beginning and end.
    pub t: [f64; 2],
    /// Ends of its slabs, one for each.
    ends: Vec<f64>,
    /// The roots of edge, bottom and top.
    pub tracks: Vec<RootTrack>,
}

impl TimeSegment {
    /// The angle of a track at a time, radians: never left of its bracket at the beginning by more than a turn.
    pub fn track_angle_at(&self, family: &SectionFamily, track: &RootTrack, t: f64) -> f64 {
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

    /// Goes on with the next slab, unless the roots differ there.
    fn try_extend(&mut self, family: &SectionFamily, next: Self) -> Result<(), Self> {
        if self.tracks.len() != next.tracks.len() {
            return Err(next);
        }
        let t = self.t[1];
        let here: Vec<f64> = self.tracks.iter().map(|track| self.track_angle_at(family, track, t)).collect();
        let there: Vec<f64> = next.tracks.iter().map(|track| next.track_angle_at(family, track, t)).collect();
        // Which track goes on in which: the nearest root of the same curve and sense, each once.
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
                // On the same turn of the circle.
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

/// Distance of two angles on the circle, radians.
pub fn angular_distance(a: f64, b: f64) -> f64 {
    let d = (a - b).rem_euclid(TAU);
    d.min(TAU - d)
}

/// Puts slabs together; each event between stretches shrinks to its middle, and stretches reach up to it.
///
/// Gives the stretches and the events at their borders: where several are next to each other, the first that tells most.
pub fn join_slabs(family: &SectionFamily, slabs: DiagramSlabs) -> (Vec<TimeSegment>, Vec<TopologyEvent>) {
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

fn strongest_event(met: &[TopologyEvent]) -> Option<TopologyEvent> {
    use super::time_slabs::EventProof;
    let rank = |event: &&TopologyEvent| match event.proof {
        EventProof::Open { .. } => 2,
        EventProof::Fold { .. } => 1,
        EventProof::Elsewhere => 0,
    };
    met.iter().max_by_key(rank).copied()
}
