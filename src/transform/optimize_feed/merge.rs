//! Where a block is split: its pieces merged from the bottom up, the pair that costs least time first.

use super::feeds::{Block, Rules};
use super::margin::Atom;
use super::parts::{Bounds, Content};
use std::ops::Range;

/// What lengths may differ by, as a share, and be equal.
const NOISE: f64 = 1e-9;

/// A run of atoms that has one feed.
#[derive(Debug, Clone)]
struct Segment {
    atoms: Range<usize>,
    length: f64,
    content: Content,
    /// Time at its own feed.
    time: f64,
    /// Time of its atoms, each at its own feed: what splitting could reach.
    least_time: f64,
}

/// The parts of a block as ranges of atoms, in order.
///
/// Neighbours are merged while that loses no more than `min_change` of the time that their pieces need one by one. What is too
/// short then grows into the neighbour where that costs less; what is too many is merged on at the least cost.
pub(super) fn parts(
    block: &Block,
    bounds: &Bounds,
    atoms: &[Atom],
    range: Range<usize>,
    rules: &Rules,
) -> Vec<Range<usize>> {
    let rule = rules.split.filter(|rule| rule.applies_to(block));
    let Some(rule) = rule else { return vec![range] };
    let path = Pieces { atoms, bounds, programmed: block.programmed };
    let mut segments: Vec<Segment> = Vec::new();
    for index in range {
        let one = path.segment(index..index + 1);
        match segments.last_mut() {
            Some(last) if same(last.content, one.content) => *last = path.join(last, &one),
            _ => segments.push(one),
        }
    }
    // Air without a feed of its own keeps the programmed one, which may be the slower: it is not joined to gain time.
    let apart = |a: &Segment, b: &Segment| rules.air_feed.is_none() && a.content.cutting != b.content.cutting;
    let cheap = |a: &Segment, b: &Segment| {
        let joined = path.join(a, b);
        !apart(a, b) && joined.time <= (1.0 + rules.min_change) * joined.least_time * (1.0 + NOISE)
    };
    while let Some(at) = path.cheapest(&segments, cheap) {
        path.merge(&mut segments, at);
    }
    let enough = rule.shortest * (1.0 - NOISE);
    while let Some(at) = too_short(&segments, enough) {
        path.grow(&mut segments, at, enough);
    }
    while segments.len() > rule.at_most.max(1) {
        match path.cheapest(&segments, |_, _| true) {
            Some(at) => path.merge(&mut segments, at),
            None => break,
        }
    }
    segments.into_iter().map(|segment| segment.atoms).collect()
}

fn same(a: Content, b: Content) -> bool {
    (a.lowest, a.air, a.cutting) == (b.lowest, b.air, b.cutting)
}

/// The shortest of all segments that are too short, unless it is the only one.
fn too_short(segments: &[Segment], enough: f64) -> Option<usize> {
    let short = segments.iter().enumerate().filter(|(_, segment)| segment.length < enough);
    let found = short.min_by(|(_, a), (_, b)| a.length.total_cmp(&b.length));
    found.map(|(at, _)| at).filter(|_| segments.len() > 1)
}

/// The atoms of a block, and what feed they get.
struct Pieces<'a> {
    atoms: &'a [Atom],
    bounds: &'a Bounds,
    programmed: f64,
}

impl Pieces<'_> {
    fn time(&self, content: Content, length: f64) -> f64 {
        length / self.bounds.feed(content).unwrap_or(self.programmed)
    }

    fn segment(&self, range: Range<usize>) -> Segment {
        let (mut content, mut length, mut least_time) = (Content::NOTHING, 0.0, 0.0);
        for atom in self.atoms.get(range.clone()).unwrap_or_default() {
            let own = Content::of(atom, self.atoms);
            content = content.and(own);
            length += atom.length;
            least_time += self.time(own, atom.length);
        }
        Segment { atoms: range, length, content, time: self.time(content, length), least_time }
    }

    fn join(&self, a: &Segment, b: &Segment) -> Segment {
        let (content, length) = (a.content.and(b.content), a.length + b.length);
        let least_time = a.least_time + b.least_time;
        Segment {
            atoms: a.atoms.start..b.atoms.end,
            length,
            content,
            time: self.time(content, length),
            least_time,
        }
    }

    /// What it costs in time to have other segments instead of two.
    fn cost(&self, before: [&Segment; 2], after: &[Segment]) -> f64 {
        let sum: f64 = after.iter().map(|segment| segment.time).sum();
        before.into_iter().fold(sum, |sum, segment| sum - segment.time)
    }

    /// The pair (index of its first) that costs least among those that `may` be merged; of equal ones the first.
    fn cheapest(&self, segments: &[Segment], may: impl Fn(&Segment, &Segment) -> bool) -> Option<usize> {
        let mut best: Option<(usize, f64)> = None;
        for (at, pair) in segments.windows(2).enumerate() {
            let [a, b] = pair else { continue };
            let cost = self.cost([a, b], &[self.join(a, b)]);
            if best.is_none_or(|(_, least)| cost < least) && may(a, b) {
                best = Some((at, cost));
            }
        }
        best.map(|(at, _)| at)
    }

    fn merge(&self, segments: &mut Vec<Segment>, at: usize) {
        if let (Some(a), Some(b)) = (segments.get(at), segments.get(at + 1)) {
            let joined = self.join(a, b);
            segments.splice(at..at + 2, [joined]);
        }
    }

    /// Gives a too short segment an atom of a neighbour, or all of a neighbour that would itself be too short without it.
    fn grow(&self, segments: &mut Vec<Segment>, at: usize, enough: f64) {
        let options = [at.checked_sub(1), Some(at)].into_iter().flatten();
        let options = options.filter_map(|first| {
            let (a, b) = (segments.get(first)?, segments.get(first + 1)?);
            let border = if first == at { b.atoms.start + 1 } else { a.atoms.end - 1 };
            let (left, right) = (self.segment(a.atoms.start..border), self.segment(border..b.atoms.end));
            let giver = if first == at { &right } else { &left };
            let new = if giver.length < enough { vec![self.join(a, b)] } else { vec![left, right] };
            Some((self.cost([a, b], &new), first, new))
        });
        if let Some((_, first, new)) = options.min_by(|(a, ..), (b, ..)| a.total_cmp(b)) {
            segments.splice(first..first + 2, new);
        }
    }
}
