//! Reads, checks, corrects and writes cutter-location data without losing a byte of what it does not change.
//!
//! A [`Source`] holds the bytes of a file. [`parse`](parse::parse) reads them into a [`Program`] of
//! statements, and the motions of the tool are a view of it:
//!
//! ```
//! use clsmith::{Source, parse::parse};
//!
//! let text = b"LOAD/TOOL,3\nRAPID\nGOTO/0,0,2\nFEDRAT/MMPM,1200.0000\nGOTO/0,0,-1\nGOTO/40,0,-1\n";
//! let source = Source::new("part.cls", text.to_vec())?;
//! let program = parse(&source, None).program;
//! for motion in program.motions() {
//!     let feed = motion.feed.map(|feed| feed.value);
//!     println!("{:?} to {:?}, {} long, at {feed:?}", motion.class, motion.to.point, motion.length());
//! }
//! assert_eq!(program.motions().count(), 3);
//! assert_eq!(program.motions().last().map(|motion| motion.length()), Some(40.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A [`ProgramEditor`] changes statements. All others stay as they were, byte for byte:
//!
//! ```
//! use clsmith::{ProgramEditor, Record, Source, parse::parse, program::StepId};
//!
//! let text = b"FEDRAT/ 1200.0000, MMPM  $$ roughing\r\nGOTO/  40.0000,0.0000,-1.0000\r\n";
//! let program = parse(&Source::new("part.ncl", text.to_vec())?, None).program;
//! let is_feed = |record: &Record| matches!(record, Record::Feed(_));
//! let feed = program.live_statements().find(|(_, statement)| is_feed(statement.record()));
//! let (feed, _) = feed.expect("there is a FEDRAT");
//!
//! let mut editor = ProgramEditor::new(program, StepId(0));
//! editor.set_numbers(feed, &[(0, 600.0)])?;
//! let program = editor.finish()?;
//! let slower = b"FEDRAT/ 600.0000, MMPM  $$ roughing\r\nGOTO/  40.0000,0.0000,-1.0000\r\n";
//! assert_eq!(program.to_bytes(), slower);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`read_and_check`](check::read_and_check) finds what is wrong with a program. Each [`Diagnostic`] has a
//! code, a place and help, and [`report::render`] prints it for people and for machines:
//!
//! ```
//! # #[cfg(feature = "report")] {
//! use clsmith::{Source, check::read_and_check, report::render::line::render_lines};
//!
//! let source = Source::new("part.cls", b"RAPID\nGOTO/10.000,12.5O00,-4.0000\n".to_vec())?;
//! let (_, findings) = read_and_check(&source, None);
//! let mut lines = Vec::new();
//! render_lines(&mut lines, &findings, None)?;
//! assert!(lines.starts_with(b"part.cls:2:13: CL0003: `12.5O00` is not a number"));
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A [`Recipe`] lists the steps that correct a program:
//!
//! ```
//! # #[cfg(feature = "simulation")] {
//! use clsmith::{Recipe, Setup, Source, parse::parse, run_recipe};
//!
//! let recipe = b"version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n  - clamp_feed: { max: 500 }\n";
//! let recipe = Recipe::load(&Source::new("recipe.yaml", recipe.to_vec())?)?;
//! let program = parse(&Source::new("part.cls", b"FEDRAT/MMPM,1200.\nGOTO/0,0,0\n".to_vec())?, None).program;
//! let outcome = run_recipe(&recipe, &Setup::default(), program)?;
//! assert_eq!(outcome.program.to_bytes(), b"FEDRAT/MMPM,500.\nGOTO/0,0,0\n");
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The same steps run without YAML, and so does a [`Transform`] of your own (CONTRIBUTING.md has one):
//!
//! ```
//! # #[cfg(feature = "simulation")] {
//! use clsmith::{LengthUnit, Setup, Source, parse::parse, run_steps};
//! use clsmith::{parameters::Factor, transform::ScaleFeed};
//!
//! let step = ScaleFeed::new(Factor::new(0.5).expect("a factor is above 0"));
//! let program = parse(&Source::new("part.cls", b"FEDRAT/MMPM,1200.\nGOTO/0,0,0\n".to_vec())?, None).program;
//! let outcome = run_steps(&[&step], LengthUnit::Mm, &Setup::default(), program)?;
//! assert_eq!(outcome.program.to_bytes(), b"FEDRAT/MMPM,600.\nGOTO/0,0,0\n");
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A [`Setup`] says what the program does not: stock, teeth, machine. [`Machining`] then removes the stock
//! motion by motion and tells what each of them cut. Here it is a slot of 10 mm with four teeth at 1000
//! mm/min and 5000 rev/min:
//!
//! ```
//! # #[cfg(feature = "simulation")] {
//! use clsmith::simulation_run::{SilentWatcher, SimulationRunOptions};
//! use clsmith::{LengthUnit, Machining, Setup, Source, parse::parse};
//!
//! let shop = b"stock: { block: { from: [0, -20, -10], to: [60, 20, 0] } }\n\
//!     tools: [ { match: {}, diameter: 10, flute_length: 20, teeth: 4 } ]\n";
//! let setup = Setup::load(&Source::new("shop.yaml", shop.to_vec())?)?;
//! let part = b"LOAD/TOOL,3\nSPINDL/RPM,5000,CLW\nRAPID\nGOTO/-10,0,-2\nFEDRAT/MMPM,1000.\nGOTO/30,0,-2\n";
//! let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
//!
//! let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new())?;
//! let teeth = machining.tooling().cutters()[0].teeth.as_ref().expect("the setup says four");
//! let mut thickest_mm = 0.0_f64;
//! machining.simulate_program(&SimulationRunOptions::default(), &SilentWatcher, &mut |motion| {
//!     if let Some(engagement) = motion.whole_engagement() {
//!         thickest_mm = thickest_mm.max(engagement.chip_thickness_mm(teeth, 1000.0, 5000.0));
//!     }
//! })?;
//! assert!((thickest_mm - 0.05).abs() < 1e-3);
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Rooms
//!
//! The modules are in the order of the data's way; each of them uses only those before it. ARCHITECTURE.md
//! follows one GOTO through all of it.
//!
//! - Text: [`source`], [`number`], [`diagnostic`]. Language: [`program`], [`parse`](mod@parse),
//!   [`mod@write`], [`check`].
//! - Feature `simulation`. Geometry: [`cutter`], [`stock`], [`engagement`], [`layered_chips`], [`machine`]. Shop:
//!   [`parameters`], [`setup`], [`recipe`], [`recipe_rules`]. What uses them: [`simulation_run`],
//!   [`transform`], [`surface_milling`].
//! - Feature `report`: [`report`], [`fingerprint`], [`provenance`], [`undo`], and [`job`], which takes one
//!   file through its recipe; [`editor`], which answers what editors ask.
//! - Feature `files`: [`output_files`]. Feature `cli`: [`batch`], and the command itself.
//!
//! Points, vectors and axes are those of [`nalgebra`].

