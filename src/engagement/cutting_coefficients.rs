//! This module holds the cutting coefficients of a work material for the mechanistic force model.

/// The mechanistic coefficients of a material. An edge element of length dl that cuts a chip of thickness h
/// meets the tangential force `dF_t = (k_tc h + k_te) dl`, and radial and axial forces of the same form
/// (Altintas, Manufacturing Automation, ch. 2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CuttingCoefficients {
    /// The tangential cutting coefficient in N/mm2.
    pub k_tc: f64,
    /// The tangential edge coefficient in N/mm.
    pub k_te: f64,
    /// The radial cutting coefficient in N/mm2; the radial force acts along the edge's normal, from the work
    /// into the cutter.
    pub k_rc: f64,
    /// The radial edge coefficient in N/mm.
    pub k_re: f64,
    /// The axial cutting coefficient in N/mm2; the axial force acts along the meridian, from the tip upwards.
    pub k_ac: f64,
    /// The axial edge coefficient in N/mm.
    pub k_ae: f64,
}
