//! This module answers what editors ask about programs and the files around them: where, what and how much, as plain data.
//!
//! It knows neither a protocol nor a terminal. An [`EditedText`] is the text as it is typed, with places as editors count
//! them. A [`ProgramView`] is a program that was read from it, with places in it from which the state at any line is found
//! without going through the program from its start. While a text is ahead of its view, [`EditedLines`] says where its lines
//! stood.

mod changed_line;
mod edited_lines;
mod edited_text;
mod feed_places;
mod line_hints;
mod line_state;
mod operation_rename;
mod outline;
mod path_page;
mod path_sums;
mod program_view;
mod quick_fix;
mod recipe_preview;
mod word_completion;
mod yaml_file;

pub use changed_line::{LineChange, StepPlace, StepReference, find_step_places};
pub use edited_lines::EditedLines;
pub use edited_text::{EditedText, LineEdit, TextPosition, find_position};
pub use line_hints::LineHint;
pub use line_state::LineState;
pub use operation_rename::refuse_operation_name;
pub use outline::{OutlineEntry, OutlineKind};
pub use path_page::{PathPageContent, make_path_page};
pub use path_sums::PathSums;
pub use program_view::ProgramView;
pub use quick_fix::{QuickFix, find_quick_fix};
pub use recipe_preview::{RecipePreview, preview_recipe};
pub use word_completion::{CompletionWord, complete_words};
pub use yaml_file::{RecipeWords, YamlFileKind, check_yaml_text, find_file_names, list_step_words};
