//! This module divides the time of a step into slabs, in which the diagram's topology does not change, and
//! events between them.
//!
//! The topology is proved. Over an interval of time every curve is enclosed by interval arithmetic. If each
//! cell of the circle has a curve of one sign, or a curve that only rises or only falls, then its roots are
//! functions of time, one in each bracket between two certain signs. If the brackets of different curves are
//! apart, the order of the roots is also certain. Otherwise the interval is bisected, down to an
//! eight-millionth of the step. An interval that short is an event: a fold (a branch of the envelope begins
//! or ends, shown by the signs of f_t and f_xx), a split, or a branch that meets the chord of the bottom
//! disc. Curves that run along each other have too many events; the covered area is then made of slices of
//! time, and never of a guess.

use super::circle_cells::{CircleCells, CurveRoots, RootBracket};
use super::moving_roots;
use crate::layered_chips::interval::IntervalF64;
use crate::layered_chips::section_family::{DiagramCurve, FamilyWindow, GRAZES, SectionFamily};
use crate::layered_chips::trig_polynomial::{AngleSinCos, TrigPolynomial};

/// The shortest interval of time that is bisected: an eight-millionth of the step.
const SHORTEST: f64 = 1.0 / (1 << 23) as f64;

/// The narrowest cells for an interval of the whole step, radians. For shorter intervals they shrink with the
/// root of the time, as folds do.
const FINEST: f64 = 0.1;

/// The most events. A diagram with more has curves that coincide.
const MOST_EVENTS: usize = 512;

/// The most slabs, for the same reason.
const MOST_SLABS: usize = 4096;

/// An interval of time in which the roots of all curves are functions of time that do not cross.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DiagramSlab {
    /// The beginning and the end.
    pub t: [f64; 2],
    /// The roots of each curve, in the order of [`DiagramCurve::ALL`]. Those of the face are only found where
    /// there is a chord.
    pub roots: [CurveRoots; 4],
}

/// What is proved about the envelope at an event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EventProof {
    /// In the box of angles, the envelope is one arc with one lowest or highest time, where two branches
    /// begin or end.
    Fold {
        /// The least and the largest angle, radians.
        angles: [f64; 2],
        /// Whether the branches begin there; otherwise they end.
        begins: bool,
    },
    /// The event is not resolved: branches may cross, split or meet in the box of angles.
    Open {
        /// The least and the largest angle, radians.
        angles: [f64; 2],
    },
    /// Nothing happens to the envelope itself: it meets a chord, or a chord appears or disappears.
    Elsewhere,
}

/// A time at which the topology changes, known to an eight-millionth of the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TopologyEvent {
    /// The time of the event.
    pub t: f64,
    /// What is proved about the envelope.
    pub proof: EventProof,
}

/// The slabs of a step and the events between them. Events next to each other in time are one event.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct DiagramSlabs {
    /// The slabs in the order of time.
    pub slabs: Vec<DiagramSlab>,
    /// The events in the order of time.
    pub events: Vec<TopologyEvent>,
    /// Whether there were so many slabs or events that the rest was left out, because curves run along each
    /// other.
    pub given_up: bool,
}

/// Divides the whole step into slabs.
pub(crate) fn cut_into_slabs(family: &SectionFamily) -> DiagramSlabs {
    let mut found = DiagramSlabs::default();
    let circle = CircleCells::new();
    let circles = CurveCells([circle.clone(), circle.clone(), circle.clone(), circle]);
    bisect_time(family, IntervalF64 { lo: 0.0, hi: 1.0 }, circles, &mut found);
    found
}

/// The cells of the circle for every curve.
#[derive(Clone)]
struct CurveCells([CircleCells; 4]);

/// Adds the slabs and events of an interval of time; bisects the interval until its topology is certain.
fn bisect_time(family: &SectionFamily, t: IntervalF64, mut circles: CurveCells, found: &mut DiagramSlabs) {
    if found.events.len() >= MOST_EVENTS || found.slabs.len() >= MOST_SLABS {
        found.given_up = true;
        return;
    }
    let window = family.window_over(t);
    let finest = FINEST * (t.hi - t.lo).sqrt();
    if let Some(roots) = isolate_all_roots(family, &window, &mut circles, finest) {
        found.slabs.push(DiagramSlab { t: [t.lo, t.hi], roots });
        return;
    }
    if t.hi - t.lo <= SHORTEST {
        let [edge, ..] = &circles.0;
        let event = TopologyEvent { t: t.middle(), proof: prove_event(&window, edge) };
        found.events.push(event);
        return;
    }
    let middle = t.middle();
    bisect_time(family, IntervalF64 { lo: t.lo, hi: middle }, circles.clone(), found);
    bisect_time(family, IntervalF64 { lo: middle, hi: t.hi }, circles, found);
}

