//! The boundary construction diagram: theta across, time up, and in it the curves that bound what the cutter covers on a layer.
//!
//! The curves are f = 0 (the envelope's branches) and, where the layer meets an end of the flutes, the places where the ellipse is cut
//! off. Their topology is proved by interval arithmetic: see [`slab`].

mod cells;
mod moving;
pub mod slab;
pub mod stretch;

use super::family::{Curve, Family};
use super::trig::Angle;
use slab::{Event, Proof};
use stretch::{Stretch, Track};

/// The diagram of a step on a layer.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagram {
    family: Family,
    stretches: Vec<Stretch>,
    events: Vec<Event>,
    resolved: bool,
}

/// How a branch begins or ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// On the first edge, t = 0, or the last, t = 1.
    Edge,
    /// In a fold, together with another branch.
    Fold,
    /// Where branches cross, split or meet, or where the section stops moving: not told apart at the resolution of time.
    Open,
}

/// A branch of the envelope: theta as a function of time.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// Theta in radians (not brought back to one turn) and time, in time's order.
    pub points: Vec<[f64; 2]>,
    /// How it begins.
    pub begins: End,
    /// How it ends.
    pub ends: End,
}

/// What the edge does at a place of the diagram.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Region {
    /// It advances into fresh material.
    Advancing,
    /// It retreats, or stands still.
    Retreating,
    /// No edge: below the bottom disc or above the flutes.
    Outside,
}

impl Diagram {
    /// The diagram of a family.
    pub fn new(family: &Family) -> Self {
        let slabs = slab::slabs(family);
        let resolved = !slabs.given_up;
        let (stretches, events) = stretch::stretches(family, slabs);
        Self { family: *family, stretches, events, resolved }
    }

    /// Whether all of it was told apart. Curves that run along each other for a while, though not to the bit, may not be.
    pub fn is_resolved(&self) -> bool {
        self.resolved
    }

    /// The family that it is of.
    pub fn family(&self) -> &Family {
        &self.family
    }

    /// Stretches of time from event to event; from 0 to 1 when everything was told apart.
    pub fn stretches(&self) -> &[Stretch] {
        &self.stretches
    }

    /// Where the topology changes, in time's order.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// What the edge does at an angle (radians) and a time.
    pub fn region(&self, theta: f64, t: f64) -> Region {
        let angle = Angle::of(theta);
        let value = |curve| self.family.curve(curve, t).value(&angle);
        if value(Curve::Bottom) < 0.0 || (self.family.has_top() && value(Curve::Top) < 0.0) {
            return Region::Outside;
        }
        if value(Curve::Edge) < -self.family.still() { Region::Advancing } else { Region::Retreating }
    }

    /// The branches of the envelope, also where they are cut off, with `steps` pieces for each stretch of time. A branch that goes
    /// on through an event that concerns another one is one branch.
    pub fn branches(&self, steps: usize) -> Vec<Branch> {
        let mut done: Vec<Branch> = Vec::new();
        let mut growing: Vec<Branch> = Vec::new();
        for stretch in &self.stretches {
            let edges = stretch.tracks.iter().filter(|track| track.curve == Curve::Edge);
            let mut next: Vec<Vec<[f64; 2]>> =
                edges.map(|track| self.points(stretch, track, steps)).collect();
            let event = self.events.iter().find(|event| event.t == stretch.t[0]);
            let (ending, beginning) = folding(event, &growing, &next);
            let mut going: Vec<Branch> = Vec::new();
            let fresh = taken(&mut next, &beginning);
            let folded = taken(&mut growing, &ending);
            done.extend(folded.into_iter().map(|branch| Branch { ends: End::Fold, ..branch }));
            going.extend(fresh.into_iter().map(|points| Branch {
                points,
                begins: End::Fold,
                ends: End::Edge,
            }));
            for points in next {
                let start = points.first().map_or(0.0, |[theta, _]| *theta);
                let near = |branch: &Branch| stretch::distance(last(branch), start) < NEAR;
                match growing.iter().position(near).map(|index| growing.swap_remove(index)) {
                    Some(mut branch) => {
                        branch.points.extend(points.into_iter().skip(1));
                        going.push(branch);
                    }
                    None => {
                        let begins = if stretch.t[0] <= 0.0 { End::Edge } else { End::Open };
                        going.push(Branch { points, begins, ends: End::Edge });
                    }
                }
            }
            done.extend(growing.drain(..).map(|branch| Branch { ends: End::Open, ..branch }));
            growing = going;
        }
        done.append(&mut growing);
        let key = |branch: &Branch| branch.points.first().copied().unwrap_or_default();
        done.sort_by(|a, b| key(a)[1].total_cmp(&key(b)[1]).then(key(a)[0].total_cmp(&key(b)[0])));
        done
    }

    /// Points of a track, denser towards both ends, where folds have their bend.
    fn points(&self, stretch: &Stretch, track: &Track, steps: usize) -> Vec<[f64; 2]> {
        let [from, to] = stretch.t;
        let steps = steps.max(1);
        let at = |index: usize| {
            let share = 0.5 - 0.5 * (std::f64::consts::PI * index as f64 / steps as f64).cos();
            let t = from + (to - from) * share;
            [stretch.theta(&self.family, track, t), t]
        };
        (0..=steps).map(at).collect()
    }
}

/// A branch that goes on behind an event is this near to where it was, radians.
const NEAR: f64 = 1e-2;

fn last(branch: &Branch) -> f64 {
    branch.points.last().map_or(0.0, |[theta, _]| *theta)
}

/// Which branches end in a fold, and which tracks begin in one: two each, nearest to the fold's box.
fn folding(event: Option<&Event>, growing: &[Branch], next: &[Vec<[f64; 2]>]) -> (Vec<usize>, Vec<usize>) {
    let Some(Event { proof: Proof::Fold { angles: [lo, hi], begins }, .. }) = event else {
        return (Vec::new(), Vec::new());
    };
    let middle = 0.5 * (lo + hi);
    let nearest = |angles: Vec<f64>| {
        let mut order: Vec<usize> = (0..angles.len()).collect();
        let off = |index: &usize| angles.get(*index).map_or(f64::INFINITY, |x| stretch::distance(*x, middle));
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
            (nearest(growing.iter().map(last).collect()), Vec::new())
        }
        _ => (Vec::new(), Vec::new()),
    }
}

/// Takes out what stands at some places, in order.
fn taken<T>(from: &mut Vec<T>, places: &[usize]) -> Vec<T> {
    places.iter().rev().map(|place| from.remove(*place)).collect()
}
