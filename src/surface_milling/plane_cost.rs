//! This module estimates what the work on many planes takes from a few of them, and holds it to a budget.

use super::plane_slices::PlaneSlice;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::simulation_run::{RunWatcher, SimulationBudget, WorkEstimate};
use crate::surface::profile::Chain;
use std::time::Instant;

/// Work on fewer planes is not estimated: it would take nearly as long as the samples.
const FEWEST_PLANES: usize = 40;

/// The planes that are tried, as shares of all of them.
const SAMPLES: [f64; 3] = [0.25, 0.5, 0.75];

/// The memory of a piece of a tip's path in bytes: in its plane, as a track, as a motion and as text.
const BYTES_PER_PIECE: f64 = 400.0;

/// How much longer than making it a plane takes with its proof.
const WITH_PROOF: f64 = 3.0;

/// Tries a few planes, tells what all of them will take, and refuses what takes more memory than it may: what
/// the watcher allows, or as much as the columns of a simulation may take.
///
/// # Errors
/// Returns [`codes::TOO_MUCH`], and what `watch` stops the work with.
pub(super) fn check_plane_cost(
    places: &[f64],
    watch: &dyn RunWatcher,
    make: &dyn Fn(f64) -> PlaneSlice,
) -> Result<(), Failure> {
    if places.len() < FEWEST_PLANES {
        return Ok(());
    }
    let count = places.len() as f64;
    let begun = Instant::now();
    let (mut pieces, mut tried) = (0, 0.0);
    for share in SAMPLES {
        watch.check_stop()?;
        let Some(offset) = places.get((count * share) as usize) else { continue };
        pieces += make(*offset).tips.iter().map(|tip: &Chain| tip.pieces().len()).sum::<usize>();
        tried += 1.0;
    }
    let in_all = pieces as f64 / f64::max(tried, 1.0) * count;
    let bytes = in_all * BYTES_PER_PIECE;
    watch.report_estimate(&WorkEstimate {
        work: "making the passes",
        thread_seconds: WITH_PROOF * begun.elapsed().as_secs_f64() / f64::max(tried, 1.0) * count,
        bytes: bytes as u64,
        size: format!("about {in_all:.0} motions in {count} planes"),
    });
    let most = watch.memory_limit_bytes().unwrap_or(SimulationBudget::default().bytes);
    if bytes <= most as f64 {
        return Ok(());
    }
    let gib = f64::from(1 << 30);
    let message = format!(
        "{count} planes will have about {in_all:.0} motions and take {:.1} GiB, more than the {:.1} GiB that they may",
        bytes / gib,
        most as f64 / gib
    );
    let help = "Take a larger --step or --tolerance, mill the part in strips by --from and --to, or allow more by --memory.";
    Err(Diagnostic::new(codes::TOO_MUCH, message).with_help(help).into())
}
