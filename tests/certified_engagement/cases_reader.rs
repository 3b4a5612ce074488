//! A small reader of programs and setups, for tests.

use clsmith::certified_engagement::*;
use nalgebra::Vector3;

pub struct Motion {
    pub line: usize,
    pub block: BlockMotion,
    pub feed: f64,
}

pub struct Case {
    pub motions: Vec<Motion>,
    pub rpm: f64,
    pub tldata: [f64; 3],
}

fn numbers(text: &str) -> Vec<f64> {
    text.split(',').filter_map(|part| part.trim().parse().ok()).collect()
}

pub fn read_program(text: &str) -> Case {
    let (mut pose, mut feed, mut rpm, mut tldata): (Option<CutterPose>, _, _, _) = (None, 0.0, 0.0, [0.0; 3]);
    let mut motions = Vec::new();
    let mut axis = Vector3::z();
    let mut arc: Option<Vec<f64>> = None;
    for (index, row) in text.lines().enumerate() {
        let Some((word, rest)) = row.split_once('/') else {
            continue;
        };
        let n = numbers(rest);
        match word {
            "TLDATA" => tldata = [n[0], n[1], n[2]],
            "SPINDL" => rpm = n[0],
            "FEDRAT" => feed = n[0],
            "CIRCLE" => arc = Some(n),
            "GOTO" => {
                if n.len() >= 6 {
                    axis = Vector3::new(n[3], n[4], n[5]);
                }
                let to = CutterPose { tip: Vector3::new(n[0], n[1], n[2]), axis };
                if let Some(from) = pose {
                    let arc = arc.take().map(|c| {
                        let (center, normal) =
                            (Vector3::new(c[0], c[1], c[2]), Vector3::new(c[3], c[4], c[5]));
                        let (a, b) = (from.tip - center, to.tip - center);
                        let angle = normal.dot(&a.cross(&b)).atan2(a.dot(&b));
                        let angle = if angle <= 1e-9 { angle + std::f64::consts::TAU } else { angle };
                        TipArc { center, normal, angle }
                    });
                    let block = BlockMotion { from, to, arc, cutter: 0 };
                    motions.push(Motion { line: index + 1, block, feed });
                }
                pose = Some(to);
            }
            _ => {}
        }
    }
    Case { motions, rpm, tldata }
}

pub fn build(case: &Case, stock: Vec<Box<dyn StockGap>>, contour: CutterContour) -> CertifiedProgram {
    let mut program = CertifiedProgram::new(stock, vec![contour], StepLimits::default()).unwrap();
    for motion in &case.motions {
        program.push_block(&motion.block).unwrap();
    }
    program
}
