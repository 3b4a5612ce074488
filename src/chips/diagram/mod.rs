//! The boundary construction diagram: theta across, time up, and in it the curves that bound what the cutter covers on a layer.
//!
//! The curves are f = 0 (the envelope's branches) and, where the layer meets an end of the flutes, the places where the ellipse is cut
//! off. Their topology is proved by interval arithmetic: see [`slab`].

mod cells;
pub mod slab;
pub mod stretch;

use super::family::{Curve, Family};
use super::trig::Angle;
use slab::{Event, Proof};
use stretch::Stretch;

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
            let mut next: Vec<Branch> = Vec::new();
            for track in stretch.tracks.iter().filter(|track| track.curve == Curve::Edge) {
                let at = |index: usize| {
                    let [from, to] = stretch.t;
                    // Denser towards both ends, where folds have their bend.
                    let share = 0.5 - 0.5 * (std::f64::consts::PI * index as f64 / steps.max(1) as f64).cos();
                    let t = from + (to - from) * share;
                    [stretch.theta(&self.family, track, t), t]
                };
                let points: Vec<[f64; 2]> = (0..=steps.max(1)).map(at).collect();
                let start = points.first().copied().unwrap_or_default();
                let event = self.event(stretch.t[0]);
                let before = growing.iter().position(|branch| goes_on(branch, start, event));
                match before.map(|index| growing.swap_remove(index)) {
                    Some(mut branch) => {
                        branch.points.extend(points.into_iter().skip(1));
                        next.push(branch);
                    }
                    None => {
                        let begins = end(event, start);
                        next.push(Branch { points, begins, ends: End::Edge });
                    }
                }
            }
            for mut branch in growing.drain(..) {
                let last = branch.points.last().copied().unwrap_or_default();
                branch.ends = end(self.event(last[1]), last);
                done.push(branch);
            }
            growing = next;
        }
        done.append(&mut growing);
        let key = |branch: &Branch| branch.points.first().copied().unwrap_or_default();
        done.sort_by(|a, b| key(a)[1].total_cmp(&key(b)[1]).then(key(a)[0].total_cmp(&key(b)[0])));
        done
    }

    fn event(&self, t: f64) -> Option<&Event> {
        self.events.iter().find(|event| event.t == t)
    }
}

/// Whether a branch up to an event goes on at a place behind it: it is there, and not in the event's box.
fn goes_on(branch: &Branch, [theta, _]: [f64; 2], event: Option<&Event>) -> bool {
    let Some([last, _]) = branch.points.last() else { return false };
    stretch::distance(*last, theta) < 1e-4 && !event.is_some_and(|event| inside(event, theta))
}

fn inside(event: &Event, theta: f64) -> bool {
    match event.proof {
        Proof::Fold { angles: [lo, hi], .. } | Proof::Open { angles: [lo, hi] } => {
            let (middle, half) = (0.5 * (lo + hi), 0.5 * (hi - lo));
            stretch::distance(theta, middle) <= half + 1e-4
        }
        Proof::Elsewhere => false,
    }
}

fn end(event: Option<&Event>, [theta, t]: [f64; 2]) -> End {
    match event {
        Some(event) if inside(event, theta) => match event.proof {
            Proof::Fold { .. } => End::Fold,
            _ => End::Open,
        },
        None if t <= 0.0 || t >= 1.0 => End::Edge,
        _ if t <= 0.0 || t >= 1.0 => End::Edge,
        _ => End::Open,
    }
}
