//! The area of a layer in pieces of bounded size, so that a cut costs what it touches and not what the workpiece is made of.

use crate::chips::area::{Clipper, Region, Window};

/// A piece of a layer: its area, or two pieces beside each other. Borders between pieces are whole steps, so that what is cut from both
/// fits together.
#[derive(Debug, Clone)]
pub(super) enum Tile {
    Area { area: Region, window: Option<Window> },
    Halves(Box<[Tile; 2]>),
}

/// Shortest side of the box around an area that is still halved, steps.
const SMALLEST: i64 = 1 << 14;

/// What cutting needs room for.
#[derive(Debug, Clone, Default)]
pub(super) struct Room {
    pub(super) clipper: Clipper,
    along: Region,
    inside: Region,
    outside: Region,
}

impl Tile {
    /// An area, halved until no piece has more than so many corners.
    pub(super) fn new(area: Region, most: usize, room: &mut Room) -> Self {
        let window = area.window();
        let mut tile = Self::Area { area, window };
        tile.halve(most, room);
        tile
    }

    /// Takes out everything that borders wind around, and adds it to `taken`, for each piece on its own. Returns from how many pieces
    /// something was taken.
    pub(super) fn take(
        &mut self,
        cut: &Region,
        around: &Window,
        most: usize,
        room: &mut Room,
        taken: &mut Region,
    ) -> usize {
        let count = match self {
            Self::Area { window: Some(window), .. } if !window.meets(around) => 0,
            Self::Area { window: None, .. } => 0,
            Self::Area { area, window: Some(window) } => {
                room.along.clear();
                room.along.add_within(window, cut);
                if room.along.is_empty() {
                    return 0;
                }
                let Room { clipper, along, inside, outside } = room;
                if !clipper.cut(area, along, inside, outside) {
                    return 0;
                }
                taken.append(inside);
                area.clear();
                area.append(outside);
                *self = Self::Area { window: area.window(), area: std::mem::take(area) };
                self.halve(most, room);
                1
            }
            Self::Halves(halves) => {
                halves.iter_mut().map(|half| half.take(cut, around, most, room, taken)).sum()
            }
        };
        if let Self::Halves(halves) = self
            && halves.iter().all(|half| matches!(half, Self::Area { window: None, .. }))
        {
            *self = Self::Area { area: Region::default(), window: None };
        }
        count
    }

    /// Halves an area with too many corners across the longer side of the box around it.
    fn halve(&mut self, most: usize, room: &mut Room) {
        let Self::Area { area, window: Some(window) } = self else { return };
        let Window { low: [x0, y0], high: [x1, y1] } = *window;
        let [wide, high] = [i64::from(x1) - i64::from(x0), i64::from(y1) - i64::from(y0)];
        if area.corners() <= most || wide.max(high) < SMALLEST {
            return;
        }
        // A little more on the outer sides, so that only the border between the halves is cut along.
        let corner = if wide >= high { [x0.midpoint(x1), y1 + 1] } else { [x1 + 1, y0.midpoint(y1)] };
        let half = Region::rectangle(&Window { low: [x0 - 1, y0 - 1], high: corner });
        let (mut one, mut other) = (Region::default(), Region::default());
        if room.clipper.cut(area, &half, &mut one, &mut other) && !other.is_empty() {
            *self = Self::Halves(Box::new([one, other].map(|area| Self::new(area, most, room))));
        }
    }

    /// Adds the area of all pieces.
    pub(super) fn collect(&self, all: &mut Region) {
        match self {
            Self::Area { area, .. } => all.append(area),
            Self::Halves(halves) => halves.iter().for_each(|half| half.collect(all)),
        }
    }
}
