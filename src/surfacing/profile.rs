//! The profile that is swept: curves that hang together, as a file describes them.

use crate::surface::profile::{
    Chain, ChainError, ChordError, Ellipse, Nurbs, Piece, Point, to_arcs, to_chords,
};

/// A curve of a profile.
#[derive(Debug, Clone, PartialEq)]
pub enum ProfileCurve {
    /// A line or an arc.
    Piece(Piece),
    /// An arc of an ellipse.
    Ellipse(Ellipse),
    /// A NURBS curve.
    Nurbs(Nurbs),
}

/// A profile in a vertical plane, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Its curves; each starts where the one before ends.
    pub curves: Vec<ProfileCurve>,
    /// Over which width it is swept, where that is said.
    pub width: Option<f64>,
}

/// Why curves make no chain.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ProfileError {
    /// Pieces that do not fit.
    #[error(transparent)]
    Chain(#[from] ChainError),
    /// A tolerance that cannot be.
    #[error(transparent)]
    Chords(#[from] ChordError),
}

impl Profile {
    /// A profile of straight pieces and arcs only.
    pub fn of_chain(chain: &Chain) -> Self {
        Self { curves: chain.pieces().iter().copied().map(ProfileCurve::Piece).collect(), width: None }
    }

    /// The profile with ellipses and NURBS in arcs and chords no farther than `tolerance` (mm) from them.
    ///
    /// # Errors
    /// When the pieces do not fit or the tolerance is too small.
    pub fn chain(&self, tolerance: f64) -> Result<Chain, ProfileError> {
        self.made(|curve| match curve {
            ProfileCurve::Piece(piece) => Ok(vec![*piece]),
            ProfileCurve::Ellipse(ellipse) => Ok(to_arcs(ellipse, tolerance)?.pieces().to_vec()),
            ProfileCurve::Nurbs(nurbs) => Ok(to_arcs(nurbs, tolerance)?.pieces().to_vec()),
        })
    }

    /// The profile to check against: the curves themselves in fine chords, by no arc fitted.
    ///
    /// # Errors
    /// As [`Profile::chain`].
    pub fn dense(&self, tolerance: f64) -> Result<Chain, ProfileError> {
        self.made(|curve| match curve {
            ProfileCurve::Piece(piece) => Ok(vec![*piece]),
            ProfileCurve::Ellipse(ellipse) => Ok(to_chords(ellipse, tolerance)?.pieces().to_vec()),
            ProfileCurve::Nurbs(nurbs) => Ok(to_chords(nurbs, tolerance)?.pieces().to_vec()),
        })
    }

    fn made(
        &self,
        mut pieces: impl FnMut(&ProfileCurve) -> Result<Vec<Piece>, ProfileError>,
    ) -> Result<Chain, ProfileError> {
        let mut all = Vec::new();
        for curve in &self.curves {
            all.extend(pieces(curve)?);
        }
        Ok(Chain::new(all)?)
    }
}

/// Least and largest u and z of a chain, from its ends and enough places of its arcs.
pub(super) fn bounds(chain: &Chain) -> (Point, Point) {
    let (mut low, mut high) = (chain.start(), chain.start());
    for piece in chain.pieces() {
        let places = if matches!(piece, Piece::Arc(_)) { 256 } else { 1 };
        for place in 0..=places {
            let at = piece.point(f64::from(place) / f64::from(places));
            low = Point::new(low.u.min(at.u), low.z.min(at.z));
            high = Point::new(high.u.max(at.u), high.z.max(at.z));
        }
    }
    (low, high)
}
