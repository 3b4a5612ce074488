//! This module finds across which direction the layers of a run lie.

use super::LayerRunOptions;
use super::layer_runner::end_line_number;
use crate::diagnostic::{Diagnostic, codes};
use crate::layered_chips::LayerFrame;
use crate::machine::AxisMount;
use crate::program::geometry::{MotionPath, Pose};
use crate::program::motion::Motion;
use crate::simulation_run::Machining;
use nalgebra::{Point3, Vector3};

/// The direction across which layers lie.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum LayerDirection {
    /// The workpiece's z.
    #[default]
    WorkpieceZ,
    /// A direction in the workpiece frame.
    Vector([f64; 3]),
    /// The tool axis at the end of the first motion that is asked for.
    ToolAxis,
    /// The z of the frame (MSYS and its kin) in which the first motion that is asked for is programmed.
    ProgramFrame,
    /// The machine's table: the rotary axis that carries the workpiece, or the tool axis with all axes at 0 where none
    /// does.
    MachineTable,
}

impl Machining<'_> {
    /// Returns the frame of the layers of a run.
    ///
    /// # Errors
    /// Returns [`codes::LAYERS`] if the direction has no length, if no motion tells it, or if the setup does not describe
    /// the machine's axes.
    pub(super) fn find_layer_frame(&self, options: &LayerRunOptions) -> Result<LayerFrame, Diagnostic> {
        let refuse = |message: &str, help: &str| {
            Diagnostic::new(codes::LAYERS, message.to_owned()).with_help(help.to_owned())
        };
        match options.direction {
            LayerDirection::WorkpieceZ => Ok(LayerFrame::WORKPIECE),
            LayerDirection::Vector(direction) => {
                LayerFrame::across(&Vector3::from(direction)).ok_or_else(|| {
                    refuse("the direction of the layers has no length", "Give a direction such as 1,0,0.")
                })
            }
            LayerDirection::MachineTable => {
                let chain = self.setup.machine.chain.as_deref().ok_or_else(|| {
                    refuse(
                        "the setup does not describe the machine's axes, so the plane of its table is not known",
                        "Describe them under `machine: axes` (see configs/README.md), or give the direction as three numbers.",
                    )
                })?;
                let turning = chain.rotary_axes().find(|axis| axis.mount == AxisMount::Table);
                let direction = turning.map_or(chain.tool_axis(), |axis| axis.direction);
                LayerFrame::across(&direction).ok_or_else(|| {
                    refuse("the table's axis has no length", "Give the direction as three numbers.")
                })
            }
            LayerDirection::ToolAxis | LayerDirection::ProgramFrame => {
                let [x, z] = self.find_first_directions(options).ok_or_else(|| {
                    refuse(
                        "there is no motion on the lines that are asked for, so nothing tells the direction of the layers",
                        "Ask for lines with motions, or give the direction as three numbers.",
                    )
                })?;
                let frame = match options.direction {
                    LayerDirection::ToolAxis => LayerFrame::across(&z),
                    _ => LayerFrame::with_axes(&x, &z),
                };
                frame.ok_or_else(|| {
                    refuse("the axes of the frame have no length", "Give the direction as three numbers.")
                })
            }
        }
    }

    /// Returns x and z of the frame of the first motion that is asked for, as they stand in the workpiece frame, or its
    /// tool axis as z.
    fn find_first_directions(&self, options: &LayerRunOptions) -> Option<[Vector3<f64>; 2]> {
        let mut places = self.start_path(options.tolerance_mm, options.longest_piece_mm);
        let asked = |motion: &Motion| {
            motion.path != MotionPath::Start && options.lines.contains(&end_line_number(self.program, motion))
        };
        let motion = self.program.motions().find(|motion| {
            places.adopt_workpiece_frame(motion);
            asked(motion)
        })?;
        let carry =
            |axis: Vector3<f64>| places.place_pose(&motion, Pose { point: Point3::origin(), axis }).axis;
        let z = match options.direction {
            LayerDirection::ToolAxis => motion.to.axis,
            _ => Vector3::z(),
        };
        Some([carry(Vector3::x()), carry(z)])
    }
}
