//! Intervals of time in which nothing changes in the diagram's topology, and the events between them.
//!
//! Over an interval of time every curve is enclosed by interval arithmetic. When each cell of the circle has a curve of one sign, or one
//! that only rises or falls, its roots are known to be functions of time, one in each bracket; when the brackets of different curves are
//! apart, so is the order of the roots. Otherwise the interval is halved, down to an eight-millionth of the step, where something
//! happens: a fold (a branch of the envelope begins or ends), a split, a branch that runs into the bottom disc's chord.

use super::cells::{Bracket, Cells, Roots};
use super::moving;
use crate::chips::cover::GRAZES;
use crate::chips::family::{Curve, Family, Window};
use crate::chips::interval::Interval;
use crate::chips::trig::{Angle, Trig};

/// Shortest interval of time that is halved: an eight-millionth of the step.
const SHORTEST: f64 = 1.0 / (1 << 23) as f64;

/// Narrowest cells for an interval of the whole step, radians; those of shorter ones go with the root of time, as folds do.
const FINEST: f64 = 0.1;

/// Events at most; a diagram with more has curves that coincide.
const MOST_EVENTS: usize = 512;

/// Slabs at most, likewise.
const MOST_SLABS: usize = 4096;

/// An interval of time in which the roots of all curves are functions of time that do not cross.
#[derive(Debug, Clone, PartialEq)]
pub struct Slab {
    /// Beginning and end.
    pub t: [f64; 2],
    /// The roots by curve, in the order of [`Curve::ALL`]; those of the face only where there is a chord.
    pub roots: [Roots; 4],
}

/// What happens to the envelope at an event, so far as it was proved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Proof {
    /// In the box of angles, the envelope is one arc with one lowest (or highest) time: two branches begin (`true`) or end there.
    Fold {
        /// Least and largest angle, radians.
        angles: [f64; 2],
        /// Whether they begin.
        begins: bool,
    },
    /// Not told apart at this resolution: branches may cross, split or meet in the box.
    Open {
        /// Least and largest angle, radians.
        angles: [f64; 2],
    },
    /// Nothing happens to the envelope itself; it meets a chord, or a chord comes or goes.
    Elsewhere,
}

/// A time at which the topology changes, known to an eight-millionth of the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// When.
    pub t: f64,
    /// What happens to the envelope.
    pub proof: Proof,
}

/// The step in slabs, with the events between them; events next to each other in time are one.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Slabs {
    /// In time's order.
    pub slabs: Vec<Slab>,
    /// In time's order.
    pub events: Vec<Event>,
    /// Whether there were so many of either that the rest was left out: curves that run along each other.
    pub given_up: bool,
}

/// Cuts the whole step into slabs.
pub fn slabs(family: &Family) -> Slabs {
    let mut found = Slabs::default();
    let circle = Cells::new();
    let circles = Circles([circle.clone(), circle.clone(), circle.clone(), circle]);
    explore(family, Interval { lo: 0.0, hi: 1.0 }, circles, &mut found);
    found
}

/// The circle in cells, for every curve.
#[derive(Clone)]
struct Circles([Cells; 4]);

fn explore(family: &Family, t: Interval, mut circles: Circles, found: &mut Slabs) {
    if found.events.len() >= MOST_EVENTS || found.slabs.len() >= MOST_SLABS {
        found.given_up = true;
        return;
    }
    let window = family.over(t);
    let finest = FINEST * (t.hi - t.lo).sqrt();
    if let Some(roots) = certain(family, &window, &mut circles, finest) {
        found.slabs.push(Slab { t: [t.lo, t.hi], roots });
        return;
    }
    if t.hi - t.lo <= SHORTEST {
        let [edge, ..] = &circles.0;
        let event = Event { t: t.middle(), proof: proof(&window, edge) };
        found.events.push(event);
        return;
    }
    let middle = t.middle();
    explore(family, Interval { lo: t.lo, hi: middle }, circles.clone(), found);
    explore(family, Interval { lo: middle, hi: t.hi }, circles, found);
}

