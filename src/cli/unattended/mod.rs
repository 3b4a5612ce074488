//! This module holds what `hook` and `watch`, which run between the CAM system and the post, have in common.

mod recipe_args;
mod run_log;
mod unattended_correction;

pub(super) use recipe_args::{RecipeArgs, RecipeChooser};
pub(super) use run_log::{
    LogLine, LoggedInput, LoggedOutput, RunLog, run_to_json, run_to_json_line, utc_now,
};
pub(super) use unattended_correction::{UnattendedCorrection, UnattendedOutcome, correct_unattended};
