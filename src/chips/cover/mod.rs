//! The area that the cutter covers on a layer between two places.
//!
//! Whatever is covered but not at the beginning was entered at some time through the section's edge where that advances. So the covered
//! area is the first section together with the images of the diagram's advancing regions. Each region (`bands`) maps to the plane
//! without folding, f having one sign in it: its border's image winds around a point as often as the edge enters it, and the union is
//! what any of the borders winds around.

mod bands;
mod outline;
mod rim;
mod sliced;

pub use outline::Cut;
pub(super) use outline::GRAZES;
pub use rim::Rim;

use super::diagram::Diagram;
use super::diagram::stretch::Stretch;
use super::ellipse::Ellipse;
use super::family::{Curve, Family};
use super::trig::Trig;
use bands::Root;
use outline::{Cuts, outline, outline_with_caps};

/// Slices for a diagram that is not resolved: a turn of a radian with a lever of 50 mm is missed by 0.4 micrometres.
const SLICES: usize = 128;

/// What a cutter covers on one layer between two places. Closed borders of x, y in mm; none repeats its first point.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cover {
    /// The section at the first place: convex, counter-clockwise; empty where the cutter does not reach the layer.
    pub first: Vec<[f64; 2]>,
    /// The section at the last place, likewise.
    pub last: Vec<[f64; 2]>,
    /// Borders of everything that the edge enters on its way; an area is covered where they wind around it at all (their
    /// winding numbers are nowhere negative). Parts of `first` may be covered again.
    pub advancing: Vec<Vec<[f64; 2]>>,
    /// How both sections came about; `None` where that is not known.
    pub seams: Option<[Seam; 2]>,
    /// What the ends of the envelope's branches, which are corners of `first`, add to it: parts of it along its border.
    pub caps: Vec<Vec<[f64; 2]>>,
}

/// All that a section depends on but for the ends of the envelope's branches. A step that goes on from another one begins with the seam
/// that the other one ended with, to the bit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seam {
    ellipse: Ellipse,
    ends: [Option<Trig<f64>>; 2],
    cuts: Cuts,
    directions: usize,
}

impl Cover {
    /// What the family of a diagram covers. Points lie on the true borders; chords between them are within the rim's tolerance. From
    /// slices where the diagram is not resolved: see [`Cover::sliced`].
    pub fn new(diagram: &Diagram, rim: &Rim) -> Self {
        let family = diagram.family();
        if !diagram.is_resolved() {
            return sliced::cover(family, rim, SLICES);
        }
        let stretches = diagram.stretches();
        let roots: Vec<Vec<Root<'_>>> = stretches.iter().map(|stretch| Root::all(family, stretch)).collect();
        let (Some(begin), Some(end)) = (stretches.first(), stretches.last()) else { return Self::default() };
        let cuts = [begin, end].map(|stretch| Cuts::of(family, stretch));
        let [before, behind] = cuts;
        let (first, caps) = outline_with_caps(family, rim, 0.0, before, &nodes(None, roots.first()));
        let mut cover = Self {
            first,
            last: outline(family, rim, 1.0, behind, &nodes(roots.last(), None)),
            advancing: Vec::new(),
            seams: Some([Seam::of(family, rim, 0.0, before), Seam::of(family, rim, 1.0, behind)]),
            caps,
        };
        let mut before: Option<(&Stretch, &Vec<Root<'_>>)> = None;
        for (index, (stretch, here)) in stretches.iter().zip(&roots).enumerate() {
            let bottom = nodes(before.map(|(_, roots)| roots), Some(here));
            let top = nodes(Some(here), roots.get(index + 1));
            if let Some((before, _)) = before {
                // The section itself closes whatever the resolution of the event leaves open, and is what appears at once when an upright
                // cutter's bottom reaches the layer.
                let (old, new) = (Cuts::of(family, before), Cuts::of(family, stretch));
                cover.add(outline(family, rim, stretch.t[0], new, &bottom));
                if old != new {
                    cover.add(outline(family, rim, stretch.t[0], old, &bottom));
                }
            }
            bands::borders(family, rim, stretch, here, [&bottom, &top], &mut cover.advancing);
            before = Some((stretch, here));
        }
        cover
    }

    /// The same without a diagram: hulls of the sections at the ends of equal slices of time. Exact where the axis stands; else a slice
    /// misses by the square of what the axis turns in it, times an eighth of the lever.
    pub fn sliced(family: &Family, rim: &Rim, slices: usize) -> Self {
        sliced::cover(family, rim, slices)
    }

    /// The sections at `count + 1` evenly spaced times, for a union by brute force.
    pub fn sections(family: &Family, rim: &Rim, count: usize) -> Vec<Vec<[f64; 2]>> {
        sliced::sections(family, rim, count)
    }

    fn add(&mut self, border: Vec<[f64; 2]>) {
        if border.len() > 2 {
            self.advancing.push(border);
        }
    }

    /// Whether nothing is entered.
    pub fn is_empty(&self) -> bool {
        self.advancing.is_empty()
    }
}

impl Seam {
    fn of(family: &Family, rim: &Rim, t: f64, cuts: Cuts) -> Self {
        let ellipse = Ellipse { velocity: [0.0; 2], ..family.ellipse(t) };
        let ends = [Curve::Bottom, Curve::Top].map(|curve| family.has(curve).then(|| family.curve(curve, t)));
        Self { ellipse, ends, cuts, directions: rim.count() }
    }
}

/// Angles of the envelope's branches where one stretch ends and another begins: corners of borders on both sides, which must be corners of
/// both.
fn nodes(before: Option<&Vec<Root<'_>>>, behind: Option<&Vec<Root<'_>>>) -> Vec<f64> {
    let edges = |roots: Option<&Vec<Root<'_>>>, end: fn([f64; 2]) -> f64| -> Vec<f64> {
        let roots = roots.into_iter().flatten().filter(|root| root.curve() == Curve::Edge);
        roots.map(|root| end(root.ends()).rem_euclid(std::f64::consts::TAU)).collect()
    };
    let mut angles = edges(before, |[_, end]| end);
    angles.extend(edges(behind, |[begin, _]| begin));
    angles.sort_by(f64::total_cmp);
    angles.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    angles
}
