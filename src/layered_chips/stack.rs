//! The workpiece as a stack of layers.

mod layer;
mod level_mesh_sections;
mod primitive_sections;
mod tiles;

pub use layer::{Layer, LayerRemoval};

use super::area::{AreaGrid, Clipper, GridArea};
use crate::sim::{SolidBody, Stock};
use level_mesh_sections::LevelMeshSections;
use primitive_sections::SectionedCylinder;
use rayon::prelude::*;

/// Layers at most: a bound on memory.
pub const MOST_LAYERS: usize = 100_000;

/// Why there is no stack of a stock.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum LayerStackError {
    /// A layer without thickness, or thicker than the stock.
    #[error("a layer must have a thickness, and not more than the stock is high: {height} mm")]
    Thickness {
        /// Height of the stock, mm.
        height: f64,
    },
    /// Thinner layers than there is memory for.
    #[error("they would be {layers}, more than the {MOST_LAYERS} that are allowed")]
    TooMany {
        /// Layers that it makes.
        layers: f64,
    },
    /// A stock too large for steps that are fine enough.
    #[error("the stock is {size} mm wide; areas are cut exactly up to 130 m only")]
    TooLarge {
        /// Its larger side in x and y, mm.
        size: f64,
    },
    /// A mesh that should be grown.
    #[error(
        "the stock is an STL with an allowance of {allowance} mm; a mesh cannot be grown for layers, so give an STL with the allowance in it"
    )]
    Allowance {
        /// The allowance, mm.
        allowance: f64,
    },
    /// What an earlier program left.
    #[error("the stock is a .clstock of columns, which has no exact layers; give a block, cylinder or STL")]
    Remains,
}

/// The workpiece in layers z = const, from below.
#[derive(Debug, Clone)]
pub struct LayerStack {
    bounds: ([f64; 3], [f64; 3]),
    grid: AreaGrid,
    layers: Vec<Layer>,
}

impl LayerStack {
    /// A stock in layers of a thickness, mm, the lowest on its lower side and the highest as thin as is left. Each has the section of
    /// the stock in its middle; curves are chords within 0.0005 mm.
    ///
    /// # Errors
    /// When the thickness is none or makes too many layers, the stock is larger than sections can be exact, or made of something that has no
    /// exact sections: a mesh with an allowance, or remains.
    pub fn new(stock: &Stock, thickness: f64) -> Result<Self, LayerStackError> {
        Self::with_max_vertices(stock, thickness, layer::MOST_CORNERS)
    }

    /// The same, with areas in pieces of at most so many corners. Nothing but the time it takes depends on them, as far as roundings go.
    ///
    /// # Errors
    /// See [`LayerStack::new`].
    pub fn with_max_vertices(stock: &Stock, thickness: f64, corners: usize) -> Result<Self, LayerStackError> {
        let bounds = stock.bounds();
        let ([x0, y0, z0], [x1, y1, z1]) = bounds;
        let height = z1 - z0;
        if !(thickness > 0.0 && thickness <= height * (1.0 + 1e-9)) {
            return Err(LayerStackError::Thickness { height });
        }
        // A rounding more than a whole number of layers is no layer.
        let count = (height / thickness - 1e-9).ceil().max(1.0);
        if count > MOST_LAYERS as f64 {
            return Err(LayerStackError::TooMany { layers: count });
        }
        let size = (x1 - x0).max(y1 - y0);
        let grid = AreaGrid::around_box([x0, y0], [x1, y1]).ok_or(LayerStackError::TooLarge { size })?;
        let slabs: Vec<[f64; 2]> = (0..count as usize)
            .map(|number| z0 + thickness * number as f64)
            .map(|bottom| [bottom, thickness.min(z1 - bottom)])
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

    /// Lower and upper corner of the box around the stock, mm.
    pub fn bounds(&self) -> ([f64; 3], [f64; 3]) {
        self.bounds
    }

    /// The grid on which areas are cut.
    pub fn grid(&self) -> &AreaGrid {
        &self.grid
    }

    /// The layers, from below.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// The layers, from below; none depends on another one.
    pub fn layers_mut(&mut self) -> &mut [Layer] {
        &mut self.layers
    }

    /// What is left, mm3: areas times thicknesses.
    pub fn volume_mm3(&self) -> f64 {
        self.layers.iter().map(|layer| layer.area_mm2() * layer.thickness_mm()).sum()
    }
}

/// A body that has level sections.
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

    /// The section in the plane with a number, whose borders wind around it once.
    fn section_at(&self, number: usize, height: f64, grid: &AreaGrid) -> GridArea {
        match self {
            Self::Block(from, to) => {
                GridArea::new(grid, [primitive_sections::section_block(*from, *to, height).as_slice()])
            }
            Self::Cylinder(cylinder) => GridArea::new(grid, [cylinder.section_at(height).as_slice()]),
            // Several shells, of which some may be turned inside out: joined before other bodies come.
            Self::Mesh(slices) => {
                let borders = slices.section_at(number, height);
                Clipper::default().unite_boundaries(&GridArea::new(grid, borders.iter().map(Vec::as_slice)))
            }
        }
    }
}
