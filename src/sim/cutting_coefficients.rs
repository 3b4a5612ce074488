//! Cutting coefficients of a work material (mechanistic force model).

/// Mechanistic coefficients: on an edge element of length dl that cuts a chip of thickness h,
/// `dF_t = (k_tc h + k_te) dl`, and radial and axial alike (Altintas, Manufacturing Automation, ch. 2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CuttingCoefficients {
    /// Tangential cutting coefficient in N/mm2.
    pub k_tc: f64,
    /// Tangential edge coefficient in N/mm.
    pub k_te: f64,
    /// Radial cutting coefficient (along the edge's normal, from the work into the cutter) in N/mm2.
    pub k_rc: f64,
    /// Radial edge coefficient in N/mm.
    pub k_re: f64,
    /// Axial cutting coefficient (along the meridian, from the tip upwards) in N/mm2.
    pub k_ac: f64,
    /// Axial edge coefficient in N/mm.
    pub k_ae: f64,
}