// What nobody outside can reach is not called public, and what they can reach they can name.
#![warn(unreachable_pub, unnameable_types)]
// A room may hold what only rooms of a larger set use; what nobody uses is found with all of them.
#![cfg_attr(not(feature = "cli"), allow(dead_code, unused_imports, unreachable_pub))]
// The front page names the rooms of all sets; without them its links lead nowhere.
#![cfg_attr(not(feature = "cli"), allow(rustdoc::broken_intra_doc_links))]

pub mod check;
pub mod diagnostic;
pub mod number;
pub mod parse;
pub mod program;
pub mod source;
mod threads;
pub mod write;

#[cfg(feature = "files")]
pub mod output_files;

#[cfg(feature = "simulation")]
pub mod certified_engagement;
#[cfg(feature = "simulation")]
pub mod cutter;
#[cfg(feature = "simulation")]
pub mod engagement;
#[cfg(feature = "simulation")]
pub mod layered_chips;
#[cfg(feature = "simulation")]
pub mod machine;
#[cfg(feature = "simulation")]
pub mod parameters;
#[cfg(feature = "simulation")]
mod presentation;
#[cfg(feature = "simulation")]
pub mod recipe;
#[cfg(feature = "simulation")]
pub mod recipe_rules;
#[cfg(feature = "simulation")]
pub mod setup;
#[cfg(feature = "simulation")]
pub mod simulation_run;
#[cfg(feature = "simulation")]
pub mod stock;
#[cfg(feature = "simulation")]
mod surface;
#[cfg(feature = "simulation")]
pub mod surface_milling;
#[cfg(feature = "simulation")]
pub mod transform;
#[cfg(feature = "simulation")]
mod yaml;

#[cfg(feature = "report")]
pub mod editor;
#[cfg(feature = "report")]
pub mod fingerprint;
#[cfg(feature = "report")]
pub mod job;
#[cfg(feature = "report")]
pub mod provenance;
#[cfg(feature = "report")]
pub mod report;
#[cfg(feature = "report")]
pub mod undo;

#[cfg(feature = "cli")]
pub mod batch;

#[cfg(feature = "simulation")]
#[doc(hidden)]
pub mod internals;

#[cfg(test)]
#[path = "../tests/support/property.rs"]
#[allow(unreachable_pub)]
mod property;

#[cfg(test)]
#[path = "../tests/support/fuzzed_statements.rs"]
#[allow(unreachable_pub)]
mod fuzzed_statements;

#[doc(no_inline)]
pub use {
    diagnostic::{Diagnostic, Failure},
    program::{Dialect, LengthUnit, Program, Record, StatementId, motion::Motion},
    source::{Source, Span},
    write::ProgramEditor,
};

#[cfg(feature = "simulation")]
#[doc(no_inline)]
pub use {
    setup::Setup,
    simulation_run::Machining,
    transform::{Recipe, Transform, run_recipe, run_steps},
};

#[cfg(feature = "report")]
#[doc(no_inline)]
pub use {job::CorrectionJob, report::finding_policy::FindingPolicy};

pub use nalgebra;

/// The example of README.md, so that it compiles and runs as a test.
#[cfg(all(doctest, feature = "simulation"))]
#[doc = include_str!("../README.md")]
pub struct ReadmeExample;

/// The examples of CONTRIBUTING.md, likewise.
#[cfg(all(doctest, feature = "simulation"))]
#[doc = include_str!("../CONTRIBUTING.md")]
pub struct ContributingExamples;
