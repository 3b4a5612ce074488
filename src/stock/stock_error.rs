//! This module holds the reasons why bodies do not make stock.

use crate::stock::axis_box::FARTHEST;
use crate::stock::memory::NoMemory;

/// The reason why there is no stock to simulate.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StockError {
    /// The list of bodies is empty.
    #[error("the stock has no body")]
    NoBody,
    /// The stock has no material: everything was cut from the remains, or the bodies are far thinner than a
    /// cell.
    #[error("there is no material in the stock")]
    Empty,
    /// A number is not finite, or larger than any workpiece.
    #[error("a number is not finite, or larger than {FARTHEST:e} mm")]
    NotFinite,
    /// The lower corner of a block is not below its upper corner.
    #[error("the block's lower corner must be below its upper one in x, y and z")]
    Block,
    /// A cylinder has no volume.
    #[error("the cylinder needs a positive diameter and two different ends")]
    Cylinder,
    /// The allowance is negative.
    #[error("the allowance must not be negative")]
    Allowance,
    /// The cell is not a positive length.
    #[error("the cell must be a positive length")]
    Cell,
    /// There is no memory for the columns.
    #[error(transparent)]
    NoMemory(#[from] NoMemory),
    /// The grid would have more columns than there is memory for.
    #[error("a cell of {cell} mm makes {columns} columns, more than the {most} that are allowed")]
    TooMany {
        /// The cell that was asked for, mm.
        cell: f64,
        /// The number of columns that it makes.
        columns: usize,
        /// The number of columns that are allowed.
        most: usize,
    },
}
