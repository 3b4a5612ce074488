//! Real files, where they are present: to the other unit and back.

use super::*;
use clsmith::program::LengthUnit;
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::{Recipe, run_recipe};

fn convert(from: &str, to: &str, program: Program) -> Program {
    let recipe = format!("version: 1\nsteps:\n  - convert_units: {{ from: {from}, to: {to} }}");
    let recipe = Source::new("recipe.yaml", recipe.into_bytes()).unwrap();
    let recipe = Recipe::load(&recipe).unwrap();
    let program = run_recipe(&recipe, &Setup::default(), program).unwrap().program;
    clsmith::parse::parse(&support::text(program.to_bytes()), Some(program.dialect())).program
}

#[test]
fn every_file_comes_back_within_a_ten_thousandth() {
    let Some(corpus) = support::require_corpus() else { return };
    for path in corpus {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let before = clsmith::parse::parse(&support::source(&path), None).program;
        let (from, to, factor) = match before.stated_length_unit() {
            Some(LengthUnit::Inch) => ("inch", "mm", 25.4),
            _ => ("mm", "inch", 1.0 / 25.4),
        };
        let there = convert(from, to, before.clone());
        for (old, new) in before.motions().zip(there.motions()) {
            let off = (old.to.point.coords * factor - new.to.point.coords).amax();
            assert!(off <= 1e-4 * factor.min(1.0), "{name}: {off}");
            assert_eq!((old.to.axis, old.hole.is_some()), (new.to.axis, new.hole.is_some()));
            let unit = |motion: &clsmith::program::motion::Motion, file| {
                motion.feed.and_then(|feed| feed.mm_per_minute(file, Some(1000.0), Some(1.0)))
            };
            let (a, b) = match from {
                "mm" => (unit(&old, LengthUnit::Mm), unit(&new, LengthUnit::Inch)),
                _ => (unit(&old, LengthUnit::Inch), unit(&new, LengthUnit::Mm)),
            };
            let (a, b) = (a.unwrap_or(0.0), b.unwrap_or(0.0));
            // 0.04 mm/rev with 4 decimals becomes 0.001575 in/rev: half of the last decimal of the old feed is kept.
            assert!((a - b).abs() <= 2e-4 * a.abs().max(1.0), "{name}: feed {a} became {b}");
        }
        let back = convert(to, from, there);
        assert_eq!(before.statements().len(), back.statements().len());
        let (mut old, mut new) = (before.motions(), back.motions());
        for (old, new) in (&mut old).zip(&mut new) {
            let off = (old.to.point - new.to.point).norm();
            assert!(off <= 1.5e-4, "{name}: {off}");
        }
        assert_eq!(
            format!("{:?}", old.take_problems()).len(),
            format!("{:?}", new.take_problems()).len(),
            "{name}"
        );
    }
}
