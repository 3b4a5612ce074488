//! This module makes the boundary construction diagram. With theta across and time upwards, it contains the
//! curves that bound the area that the cutter covers on a layer.
//!
//! The curves are f = 0, whose parts are the branches of the envelope, and the angles at which an end of the
//! flutes cuts off the ellipse, if the layer meets one. The topology of the curves is proved by interval
//! arithmetic and not sampled: see `time_slabs`.

mod circle_cells;
mod moving_roots;
pub(crate) mod time_segments;
mod time_slabs;

use super::section_family::{DiagramCurve, SectionFamily};
use super::trig_polynomial::AngleSinCos;
use time_segments::{RootTrack, TimeSegment};
pub use time_slabs::{EventProof, TopologyEvent};

/// The diagram of a step on a layer.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundaryDiagram {
    family: SectionFamily,
    stretches: Vec<TimeSegment>,
    events: Vec<TopologyEvent>,
    resolved: bool,
}

/// The kind of a branch's beginning or end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BranchEnd {
    /// It is at the first time, t = 0, or at the last, t = 1.
    Edge,
    /// It is in a fold, where two branches begin or end together.
    Fold,
    /// It is where branches cross, split or meet, or where the section stops moving; the resolution of time
    /// does not separate these cases.
    Open,
}

/// A branch of the envelope: theta as a function of time.
#[derive(Debug, Clone, PartialEq)]
pub struct EnvelopeBranch {
    /// Points of theta in radians (which may exceed one turn) and time, in the order of time.
    pub points: Vec<[f64; 2]>,
    /// The kind of its beginning.
    pub begins: BranchEnd,
    /// The kind of its end.
    pub ends: BranchEnd,
}

/// The state of the section's edge at a point of the diagram.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeState {
    /// The edge advances into fresh material.
    Advancing,
    /// The edge retreats or does not move.
    Retreating,
    /// There is no edge: the point is below the bottom disc or above the flutes.
    Outside,
}

impl BoundaryDiagram {
    /// Makes the diagram of a family of sections.
    pub fn new(family: &SectionFamily) -> Self {
        let slabs = time_slabs::cut_into_slabs(family);
        let resolved = !slabs.given_up;
        let (stretches, events) = time_segments::join_slabs(family, slabs);
        Self { family: *family, stretches, events, resolved }
    }

    /// Returns whether the whole diagram is resolved. It may not be if curves run along each other for some
    /// time without being equal to the bit.
    pub fn is_resolved(&self) -> bool {
        self.resolved
    }

    /// Returns the family of sections that the diagram belongs to.
    pub fn family(&self) -> &SectionFamily {
        &self.family
    }

    /// Returns the segments of time between events. They cover the times from 0 to 1 if the diagram is
    /// resolved.
    pub(crate) fn time_segments(&self) -> &[TimeSegment] {
        &self.stretches
    }

    /// Returns the events, at which the topology changes, in the order of time.
    pub fn events(&self) -> &[TopologyEvent] {
        &self.events
    }

    /// Returns the state of the edge at an angle (radians) and a time.
    pub fn edge_state_at(&self, theta: f64, t: f64) -> EdgeState {
        let angle = AngleSinCos::from_radians(theta);
        let value = |curve| self.family.curve_at(curve, t).value_at(&angle);
        if value(DiagramCurve::Bottom) < 0.0 || (self.family.has_top() && value(DiagramCurve::Top) < 0.0) {
            return EdgeState::Outside;
        }
        if value(DiagramCurve::Edge) < -self.family.zero_threshold() {
            EdgeState::Advancing
        } else {
            EdgeState::Retreating
        }
    }

