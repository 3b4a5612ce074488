//! This module holds what a work material asks of an edge: the mechanistic force laws and their coefficients.

/// The mechanistic coefficients of a material. An edge element of length dl that cuts a chip of thickness h
/// meets the tangential force `dF_t = (k_tc h + k_te) dl`, and radial and axial forces of the same form
/// (Altintas, Manufacturing Automation, ch. 2; directions as in Engin and Altintas, Int. J. Machine Tools and
/// Manufacture 41 (2001), 2195-2212).
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
    /// The axial cutting coefficient in N/mm2; the axial force on the cutter acts along the meridian, towards the tip. So
    /// one above 0 draws an end mill out of its holder and lifts the workpiece.
    pub k_ac: f64,
    /// The axial edge coefficient in N/mm.
    pub k_ae: f64,
}

impl CuttingCoefficients {
    /// Those of an edge that meets no force.
    pub const NONE: Self = Self { k_tc: 0.0, k_te: 0.0, k_rc: 0.0, k_re: 0.0, k_ac: 0.0, k_ae: 0.0 };
}

/// The Kienzle law of one direction: a force of `k11 h^(1 - m)` per length of edge (O. Kienzle, VDI-Z 94 (1952), 299-305).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KienzleTerm {
    /// The specific force at a chip of 1 mm, N/mm2.
    pub k11: f64,
    /// By what power the specific force falls with the thickness: at least 0 and below 1.
    pub m: f64,
}

impl KienzleTerm {
    fn force(self, chip_mm: f64) -> f64 {
        if self.k11 == 0.0 { 0.0 } else { self.k11 * chip_mm.powf(1.0 - self.m) }
    }

    /// Returns the slope and the value at 0 of the tangent at a thickness. The law is concave, so it lies below.
    fn tangent_at(self, chip_mm: f64) -> [f64; 2] {
        let specific = self.k11 * chip_mm.powf(-self.m);
        [specific * (1.0 - self.m), specific * self.m * chip_mm]
    }
}

/// What an edge needs to cut a chip.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum CuttingLaw {
    /// Forces grow linearly with the thickness, from what the edge needs without any.
    Linear(CuttingCoefficients),
    /// Forces grow with a power of the thickness.
    Kienzle {
        /// The force against the motion of the edge.
        tangential: KienzleTerm,
        /// The force along the normal.
        radial: KienzleTerm,
        /// The force along the meridian.
        axial: KienzleTerm,
    },
}

impl From<CuttingCoefficients> for CuttingLaw {
    fn from(coefficients: CuttingCoefficients) -> Self {
        Self::Linear(coefficients)
    }
}

/// The thicknesses (mm) at which a Kienzle law is replaced by its tangents.
const TANGENTS_MM: [f64; 8] = [0.004, 0.01, 0.02, 0.04, 0.08, 0.15, 0.3, 0.6];

impl CuttingLaw {
    /// Returns the tangential, radial and axial force per mm of edge at a chip above 0, N/mm.
    pub fn edge_forces_n_mm(&self, chip_mm: f64) -> [f64; 3] {
        match self {
            Self::Linear(CuttingCoefficients { k_tc, k_te, k_rc, k_re, k_ac, k_ae }) => {
                [k_tc * chip_mm + k_te, k_rc * chip_mm + k_re, k_ac * chip_mm + k_ae]
            }
            Self::Kienzle { tangential, radial, axial } => {
                [tangential, radial, axial].map(|term| term.force(chip_mm))
            }
        }
    }

    /// Returns by how much the tangential force per mm of edge grows with the chip, N/mm2.
    pub(super) fn tangential_slope(&self, chip_mm: f64) -> f64 {
        match self {
            Self::Linear(coefficients) => coefficients.k_tc,
            Self::Kienzle { tangential, .. } => tangential.tangent_at(chip_mm)[0],
        }
    }

    /// Returns whether forces are linear in the chip.
    pub fn is_linear(&self) -> bool {
        matches!(self, Self::Linear(_))
    }

    /// Returns the law with all forces multiplied.
    #[must_use]
    pub fn scaled(&self, by: f64) -> Self {
        match self {
            Self::Linear(CuttingCoefficients { k_tc, k_te, k_rc, k_re, k_ac, k_ae }) => {
                Self::Linear(CuttingCoefficients {
                    k_tc: k_tc * by,
                    k_te: k_te * by,
                    k_rc: k_rc * by,
                    k_re: k_re * by,
                    k_ac: k_ac * by,
                    k_ae: k_ae * by,
                })
            }
            Self::Kienzle { tangential, radial, axial } => {
                let scaled = |term: &KienzleTerm| KienzleTerm { k11: term.k11 * by, m: term.m };
                Self::Kienzle { tangential: scaled(tangential), radial: scaled(radial), axial: scaled(axial) }
            }
        }
    }

    /// Returns linear laws of which none is below this one, whose smallest is near it at usual chips.
    pub(super) fn upper_linear_laws(&self) -> Vec<CuttingCoefficients> {
        match self {
            Self::Linear(coefficients) => vec![*coefficients],
            Self::Kienzle { tangential, radial, axial } => TANGENTS_MM
                .map(|chip| {
                    let [[k_tc, k_te], [k_rc, k_re], [k_ac, k_ae]] =
                        [tangential, radial, axial].map(|term| term.tangent_at(chip));
                    CuttingCoefficients { k_tc, k_te, k_rc, k_re, k_ac, k_ae }
                })
                .to_vec(),
        }
    }
}