/// The roots of all curves, if they are certain and apart.
fn certain(family: &Family, window: &Window<'_>, circles: &mut Circles, finest: f64) -> Option<[Roots; 4]> {
    let [edge_cells, bottom_cells, top_cells, face_cells] = &mut circles.0;
    let (edge, _) = window.curve(Curve::Edge);
    let edge_roots = if edge.magnitude() <= family.still() {
        Roots { brackets: Vec::new(), positive: true }
    } else {
        roots(edge_cells, &edge, finest)?
    };
    let (bottom, _) = window.curve(Curve::Bottom);
    let bottom_roots = end_roots(bottom_cells, &bottom, finest)?;
    let nothing = Roots { brackets: Vec::new(), positive: true };
    let mut top_roots = nothing.clone();
    if family.has_top() {
        let (curve, _) = window.curve(Curve::Top);
        top_roots = end_roots(top_cells, &curve, finest)?;
    }
    if bottom_roots.brackets.is_empty() && top_roots.brackets.is_empty() {
        return Some([edge_roots, bottom_roots, top_roots, nothing]);
    }
    let (face, _) = window.curve(Curve::Face);
    // A disc that slides in its own plane neither advances nor retreats anywhere.
    let slides = face.magnitude() <= family.still() / family.step().mill().radius;
    let face_roots = if slides { nothing } else { roots(face_cells, &face, finest)? };
    // Turning about the tip, f is zero all along the bottom disc's rim: the order of two curves that are one does not matter.
    let pivots = family.pivots_about_tip();
    let others = [(&edge_roots, Curve::Edge, pivots), (&face_roots, Curve::Face, false)];
    for (other, curve, same) in others {
        (same || apart(&bottom_roots, Curve::Bottom, other, curve, window)).then_some(())?;
        apart(&top_roots, Curve::Top, other, curve, window).then_some(())?;
    }
    apart(&bottom_roots, Curve::Bottom, &top_roots, Curve::Top, window).then_some(())?;
    Some([edge_roots, bottom_roots, top_roots, face_roots])
}

/// The roots of an end of the flutes.
fn end_roots(cells: &mut Cells, curve: &Trig<Interval>, finest: f64) -> Option<Roots> {
    // An upright end in the layer's height cuts everything off, however rounding has it.
    if curve.magnitude() <= GRAZES {
        return Some(Roots { brackets: Vec::new(), positive: false });
    }
    roots(cells, curve, finest)
}

fn roots(cells: &mut Cells, curve: &Trig<Interval>, finest: f64) -> Option<Roots> {
    let Trig([constant, others @ ..]) = curve;
    let swing: f64 = others.iter().map(|k| k.magnitude()).sum();
    // Most layers are nowhere near the ends of the flutes.
    if constant.lo > swing || constant.hi < -swing {
        return Some(Roots { brackets: Vec::new(), positive: constant.lo > 0.0 });
    }
    cells.look(curve, finest);
    cells.roots(curve)
}

/// Whether no root of one curve meets one of the other.
fn apart(a: &Roots, a_curve: Curve, b: &Roots, b_curve: Curve, window: &Window<'_>) -> bool {
    for a in &a.brackets {
        for b in &b.brackets {
            if meet(a, b) && !moving::apart(a, a_curve, b_curve, window) {
                return false;
            }
        }
    }
    true
}

fn meet(a: &Bracket, b: &Bracket) -> bool {
    let turn = std::f64::consts::TAU;
    [-turn, 0.0, turn].into_iter().any(|shift| a.lo <= b.hi + shift && b.lo + shift <= a.hi)
}

/// What can be said of the envelope in the box of which nothing is known.
fn proof(window: &Window<'_>, cells: &Cells) -> Proof {
    let Some(x) = cells.unknown() else { return Proof::Elsewhere };
    let (edge, rate) = window.curve(Curve::Edge);
    let angle = Angle::over(x);
    // Where f_t and f_xx keep their signs the zero set is t(x) with t'' = -f_xx / f_t wherever t' = 0: at most one extremum.
    match (rate.value(&angle).sign(), edge.bend(&angle).sign()) {
        (Some(later), Some(bend)) => Proof::Fold { angles: [x.lo, x.hi], begins: later != bend },
        _ => Proof::Open { angles: [x.lo, x.hi] },
    }
}
