//! What editors get.

mod schemas;
