//! A layer of the workpiece.

use super::tiles::{Room, Tile};
use crate::chips::Polygon;
use crate::chips::area::{Grid, Region};
use crate::chips::cover::{Cover, Seam};

/// Corners from which on a piece of a layer is halved: large enough that the edge of one cut fits in a piece.
pub(super) const MOST_CORNERS: usize = 128;

/// Borders that are cut along at once.
const GROUP: usize = 12;

/// What is left of the workpiece between two heights.
#[derive(Debug, Clone)]
pub struct Layer {
    number: usize,
    bottom: f64,
    thickness: f64,
    grid: Grid,
    most_corners: usize,
    material: Tile,
    /// The cutter's section at the end of the last cut, and its seam: nothing is left inside.
    cleared: Vec<[f64; 2]>,
    seam: Option<Seam>,
    room: Room,
}

/// What was taken out of a layer.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Removed {
    /// The chip's pieces.
    pub pieces: Vec<Polygon>,
    /// Their area, mm2.
    pub area_mm2: f64,
    /// Area of the material that stood inside the cutter at its first place, mm2.
    pub inside_mm2: f64,
}

impl Layer {
    pub(super) fn new(
        number: usize,
        [bottom, thickness]: [f64; 2],
        grid: Grid,
        area: Region,
        most: usize,
    ) -> Self {
        let mut room = Room::default();
        let material = Tile::new(room.clipper.joined(&area), most, &mut room);
        let (cleared, seam, room) = Default::default();
        Self { number, bottom, thickness, grid, most_corners: most, material, cleared, seam, room }
    }

    /// Its number, from below.
    pub fn number(&self) -> usize {
        self.number
    }

    /// Height of its lower side, mm.
    pub fn bottom(&self) -> f64 {
        self.bottom
    }

    /// Height of its middle, mm: there the cutter's sections belong.
    pub fn z(&self) -> f64 {
        self.bottom + self.thickness / 2.0
    }

    /// Its thickness, mm.
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Takes out the material that a cutter meets between two places.
    ///
    /// First everything inside its first place goes, which is no part of the chip; nothing is there when the last cut ended in the same
    /// section, but for the caps, thinner than what chords leave, which the chip gets. The chip is what is left of the material inside the advancing borders. Areas are exact for corners rounded to the
    /// [`Grid`], and what is as thin as a step or two is left out.
    pub fn remove(&mut self, cover: &Cover) -> Removed {
        let mut removed = Removed::default();
        let [seam, next] = cover.seams.map_or([None; 2], |seams| seams.map(Some));
        let goes_on = seam.is_some() && seam == self.seam;
        if !goes_on && cover.first != self.cleared {
            let first = Region::new(&self.grid, [cover.first.as_slice()]);
            removed.inside_mm2 = self.take(&first).0.area_mm2(&self.grid);
        }
        let mut cut = self.joined(&cover.advancing);
        if goes_on {
            cover.caps.iter().for_each(|cap| cut.add(&self.grid, cap));
        }
        let (taken, pieces) = self.take(&cut);
        if !taken.is_empty() {
            (removed.pieces, removed.area_mm2) = self.room.clipper.pieces(&taken, pieces > 1, &self.grid);
        }
        self.cleared.clone_from(&cover.last);
        self.seam = next;
        removed
    }

    /// What many borders wind around, by groups: borders that run along each other cost by the square of their number.
    fn joined(&mut self, borders: &[Vec<[f64; 2]>]) -> Region {
        if borders.len() <= GROUP {
            return Region::new(&self.grid, borders.iter().map(Vec::as_slice));
        }
        let (one, other) = borders.split_at(borders.len() / 2);
        let (mut all, other) = (self.joined(one), self.joined(other));
        all.append(&other);
        self.room.clipper.joined(&all)
    }

    /// Takes out everything that borders wind around; from how many tiles.
    fn take(&mut self, cut: &Region) -> (Region, usize) {
        let mut taken = Region::default();
        let Some(window) = cut.window() else { return (taken, 0) };
        let count = self.material.take(cut, &window, self.most_corners, &mut self.room, &mut taken);
        (taken, count)
    }

    /// What is left, mm2.
    pub fn area_mm2(&self) -> f64 {
        self.region().area_mm2(&self.grid)
    }

    /// What is left, as connected polygons.
    pub fn polygons(&self) -> Vec<Polygon> {
        Room::default().clipper.polygons(&self.region(), &self.grid).0
    }

    fn region(&self) -> Region {
        let mut all = Region::default();
        self.material.collect(&mut all);
        all
    }
}
