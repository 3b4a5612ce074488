//! Mills of the tests, from APT's numbers: diameter, corner radius, taper, angle of the bottom and height, in mm and
//! radians.

use clsmith::certified_engagement::{CutterContour, ProofCutter};
use clsmith::cutter::Meridian;

/// The contour of a mill.
pub fn mill(diameter: f64, corner: f64, taper: f64, tip: f64, height: f64) -> CutterContour {
    CutterContour::from_meridian(&Meridian::new(diameter, corner, taper, tip, height).unwrap()).unwrap()
}

/// The same mill for a proof, from its numbers alone.
pub fn proof_mill(diameter: f64, corner: f64, taper: f64, tip: f64, height: f64) -> ProofCutter {
    let half = diameter / 2.0;
    // The flank leans by the taper and passes (half, half tan tip); the bottom rises by the tip's angle.
    let foot = half * tip.tan();
    let flank = move |z: f64| half + (z - foot) * taper.tan();
    // The corner's centre is one radius inside of both.
    let inset = |z: f64| flank(z) - corner / taper.cos();
    let bottom = |r: f64| r * tip.tan() + corner / tip.cos();
    let (mut low, mut high) = (0.0, height.max(half + foot + corner) * 2.0);
    for _ in 0..200 {
        let middle = (low + high) / 2.0;
        if bottom(inset(middle)) > middle { low = middle } else { high = middle }
    }
    let (center_z, center_r) =
        if corner >= half - 1e-6 && tip == 0.0 { (corner, 0.0) } else { (low, inset(low).max(0.0)) };
    let (lower, upper) = (center_z - corner * tip.cos(), center_z - corner * taper.sin());
    let radius = move |z: f64| {
        if z < lower && tip > 0.0 {
            z / tip.tan()
        } else if z < upper && corner > 0.0 {
            let across = corner * corner - (center_z - z) * (center_z - z);
            center_r + across.max(0.0).sqrt()
        } else {
            flank(z)
        }
    };
    ProofCutter::from_radius(Box::new(radius), height)
}
