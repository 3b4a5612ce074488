//! Programs in every dialect, read back by the parser and looked at by the checks.

use super::{along, options, over};
use crate::support;
use crate::surface::solids::{mesh, terrain};
use clsmith::check::read_and_check;
use clsmith::diagnostic::Severity;
use clsmith::program::geometry::MotionPath;
use clsmith::program::{Dialect, LengthUnit, MotionClass};
use clsmith::surface_milling::{SurfaceMillingOptions, SurfaceProgramWords};
use clsmith::write::new_program::{
    DraftMove, DraftMoveKind, DraftTool, ProgramDraft, WRITABLE, can_write_arcs, write_program,
};
use nalgebra::{Point3, Vector3};

const HILL: [[f64; 2]; 5] = [[0.0, 0.0], [12.0, 0.0], [20.0, 8.0], [28.0, 8.0], [40.0, 2.0]];

fn in_dialect(dialect: Dialect, options: SurfaceMillingOptions) -> SurfaceMillingOptions {
    SurfaceMillingOptions { words: SurfaceProgramWords { dialect, ..options.words.clone() }, ..options }
}

#[test]
fn a_small_program_of_each_dialect() {
    for dialect in WRITABLE {
        let options = in_dialect(dialect, SurfaceMillingOptions { step_mm: 10.0, arcs: true, ..options() });
        let surfaced = along(&HILL, &options);
        let text = String::from_utf8(surfaced.text).unwrap();
        assert!(text.lines().all(|line| dialect != Dialect::Catia || line.len() <= 72), "{text}");
        support::snapshots("surfacing").bind(|| insta::assert_snapshot!(dialect.name(), text));
    }
}

#[test]
fn programs_read_back_as_they_were_meant() {
    let part = mesh(&terrain(10.0, 8, |x, y| 3.0 * (x / 3.0).sin() * (y / 4.0).cos()));
    for dialect in WRITABLE {
        for (units, arcs, scale) in
            [(LengthUnit::Mm, false, 1.0), (LengthUnit::Mm, true, 1.0), (LengthUnit::Inch, true, 25.4)]
        {
            let mut options =
                in_dialect(dialect, SurfaceMillingOptions { arcs, tolerance_mm: 0.05, ..options() });
            options.words.units = units;
            options.words.coolant = true;
            let surfaced = over(&part, &options);
            let source = support::text(&surfaced.text);
            let (program, found) = read_and_check(&source, None);
            assert!(found.iter().all(|found| found.severity == Severity::Note), "{dialect}: {found:?}");
            assert_eq!(program.dialect(), dialect);
            let motions: Vec<_> = program.motions().collect();
            assert_eq!(motions.len(), surfaced.draft.moves.len());
            for (motion, meant) in motions.iter().zip(&surfaced.draft.moves) {
                assert!((motion.to.point - meant.to).norm() < 1e-12);
                assert_eq!(motion.rapid, meant.way == DraftMoveKind::Rapid);
                if !motion.rapid {
                    let feed = motion.feed.unwrap().value * scale;
                    let is = if meant.class == MotionClass::Engage { 300.0 } else { 800.0 };
                    assert!((feed - is).abs() < 0.01, "{feed}");
                }
                if dialect == Dialect::Nx {
                    assert_eq!(motion.class, meant.class);
                }
            }
            let tool = motions[0].tool.clone().unwrap();
            assert_eq!(tool.number, Some(3));
            let arcs_read = motions.iter().filter(|motion| matches!(motion.path, MotionPath::Arc(_))).count();
            assert_eq!(arcs_read > 0, arcs && can_write_arcs(dialect), "{dialect}, {arcs_read} arcs");
        }
    }
}

fn draft(moves: Vec<DraftMove>) -> ProgramDraft {
    ProgramDraft {
        name: "A".to_owned(),
        operation: "B".to_owned(),
        tool: DraftTool { number: 1, name: "C".to_owned(), diameter: 10.0, corner_radius: 5.0, length: 80.0 },
        spindle: None,
        coolant: false,
        units: LengthUnit::Mm,
        tolerance: 0.01,
        moves,
    }
}

fn to(x: f64, z: f64, way: DraftMoveKind) -> DraftMove {
    DraftMove { to: Point3::new(x, 0.0, z), way, class: MotionClass::Cut }
}

#[test]
fn arcs_turn_as_they_were_meant_in_every_plane_and_sense() {
    for dialect in [Dialect::Nx, Dialect::Catia] {
        for angle in [0.0f64, 30.0, 90.0, 200.0] {
            let (sin, cos) = angle.to_radians().sin_cos();
            let at = |u: f64, z: f64| {
                Point3::new(u * cos, u * sin, z)
                    .map(|v| clsmith::write::new_program::round_coordinate(v, dialect))
            };
            let axis = Vector3::new(sin, -cos, 0.0);
            // A hill over a quarter from (-10, 0), right-hand about -axis; and a hollow.
            for (axis, centre, end) in
                [(-axis, at(0.0, 0.0), at(0.0, 10.0)), (axis, at(-10.0, 10.0), at(0.0, 10.0))]
            {
                let moves = vec![
                    DraftMove { to: at(-10.0, 0.0), way: DraftMoveKind::Rapid, class: MotionClass::Approach },
                    DraftMove {
                        to: end,
                        way: DraftMoveKind::Arc { centre, axis, feed: 100.0 },
                        class: MotionClass::Cut,
                    },
                ];
                let text = write_program(&draft(moves), dialect).unwrap();
                let program = support::program(text);
                let motion = program.motions().nth(1).unwrap();
                let MotionPath::Arc(arc) = &motion.path else { panic!("{motion:?}") };
                assert!((arc.sweep - std::f64::consts::FRAC_PI_2).abs() < 1e-3, "{dialect} {angle}: {arc:?}");
                assert!(arc.axis.dot(&axis) > 0.9999, "{dialect} {angle}: {arc:?}");
            }
        }
    }
}

#[test]
fn what_does_not_read_back_is_no_program() {
    let plain = vec![to(0.0, 1.0, DraftMoveKind::Rapid), to(1.0, 1.0, DraftMoveKind::Line { feed: 100.0 })];
    for dialect in WRITABLE {
        assert!(write_program(&draft(plain.clone()), dialect).is_ok());
        let fine =
            vec![to(0.0, 1.0, DraftMoveKind::Rapid), to(1.0 / 3.0, 1.0, DraftMoveKind::Line { feed: 100.0 })];
        let coarse = vec![
            to(0.0, 1.0, DraftMoveKind::Rapid),
            to(1.0 / 3.0, 1.0, DraftMoveKind::Line { feed: 1.0 / 3.0 }),
        ];
        assert!(write_program(&draft(fine), dialect).is_err() || dialect == Dialect::Creo);
        assert!(write_program(&draft(coarse), dialect).is_err());
    }
    let broken = ProgramDraft { operation: "A,B\nRAPID".to_owned(), ..draft(plain) };
    assert!(write_program(&broken, Dialect::Nx).is_err(), "a line of its own");
    let arc = DraftMoveKind::Arc { centre: Point3::origin(), axis: Vector3::y(), feed: 100.0 };
    let error =
        write_program(&draft(vec![to(-5.0, 0.0, DraftMoveKind::Rapid), to(0.0, 5.0, arc)]), Dialect::Creo)
            .unwrap_err();
    assert_eq!(error.motion, 2, "Creo holds no arc: {error}");
}
