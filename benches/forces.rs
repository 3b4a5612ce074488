//! How long the cutting loads of one engagement take, and forces of a program beside its thickest chips:
//! `cargo bench --bench forces`; CLSMITH_BENCH_PROGRAM and CLSMITH_BENCH_SETUP for another program than the figurine.
//!
//! A bull-nose cutter of 10 mm in a slot 1 and 10 mm deep, four teeth with a helix, evenly spaced and turning off centre. The engagement comes
//! from the simulation.

// A benchmark that cannot make its cutter has nothing to measure.
#![allow(clippy::expect_used)]

use clsmith::cutter::{CutterModel, Meridian, Teeth};
use clsmith::engagement::{CuttingCoefficients, Engagement, LoadModel, PathPiece, Simulation};
use clsmith::parse::parse;
use clsmith::program::LengthUnit;
use clsmith::program::geometry::Pose;
use clsmith::program::record::SpindleDirection;
use clsmith::report::simulation::SimulationReport;
use clsmith::setup::{MaterialChoice, Setup, WorkMaterial};
use clsmith::simulation_run::{KnownShares, Machining, SilentWatcher, SimulationRunOptions};
use clsmith::source::Source;
use clsmith::stock::{DexelGrid, Dexels};
use nalgebra::{Point3, Vector3};
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

const STEEL: CuttingCoefficients =
    CuttingCoefficients { k_tc: 1800.0, k_te: 25.0, k_rc: 600.0, k_re: 30.0, k_ac: 200.0, k_ae: 5.0 };
const RPM: f64 = 3000.0;
const RUNS: u32 = 1000;

/// What a cutter engages a millimetre further on in a slot of a depth.
fn slot(profile: &Meridian, depth: f64) -> Engagement {
    let grid = DexelGrid::covering_box([0.0, -10.0, -15.0], [40.0, 10.0, 0.0], 0.1);
    let mut stock = Dexels::with_empty_columns(grid);
    for row in 0..grid.rows {
        for column in 0..grid.columns {
            stock.set_column(column, row, &[[0.0, 15.0]]);
        }
    }
    let pose = |x: f64| Pose { point: Point3::new(x, 0.0, -depth), axis: Vector3::z() };
    let piece = |from: f64, to: f64| PathPiece { from: pose(from), to: pose(to), cutter: 0 };
    let cutter = CutterModel { profile: profile.clone(), collars: Vec::new(), teeth: None };
    let found =
        Simulation::new(stock, true).sweep_pieces(&[piece(-10.0, 20.0), piece(20.0, 21.0)], &[cutter]);
    found.into_iter().next_back().expect("two pieces")
}

fn main() {
    let profile = Meridian::new(10.0, 2.0, 0.0, 0.0, 40.0).expect("a cutter");
    let even = Teeth::evenly_spaced(4, 0.6).expect("four teeth");
    let eccentric = Teeth::with_eccentricity(vec![1.0; 4], 0.01, 0.0, 0.6).expect("four teeth");
    for (name, teeth) in [("even", even), ("off centre", eccentric)] {
        for depth in [1.0, 10.0] {
            let slot = slot(&profile, depth);
            let model = LoadModel::new(&profile, &teeth, STEEL, SpindleDirection::Clockwise);
            let start = Instant::now();
            for turn in 0..RUNS {
                black_box(model.cutting_loads(&slot, 900.0 + f64::from(turn), RPM));
            }
            let each = start.elapsed() / RUNS;
            println!("{name:<12}{depth:>4} mm deep {each:>10.1?} an engagement");
        }
    }
    compare_with_thickness();
}

/// Reads a file that an environment variable names, or another one.
fn read(variable: &str, otherwise: &str) -> Arc<Source> {
    let path = std::env::var(variable).unwrap_or_else(|_| otherwise.to_owned());
    let bytes = std::fs::read(&path).expect("a file that can be read");
    Source::new(path, bytes).expect("a file that is not too large")
}

/// Simulates a program with certified chips, without and with the forces of all motions.
fn compare_with_thickness() {
    let text = read("CLSMITH_BENCH_PROGRAM", "examples/figurine/part.cls");
    let program = parse(&text, None).program;
    let shop = read("CLSMITH_BENCH_SETUP", "examples/figurine/shop.yaml");
    let mut setup = Setup::load(&shop).expect("a setup");
    let blocks = program.motions().count();
    let mut seconds = Vec::new();
    for with_forces in [false, true] {
        setup.material = with_forces.then(|| {
            let (_, steel) = WorkMaterial::load_shipped().expect("materials").swap_remove(3);
            MaterialChoice::Given(Box::new(steel))
        });
        let machining =
            Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).expect("a program that cuts");
        let start = Instant::now();
        let options = SimulationRunOptions::default();
        let mut report =
            SimulationReport::simulate_program(&machining, &options, &SilentWatcher).expect("a run");
        report.certify_chips(&machining, &KnownShares::default(), &SilentWatcher).expect("chips");
        seconds.push(start.elapsed().as_secs_f64());
        let what = if with_forces { "chips and forces" } else { "chips" };
        println!("{what:<18}{blocks:>7} motions {:>8.2} s", start.elapsed().as_secs_f64());
    }
    if let [chips, both] = seconds.as_slice() {
        println!("forces beside chips: {:.2} x the time", both / chips);
    }
}