    /// Returns the branches of the envelope, including parts that an end of the flutes cuts off, with `steps`
    /// pieces for each segment of time. A branch that continues through an event of another branch stays one
    /// branch.
    pub fn trace_branches(&self, steps: usize) -> Vec<EnvelopeBranch> {
        let mut done: Vec<EnvelopeBranch> = Vec::new();
        let mut growing: Vec<EnvelopeBranch> = Vec::new();
        for stretch in &self.stretches {
            let edges = stretch.tracks.iter().filter(|track| track.curve == DiagramCurve::Edge);
            let mut next: Vec<Vec<[f64; 2]>> =
                edges.map(|track| self.sample_track(stretch, track, steps)).collect();
            // At a fold two branches appear or disappear; all others continue at the angle where they were.
            let event = self.events.iter().find(|event| event.t == stretch.t[0]);
            let (ending, beginning) = find_fold_branches(event, &growing, &next);
            let mut going: Vec<EnvelopeBranch> = Vec::new();
            let fresh = remove_at_indices(&mut next, &beginning);
            let folded = remove_at_indices(&mut growing, &ending);
            done.extend(folded.into_iter().map(|branch| EnvelopeBranch { ends: BranchEnd::Fold, ..branch }));
            going.extend(fresh.into_iter().map(|points| EnvelopeBranch {
                points,
                begins: BranchEnd::Fold,
                ends: BranchEnd::Edge,
            }));
            for points in next {
                let start = points.first().map_or(0.0, |[theta, _]| *theta);
                let near = |branch: &EnvelopeBranch| {
                    time_segments::angular_distance(last_angle(branch), start) < NEAR
                };
                match growing.iter().position(near).map(|index| growing.swap_remove(index)) {
                    Some(mut branch) => {
                        branch.points.extend(points.into_iter().skip(1));
                        going.push(branch);
                    }
                    None => {
                        let begins = if stretch.t[0] <= 0.0 { BranchEnd::Edge } else { BranchEnd::Open };
                        going.push(EnvelopeBranch { points, begins, ends: BranchEnd::Edge });
                    }
                }
            }
            done.extend(growing.drain(..).map(|branch| EnvelopeBranch { ends: BranchEnd::Open, ..branch }));
            growing = going;
        }
        done.append(&mut growing);
        let key = |branch: &EnvelopeBranch| branch.points.first().copied().unwrap_or_default();
        done.sort_by(|a, b| key(a)[1].total_cmp(&key(b)[1]).then(key(a)[0].total_cmp(&key(b)[0])));
        done
    }

    /// Samples a track. The points are denser towards both ends, where folds are curved most.
    fn sample_track(&self, stretch: &TimeSegment, track: &RootTrack, steps: usize) -> Vec<[f64; 2]> {
        let [from, to] = stretch.t;
        let steps = steps.max(1);
        let at = |index: usize| {
            // Chebyshev points: the cosine makes the steps shrink quadratically towards the ends.
            let share = 0.5 - 0.5 * (std::f64::consts::PI * index as f64 / steps as f64).cos();
            let t = from + (to - from) * share;
            [stretch.track_angle_at(&self.family, track, t), t]
        };
        (0..=steps).map(at).collect()
    }
}

/// A branch continues behind an event if its angle changes by less than this, in radians.
const NEAR: f64 = 1e-2;

/// Returns the last angle of a branch.
fn last_angle(branch: &EnvelopeBranch) -> f64 {
    branch.points.last().map_or(0.0, |[theta, _]| *theta)
}

/// Finds the branches that end in a fold and the tracks that begin in one. They are the two that are nearest
/// to the fold's box.
fn find_fold_branches(
    event: Option<&TopologyEvent>,
    growing: &[EnvelopeBranch],
    next: &[Vec<[f64; 2]>],
) -> (Vec<usize>, Vec<usize>) {
    let Some(TopologyEvent { proof: EventProof::Fold { angles: [lo, hi], begins }, .. }) = event else {
        return (Vec::new(), Vec::new());
    };
    let middle = 0.5 * (lo + hi);
    let nearest = |angles: Vec<f64>| {
        let mut order: Vec<usize> = (0..angles.len()).collect();
        let off = |index: &usize| {
            angles.get(*index).map_or(f64::INFINITY, |x| time_segments::angular_distance(*x, middle))
        };
        order.sort_by(|a, b| off(a).total_cmp(&off(b)));
        order.truncate(2);
        order.sort_unstable();
        order
    };
    match (*begins, growing.len(), next.len()) {
        (true, before, after) if after == before + 2 => {
            let start = |points: &Vec<[f64; 2]>| points.first().map_or(0.0, |[theta, _]| *theta);
            (Vec::new(), nearest(next.iter().map(start).collect()))
        }
        (false, before, after) if before == after + 2 => {
            (nearest(growing.iter().map(last_angle).collect()), Vec::new())
        }
        _ => (Vec::new(), Vec::new()),
    }
}

/// Removes the items at some indices, which must ascend.
fn remove_at_indices<T>(from: &mut Vec<T>, places: &[usize]) -> Vec<T> {
    places.iter().rev().map(|place| from.remove(*place)).collect()
}
