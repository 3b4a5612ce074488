mod catia_arcs;
mod corpus;
mod fixtures;
mod geometry;
mod modal;
mod operations;
mod splines;
mod tools;
