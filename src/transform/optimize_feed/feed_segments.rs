//! Parts of blocks with their limits: windows over atoms, bounds, and the margin's tie to the cut beside it.

use super::block_feeds::{FeedBlock, FeedRules, FeedWindow};
use super::classed_pieces::{self, ClassedPiece, PieceClass};
use super::segment_merge;
use std::ops::Range;

/// Lengths below this (mm) do not count for a window.
const NOTHING: f64 = 1e-9;

/// A part of a block that gets one feed.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FeedSegment {
    pub(super) block: usize,
    pub(super) chain: usize,
    pub(super) atoms: Range<usize>,
    pub(super) length: f64,
    /// End as a share of the block.
    pub(super) end: f64,
    /// Its feed so far; starts as its limit.
    pub(super) feed: f64,
    /// The lowest feed that its block allows.
    pub(super) least: f64,
    /// Whether the feed is the programmed one and stays.
    pub(super) fixed: bool,
    /// Whether a limit was below the lowest feed.
    pub(super) below: bool,
}

/// What a window holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WindowContent {
    /// Lowest limit; infinite without material.
    pub(super) lowest: f64,
    /// Lowest limit of material itself, without the margins of other material.
    lowest_cut: f64,
    pub(super) air: bool,
    pub(super) cutting: bool,
}

impl WindowContent {
    pub(super) const NOTHING: Self =
        Self { lowest: f64::INFINITY, lowest_cut: f64::INFINITY, air: false, cutting: false };

    pub(super) fn from_piece(atom: &ClassedPiece, all: &[ClassedPiece]) -> Self {
        match atom.kind {
            PieceClass::Air => Self { air: true, ..Self::NOTHING },
            PieceClass::Cut(limit) => Self { lowest: limit, lowest_cut: limit, cutting: true, air: false },
            PieceClass::Margin(left, right) => {
                let limit = |cut: Option<usize>| match cut.and_then(|cut| all.get(cut)).map(|atom| atom.kind)
                {
                    Some(PieceClass::Cut(limit)) => limit,
                    _ => f64::INFINITY,
                };
                let lowest = limit(left).min(limit(right));
                Self { lowest, cutting: true, ..Self::NOTHING }
            }
        }
    }

    pub(super) fn combined_with(self, other: Self) -> Self {
        Self {
            lowest: self.lowest.min(other.lowest),
            lowest_cut: self.lowest_cut.min(other.lowest_cut),
            air: self.air || other.air,
            cutting: self.cutting || other.cutting,
        }
    }
}

/// Lowest and highest feed of a block.
#[derive(Debug, Clone, Copy)]
pub(super) struct FeedBounds {
    pub(super) least: f64,
    most: f64,
    air: Option<f64>,
}

impl FeedBounds {
    pub(super) fn from_rules(block: &FeedBlock, rules: &FeedRules) -> Self {
        let share = |ratio: Option<f64>| ratio.map(|ratio| ratio * block.programmed);
        let most = rules.max_feed.min(share(rules.max_ratio).unwrap_or(f64::INFINITY));
        let least = rules.min_feed.max(share(rules.min_ratio).unwrap_or(0.0)).min(most);
        Self { least, most, air: rules.air_feed }
    }

    /// The feed of a window; `None` where nothing limits it and the programmed feed stays.
    pub(super) fn window_feed_mm_min(&self, content: WindowContent) -> Option<f64> {
        let air = if content.air { self.air } else { None };
        let wanted = match (content.cutting, air) {
            (false, air) => air?,
            (true, air) => content.lowest.min(air.unwrap_or(f64::INFINITY)),
        };
        let feed = wanted.max(self.least).min(self.most);
        feed.is_finite().then_some(feed)
    }
}

