//! How long certified engagement takes: `cargo bench --bench engagement`.
//!
//! Zigzags over a block of 60 x 60 x 20 mm, on a surface that rises and falls by 0.5 mm, down to which an earlier zigzag has come 0.6 mm nearer.
//! The cutters are a ball R3 with its axis upright, and, with axes that turn from point to point as in five-axis milling, a ball R5, a
//! bull-nose 10 mm R1 and a flat end of 10 mm. Every block of the second zigzag is certified, and told are blocks a second on one and on two
//! threads, how many of them cut, and how wide their intervals are. Then a part of the blocks gets its loads bounded, with the time of
//! thickness alone beside it.

// A benchmark that cannot make its program has nothing to measure.
#![allow(clippy::expect_used)]

use clsmith::certified_engagement::{
    BlockMotion, BoxGap, CertifiedEngagement, CertifiedProgram, CutterContour, CutterPose,
    EngagementCriterion, EngagementOptions, StepLimits, WarmStart,
};
use clsmith::cutter::{Meridian, Teeth};
use clsmith::engagement::{CuttingCoefficients, LoadBound, LoadModel};
use clsmith::program::record::SpindleDirection;
use nalgebra::Vector3;
use std::time::{Duration, Instant};

const SIDE_MM: f64 = 60.0;
const STEP_MM: f64 = 0.5;
const STEEL: CuttingCoefficients =
    CuttingCoefficients { k_tc: 1800.0, k_te: 25.0, k_rc: 600.0, k_re: 30.0, k_ac: 200.0, k_ae: 5.0 };
/// The loads of one block in so many are bounded.
const LOADED: usize = 50;

struct Case {
    name: &'static str,
    diameter_mm: f64,
    corner_mm: f64,
    stepover_mm: f64,
    /// The largest lean of the axis, radians.
    lean_rad: f64,
}

impl Case {
    fn pose_at(&self, x: f64, y: f64, above_mm: f64) -> CutterPose {
        let height = 0.5 * (x / 7.0).sin() * (y / 9.0).cos() - 2.0 + above_mm;
        let [lead, tilt] = [(x / 11.0).sin(), (y / 13.0).cos()].map(|share| self.lean_rad * share);
        let axis = Vector3::new(lead.sin(), tilt.sin(), 1.0).normalize();
        // The ball's centre, or the foot of a flat end, is led; a lean turns about it.
        let lead = Vector3::new(x, y, height + self.corner_mm);
        CutterPose { tip: lead - axis * self.corner_mm, axis }
    }

    /// Pushes a zigzag at a distance above the surface.
    fn push_zigzag(&self, program: &mut CertifiedProgram, above_mm: f64) {
        let (rows, columns) = ((SIDE_MM / self.stepover_mm) as usize, (SIDE_MM / STEP_MM) as usize);
        let mut last: Option<CutterPose> = None;
        for row in 0..rows {
            for column in 0..=columns {
                let along = if row % 2 == 0 { column } else { columns - column };
                let pose = self.pose_at(along as f64 * STEP_MM, row as f64 * self.stepover_mm, above_mm);
                if let Some(from) = last {
                    let motion = BlockMotion { from, to: pose, arc: None, cutter: 0 };
                    program.push_block(&motion).expect("a motion");
                }
                last = Some(pose);
            }
        }
    }

    fn profile(&self) -> Meridian {
        Meridian::new(self.diameter_mm, self.corner_mm, 0.0, 0.0, 40.0).expect("a cutter")
    }

    fn make_program(&self) -> (CertifiedProgram, usize) {
        let block = BoxGap::new(Vector3::new(0.0, 0.0, -20.0), Vector3::new(SIDE_MM, SIDE_MM, 0.0));
        let contour = CutterContour::from_meridian(&self.profile()).expect("a contour");
        let mut program = CertifiedProgram::new(vec![Box::new(block)], vec![contour], StepLimits::default())
            .expect("a program");
        self.push_zigzag(&mut program, 0.6);
        let first = program.block_count();
        self.push_zigzag(&mut program, 0.0);
        (program, first)
    }
}

