//! This module holds the profile that is swept: connected curves as a file describes them.

use crate::surface::profile::{
    Chain, ChainError, ChainPiece, ChordError, EllipseArc, NurbsCurve, Point, to_arcs, to_chords,
};

/// A curve of a profile.
#[derive(Debug, Clone, PartialEq)]
pub enum ProfileCurve {
    /// A line or an arc.
    Piece(ChainPiece),
    /// An arc of an ellipse.
    Ellipse(EllipseArc),
    /// A NURBS curve.
    Nurbs(NurbsCurve),
}

/// A profile in a vertical plane, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionProfile {
    /// The curves; each starts where the one before ends.
    pub curves: Vec<ProfileCurve>,
    /// The width over which the profile is swept, if it is given.
    pub width_mm: Option<f64>,
}

/// The reason why curves do not make a chain.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SectionProfileError {
    /// The pieces do not fit together.
    #[error(transparent)]
    Chain(#[from] ChainError),
    /// The tolerance cannot be used.
    #[error(transparent)]
    Chords(#[from] ChordError),
}

impl SectionProfile {
    /// Makes a profile that only has straight pieces and arcs.
    pub fn from_chain(chain: &Chain) -> Self {
        Self { curves: chain.pieces().iter().copied().map(ProfileCurve::Piece).collect(), width_mm: None }
    }

    /// Converts the profile to a chain in which ellipses and NURBS curves are arcs and chords at most
    /// `tolerance_mm` from them.
    ///
    /// # Errors
    /// Returns an error if the pieces do not fit together or the tolerance is too small.
    pub fn to_chain(&self, tolerance_mm: f64) -> Result<Chain, SectionProfileError> {
        self.convert_curves(|curve| match curve {
            ProfileCurve::Piece(piece) => Ok(vec![*piece]),
            ProfileCurve::Ellipse(ellipse) => Ok(to_arcs(ellipse, tolerance_mm)?.pieces().to_vec()),
            ProfileCurve::Nurbs(nurbs) => Ok(to_arcs(nurbs, tolerance_mm)?.pieces().to_vec()),
        })
    }

    /// Converts the profile to the chain that the proof uses: curves become fine chords without fitted arcs.
    ///
    /// # Errors
    /// Returns the errors of [`SectionProfile::to_chain`].
    pub fn to_dense_chain(&self, tolerance_mm: f64) -> Result<Chain, SectionProfileError> {
        self.convert_curves(|curve| match curve {
            ProfileCurve::Piece(piece) => Ok(vec![*piece]),
            ProfileCurve::Ellipse(ellipse) => Ok(to_chords(ellipse, tolerance_mm)?.pieces().to_vec()),
            ProfileCurve::Nurbs(nurbs) => Ok(to_chords(nurbs, tolerance_mm)?.pieces().to_vec()),
        })
    }

    fn convert_curves(
        &self,
        mut pieces: impl FnMut(&ProfileCurve) -> Result<Vec<ChainPiece>, SectionProfileError>,
    ) -> Result<Chain, SectionProfileError> {
        let mut all = Vec::new();
        for curve in &self.curves {
            all.extend(pieces(curve)?);
        }
        Ok(Chain::new(all)?)
    }
}

/// Returns the least and the greatest u and z of a chain, from its ends and from enough points of its arcs.
pub(super) fn chain_bounds(chain: &Chain) -> (Point, Point) {
    let (mut low, mut high) = (chain.start(), chain.start());
    for piece in chain.pieces() {
        let places = if matches!(piece, ChainPiece::Arc(_)) { 256 } else { 1 };
        for place in 0..=places {
            let at = piece.point_at(f64::from(place) / f64::from(places));
            low = Point::new(low.u.min(at.u), low.z.min(at.z));
            high = Point::new(high.u.max(at.u), high.z.max(at.z));
        }
    }
    (low, high)
}