/// The parts of all blocks that have a length and a known feed, with their limits as feeds.
pub(super) fn build_feed_segments(
    blocks: &[FeedBlock],
    chains: &[usize],
    atoms: &[ClassedPiece],
    rules: &FeedRules,
) -> Vec<FeedSegment> {
    let mut found = Vec::new();
    for range in classed_pieces::group_by_block(atoms) {
        let Some(index) = atoms.get(range.start).map(|atom| atom.block) else { continue };
        let (Some(block), Some(chain)) = (blocks.get(index), chains.get(index)) else { continue };
        let bounds = FeedBounds::from_rules(block, rules);
        let mut end = 0.0;
        for part in segment_merge::merge_into_segments(block, &bounds, atoms, range, rules) {
            let length: f64 =
                atoms.get(part.clone()).unwrap_or_default().iter().map(|atom| atom.length).sum();
            end += length;
            found.push(FeedSegment {
                block: index,
                chain: *chain,
                atoms: part,
                length,
                end: end / block.length,
                feed: block.programmed,
                least: bounds.least,
                fixed: true,
                below: false,
            });
        }
    }
    apply_window_limits(&mut found, blocks, atoms, rules);
    keep_margins(&mut found, atoms);
    found
}

fn apply_window_limits(
    spans: &mut [FeedSegment],
    blocks: &[FeedBlock],
    atoms: &[ClassedPiece],
    rules: &FeedRules,
) {
    let windows: Vec<WindowContent> =
        (0..spans.len()).map(|index| find_window_content(spans, index, atoms, rules.window)).collect();
    for (span, content) in spans.iter_mut().zip(windows) {
        let Some(block) = blocks.get(span.block).filter(|block| block.touched && !block.pieces.is_empty())
        else {
            continue;
        };
        let bounds = FeedBounds::from_rules(block, rules);
        if let Some(feed) = bounds.window_feed_mm_min(content) {
            (span.feed, span.fixed) = (feed, false);
            span.below = content.lowest_cut < bounds.least;
        }
    }
}

fn find_window_content(
    spans: &[FeedSegment],
    index: usize,
    atoms: &[ClassedPiece],
    window: FeedWindow,
) -> WindowContent {
    let Some(span) = spans.get(index) else { return WindowContent::NOTHING };
    let own = content_between(span, atoms, 0.0, span.length);
    if window == FeedWindow::Block {
        return own;
    }
    let in_chain = |other: &&FeedSegment| other.chain == span.chain;
    let before = index.checked_sub(1).and_then(|before| spans.get(before)).filter(in_chain);
    let start = if before.is_some() { span.length / 2.0 } else { 0.0 };
    let mut content = content_between(span, atoms, start, span.length);
    if let Some(after) = spans.get(index + 1).filter(in_chain) {
        content = content.combined_with(content_between(after, atoms, 0.0, after.length / 2.0));
    }
    if own.cutting && !content.cutting { own } else { content }
}

/// What lies between two places (mm from the start) of a part.
fn content_between(span: &FeedSegment, atoms: &[ClassedPiece], from: f64, to: f64) -> WindowContent {
    let mut content = WindowContent::NOTHING;
    let mut start = 0.0;
    for atom in atoms.get(span.atoms.clone()).unwrap_or_default() {
        let end = start + atom.length;
        if end.min(to) - start.max(from) > NOTHING.min(atom.length / 2.0) {
            content = content.combined_with(WindowContent::from_piece(atom, atoms));
        }
        start = end;
    }
    content
}

/// Air within the margin goes no faster than the part that cuts beside it, as its limits say before any lowering.
fn keep_margins(spans: &mut [FeedSegment], atoms: &[ClassedPiece]) {
    let mut limit_at = vec![f64::INFINITY; atoms.len()];
    for span in spans.iter() {
        limit_at.get_mut(span.atoms.clone()).unwrap_or_default().fill(span.feed);
    }
    for span in spans.iter_mut().filter(|span| !span.fixed) {
        for atom in atoms.get(span.atoms.clone()).unwrap_or_default() {
            let PieceClass::Margin(left, right) = atom.kind else { continue };
            for cut in [left, right].into_iter().flatten() {
                let beside = limit_at.get(cut).copied().unwrap_or(f64::INFINITY);
                span.feed = span.feed.min(beside.max(span.least));
            }
        }
    }
}
