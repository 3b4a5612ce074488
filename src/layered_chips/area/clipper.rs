//! This module cuts and joins areas with the polygon booleans of [`i_overlay`]. It keeps the memory that they
//! need from one call to the next.

use super::grid_area::{is_thick, twice_area};
use super::{AreaGrid, GridArea, Polygon};
use i_overlay::core::extract::BooleanExtractionBuffer;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::{Overlay, ShapeType};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;

/// Cuts and joins areas.
#[derive(Default)]
pub struct Clipper {
    // The buffers are made at the first call, because they are large and most layers of a workpiece are never
    // cut.
    room: Option<Box<ClipperBuffers>>,
}

/// The memory that the polygon booleans reuse.
struct ClipperBuffers {
    overlay: Overlay,
    buffer: BooleanExtractionBuffer,
}

impl Clipper {
    /// Cuts an area along another one and writes the part inside and the part outside. The boundaries of
    /// `area` must wind around it once; `along` is everything that its boundaries wind around. Slivers that
    /// are as thin as rounding are left out of both results. Returns whether anything is inside; if not, both
    /// results are empty and the area stays as it is.
    pub fn split_area(
        &mut self,
        area: &GridArea,
        along: &GridArea,
        inside: &mut GridArea,
        outside: &mut GridArea,
    ) -> bool {
        inside.clear();
        outside.clear();
        let ClipperBuffers { overlay, buffer } = self.buffers_mut();
        overlay.clear();
        overlay.add_flat_buffer(&area.borders, ShapeType::Subject);
        overlay.add_flat_buffer(&along.borders, ShapeType::Clip);
        let Some(graph) = overlay.build_graph_view(FillRule::NonZero) else { return false };
        graph.extract_contours_into(OverlayRule::Intersect, buffer, &mut inside.borders);
        inside.drop_slivers();
        if inside.is_empty() {
            return false;
        }
        graph.extract_contours_into(OverlayRule::Difference, buffer, &mut outside.borders);
        outside.drop_slivers();
        true
    }

    /// Returns everything that the boundaries wind around, with boundaries that wind around it once.
    pub fn unite_boundaries(&mut self, area: &GridArea) -> GridArea {
        let mut joined = GridArea::default();
        let ClipperBuffers { overlay, buffer } = self.buffers_mut();
        overlay.clear();
        overlay.add_flat_buffer(&area.borders, ShapeType::Subject);
        if let Some(graph) = overlay.build_graph_view(FillRule::NonZero) {
            graph.extract_contours_into(OverlayRule::Subject, buffer, &mut joined.borders);
        }
        joined.drop_slivers();
        joined
    }

    /// Returns the connected pieces of everything that the boundaries wind around, and their area in mm2.
    /// Slivers that are as thin as rounding are left out.
    pub fn extract_polygons(&mut self, area: &GridArea, grid: &AreaGrid) -> (Vec<Polygon>, f64) {
        let ClipperBuffers { overlay, buffer } = self.buffers_mut();
        overlay.clear();
        overlay.add_flat_buffer(&area.borders, ShapeType::Subject);
        let shapes = match overlay.build_graph_view(FillRule::NonZero) {
            Some(graph) => graph.extract_shapes(OverlayRule::Subject, buffer),
            None => Vec::new(),
        };
        let places =
            |contour: Vec<IntPoint>| contour.into_iter().map(|point| grid.point_in_mm(point)).collect();
        let mut twice = 0;
        let pieces = shapes.into_iter().filter_map(|mut shape| {
            // A piece whose outer boundary is a sliver is left out with its holes.
            shape.first().filter(|outer| is_thick(outer))?;
            shape.retain(|contour| is_thick(contour));
            twice += shape.iter().map(|contour| twice_area(contour)).sum::<i128>();
            let mut borders = shape.into_iter().map(places);
            Some(Polygon { outer: borders.next()?, holes: borders.collect() })
        });
        let pieces = pieces.collect();
        (pieces, twice as f64 / 2.0 * grid.step_mm() * grid.step_mm())
    }

    /// Returns the connected pieces of an area whose boundaries wind around it once, and their area in mm2.
    /// `parted` says that several boundaries may have parts in common.
    pub(crate) fn extract_connected_pieces(
        &mut self,
        area: &GridArea,
        parted: bool,
        grid: &AreaGrid,
    ) -> (Vec<Polygon>, f64) {
        // Without holes and common parts, every boundary is a piece, and no boolean is needed.
        if parted || area.contours().any(|contour| twice_area(contour) < 0) {
            return self.extract_polygons(area, grid);
        }
        let piece = |contour: &[IntPoint]| {
            let outer = contour.iter().map(|point| grid.point_in_mm(*point)).collect();
            Polygon { outer, holes: Vec::new() }
        };
        (area.contours().map(piece).collect(), area.area_mm2(grid))
    }

    fn buffers_mut(&mut self) -> &mut ClipperBuffers {
        self.room.get_or_insert_with(|| {
            Box::new(ClipperBuffers { overlay: Overlay::new(256), buffer: Default::default() })
        })
    }
}

impl Clone for Clipper {
    /// Makes an empty clipper, since the buffers hold nothing between two calls.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl std::fmt::Debug for Clipper {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Clipper").finish_non_exhaustive()
    }
}
