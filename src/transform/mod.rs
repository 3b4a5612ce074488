//! Transforms: what recipe steps do to a program.
//!
//! A transform is one file, one line in the list below, and one fixture folder. It takes the program by value, so a step
//! that fails leaves nothing half-edited to write.

mod affine;
mod clamp_feed;
pub mod compensate_z;
mod convert_units;
pub mod correct_ramp;
pub mod feed_plan;
mod motion_selection;
mod move_origin;
pub mod optimize_feed;
mod recipe_run;
mod rewrite;
mod scale_feed;
mod stale_records;
mod statement_numbers;
mod step_context;
mod unchanged_statements;

pub use affine::Affine;
pub use clamp_feed::ClampFeed;
pub use compensate_z::CompensateZ;
pub use convert_units::ConvertUnits;
pub use correct_ramp::CorrectRamp;
pub use motion_selection::MotionSelection;
pub use move_origin::MoveOrigin;
pub use optimize_feed::OptimizeFeed;
pub use recipe_run::{RecipeOutcome, run_recipe, run_recipe_watched};
pub use rewrite::{Rewrite, RewriteRegionSpec, RewriteRule};
pub use scale_feed::ScaleFeed;
pub use step_context::StepContext;

use crate::diagnostic::Diagnostic;
use crate::program::{Program, StepId};
use crate::recipe::Provenance;
use schemars::JsonSchema;
use serde::Deserialize;

/// A recipe of clsmith's own steps.
pub type Recipe = crate::recipe::Recipe<Step>;

/// The name under which reports list the comments of `provenance:`, which come after the last step.
pub const PROVENANCE: &str = "provenance";

impl Recipe {
    /// Names for what changed a program, by [`StepId`]: the steps, and at last the comments, if the
    /// recipe asks for any.
    pub fn step_names(&self) -> Vec<&'static str> {
        let comments = (self.provenance != Provenance::None).then_some(PROVENANCE);
        self.steps.iter().map(Step::name).chain(comments).collect()
    }

    /// The step after the last one, which signs the comments.
    pub fn provenance_step(&self) -> StepId {
        step_id(self.steps.len())
    }
}

fn step_id(index: usize) -> StepId {
    StepId(u16::try_from(index).unwrap_or(u16::MAX))
}

/// What a step does.
pub trait Transform {
    /// Changes the program.
    ///
    /// # Errors
    /// A diagnostic with its places in the recipe and in the CL file. The program is gone with it.
    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Box<Diagnostic>>;
}

/// Writes the list of transforms as the step enum of recipes and a table of names.
macro_rules! transforms {
    ($($name:literal => $step:ident,)*) => {
        /// A step of a recipe: its name and its parameters.
        #[derive(Debug, Clone, Deserialize, JsonSchema)]
        #[serde(rename_all = "snake_case")]
        pub enum Step {
            $(
                #[doc = concat!("`", $name, "`.")]
                $step($step),
            )*
        }

        /// Names of all transforms, in the order of the list.
        pub const NAMES: &[&str] = &[$($name),*];

        impl Step {
            /// The step's name in a recipe.
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$step(_) => $name,)*
                }
            }

            /// What it does.
            pub fn transform(&self) -> &dyn Transform {
                match self {
                    $(Self::$step(step) => step,)*
                }
            }
        }

        /// The JSON schema of a transform's parameters; its descriptions are the doc comments.
        pub fn schema_of(name: &str) -> Option<schemars::Schema> {
            match name {
                $($name => Some(schemars::schema_for!($step)),)*
                _ => None,
            }
        }
    };
}

transforms! {
    "scale_feed" => ScaleFeed,
    "clamp_feed" => ClampFeed,
    "rewrite" => Rewrite,
    "move_origin" => MoveOrigin,
    "convert_units" => ConvertUnits,
    "correct_ramp" => CorrectRamp,
    "compensate_z" => CompensateZ,
    "optimize_feed" => OptimizeFeed,
}

impl Step {
    /// A file that the step reads beside the program.
    pub fn input_file(&self) -> Option<&crate::parameters::FilePath> {
        match self {
            Self::CompensateZ(step) => step.mesh_path(),
            _ => None,
        }
    }
}

/// What a step has to say about itself beyond findings.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum StepReport {
    /// Of `compensate_z`.
    CompensateZ(compensate_z::CompensateZReport),
    /// Of `correct_ramp`.
    CorrectRamp(correct_ramp::CorrectRampReport),
    /// Of `optimize_feed`.
    OptimizeFeed(optimize_feed::OptimizeFeedReport),
}