fn certify_blocks(program: &CertifiedProgram, blocks: std::ops::Range<usize>) -> Vec<CertifiedEngagement> {
    let options = EngagementOptions::default();
    let mut warm = WarmStart::default();
    blocks
        .map(|block| program.certify_block(block, EngagementCriterion::Share, &options, &mut warm))
        .collect()
}

/// Bounds contacts and loads of some blocks; returns how long a block of them takes, with contacts alone first.
fn time_loads(case: &Case, program: &CertifiedProgram, blocks: std::ops::Range<usize>) -> [Duration; 2] {
    let helix = 0.5;
    let teeth = Teeth::evenly_spaced(4, helix).expect("four teeth");
    let profile = case.profile();
    let model = LoadModel::new(&profile, &teeth, STEEL, SpindleDirection::Clockwise);
    let lag = f64::tan(helix) / (0.5 * case.diameter_mm);
    let options = EngagementOptions { tolerance: 0.01, most_patches: 4_000, most_line_tests: 300_000 };
    let asked: Vec<usize> = blocks.step_by(LOADED).collect();
    let start = Instant::now();
    let contacts: Vec<_> = asked.iter().map(|block| program.bound_contacts(*block, lag, &options)).collect();
    let found = start.elapsed() / asked.len() as u32;
    let start = Instant::now();
    let mut largest = 0.0_f64;
    for grid in &contacts {
        largest = largest.max(LoadBound::from_contacts(&model, grid).loads_at(1000.0, 5000.0).force_n);
    }
    assert!(largest.is_finite());
    [found, start.elapsed() / asked.len() as u32]
}

fn main() {
    let cases = [
        Case { name: "ball R3, upright", diameter_mm: 6.0, corner_mm: 3.0, stepover_mm: 0.4, lean_rad: 0.0 },
        Case { name: "ball R5, turning", diameter_mm: 10.0, corner_mm: 5.0, stepover_mm: 0.4, lean_rad: 0.3 },
        Case { name: "bull R1, turning", diameter_mm: 10.0, corner_mm: 1.0, stepover_mm: 0.8, lean_rad: 0.3 },
        Case { name: "flat, turning", diameter_mm: 10.0, corner_mm: 0.0, stepover_mm: 0.8, lean_rad: 0.3 },
    ];
    let only = std::env::args().skip(1).find(|argument| !argument.starts_with('-'));
    for case in cases.iter().filter(|case| only.as_ref().is_none_or(|only| case.name.contains(only))) {
        let (program, first) = case.make_program();
        let blocks = first..program.block_count();
        let start = Instant::now();
        let found = certify_blocks(&program, blocks.clone());
        let alone = start.elapsed();
        let middle = (blocks.start + blocks.end) / 2;
        let start = Instant::now();
        std::thread::scope(|scope| {
            let half = scope.spawn(|| certify_blocks(&program, blocks.start..middle));
            certify_blocks(&program, middle..blocks.end);
            half.join().expect("a half");
        });
        let both = start.elapsed();
        let cutting: Vec<f64> =
            found.iter().filter(|one| one.lower > 0.0).map(|one| one.upper / one.lower).collect();
        let wide = found.iter().filter(|one| !one.is_within_tolerance).count();
        let [contacts, loads] = time_loads(case, &program, blocks.clone());
        println!(
            "{:<18}{:>7} blocks {:>6.1} s, {:>6.0}/s; two threads {:>4.2} x; {} cut, {} wide; widest {:.4}; \
             share {:.2?}, contacts {:.2?}, loads {:.2?} a block",
            case.name,
            blocks.len(),
            alone.as_secs_f64(),
            blocks.len() as f64 / alone.as_secs_f64(),
            alone.as_secs_f64() / both.as_secs_f64(),
            cutting.len(),
            wide,
            cutting.iter().copied().fold(1.0, f64::max),
            alone / blocks.len() as u32,
            contacts,
            loads,
        );
    }
}
