//! This module estimates the cost of a run in layers before it starts, and holds it to a budget.

use super::LayerRunOptions;
use super::layer_runner::end_line_number;
use super::stock_reach::can_reach_stock;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::engagement::PathPiece;
use crate::layered_chips::stack::MOST_LAYERS;
use crate::layered_chips::{FlatMill, LayerFrame};
use crate::program::geometry::MotionPath;
use crate::simulation_run::{Machining, WorkEstimate};
use crate::stock::{AxisBox, Stock};

/// How many sections of chips one thread finds in a second where the ground has many scallops: 2,000 passes of 40 mm, a
/// fiftieth of a millimetre apart, take about three times as long. Short steps through a block are much faster
/// (`cargo bench --bench chips`).
const SECTIONS_PER_SECOND: f64 = 1e3;

/// The memory of a layer of the workpiece before the first cut, in bytes, as far as it does not depend on the
/// shape of the stock.
const BYTES_PER_LAYER: u64 = 2048;

/// The most sections of a run: days of one core.
const MOST_SECTIONS: f64 = 1e9;

/// The estimated cost of a run in layers.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LayerRunCost {
    /// The number of layers.
    pub layers: u64,
    /// An upper estimate of how often a motion's cutter is cut by a layer. Chords of curves count as one.
    pub sections: f64,
    /// The memory in bytes: of the workpiece, and of what is kept of sections.
    pub bytes: u64,
    /// The length of the path, mm.
    pub path_mm: f64,
}

impl LayerRunCost {
    /// Returns what the run takes, for its watcher.
    pub fn to_estimate(&self) -> WorkEstimate {
        WorkEstimate {
            work: "finding the chips",
            thread_seconds: self.sections / SECTIONS_PER_SECOND,
            bytes: self.bytes,
            size: format!(
                "up to {:.0} sections in {} layers, {:.0} mm of path",
                self.sections, self.layers, self.path_mm
            ),
        }
    }
}

/// Returns whether the stock has no more layers of a thickness (mm) than a stack may have.
pub(super) fn can_divide_stock(stock: &Stock, layer_mm: f64) -> bool {
    let ([.., bottom], [.., top]) = stock.bounds();
    layer_mm > 0.0 && (top - bottom) / layer_mm <= MOST_LAYERS as f64
}

impl Machining<'_> {
    /// Estimates the cost of a run in layers that may take `most_bytes` of memory. Layers and `bounds` of the stock are
    /// those of `frame`; `mills` are the flat end mills
    /// by the index of their cutters, and `None` for others.
    ///
    /// # Errors
    /// Returns [`codes::TOO_MUCH`] if the run takes more, and [`codes::TOO_MANY_PIECES`] for a motion that would
    /// be cut into far too many pieces.
    pub(super) fn estimate_layer_cost(
        &self,
        options: &LayerRunOptions,
        (frame, bounds): (&LayerFrame, AxisBox),
        mills: &[Option<FlatMill>],
        most_bytes: u64,
    ) -> Result<LayerRunCost, Failure> {
        let last = *options.lines.end();
        let motions =
            || self.program.motions().take_while(move |motion| end_line_number(self.program, motion) <= last);
        let unit = self.units.mm_per_unit();
        let trace = self.start_path(options.tolerance_mm, options.longest_piece_mm);
        let mut place = trace.clone();
        let is_mill = |cutter: usize| mills.get(cutter).is_some_and(Option::is_some);
        self.refuse_too_many_pieces(
            trace.with_air_clip(self.surroundings_of_stock()),
            motions().count(),
            &is_mill,
        )?;
        let ([.., bottom], [.., top]) = bounds;
        let layers = ((top - bottom) / options.layer_mm).ceil().clamp(1.0, MOST_LAYERS as f64);
        let (mut path_mm, mut sections) = (0.0, 0.0);
        for motion in motions() {
            place.adopt_workpiece_frame(&motion);
            path_mm += motion.length() * unit;
            let Some(cutter) = self.tooling.cutter_index(&motion) else { continue };
            let Some(mill) = mills.get(cutter).copied().flatten() else { continue };
            let [from, to] =
                [motion.from, motion.to].map(|pose| frame.turn_pose(&place.place_pose(&motion, pose)));
            let piece = PathPiece { from, to, cutter };
            // What curves reach between their ends is not known here.
            if motion.path == MotionPath::Line && !can_reach_stock(&piece, &mill, bounds) {
                continue;
            }
            // The rim of a tilted mill lies lower than its tip, and its flutes end as high as they are long.
            let lean = from.axis.xy().norm().max(to.axis.xy().norm());
            let low = from.point.z.min(to.point.z) - mill.radius_mm * lean;
            let high = from.point.z.max(to.point.z) + mill.flute_length_mm + mill.radius_mm * lean;
            let height = (high.min(top) - low.max(bottom)).clamp(0.0, top - bottom);
            let parts = (motion.length() * unit / options.longest_piece_mm).ceil().max(1.0);
            sections += parts * (height / options.layer_mm).ceil().min(layers);
        }
        let kept = (sections * options.kept_bytes as f64).min(1e18) as u64;
        let bytes = (layers as u64 * BYTES_PER_LAYER).saturating_add(kept);
        let cost = LayerRunCost { layers: layers as u64, sections, bytes, path_mm };
        if sections <= MOST_SECTIONS && bytes <= most_bytes {
            return Ok(cost);
        }
        let gib = f64::from(1 << 30);
        let message = format!(
            "in layers of {} mm the chips take up to {:.1} GiB and {sections:.0e} sections, more than the {:.1} GiB and \
             {MOST_SECTIONS:.0e} that they may",
            options.layer_mm,
            bytes as f64 / gib,
            most_bytes as f64 / gib,
        );
        let help = "Take thicker layers, ask for fewer motions by --lines, or allow more by --memory.";
        Err(Diagnostic::new(codes::TOO_MUCH, message).with_help(help).into())
    }
}
