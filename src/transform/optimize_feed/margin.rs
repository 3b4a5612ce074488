//! Pieces on one line: each block's pieces scaled to its length, and air cut where the margin around material ends.

use super::feeds::{Block, Load, has_feed, has_length};
use std::ops::Range;

/// A border this close to another (mm) is the same border.
const SAME_PLACE: f64 = 1e-9;

/// A stretch of constant load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Atom {
    pub(super) block: usize,
    pub(super) length: f64,
    pub(super) kind: Kind,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// Air farther from material than the margin.
    Air,
    /// Air within the margin of the cutting atoms before and after it (their indices).
    Margin(Option<usize>, Option<usize>),
    /// Material, with its limit; in a block that is not touched, the feed at which it is cut.
    Cut(f64),
}

/// All atoms, in order. A block with a length and a known feed has at least one.
pub(super) fn atoms(blocks: &[Block], chains: &[usize], margin: f64) -> Vec<Atom> {
    let mut plain = Vec::new();
    for (index, block) in blocks.iter().enumerate() {
        if has_length(block) && has_feed(block) {
            plain.extend(of_block(index, block));
        }
    }
    if margin > 0.0 { with_margins(&plain, blocks, chains, margin) } else { plain }
}

/// The range of atoms of each block that has any, in order.
pub(super) fn by_block(atoms: &[Atom]) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start = 0;
    for group in atoms.chunk_by(|a, b| a.block == b.block) {
        found.push(start..start + group.len());
        start += group.len();
    }
    found
}

fn of_block(index: usize, block: &Block) -> Vec<Atom> {
    let pieces = block.pieces.iter().filter(|piece| piece.length.is_finite() && piece.length > 0.0);
    let sum: f64 = pieces.clone().map(|piece| piece.length).sum();
    let mut found: Vec<Atom> = pieces
        .map(|piece| {
            let kind = match piece.load {
                Load::Air => Kind::Air,
                Load::Limit(_) if !block.touched => Kind::Cut(block.programmed),
                Load::Limit(limit) => Kind::Cut(limit),
            };
            Atom { block: index, length: piece.length / sum * block.length, kind }
        })
        .collect();
    if found.is_empty() {
        found.push(Atom { block: index, length: block.length, kind: Kind::Air });
    }
    found
}

fn with_margins(plain: &[Atom], blocks: &[Block], chains: &[usize], margin: f64) -> Vec<Atom> {
    let chain = |atom: &Atom| chains.get(atom.block).copied();
    let before = nearest(plain.iter().enumerate(), chain);
    let mut after = nearest(plain.iter().enumerate().rev(), chain);
    after.reverse();
    let mut found: Vec<Atom> = Vec::with_capacity(plain.len());
    let mut new_index = Vec::with_capacity(plain.len());
    for ((atom, before), after) in plain.iter().zip(before).zip(after) {
        new_index.push(found.len());
        let touched = blocks.get(atom.block).is_some_and(|block| block.touched);
        if atom.kind != Kind::Air || !touched {
            found.push(*atom);
            continue;
        }
        // How much of the atom's start and end lies within the margin.
        let reach = |near: Option<(usize, f64)>| near.map_or(0.0, |(_, distance)| margin - distance);
        let (head, tail) = (reach(before), atom.length - reach(after));
        let mut borders = vec![0.0, head, tail, atom.length];
        borders.retain(|border| (0.0..=atom.length).contains(border));
        borders.sort_by(f64::total_cmp);
        borders.dedup_by(|a, b| (*a - *b).abs() <= SAME_PLACE);
        if let [only] = borders.as_slice() {
            borders = vec![*only, atom.length];
        }
        for pair in borders.windows(2) {
            let [start, end] = pair else { continue };
            let middle = (start + end) / 2.0;
            let left = before.filter(|_| middle < head).map(|(cut, _)| cut);
            let right = after.filter(|_| middle > tail).map(|(cut, _)| cut);
            let kind = match (left, right) {
                (None, None) => Kind::Air,
                (left, right) => Kind::Margin(left, right),
            };
            found.push(Atom { length: end - start, kind, ..*atom });
        }
    }
    let renumbered = |cut: Option<usize>| cut.and_then(|cut| new_index.get(cut).copied());
    for atom in &mut found {
        if let Kind::Margin(left, right) = &mut atom.kind {
            (*left, *right) = (renumbered(*left), renumbered(*right));
        }
    }
    found
}

/// For each atom in the order given: the nearest cutting atom met before it in the same chain, and the path between them.
fn nearest<'a>(
    atoms: impl Iterator<Item = (usize, &'a Atom)>,
    chain: impl Fn(&Atom) -> Option<usize>,
) -> Vec<Option<(usize, f64)>> {
    let mut last: Option<(usize, f64)> = None;
    let mut last_chain = None;
    let mut found = Vec::new();
    for (index, atom) in atoms {
        if chain(atom) != last_chain {
            (last, last_chain) = (None, chain(atom));
        }
        found.push(last);
        match atom.kind {
            Kind::Cut(_) => last = Some((index, 0.0)),
            _ => last = last.map(|(cut, distance)| (cut, distance + atom.length)),
        }
    }
    found
}
