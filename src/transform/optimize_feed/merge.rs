//! Where a block is split: its pieces merged from the bottom up, the pair that costs least time first.

use super::feeds::{Block, Rules};
use super::margin::Atom;
use super::parts::{Bounds, Content};
use std::ops::Range;

/// A run of atoms that has one feed.
#[derive(Debug, Clone)]
struct Segment {
    atoms: Range<usize>,
    length: f64,
    content: Content,
    /// Time at its own feed.
    time: f64,
    /// Time of its first segments, each at its own feed: what splitting could reach.
    least_time: f64,
}

/// The parts of a block as ranges of atoms, in order.
///
/// Neighbours are merged while that loses no more than `min_change` of the time that their pieces need one by one; parts that
/// are too short, or too many, are merged on at the least cost. A part's choice depends on its own pieces only, so parts split
/// again fall apart no further (unless `at_most` had forced them together).
pub(super) fn parts(
    block: &Block,
    bounds: &Bounds,
    atoms: &[Atom],
    range: Range<usize>,
    rules: &Rules,
) -> Vec<Range<usize>> {
    let Some(rule) = rules.split.filter(|rule| {
        block.touched && block.splittable && block.length > rule.above && !block.pieces.is_empty()
    }) else {
        return vec![range];
    };
    let feed = |content: Content| bounds.feed(content).unwrap_or(block.programmed);
    let join = |a: &Segment, b: &Segment| {
        let (content, length) = (a.content.and(b.content), a.length + b.length);
        Segment {
            atoms: a.atoms.start..b.atoms.end,
            length,
            content,
            time: length / feed(content),
            least_time: a.least_time + b.least_time,
        }
    };
    let mut segments: Vec<Segment> = Vec::new();
    for (index, atom) in atoms.iter().enumerate().take(range.end).skip(range.start) {
        let content = Content::of(atom, atoms);
        let time = atom.length / feed(content);
        let one = Segment { atoms: index..index + 1, length: atom.length, content, time, least_time: time };
        match segments.last_mut() {
            Some(last) if same(last.content, content) => *last = join(last, &one),
            _ => segments.push(one),
        }
    }
    let cost = |a: &Segment, b: &Segment| join(a, b).time - a.time - b.time;
    // Air without a feed of its own keeps the programmed one, which may be the slower: it is not joined to gain time.
    let apart = |a: &Segment, b: &Segment| rules.air_feed.is_none() && a.content.cutting != b.content.cutting;
    let cheap = |a: &Segment, b: &Segment| {
        let joined = join(a, b);
        !apart(a, b) && joined.time <= (1.0 + rules.min_change) * joined.least_time * (1.0 + 1e-12)
    };
    while let Some(at) = cheapest(&segments, cost, cheap) {
        merge(&mut segments, at, join);
    }
    while let Some(at) = shortest(&segments, rule.shortest, cost) {
        merge(&mut segments, at, join);
    }
    while segments.len() > rule.at_most.max(1) {
        match cheapest(&segments, cost, |_, _| true) {
            Some(at) => merge(&mut segments, at, join),
            None => break,
        }
    }
    segments.into_iter().map(|segment| segment.atoms).collect()
}

fn same(a: Content, b: Content) -> bool {
    (a.lowest, a.air, a.cutting) == (b.lowest, b.air, b.cutting)
}

/// The pair (index of its first) that costs least among those that `may` be merged; of equal ones the first.
fn cheapest(
    segments: &[Segment],
    cost: impl Fn(&Segment, &Segment) -> f64,
    may: impl Fn(&Segment, &Segment) -> bool,
) -> Option<usize> {
    let mut best: Option<(usize, f64)> = None;
    for (at, pair) in segments.windows(2).enumerate() {
        if let [a, b] = pair
            && may(a, b)
            && best.is_none_or(|(_, least)| cost(a, b) < least)
        {
            best = Some((at, cost(a, b)));
        }
    }
    best.map(|(at, _)| at)
}

/// The pair that the shortest of all too short segments is merged in: with the neighbour that costs less.
fn shortest(segments: &[Segment], least: f64, cost: impl Fn(&Segment, &Segment) -> f64) -> Option<usize> {
    let too_short = segments.iter().enumerate().filter(|(_, segment)| segment.length < least * (1.0 - 1e-9));
    let (at, segment) = too_short.min_by(|(_, a), (_, b)| a.length.total_cmp(&b.length))?;
    let before =
        at.checked_sub(1).and_then(|before| segments.get(before)).map(|before| cost(before, segment));
    let after = segments.get(at + 1).map(|after| cost(segment, after));
    match (before, after) {
        (None, None) => None,
        (Some(before), Some(after)) if after < before => Some(at),
        (None, Some(_)) => Some(at),
        (Some(_), _) => Some(at - 1),
    }
}

fn merge(segments: &mut Vec<Segment>, at: usize, join: impl Fn(&Segment, &Segment) -> Segment) {
    if let (Some(a), Some(b)) = (segments.get(at), segments.get(at + 1)) {
        let joined = join(a, b);
        segments.splice(at..at + 2, [joined]);
    }
}
