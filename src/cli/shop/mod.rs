//! What commands that stand between the CAM system and the post have in common: `hook` and `watch`.

mod correct;
mod log;
mod recipe_args;

pub use correct::{Correction, Outcome, correct};
pub use log::{InputRecord, Log, OutputRecord, Record, now};
pub use recipe_args::{Chooser, RecipeArgs};
