//! This module holds one layer of the workpiece.

use super::tiles::{LayerTile, TileBuffers};
use crate::layered_chips::Polygon;
use crate::layered_chips::area::{AreaGrid, GridArea};
use crate::layered_chips::swept_area::{LayerSweptArea, SectionSeam};

/// The number of vertices above which a piece of a layer is divided. It is large enough that the edge of one
/// cut fits in a piece.
pub(super) const MOST_CORNERS: usize = 128;

/// The most boundaries that are united at once.
const GROUP: usize = 12;

/// The part of the workpiece between two heights.
#[derive(Debug, Clone)]
pub struct Layer {
    number: usize,
    bottom: f64,
    thickness: f64,
    grid: AreaGrid,
    most_corners: usize,
    material: LayerTile,
    /// The cutter's section at the end of the last cut, inside which nothing is left, and the seam of that
    /// section.
    cleared: Vec<[f64; 2]>,
    seam: Option<SectionSeam>,
    room: TileBuffers,
}

/// The material that was removed from a layer.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LayerRemoval {
    /// The pieces of the chip.
    pub pieces: Vec<Polygon>,
    /// The area of the chip, mm2.
    pub area_mm2: f64,
    /// The area of the material that was inside the cutter at its first pose, mm2.
    pub inside_mm2: f64,
}

impl Layer {
    /// Makes a layer with the material of an area.
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

    /// Returns the number of the layer, counted from below.
    pub fn number(&self) -> usize {
        self.number
    }

    /// Returns the height of its lower side, mm.
    pub fn bottom_mm(&self) -> f64 {
        self.bottom
    }

    /// Returns the height of its middle, mm, at which the cutter's sections are taken.
    pub fn middle_z_mm(&self) -> f64 {
        self.bottom + self.thickness / 2.0
    }

    /// Returns its thickness, mm.
    pub fn thickness_mm(&self) -> f64 {
        self.thickness
    }

    /// Removes the material that a cutter meets between two poses.
    ///
    /// First everything inside the first section is removed, which does not belong to the chip. If the last
    /// cut ended in the same section, nothing is there except the caps, which are thinner than the error of
    /// chords; these are added to the chip. The chip is the rest of the material inside the advancing
    /// boundaries. Areas are exact for vertices rounded to the [`AreaGrid`]; what is as thin as a step or two
    /// is left out.
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

    /// Unites many boundaries in groups, because the cost of boundaries that run along each other grows with
    /// the square of their number.
    fn unite_in_groups(&mut self, borders: &[Vec<[f64; 2]>]) -> GridArea {
        if borders.len() <= GROUP {
            return GridArea::new(&self.grid, borders.iter().map(Vec::as_slice));
        }
        let (one, other) = borders.split_at(borders.len() / 2);
        let (mut all, other) = (self.unite_in_groups(one), self.unite_in_groups(other));
        all.append(&other);
        self.room.clipper.unite_boundaries(&all)
    }

    /// Removes everything that the boundaries wind around. Returns the removed area and the number of tiles
    /// it was in.
    fn take_out_area(&mut self, cut: &GridArea) -> (GridArea, usize) {
        let mut taken = GridArea::default();
        let Some(window) = cut.bounding_box() else { return (taken, 0) };
        let count = self.material.take_out_area(cut, &window, self.most_corners, &mut self.room, &mut taken);
        (taken, count)
    }

    /// Returns the area that is left, mm2.
    pub fn area_mm2(&self) -> f64 {
        self.remaining_area().area_mm2(&self.grid)
    }

    /// Returns the material that is left as connected polygons.
    pub fn remaining_polygons(&self) -> Vec<Polygon> {
        TileBuffers::default().clipper.extract_polygons(&self.remaining_area(), &self.grid).0
    }

    fn remaining_area(&self) -> GridArea {
        let mut all = GridArea::default();
        self.material.append_area_to(&mut all);
        all
    }
}
