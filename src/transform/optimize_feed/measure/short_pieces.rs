//! This module corrects the loads of pieces that are so short that no column of the grid may lie in them,
//! only before or behind.

use super::feed_block::{FeedBlock, FeedLimit};

/// Gives every piece shorter than `reach` (mm) the lowest limit of all pieces that are no farther than
/// `reach` before or behind it in its chain of blocks. Longer pieces contain columns of their own.
pub(super) fn lower_short_pieces(blocks: &mut [FeedBlock], reach: f64) {
    let mut pieces: Vec<PlacedPiece> = Vec::new();
    let (mut at, mut chain) = (0.0, 0);
    for (index, block) in blocks.iter().enumerate() {
        chain += usize::from(block.breaks_chain);
        for (number, piece) in block.pieces.iter().enumerate() {
            let limit = match piece.limit {
                FeedLimit::Air => f64::INFINITY,
                FeedLimit::Limit(limit) => limit,
            };
            let end = at + piece.length;
            pieces.push(PlacedPiece {
                block: index,
                piece: number,
                chain,
                from: at,
                to: end,
                limit,
                air: piece.limit == FeedLimit::Air,
            });
            at = end;
        }
    }
    // Pieces are in the order of the path, so the start of the window only moves forwards.
    let mut first = 0;
    for placed in &pieces {
        while pieces
            .get(first)
            .is_some_and(|other| other.chain != placed.chain || other.to < placed.from - reach)
        {
            first += 1;
        }
        if placed.to - placed.from >= reach {
            continue;
        }
        let near = pieces.get(first..).unwrap_or_default().iter();
        let near = near.take_while(|other| other.chain == placed.chain && other.from <= placed.to + reach);
        let (mut limit, mut air) = (f64::INFINITY, true);
        for other in near {
            limit = limit.min(other.limit);
            air &= other.air;
        }
        // A short piece is air only if everything around it is air as well. Otherwise the columns may just
        // have missed what it cuts.
        let piece = blocks.get_mut(placed.block).and_then(|block| block.pieces.get_mut(placed.piece));
        if let Some(piece) = piece.filter(|_| !air) {
            piece.limit = FeedLimit::Limit(limit);
        }
    }
}

/// A piece with its position on the path.
struct PlacedPiece {
    block: usize,
    piece: usize,
    chain: usize,
    from: f64,
    to: f64,
    limit: f64,
    air: bool,
}
