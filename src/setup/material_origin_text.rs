//! This module holds parts of a material as they are written: the law of Kienzle, and where numbers come from and hold.

use crate::engagement::KienzleTerm;
use crate::parameters::{Finite, Fraction, NonNegative};
use schemars::JsonSchema;
use serde::Deserialize;

/// The Kienzle law: a force of k11 h^(1-m) per mm of edge in each direction.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Kienzle")]
pub(super) struct KienzleText {
    /// The force against the motion of the edge.
    pub tangential: KienzleTermText,
    /// The force along the normal into the tool; none when it is left out.
    pub radial: Option<KienzleTermText>,
    /// The force along the meridian towards the tip; none when it is left out.
    pub axial: Option<KienzleTermText>,
}

/// The Kienzle law of one direction.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "KienzleTerm")]
pub(super) struct KienzleTermText {
    /// The specific force at a chip of 1 mm, in N/mm2.
    #[schemars(extend("x-unit" = "N/mm2"))]
    pub k11: Finite,
    /// The power by which the specific force falls with the thickness, from 0 to below 1.
    pub m: Fraction,
}

impl KienzleTermText {
    pub(super) fn to_term(&self) -> KienzleTerm {
        KienzleTerm { k11: self.k11.get(), m: self.m.get() }
    }
}

/// Where single numbers come from.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "CoefficientSources")]
pub(super) struct CoefficientSourcesText {
    /// The source of `k_tc`.
    pub k_tc: Option<String>,
    /// The source of `k_te`.
    pub k_te: Option<String>,
    /// The source of `k_rc`.
    pub k_rc: Option<String>,
    /// The source of `k_re`.
    pub k_re: Option<String>,
    /// The source of `k_ac`.
    pub k_ac: Option<String>,
    /// The source of `k_ae`.
    pub k_ae: Option<String>,
    /// The source of `kienzle`.
    pub kienzle: Option<String>,
}

/// The standard errors of single numbers.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "CoefficientErrors")]
pub(super) struct CoefficientErrorsText {
    /// The standard error of `k_tc`, in N/mm2.
    pub k_tc: Option<NonNegative>,
    /// The standard error of `k_te`, in N/mm.
    pub k_te: Option<NonNegative>,
    /// The standard error of `k_rc`, in N/mm2.
    pub k_rc: Option<NonNegative>,
    /// The standard error of `k_re`, in N/mm.
    pub k_re: Option<NonNegative>,
    /// The standard error of `k_ac`, in N/mm2.
    pub k_ac: Option<NonNegative>,
    /// The standard error of `k_ae`, in N/mm.
    pub k_ae: Option<NonNegative>,
}

/// The cuts in which the numbers were found: least and largest values.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "MaterialRanges")]
pub(super) struct MaterialRangesText {
    /// The thickest chips, in mm.
    pub chip: Option<[NonNegative; 2]>,
    /// The cutting speeds, in m/min.
    pub cutting_speed: Option<[NonNegative; 2]>,
    /// The axial depths, in mm.
    pub axial_depth: Option<[NonNegative; 2]>,
}

impl CoefficientSourcesText {
    pub(super) fn into_list(self) -> Vec<(&'static str, String)> {
        let all = [
            ("k_tc", self.k_tc),
            ("k_te", self.k_te),
            ("k_rc", self.k_rc),
            ("k_re", self.k_re),
            ("k_ac", self.k_ac),
            ("k_ae", self.k_ae),
            ("kienzle", self.kienzle),
        ];
        all.into_iter().filter_map(|(key, source)| Some((key, source?))).collect()
    }
}

impl CoefficientErrorsText {
    pub(super) fn into_list(self) -> Vec<(&'static str, f64)> {
        let all = [
            ("k_tc", self.k_tc),
            ("k_te", self.k_te),
            ("k_rc", self.k_rc),
            ("k_re", self.k_re),
            ("k_ac", self.k_ac),
            ("k_ae", self.k_ae),
        ];
        all.into_iter().filter_map(|(key, error)| Some((key, error?.get()))).collect()
    }
}
