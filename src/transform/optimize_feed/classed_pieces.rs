//! Pieces on one line: each block's pieces scaled to its length, and air cut where the margin around material ends.

use super::block_feeds::{FeedBlock, FeedLimit, FeedRules, has_known_feed, has_length};
use std::ops::Range;

/// A border this close to another (mm) is the same border.
const SAME_PLACE: f64 = 1e-9;

/// Most bits that one atom is cut into.
const MOST_BITS: f64 = 1000.0;

/// A stretch of constant load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ClassedPiece {
    pub(super) block: usize,
    pub(super) length: f64,
    pub(super) kind: PieceClass,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum PieceClass {
    /// Air farther from material than the margin.
    Air,
    /// Air within the margin of the cutting atoms before and after it (their indices).
    Margin(Option<usize>, Option<usize>),
    /// Material, with its limit; in a block that is not touched, the feed at which it is cut.
    Cut(f64),
}

/// All atoms, in order. A block with a length and a known feed has at least one.
pub(super) fn classify_pieces(
    blocks: &[FeedBlock],
    chains: &[usize],
    rules: &FeedRules,
) -> Vec<ClassedPiece> {
    let mut plain = Vec::new();
    for (index, block) in blocks.iter().enumerate() {
        if has_length(block) && has_known_feed(block) {
            plain.extend(classify_block(index, block));
        }
    }
    let cut = if rules.margin > 0.0 { cut_at_margins(&plain, blocks, chains, rules.margin) } else { plain };
    match rules.split {
        Some(rule) if rule.shortest > 0.0 => {
            let longest = |atom: &ClassedPiece| {
                let splits = blocks.get(atom.block).is_some_and(|block| rule.applies_to(block));
                if splits { rule.shortest / 2.0 } else { f64::INFINITY }
            };
            subdivide_pieces(cut, longest)
        }
        _ => cut,
    }
}

/// Long atoms of one load cut into equal bits, so that a too short neighbour can grow by as little as it needs.
fn subdivide_pieces(atoms: Vec<ClassedPiece>, longest: impl Fn(&ClassedPiece) -> f64) -> Vec<ClassedPiece> {
    let bits = |atom: &ClassedPiece| (atom.length / longest(atom)).ceil().clamp(1.0, MOST_BITS) as usize;
    let mut new_index = Vec::with_capacity(atoms.len());
    let mut found: Vec<ClassedPiece> = Vec::with_capacity(atoms.len());
    for atom in &atoms {
        new_index.push(found.len());
        let count = bits(atom);
        let bit = ClassedPiece { length: atom.length / count as f64, ..*atom };
        found.extend(std::iter::repeat_n(bit, count));
    }
    renumber_margins(&mut found, &new_index);
    found
}

/// The range of atoms of each block that has any, in order.
pub(super) fn group_by_block(atoms: &[ClassedPiece]) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start = 0;
    for group in atoms.chunk_by(|a, b| a.block == b.block) {
        found.push(start..start + group.len());
        start += group.len();
    }
    found
}

fn classify_block(index: usize, block: &FeedBlock) -> Vec<ClassedPiece> {
    let pieces = block.pieces.iter().filter(|piece| piece.length.is_finite() && piece.length > 0.0);
    let sum: f64 = pieces.clone().map(|piece| piece.length).sum();
    let mut found: Vec<ClassedPiece> = pieces
        .map(|piece| {
            let kind = match piece.load {
                FeedLimit::Air => PieceClass::Air,
                FeedLimit::Limit(_) if !block.touched => PieceClass::Cut(block.programmed),
                FeedLimit::Limit(limit) => PieceClass::Cut(limit),
            };
            ClassedPiece { block: index, length: piece.length / sum * block.length, kind }
        })
        .collect();
    if found.is_empty() {
        found.push(ClassedPiece { block: index, length: block.length, kind: PieceClass::Air });
    }
    found
}

fn cut_at_margins(
    plain: &[ClassedPiece],
    blocks: &[FeedBlock],
    chains: &[usize],
    margin: f64,
) -> Vec<ClassedPiece> {
    let chain = |atom: &ClassedPiece| chains.get(atom.block).copied();
    let before = find_nearest_cuts(plain.iter().enumerate(), chain);
    let mut after = find_nearest_cuts(plain.iter().enumerate().rev(), chain);
    after.reverse();
    let mut found: Vec<ClassedPiece> = Vec::with_capacity(plain.len());
    let mut new_index = Vec::with_capacity(plain.len());
    for ((atom, before), after) in plain.iter().zip(before).zip(after) {
        new_index.push(found.len());
        let touched = blocks.get(atom.block).is_some_and(|block| block.touched);
        if atom.kind != PieceClass::Air || !touched {
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
                (None, None) => PieceClass::Air,
                (left, right) => PieceClass::Margin(left, right),
            };
            found.push(ClassedPiece { length: end - start, kind, ..*atom });
        }
    }
    renumber_margins(&mut found, &new_index);
    found
}

/// Lets margins name the atoms that they lie beside by their new indices: of a cut in bits the nearest.
fn renumber_margins(atoms: &mut [ClassedPiece], new_index: &[usize]) {
    let count = atoms.len();
    let first = |cut: usize| new_index.get(cut).copied();
    let last = |cut: usize| Some(first(cut + 1).unwrap_or(count).saturating_sub(1));
    for atom in atoms {
        if let PieceClass::Margin(left, right) = &mut atom.kind {
            (*left, *right) = (left.and_then(last), right.and_then(first));
        }
    }
}

/// For each atom in the order given: the nearest cutting atom met before it in the same chain, and the path between them.
fn find_nearest_cuts<'a>(
    atoms: impl Iterator<Item = (usize, &'a ClassedPiece)>,
    chain: impl Fn(&ClassedPiece) -> Option<usize>,
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
            PieceClass::Cut(_) => last = Some((index, 0.0)),
            _ => last = last.map(|(cut, distance)| (cut, distance + atom.length)),
        }
    }
    found
}
