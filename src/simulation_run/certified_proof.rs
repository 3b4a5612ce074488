//! This module tests certified shares at points: random points of every block, and points near the worst ones, are
//! tested for membership in the stock and in all earlier sweeps by code that shares nothing with what made the bounds.

use super::certified_shares::CertifiedShares;
use super::{Machining, RunPhase, RunWatcher};
use crate::certified_engagement::{EngagementProof, ProofClaim, ProofCutter, ProofFinding, ProofStock};
use crate::cutter::{CutterModel, Meridian};
use crate::diagnostic::Failure;
use crate::stock::{SolidBody, Stock};
use nalgebra::Vector3;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// The random points of a block; half as many are tried near the worst of them.
const POINTS_OF_A_BLOCK: usize = 24;

/// Blocks that one thread tests before it looks whether it has to stop.
const BLOCKS_OF_A_RUN: usize = 256;

/// The first point sequence; every run tries the same points.
const SEED: u64 = 20_150_723;

/// The proof of the shares of a program by points.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct ShareProof {
    /// The number of points that were tried.
    pub samples: u64,
    /// For each motion that was tested, the largest share of a point that is cut.
    pub largest_shares: BTreeMap<usize, f64>,
    /// The index of the first motion of which a point is above its bound.
    pub refuted_motion: Option<usize>,
}

impl Machining<'_> {
    /// Tests shares at points. Returns `None` for stock whose points cannot be told by other means: meshes, and what
    /// another program left.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` has stopped the run.
    pub(crate) fn test_shares(
        &self,
        shares: &CertifiedShares,
        watch: &dyn RunWatcher,
    ) -> Result<Option<ShareProof>, Failure> {
        let Some(stock) = make_proof_stock(&self.stock) else { return Ok(None) };
        watch.begin_phase(RunPhase::Checking);
        let (low, high) = self.stock.bounds();
        // The blocks count the cutters that have a contour.
        let cutters = self.tooling.cutters().iter().zip(self.list_contours());
        let cutters = cutters.filter_map(|(cutter, contour)| contour.map(|_| make_proof_cutter(cutter)));
        let mut proof = EngagementProof::new(stock, [low.into(), high.into()], cutters.collect());
        for block in shares.blocks() {
            let is_known = proof.push_block(block);
            debug_assert!(is_known, "blocks name the cutters that have a contour");
        }
        let claims: Vec<(usize, ProofClaim)> = shares
            .claims()
            .map(|claim| {
                // The point that the bound's own search found is the worst that is known.
                let hint = claim.witness.map(|witness| (witness.point, witness.at));
                let of_block = ProofClaim { block: claim.block, upper_share: claim.upper, chip: None, hint };
                (claim.motion, of_block)
            })
            .collect();
        let pace = |claim: &ProofClaim| shares.pace_of(claim.block);
        let test_run = |run: &[(usize, ProofClaim)]| -> Result<Vec<(usize, ProofFinding)>, Failure> {
            watch.check_stop()?;
            let test = |(motion, claim): &(usize, ProofClaim)| {
                let mut finding = proof.test_block(claim, POINTS_OF_A_BLOCK, SEED);
                finding.largest_share *= pace(claim);
                (*motion, finding)
            };
            Ok(run.iter().map(test).collect())
        };
        let found: Result<Vec<_>, Failure> = claims.par_chunks(BLOCKS_OF_A_RUN).map(test_run).collect();
        let mut sum = ShareProof::default();
        for (motion, finding) in found?.into_iter().flatten() {
            sum.samples += finding.samples as u64;
            let largest = sum.largest_shares.entry(motion).or_default();
            *largest = largest.max(finding.largest_share);
            if finding.refuted.is_some() && sum.refuted_motion.is_none() {
                sum.refuted_motion = Some(motion);
            }
        }
        Ok(Some(sum))
    }
}

/// Makes the cutter of a proof.
fn make_proof_cutter(cutter: &CutterModel) -> ProofCutter {
    let profile: Meridian = cutter.profile.clone();
    let height = profile.height_mm();
    ProofCutter::from_radius(Box::new(move |z| profile.radius_at_height_mm(z)), height)
}

/// Makes the membership of points in a stock of blocks and cylinders.
fn make_proof_stock(stock: &Stock) -> Option<ProofStock> {
    let grown_mm = stock.allowance_mm();
    let bodies: Option<Vec<ProofStock>> =
        stock.bodies().iter().map(|body| make_membership(body, grown_mm)).collect();
    let bodies = bodies?;
    Some(Box::new(move |point| bodies.iter().any(|contains| contains(point))))
}

fn make_membership(body: &SolidBody, grown_mm: f64) -> Option<ProofStock> {
    match body {
        SolidBody::Block { from, to } => {
            let (from, to) = (*from, *to);
            Some(Box::new(move |point| {
                (0..3).zip(from.iter().zip(&to)).all(|(axis, (from, to))| {
                    point.iter().nth(axis).is_some_and(|at| (from - grown_mm..=to + grown_mm).contains(at))
                })
            }))
        }
        SolidBody::Cylinder { diameter, from, to } => {
            let (from, to) = (Vector3::from(*from), Vector3::from(*to));
            let (length, radius) = ((to - from).norm(), diameter / 2.0 + grown_mm);
            Some(Box::new(move |point| {
                let along = (point - from).dot(&(to - from)) / length;
                let across = ((point - from).norm_squared() - along * along).max(0.0).sqrt();
                (-grown_mm..=length + grown_mm).contains(&along) && across <= radius
            }))
        }
        SolidBody::Mesh(_) | SolidBody::Remains(_) => None,
    }
}
