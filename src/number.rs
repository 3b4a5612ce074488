//! CL number text to `f64` and back, keeping the style of the text.
//!
//! CAM systems write plain decimals: no exponent, no `+` (measured over 127 files). Hand-written files may have both, and
//! FORTRAN's `D` exponent; all are read.