/// Returns the roots of all curves if they are certain and apart, else `None`.
fn isolate_all_roots(
    family: &SectionFamily,
    window: &FamilyWindow<'_>,
    circles: &mut CurveCells,
    finest: f64,
) -> Option<[CurveRoots; 4]> {
    let [edge_cells, bottom_cells, top_cells, face_cells] = &mut circles.0;
    let (edge, _) = window.enclose_curve(DiagramCurve::Edge);
    // A section that does not move has no envelope; its f is noise around zero.
    let edge_roots = if edge.max_magnitude() <= family.zero_threshold() {
        CurveRoots { brackets: Vec::new(), positive: true }
    } else {
        isolate_curve_roots(edge_cells, &edge, finest)?
    };
    let (bottom, _) = window.enclose_curve(DiagramCurve::Bottom);
    let bottom_roots = isolate_flute_end_roots(bottom_cells, &bottom, finest)?;
    let nothing = CurveRoots { brackets: Vec::new(), positive: true };
    let mut top_roots = nothing.clone();
    if family.has_top() {
        let (curve, _) = window.enclose_curve(DiagramCurve::Top);
        top_roots = isolate_flute_end_roots(top_cells, &curve, finest)?;
    }
    // Without chords the curves of face and chords need not be compared.
    if bottom_roots.brackets.is_empty() && top_roots.brackets.is_empty() {
        return Some([edge_roots, bottom_roots, top_roots, nothing]);
    }
    let (face, _) = window.enclose_curve(DiagramCurve::Face);
    // A disc that moves in its own plane neither advances nor retreats.
    let slides = face.max_magnitude() <= family.zero_threshold() / family.step().mill().radius_mm;
    let face_roots = if slides { nothing } else { isolate_curve_roots(face_cells, &face, finest)? };
    // If the mill turns about its tip, f is zero all along the rim of the bottom disc. The order of two equal
    // curves does not matter.
    let pivots = family.pivots_about_tip();
    let others = [(&edge_roots, DiagramCurve::Edge, pivots), (&face_roots, DiagramCurve::Face, false)];
    for (other, curve, same) in others {
        (same || has_no_common_root(&bottom_roots, DiagramCurve::Bottom, other, curve, window))
            .then_some(())?;
        has_no_common_root(&top_roots, DiagramCurve::Top, other, curve, window).then_some(())?;
    }
    has_no_common_root(&bottom_roots, DiagramCurve::Bottom, &top_roots, DiagramCurve::Top, window)
        .then_some(())?;
    Some([edge_roots, bottom_roots, top_roots, face_roots])
}

/// Returns the roots of the curve of an end of the flutes, or `None` if they are not certain.
fn isolate_flute_end_roots(
    cells: &mut CircleCells,
    curve: &TrigPolynomial<IntervalF64>,
    finest: f64,
) -> Option<CurveRoots> {
    // If a vertical mill ends at the layer's own height, everything counts as cut off, whatever the rounding
    // says.
    if curve.max_magnitude() <= GRAZES {
        return Some(CurveRoots { brackets: Vec::new(), positive: false });
    }
    isolate_curve_roots(cells, curve, finest)
}

/// Returns the roots of a curve, or `None` if they are not certain.
fn isolate_curve_roots(
    cells: &mut CircleCells,
    curve: &TrigPolynomial<IntervalF64>,
    finest: f64,
) -> Option<CurveRoots> {
    let TrigPolynomial([constant, others @ ..]) = curve;
    let swing: f64 = others.iter().map(|k| k.magnitude()).sum();
    // The constant outweighs the rest: most layers are far from the ends of the flutes.
    if constant.lo > swing || constant.hi < -swing {
        return Some(CurveRoots { brackets: Vec::new(), positive: constant.lo > 0.0 });
    }
    cells.classify_cells(curve, finest);
    cells.isolate_roots(curve)
}

/// Returns whether no root of one curve meets a root of the other.
fn has_no_common_root(
    a: &CurveRoots,
    a_curve: DiagramCurve,
    b: &CurveRoots,
    b_curve: DiagramCurve,
    window: &FamilyWindow<'_>,
) -> bool {
    for a in &a.brackets {
        for b in &b.brackets {
            if can_brackets_meet(a, b) && !moving_roots::is_root_apart(a, a_curve, b_curve, window) {
                return false;
            }
        }
    }
    true
}

/// Returns whether two brackets overlap on the circle.
fn can_brackets_meet(a: &RootBracket, b: &RootBracket) -> bool {
    let turn = std::f64::consts::TAU;
    [-turn, 0.0, turn].into_iter().any(|shift| a.lo <= b.hi + shift && b.lo + shift <= a.hi)
}

/// Returns what is proved about the envelope in the box of angles on which nothing is known.
fn prove_event(window: &FamilyWindow<'_>, cells: &CircleCells) -> EventProof {
    let Some(x) = cells.unknown_angles() else { return EventProof::Elsewhere };
    let (edge, rate) = window.enclose_curve(DiagramCurve::Edge);
    let angle = AngleSinCos::from_interval(x);
    // Where f_t and f_xx keep their signs, the zero set is a function t(x) with t'' = -f_xx / f_t wherever t'
    // = 0, so it has at most one extremum.
    match (rate.value_at(&angle).sign(), edge.second_derivative_at(&angle).sign()) {
        (Some(later), Some(bend)) => EventProof::Fold { angles: [x.lo, x.hi], begins: later != bend },
        _ => EventProof::Open { angles: [x.lo, x.hi] },
    }
}
