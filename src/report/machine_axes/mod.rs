//! This module reports machines and what their axes do in a program.
//!
//! [`describe_machine`], [`machine_to_json`] and [`draw_machine`] show a machine. [`JointTable`] has the values of all axes at the end of each
//! motion of a program; [`JointTable::write_csv`], [`JointTable::to_json`] and [`JointTable::write_npy`] write them,
//! [`draw_joints`] draws them over time or the line of the program.

mod joint_outputs;
mod joint_plot;
mod joint_table;
mod machine_document;
mod machine_drawing;
mod machine_text;

pub use joint_plot::{JointAbscissa, draw_joints};
pub use joint_table::{JointRow, JointTable};
pub use machine_document::machine_to_json;
pub use machine_drawing::draw_machine;
pub use machine_text::describe_machine;
