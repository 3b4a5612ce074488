//! This module holds the workpiece as a stack of layers.

mod layer;
mod level_mesh_sections;
mod primitive_sections;
mod tiles;

pub use layer::{Layer, LayerRemoval};

use super::area::{AreaGrid, Clipper, GridArea};
use crate::stock::{AxisBox, SolidBody, Stock};
use level_mesh_sections::LevelMeshSections;
use primitive_sections::SectionedCylinder;
use rayon::prelude::*;

/// The most layers, which bounds the memory.
pub(crate) const MOST_LAYERS: usize = 100_000;

/// The reason why a stock has no stack of layers.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LayerStackError {
    /// The layers have no thickness, or are thicker than the stock is high.
    #[error("a layer must have a thickness, and not more than the stock is high: {height} mm")]
    Thickness {
        /// The height of the stock, mm.
        height: f64,
    },
    /// The layers are so thin that there are too many of them.
    #[error("they would be {layers}, more than the {MOST_LAYERS} that are allowed")]
    TooMany {
        /// The number of layers.
        layers: f64,
    },
    /// The stock is too large for a grid that is fine enough.
    #[error("the stock is {size} mm wide; areas are cut exactly up to 130 m only")]
    TooLarge {
        /// The larger side of the stock in x and y, mm.
        size: f64,
    },
    /// The stock is a mesh with an allowance, and a mesh cannot be grown here.
    #[error(
        "the stock is an STL with an allowance of {allowance} mm; a mesh cannot be grown for layers, so give an STL with the allowance in it"
    )]
    Allowance {
        /// The allowance, mm.
        allowance: f64,
    },
    /// The stock has a mesh that cannot be turned into the frame of the layers.
    #[error(
        "the stock is an STL in which long edges meet several shorter ones, and such a mesh cannot be turned; give an STL whose triangles meet edge to edge"
    )]
    Turned,
    /// The stock is what an earlier program left.
    #[error("the stock is a .clstock of columns, which has no exact layers; give a block, cylinder or STL")]
    Remains,
}

/// The workpiece in layers z = const, from below.
#[derive(Debug, Clone)]
pub struct LayerStack {
    bounds: AxisBox,
    grid: AreaGrid,
    layers: Vec<Layer>,
}

impl LayerStack {
    /// Makes the stack of a stock in layers of a thickness, mm. The lowest layer is on the lower side of the
    /// stock, and the highest one is thinner if the thickness does not divide the height. Each layer has the
    /// stock's section at the layer's middle; curves become chords within 0.0005 mm.
    ///
    /// # Errors
    /// Returns an error if the thickness is not positive or makes too many layers, if the stock is too large
    /// for exact sections, or if it has no exact sections: a mesh with an allowance, or remains.
    pub fn new(stock: &Stock, thickness_mm: f64) -> Result<Self, LayerStackError> {
        Self::with_max_vertices(stock, thickness_mm, layer::MOST_CORNERS)
    }

    /// Makes the same stack with areas in pieces of at most `corners` vertices. Apart from rounding, the
    /// result does not depend on that number, only the time.
    ///
    /// # Errors
    /// Returns the errors of [`LayerStack::new`].
    pub fn with_max_vertices(
        stock: &Stock,
        thickness_mm: f64,
        corners: usize,
    ) -> Result<Self, LayerStackError> {
        let bounds = stock.bounds();
        let ([x0, y0, z0], [x1, y1, z1]) = bounds;
        let height = z1 - z0;
        if !(thickness_mm > 0.0 && thickness_mm <= height * (1.0 + 1e-9)) {
            return Err(LayerStackError::Thickness { height });
        }
        // A rest of the height that is only rounding gets no layer.
        let count = (height / thickness_mm - 1e-9).ceil().max(1.0);
        if count > MOST_LAYERS as f64 {
            return Err(LayerStackError::TooMany { layers: count });
        }
        let size = (x1 - x0).max(y1 - y0);
        let grid = AreaGrid::around_box([x0, y0], [x1, y1]).ok_or(LayerStackError::TooLarge { size })?;
        let slabs: Vec<[f64; 2]> = (0..count as usize)
            .map(|number| z0 + thickness_mm * number as f64)
            .map(|bottom| [bottom, thickness_mm.min(z1 - bottom)])
            .collect();
        let heights: Vec<f64> = slabs.iter().map(|[bottom, thickness]| bottom + thickness / 2.0).collect();
        let shapes =
            stock.bodies().iter().map(|body| SectionedBody::new(body, stock.allowance_mm(), &heights));
        let shapes: Vec<SectionedBody> = shapes.collect::<Result<_, _>>()?;
        let layers = slabs.into_par_iter().zip(&heights).enumerate().map(|(number, (slab, height))| {
            let mut area = GridArea::default();
            shapes.iter().for_each(|shape| area.append(&shape.section_at(number, *height, &grid)));
            Layer::new(number, slab, grid, area, corners)
        });
        Ok(Self { bounds, grid, layers: layers.collect() })
    }

    /// Returns the lowest and highest corner of the box around the stock, mm.
    pub fn bounds(&self) -> AxisBox {
        self.bounds
    }

    /// Returns the grid on which areas are cut.
    pub fn grid(&self) -> &AreaGrid {
        &self.grid
    }

    /// Returns the layers, from below.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// Returns the layers for changing, from below. No layer depends on another one.
    pub fn layers_mut(&mut self) -> &mut [Layer] {
        &mut self.layers
    }

    /// Returns the volume that is left, mm3: the sum of area times thickness.
    pub fn volume_mm3(&self) -> f64 {
        self.layers.iter().map(|layer| layer.area_mm2() * layer.thickness_mm()).sum()
    }
}

/// A body that has exact level sections.
enum SectionedBody {
    Block([f64; 3], [f64; 3]),
    Cylinder(SectionedCylinder),
    Mesh(LevelMeshSections),
}

impl SectionedBody {
    fn new(body: &SolidBody, allowance: f64, heights: &[f64]) -> Result<Self, LayerStackError> {
        match body {
            SolidBody::Block { from, to } => {
                Ok(Self::Block(from.map(|at| at - allowance), to.map(|at| at + allowance)))
            }
            SolidBody::Cylinder { diameter, from, to } => {
                Ok(Self::Cylinder(SectionedCylinder::new(*diameter, [*from, *to], allowance)))
            }
            SolidBody::Mesh(_) if allowance > 0.0 => Err(LayerStackError::Allowance { allowance }),
            SolidBody::Mesh(mesh) => Ok(Self::Mesh(LevelMeshSections::new(mesh, heights))),
            SolidBody::Remains(_) => Err(LayerStackError::Remains),
        }
    }

    /// Returns the body's section in the plane with this number and height; its boundaries wind around it
    /// once.
    fn section_at(&self, number: usize, height: f64, grid: &AreaGrid) -> GridArea {
        match self {
            Self::Block(from, to) => {
                GridArea::new(grid, [primitive_sections::section_block(*from, *to, height).as_slice()])
            }
            Self::Cylinder(cylinder) => GridArea::new(grid, [cylinder.section_at(height).as_slice()]),
            // A mesh may have several shells, some of them turned inside out, so they are united before other
            // bodies are added.
            Self::Mesh(slices) => {
                let borders = slices.section_at(number, height);
                Clipper::default().unite_boundaries(&GridArea::new(grid, borders.iter().map(Vec::as_slice)))
            }
        }
    }
}
