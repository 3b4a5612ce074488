//! The simulation.

mod compare;
mod export;
mod mesh;
mod remains;
mod shapes;
mod stock;
