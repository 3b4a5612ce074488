//! Real files, where they are present.

use super::*;
use clsmith::program::{Dialect, Program};
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::{Recipe, run_recipe};

fn read(path: &std::path::Path) -> Program {
    clsmith::parse::parse(&support::source(path), None).program
}

fn reread(program: &Program) -> Program {
    clsmith::parse::parse(&support::text(program.to_bytes()), Some(program.dialect())).program
}

fn run_on(settings: &str, program: Program) -> Result<Program, String> {
    let units = match program.stated_length_unit() {
        Some(clsmith::program::LengthUnit::Inch) => "inch",
        _ => "mm",
    };
    let recipe = format!("version: 1\nunits: {units}\nsteps:\n  - move_origin: {settings}");
    let recipe = Source::new("recipe.yaml", recipe.into_bytes()).unwrap();
    let recipe = Recipe::load(&recipe).unwrap();
    run_recipe(&recipe, &Setup::default(), program)
        .map(|outcome| outcome.program)
        .map_err(|failure| failure.findings().last().unwrap().message.clone())
}

fn moves() -> Vec<(&'static str, Place)> {
    let start = Place::identity();
    vec![
        ("{ translate: [12.34, -56.78, 9.1] }", start.translated([12.34, -56.78, 9.1])),
        (
            "{ rotate: { axis: z, degrees: 90, about: [1, 2, 3] } }",
            start.rotated([0.0, 0.0, 1.0], 90.0, [1.0, 2.0, 3.0]),
        ),
        ("{ rotate: { axis: z, degrees: 33.7 } }", start.rotated([0.0, 0.0, 1.0], 33.7, [0.0; 3])),
        ("{ mirror: x }", start.mirrored([1.0, 0.0, 0.0], [0.0; 3])),
        (
            "{ mirror: { normal: [1, 2, 0], through: [5, 6, 7] } }",
            start.mirrored([1.0, 2.0, 0.0], [5.0, 6.0, 7.0]),
        ),
        (
            "{ rotate: { axis: [1, 2, 3], degrees: 47, about: [9, 8, 7] }, translate: [1, 1, 1] }",
            start.rotated([1.0, 2.0, 3.0], 47.0, [9.0, 8.0, 7.0]).translated([1.0; 3]),
        ),
        (
            "{ mirror: z, rotate: { axis: y, degrees: -90 } }",
            start.mirrored([0.0, 0.0, 1.0], [0.0; 3]).rotated([0.0, 1.0, 0.0], -90.0, [0.0; 3]),
        ),
    ]
}

#[test]
fn every_file_moves_rigidly_or_is_refused_for_a_reason() {
    let Some(corpus) = support::require_corpus() else { return };
    for path in corpus {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let before = read(&path);
        let large = before.statements().len() > 20_000;
        for (index, (settings, place)) in moves().into_iter().enumerate() {
            if large && index % 3 != 2 {
                continue;
            }
            let tilts = index >= 5;
            match run_on(settings, before.clone()) {
                Ok(after) => {
                    assert_moved(&format!("{name} {settings}"), &before, &reread(&after), &place, 2e-3);
                }
                Err(message) => {
                    let allowed = match before.dialect() {
                        Dialect::CamWorks => tilts,
                        // Tilted setups refuse other turns as well.
                        Dialect::SolidWorks => index > 0,
                        Dialect::CatiaIcam => index > 0 && message.contains("ignore TLAXIS"),
                        _ => tilts && message.contains("CUTCOM names"),
                    };
                    // A lathe stays in its plane y = 0; of these moves only the mirror in x keeps it.
                    let allowed = allowed || index != 3 && message.contains("this program turns");
                    assert!(allowed, "{name} {settings}: {message}");
                }
            }
        }
    }
}

#[test]
fn the_golden_pair_moves_by_its_offset_to_the_tenth_decimal() {
    let Some(path) = support::require_corpus_file("finition2.ncl") else { return };
    let before = read(&path);
    let after = run_on("{ translate: [-106.609375, -121.28125, -100.59375] }", before.clone()).unwrap();
    let after = reread(&after);
    let mut points = 0;
    for (old, new) in before.motions().zip(after.motions()) {
        let step = new.to.point - old.to.point;
        let off = step - nalgebra::Vector3::new(-106.609375, -121.28125, -100.59375);
        assert!(off.amax() <= 1.01e-10, "{off}");
        assert_eq!(old.to.axis, new.to.axis);
        points += 1;
    }
    assert_eq!(points, 35_418);
    for (old, new) in before.statements().iter().zip(after.statements()) {
        let (old, new) = (before.statement_text(old), after.statement_text(new));
        if old.starts_with(b"GOTO") {
            let axis = |text: &[u8]| text[text.iter().position(|byte| *byte == b'$').unwrap()..].to_vec();
            assert_eq!(axis(old), axis(new));
        } else {
            assert_eq!(old, new);
        }
    }
}
