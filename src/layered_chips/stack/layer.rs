//! A layer of the workpiece.

use super::tiles::{LayerTile, TileBuffers};
use crate::layered_chips::Polygon;
use crate::layered_chips::area::{AreaGrid, GridArea};
use crate::layered_chips::swept_area::{LayerSweptArea, SectionSeam};

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
    grid: AreaGrid,
    most_corners: usize,
    material: LayerTile,
    /// The cutter's section at the end of the last cut, and its seam: nothing is left inside.
    cleared: Vec<[f64; 2]>,
    seam: Option<SectionSeam>,
    room: TileBuffers,
}

/// What was taken out of a layer.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LayerRemoval {
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
        grid: AreaGrid,
        area: GridArea,
        most: usize,
    ) -> Self {
        let mut room = TileBuffers::default();
        let material = LayerTile::new(room.clipper.unite_boundaries(&area), most, &mut room);
        let (cleared, seam, room) = Default::default();
        Self { number, bottom, thickness, grid, most_corners: most, material, cleared, seam, room }
    }

    /// Its number, from below.
    pub fn number(&self) -> usize {
        self.number
    }

    /// Height of its lower side, mm.
    pub fn bottom_mm(&self) -> f64 {
        self.bottom
    }

    /// Height of its middle, mm: there the cutter's sections belong.
    pub fn middle_z_mm(&self) -> f64 {
        self.bottom + self.thickness / 2.0
    }

    /// Its thickness, mm.
    pub fn thickness_mm(&self) -> f64 {
        self.thickness
    }

    /// Takes out the material that a cutter meets between two places.
    ///
    /// First everything inside its first place goes, which is no part of the chip; nothing is there when the last cut ended in the same
    /// section, but for the caps, thinner than what chords leave, which the chip gets. The chip is what is left of the material inside the advancing borders. Areas are exact for corners rounded to the
    /// [`AreaGrid`], and what is as thin as a step or two is left out.
    pub fn remove_swept_area(&mut self, cover: &LayerSweptArea) -> LayerRemoval {
        let mut removed = LayerRemoval::default();
        let [seam, next] = cover.seams.map_or([None; 2], |seams| seams.map(Some));
        let goes_on = seam.is_some() && seam == self.seam;
        if !goes_on && cover.first != self.cleared {
            let first = GridArea::new(&self.grid, [cover.first.as_slice()]);
            removed.inside_mm2 = self.take_out_area(&first).0.area_mm2(&self.grid);
        }
        let mut cut = self.unite_in_groups(&cover.advancing);
        if goes_on {
            cover.caps.iter().for_each(|cap| cut.add_boundary(&self.grid, cap));
        }
        let (taken, pieces) = self.take_out_area(&cut);
        if !taken.is_empty() {
            (removed.pieces, removed.area_mm2) =
                self.room.clipper.extract_connected_pieces(&taken, pieces > 1, &self.grid);
        }
        self.cleared.clone_from(&cover.last);
        self.seam = next;
        removed
    }

    /// What many borders wind around, by groups: borders that run along each other cost by the square of their number.
    fn unite_in_groups(&mut self, borders: &[Vec<[f64; 2]>]) -> GridArea {
        if borders.len() <= GROUP {
            return GridArea::new(&self.grid, borders.iter().map(Vec::as_slice));
        }
        let (one, other) = borders.split_at(borders.len() / 2);
        let (mut all, other) = (self.unite_in_groups(one), self.unite_in_groups(other));
        all.append(&other);
        self.room.clipper.unite_boundaries(&all)
    }

    /// Takes out everything that borders wind around; from how many tiles.
    fn take_out_area(&mut self, cut: &GridArea) -> (GridArea, usize) {
        let mut taken = GridArea::default();
        let Some(window) = cut.bounding_box() else { return (taken, 0) };
        let count = self.material.take_out_area(cut, &window, self.most_corners, &mut self.room, &mut taken);
        (taken, count)
    }

    /// What is left, mm2.
    pub fn area_mm2(&self) -> f64 {
        self.remaining_area().area_mm2(&self.grid)
    }

    /// What is left, as connected polygons.
    pub fn remaining_polygons(&self) -> Vec<Polygon> {
        TileBuffers::default().clipper.extract_polygons(&self.remaining_area(), &self.grid).0
    }

    fn remaining_area(&self) -> GridArea {
        let mut all = GridArea::default();
        self.material.append_area_to(&mut all);
        all
    }
}
