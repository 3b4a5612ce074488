//! The boundary construction diagram: theta across, time up, and in it the curves that bound what the cutter covers on a layer.
//!
//! The curves are f = 0 (the envelope's branches) and, where the layer meets an end of the flutes, the places where the ellipse is cut
//! off. Their topology is proved by interval arithmetic: see [`time_slabs`].

mod circle_cells;
mod moving_roots;
pub mod time_segments;
pub mod time_slabs;

use super::section_family::{DiagramCurve, SectionFamily};
use super::trig_polynomial::AngleSinCos;
use time_segments::{RootTrack, TimeSegment};
use time_slabs::{EventProof, TopologyEvent};

/// The diagram of a step on a layer.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundaryDiagram {
    family: SectionFamily,
    stretches: Vec<TimeSegment>,
    events: Vec<TopologyEvent>,
    resolved: bool,
}

/// How a branch begins or ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BranchEnd {
    /// On the first edge, t = 0, or the last, t = 1.
    Edge,
    /// In a fold, together with another branch.
    Fold,
    /// Where branches cross, split or meet, or where the section stops moving: not told apart at the resolution of time.
    Open,
}

/// A branch of the envelope: theta as a function of time.
#[derive(Debug, Clone, PartialEq)]
pub struct EnvelopeBranch {
    /// Theta in radians (not brought back to one turn) and time, in time's order.
    pub points: Vec<[f64; 2]>,
    /// How it begins.
    pub begins: BranchEnd,
    /// How it ends.
    pub ends: BranchEnd,
}

/// What the edge does at a place of the diagram.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeState {
    /// It advances into fresh material.
    Advancing,
    /// It retreats, or stands still.
    Retreating,
    /// No edge: below the bottom disc or above the flutes.
    Outside,
}

impl BoundaryDiagram {
    /// The diagram of a family.
    pub fn new(family: &SectionFamily) -> Self {
        let slabs = time_slabs::cut_into_slabs(family);
        let resolved = !slabs.given_up;
        let (stretches, events) = time_segments::join_slabs(family, slabs);
        Self { family: *family, stretches, events, resolved }
    }

    /// Whether all of it was told apart. Curves that run along each other for a while, though not to the bit, may not be.
    pub fn is_resolved(&self) -> bool {
        self.resolved
    }

    /// The family that it is of.
    pub fn family(&self) -> &SectionFamily {
        &self.family
    }

    /// Stretches of time from event to event; from 0 to 1 when everything was told apart.
    pub fn time_segments(&self) -> &[TimeSegment] {
        &self.stretches
    }

    /// Where the topology changes, in time's order.
    pub fn events(&self) -> &[TopologyEvent] {
        &self.events
    }

    /// What the edge does at an angle (radians) and a time.
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

    /// The branches of the envelope, also where they are cut off, with `steps` pieces for each stretch of time. A branch that goes
    /// on through an event that concerns another one is one branch.
    pub fn trace_branches(&self, steps: usize) -> Vec<EnvelopeBranch> {
        let mut done: Vec<EnvelopeBranch> = Vec::new();
        let mut growing: Vec<EnvelopeBranch> = Vec::new();
        for stretch in &self.stretches {
            let edges = stretch.tracks.iter().filter(|track| track.curve == DiagramCurve::Edge);
            let mut next: Vec<Vec<[f64; 2]>> =
                edges.map(|track| self.sample_track(stretch, track, steps)).collect();
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

    /// Points of a track, denser towards both ends, where folds have their bend.
    fn sample_track(&self, stretch: &TimeSegment, track: &RootTrack, steps: usize) -> Vec<[f64; 2]> {
        let [from, to] = stretch.t;
        let steps = steps.max(1);
        let at = |index: usize| {
            let share = 0.5 - 0.5 * (std::f64::consts::PI * index as f64 / steps as f64).cos();
            let t = from + (to - from) * share;
            [stretch.track_angle_at(&self.family, track, t), t]
        };
        (0..=steps).map(at).collect()
    }
}

/// A branch that goes on behind an event is this near to where it was, radians.
const NEAR: f64 = 1e-2;

fn last_angle(branch: &EnvelopeBranch) -> f64 {
    branch.points.last().map_or(0.0, |[theta, _]| *theta)
}

/// Which branches end in a fold, and which tracks begin in one: two each, nearest to the fold's box.
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

/// Takes out what stands at some places, in order.
fn remove_at_indices<T>(from: &mut Vec<T>, places: &[usize]) -> Vec<T> {
    places.iter().rev().map(|place| from.remove(*place)).collect()
}
