//! This module scales the pieces of each block to its length, and divides air where the margin around
//! material ends.

use super::feed_rules::FeedRules;
use crate::transform::optimize_feed::measure::{FeedBlock, FeedLimit};
use std::ops::Range;

/// Boundaries that are this close to each other (mm) are the same.
const SAME_PLACE: f64 = 1e-9;

/// The largest number of parts into which one piece is divided.
const MOST_PARTS: f64 = 1000.0;

/// A length of path on which the load is taken as constant, with its class.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::transform::optimize_feed) struct ClassedPiece {
    pub block: usize,
    pub length: f64,
    pub kind: PieceClass,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::transform::optimize_feed) enum PieceClass {
    /// Air farther from material than the margin.
    Air,
    /// Air within the margin of the cutting pieces before and after it. Their indices are given.
    Margin(Option<usize>, Option<usize>),
    /// Material with its limit. In a block that is not touched, it is the feed at which the block is cut.
    Cut(f64),
}

/// Returns all pieces in order. A block with a length and a known feed has at least one.
pub(in crate::transform::optimize_feed) fn classify_pieces(
    blocks: &[FeedBlock],
    chains: &[usize],
    rules: &FeedRules,
) -> Vec<ClassedPiece> {
    let mut plain = Vec::new();
    for (index, block) in blocks.iter().enumerate() {
        if block.has_length() && block.has_known_feed() {
            plain.extend(classify_block(index, block));
        }
    }
    let cut = if rules.margin > 0.0 { cut_at_margins(&plain, blocks, chains, rules.margin) } else { plain };
    match rules.split {
        Some(rule) if rule.shortest > 0.0 => {
            let longest = |piece: &ClassedPiece| {
                let splits = blocks.get(piece.block).is_some_and(|block| rule.applies_to(block));
                if splits { rule.shortest / 2.0 } else { f64::INFINITY }
            };
            subdivide_pieces(cut, longest)
        }
        _ => cut,
    }
}

/// Divides long pieces of constant load into equal parts, so that a neighbour that is too short can grow by
/// as little as it needs.
fn subdivide_pieces(pieces: Vec<ClassedPiece>, longest: impl Fn(&ClassedPiece) -> f64) -> Vec<ClassedPiece> {
    let parts = |piece: &ClassedPiece| (piece.length / longest(piece)).ceil().clamp(1.0, MOST_PARTS) as usize;
    let mut new_index = Vec::with_capacity(pieces.len());
    let mut found: Vec<ClassedPiece> = Vec::with_capacity(pieces.len());
    for piece in &pieces {
        new_index.push(found.len());
        let count = parts(piece);
        let part = ClassedPiece { length: piece.length / count as f64, ..*piece };
        found.extend(std::iter::repeat_n(part, count));
    }
    renumber_margins(&mut found, &new_index);
    found
}

/// Returns the range of pieces of each block that has any, in order.
pub(super) fn group_by_block(pieces: &[ClassedPiece]) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start = 0;
    for group in pieces.chunk_by(|a, b| a.block == b.block) {
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
            let kind = match piece.limit {
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
    let chain = |piece: &ClassedPiece| chains.get(piece.block).copied();
    // One pass in each direction finds the nearest cuts of all pieces in linear time.
    let before = find_nearest_cuts(plain.iter().enumerate(), chain);
    let mut after = find_nearest_cuts(plain.iter().enumerate().rev(), chain);
    after.reverse();
    let mut found: Vec<ClassedPiece> = Vec::with_capacity(plain.len());
    let mut new_index = Vec::with_capacity(plain.len());
    for ((piece, before), after) in plain.iter().zip(before).zip(after) {
        new_index.push(found.len());
        let touched = blocks.get(piece.block).is_some_and(|block| block.touched);
        if piece.kind != PieceClass::Air || !touched {
            found.push(*piece);
            continue;
        }
        // Within this distance of its start and of its end the piece lies in a margin.
        let reach = |near: Option<(usize, f64)>| near.map_or(0.0, |(_, distance)| margin - distance);
        let (head, tail) = (reach(before), piece.length - reach(after));
        let mut boundaries = vec![0.0, head, tail, piece.length];
        boundaries.retain(|boundary| (0.0..=piece.length).contains(boundary));
        boundaries.sort_by(f64::total_cmp);
        boundaries.dedup_by(|a, b| (*a - *b).abs() <= SAME_PLACE);
        if let [only] = boundaries.as_slice() {
            boundaries = vec![*only, piece.length];
        }
        for pair in boundaries.windows(2) {
            let [start, end] = pair else { continue };
            let middle = (start + end) / 2.0;
            let left = before.filter(|_| middle < head).map(|(cut, _)| cut);
            let right = after.filter(|_| middle > tail).map(|(cut, _)| cut);
            let kind = match (left, right) {
                (None, None) => PieceClass::Air,
                (left, right) => PieceClass::Margin(left, right),
            };
            found.push(ClassedPiece { length: end - start, kind, ..*piece });
        }
    }
    renumber_margins(&mut found, &new_index);
    found
}

/// Renumbers the cutting pieces that margins refer to. If a cutting piece was divided, the nearest part
/// counts.
fn renumber_margins(pieces: &mut [ClassedPiece], new_index: &[usize]) {
    let count = pieces.len();
    let first = |cut: usize| new_index.get(cut).copied();
    let last = |cut: usize| Some(first(cut + 1).unwrap_or(count).saturating_sub(1));
    for piece in pieces {
        if let PieceClass::Margin(left, right) = &mut piece.kind {
            (*left, *right) = (left.and_then(last), right.and_then(first));
        }
    }
}

/// Returns for each piece, in the given order, the last cutting piece before it in the same chain, and the
/// length of the path between them.
fn find_nearest_cuts<'a>(
    pieces: impl Iterator<Item = (usize, &'a ClassedPiece)>,
    chain: impl Fn(&ClassedPiece) -> Option<usize>,
) -> Vec<Option<(usize, f64)>> {
    let mut last: Option<(usize, f64)> = None;
    let mut last_chain = None;
    let mut found = Vec::new();
    for (index, piece) in pieces {
        if chain(piece) != last_chain {
            (last, last_chain) = (None, chain(piece));
        }
        found.push(last);
        match piece.kind {
            PieceClass::Cut(_) => last = Some((index, 0.0)),
            _ => last = last.map(|(cut, distance)| (cut, distance + piece.length)),
        }
    }
    found
}
