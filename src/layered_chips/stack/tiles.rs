//! This module holds the area of a layer in pieces (tiles) of at most 128 vertices, so that the cost of a cut
//! depends on what it touches and not on the whole workpiece.

use crate::layered_chips::area::{Clipper, GridArea, GridBox};

/// A tile of a layer: its area, or two tiles beside each other. Boundaries between tiles are whole steps of
/// the grid, so that what is cut from both fits together.
#[derive(Debug, Clone)]
pub(super) enum LayerTile {
    Area { area: GridArea, window: Option<GridBox> },
    Halves(Box<[LayerTile; 2]>),
}

/// The shortest side, in steps, of the box around an area that is still divided.
const SMALLEST: i64 = 1 << 14;

/// The memory that cutting reuses.
#[derive(Debug, Clone, Default)]
pub(super) struct TileBuffers {
    pub(super) clipper: Clipper,
    along: GridArea,
    inside: GridArea,
    outside: GridArea,
}

impl LayerTile {
    /// Makes a tile of an area and divides it until no tile has more than `most` vertices.
    pub(super) fn new(area: GridArea, most: usize, room: &mut TileBuffers) -> Self {
        let window = area.bounding_box();
        let mut tile = Self::Area { area, window };
        tile.bisect_area(most, room);
        tile
    }

    /// Removes everything that the boundaries of `cut` wind around and adds it to `taken`, for each tile
    /// separately. Returns the number of tiles from which something was removed.
    pub(super) fn take_out_area(
        &mut self,
        cut: &GridArea,
        around: &GridBox,
        most: usize,
        room: &mut TileBuffers,
        taken: &mut GridArea,
    ) -> usize {
        let count = match self {
            Self::Area { window: Some(window), .. } if !window.intersects(around) => 0,
            Self::Area { window: None, .. } => 0,
            Self::Area { area, window: Some(window) } => {
                // Far from the tile, the boundaries need no detail, and most of them vanish.
                room.along.clear();
                room.along.add_simplified_within(window, cut);
                if room.along.is_empty() {
                    return 0;
                }
                let TileBuffers { clipper, along, inside, outside } = room;
                if !clipper.split_area(area, along, inside, outside) {
                    return 0;
                }
                taken.append(inside);
                area.clear();
                area.append(outside);
                *self = Self::Area { window: area.bounding_box(), area: std::mem::take(area) };
                self.bisect_area(most, room);
                1
            }
            Self::Halves(halves) => {
                halves.iter_mut().map(|half| half.take_out_area(cut, around, most, room, taken)).sum()
            }
        };
        // Two empty tiles become one again.
        if let Self::Halves(halves) = self
            && halves.iter().all(|half| matches!(half, Self::Area { window: None, .. }))
        {
            *self = Self::Area { area: GridArea::default(), window: None };
        }
        count
    }

    /// Divides an area with too many vertices across the longer side of the box around it.
    fn bisect_area(&mut self, most: usize, room: &mut TileBuffers) {
        let Self::Area { area, window: Some(window) } = self else { return };
        let GridBox { low: [x0, y0], high: [x1, y1] } = *window;
        let [wide, high] = [i64::from(x1) - i64::from(x0), i64::from(y1) - i64::from(y0)];
        if area.vertex_count() <= most || wide.max(high) < SMALLEST {
            return;
        }
        // The box is slightly larger on its outer sides, so that only the line between the two halves is cut.
        let corner = if wide >= high { [x0.midpoint(x1), y1 + 1] } else { [x1 + 1, y0.midpoint(y1)] };
        let half = GridArea::from_box(&GridBox { low: [x0 - 1, y0 - 1], high: corner });
        let (mut one, mut other) = (GridArea::default(), GridArea::default());
        if room.clipper.split_area(area, &half, &mut one, &mut other) && !other.is_empty() {
            *self = Self::Halves(Box::new([one, other].map(|area| Self::new(area, most, room))));
        }
    }

    /// Adds the areas of all tiles.
    pub(super) fn append_area_to(&self, all: &mut GridArea) {
        match self {
            Self::Area { area, .. } => all.append(area),
            Self::Halves(halves) => halves.iter().for_each(|half| half.append_area_to(all)),
        }
    }
}
