//! The path on which a machine takes the tool: against closed forms, and against programs of many small motions.

use super::chain_of;
use crate::support::program;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::engagement::MotionPiece;
use clsmith::program::{LengthUnit, Program};
use clsmith::report::simulation::SimulationReport;
use clsmith::setup::Setup;
use clsmith::simulation_run::layer_run::LayerRunOptions;
use clsmith::simulation_run::{KnownShares, Machining, SilentWatcher, SimulationRunOptions};
use clsmith::source::Source;
use nalgebra::{Point3, Vector3};

/// A table that tilts about y at a height, below three linear axes.
fn tilting_table(height: f64, more: &str) -> String {
    format!(
        "machine:
  {more}
  max_feed: 9000
  table:
    - {{ name: B, kind: rotary, direction: [0, 1, 0], point: [0, 0, {height}], max_speed: 3600, rapid: 9000, acceleration: 400 }}
  head:
    - {{ name: X, kind: linear, direction: [1, 0, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }}
    - {{ name: Y, kind: linear, direction: [0, 1, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }}
    - {{ name: Z, kind: linear, direction: [0, 0, 1], max_speed: 17000, rapid: 20000, acceleration: 3500 }}
"
    )
}

const SHOP: &str = "stock: { block: { from: [-20, -15, -10], to: [20, 15, 0] } }
tools: [ { match: {}, diameter: 10, corner_radius: CORNER, flute_length: 20, teeth: 4 } ]
";

fn setup(machine: &str, corner: f64) -> Setup {
    let text = format!("{machine}{}", SHOP.replace("CORNER", &corner.to_string()));
    Setup::load(&Source::new("shop.yaml", text.into_bytes()).unwrap()).unwrap()
}

/// Where the tool stands at an angle of B in degrees: the table turns the workpiece, so the tool goes the other way.
fn axis_at(b: f64) -> Vector3<f64> {
    let (sine, cosine) = b.to_radians().sin_cos();
    Vector3::new(-sine, 0.0, cosine)
}

/// A motion of the tip from one place to another while B turns.
#[derive(Clone, Copy)]
struct Rocking {
    height: f64,
    tips: [[f64; 3]; 2],
    angles: [f64; 2],
}

impl Rocking {
    /// The tip in the workpiece at a share of the motion, with all axes linear: turned back from the line in the machine.
    fn tip(&self, share: f64) -> Point3<f64> {
        let pivot = Vector3::new(0.0, 0.0, self.height);
        let turn = |b: f64| nalgebra::Rotation3::from_axis_angle(&Vector3::y_axis(), b.to_radians());
        let [from, to] =
            [0, 1].map(|end| turn(self.angles[end]) * (Vector3::from(self.tips[end]) - pivot) + pivot);
        let there = from + (to - from) * share;
        (turn(self.angle(share)).inverse() * (there - pivot) + pivot).into()
    }

    fn angle(&self, share: f64) -> f64 {
        self.angles[0] + (self.angles[1] - self.angles[0]) * share
    }

    fn goto(tip: Point3<f64>, axis: Vector3<f64>) -> String {
        format!("GOTO/{:.7},{:.7},{:.7},{:.9},{:.9},{:.9}\n", tip.x, tip.y, tip.z, axis.x, axis.y, axis.z)
    }

    fn head(&self) -> String {
        format!(
            "TOOL PATH/A,TOOL,T1\nTLDATA/MILL,10.0000,0.0000,60.0000,0.0000,0.0000\nSPINDL/RPM,6000,CLW\nRAPID\n{}",
            Self::goto(self.tip(0.0), axis_at(self.angle(0.0)))
        )
    }

    /// As a CAM system writes it.
    fn program(&self) -> Program {
        let end = Self::goto(self.tip(1.0), axis_at(self.angle(1.0)));
        program(format!("{}FEDRAT/MMPM,600.0000\n{end}END-OF-PATH\n", self.head()))
    }

    /// The same in small steps on the path of the machine, each with the feed that takes the same time.
    fn small_steps(&self, steps: usize) -> Program {
        let mut text = self.head();
        let way = (self.tip(1.0) - self.tip(0.0)).norm() / steps as f64;
        for step in 1..=steps {
            let [from, to] = [step - 1, step].map(|step| self.tip(step as f64 / steps as f64));
            text += &format!("FEDRAT/MMPM,{:.6}\n", 600.0 * (to - from).norm() / way);
            text += &Self::goto(to, axis_at(self.angle(step as f64 / steps as f64)));
        }
        program(&(text + "END-OF-PATH\n"))
    }
}

/// The pieces of the last motion, and the notes.
fn pieces_of(program: &Program, setup: &Setup) -> (Vec<MotionPiece>, Vec<Diagnostic>) {
    let mut notes = Vec::new();
    let machining = Machining::new(program, setup, LengthUnit::Mm, &mut notes).unwrap();
    let mut pieces = Vec::new();
    let options = SimulationRunOptions::default().with_cell_mm(0.5);
    machining
        .simulate_program(&options, &SilentWatcher, &mut |motion| {
            pieces = motion.pieces.iter().map(|(step, _)| *step).collect();
        })
        .unwrap();
    (pieces, notes.into_iter().filter(|note| note.code == codes::TRUE_PATH).collect())
}

/// The largest distance of the ends of pieces from the straight line between both tips.
fn largest_sag(pieces: &[MotionPiece]) -> f64 {
    let (first, last) = (pieces[0].piece.from.point, pieces[pieces.len() - 1].piece.to.point);
    let line = (last - first).normalize();
    let off = |piece: &MotionPiece| (piece.piece.to.point - first).cross(&line).norm();
    pieces.iter().map(off).fold(0.0, f64::max)
}

#[test]
fn the_tip_leaves_its_line_by_the_closed_form() {
    for (height, angle) in [(77.5, 5.0), (77.5, 30.0), (-60.0, 12.0), (200.0, 4.0_f64)] {
        // The tip goes along the axis of B, below or above it, while B rocks about its middle.
        let rocking = Rocking {
            height,
            tips: [[0.0, -4.0, -1.0], [0.0, 4.0, -1.0]],
            angles: [-angle / 2.0, angle / 2.0],
        };
        let program = rocking.program();
        let (pieces, notes) = pieces_of(&program, &setup(&tilting_table(height, "tcp: false"), 0.0));
        // The machine cuts the chord of the circle on which the workpiece goes: r (1 - cos (a / 2)), or r a2 / 8.
        let (arm, turn) = ((height + 1.0).abs(), angle.to_radians());
        let sag = arm * (1.0 - (turn / 2.0).cos());
        assert!((sag - arm * turn * turn / 8.0).abs() <= 0.006 * sag);
        assert!((largest_sag(&pieces) - sag).abs() <= 0.003, "{} for {sag}", largest_sag(&pieces));
        // Every piece is on the path, all along it and in the machine's time.
        for step in &pieces {
            for part in [0.0, 0.3, 0.5, 1.0] {
                let share = step.from + (step.to - step.from) * part;
                let there = step.piece.from.point + (step.piece.to.point - step.piece.from.point) * part;
                assert!((there - rocking.tip(share)).norm() < 0.0021, "{height} {angle} {share}");
            }
        }
        assert!(
            pieces
                .windows(2)
                .all(|pair| pair[0].to == pair[1].from && pair[0].piece.to == pair[1].piece.from)
        );
        assert_eq!((pieces[0].from, pieces[pieces.len() - 1].to), (0.0, 1.0));
        assert_eq!(notes.len(), 1, "{notes:?}");
        let told = notes[0].message.split("by up to ").nth(1).unwrap().split(' ').next().unwrap();
        let told: f64 = told.parse().unwrap();
        assert!(notes[0].message.ends_with("on line 7"), "{}", notes[0].message);
        assert!((told - sag).abs() < 0.006 * sag, "{}", notes[0].message);
    }
}

#[test]
fn chips_and_stock_are_those_of_many_small_steps() {
    for (corner, height) in [(0.0, 77.5), (5.0, -60.0)] {
        let rocking = Rocking { height, tips: [[-12.0, 3.0, -2.0], [12.0, 1.0, -2.5]], angles: [-6.0, 6.0] };
        let machine = setup(&tilting_table(height, "tcp: false"), corner);
        let plain = setup("", corner);
        let simulated = |program: &Program, setup: &Setup, certified: bool| {
            let machining = Machining::new(program, setup, LengthUnit::Mm, &mut Vec::new()).unwrap();
            let options = SimulationRunOptions::default().with_cell_mm(0.25);
            let mut report =
                SimulationReport::simulate_program(&machining, &options, &SilentWatcher).unwrap();
            if certified {
                report.certify_chips(&machining, &KnownShares::default(), &SilentWatcher).unwrap();
            }
            report
        };
        let (once, steps) = (rocking.program(), rocking.small_steps(60));
        for certified in [false, true] {
            let (own, small) = (simulated(&once, &machine, certified), simulated(&steps, &plain, certified));
            let (volume, wanted) = (own.totals.removed_mm3, small.totals.removed_mm3);
            assert!((volume - wanted).abs() < 2e-3 * wanted, "{volume} and {wanted}");
            // As programmed it is another chip and another stock.
            let straight = simulated(&once, &plain, certified).totals;
            let is_told = |report: &SimulationReport| {
                report.assumptions.iter().any(|sentence| sentence.contains("the path of the machine"))
            };
            assert!(is_told(&own) && !is_told(&small));
            assert!((straight.removed_mm3 - wanted).abs() > 0.02 * wanted, "{}", straight.removed_mm3);
            let chip = |report: &SimulationReport| report.totals.chip_thickness_mm.unwrap().value;
            let (chip, wanted) = (chip(&own), chip(&small));
            assert!((chip - wanted).abs() < 0.02 * wanted, "{certified}: {chip} and {wanted}");
        }
    }
}

#[test]
fn layers_follow_the_machine_too() {
    let rocking =
        Rocking { height: 77.5, tips: [[-12.0, 3.0, -2.0], [12.0, 1.0, -2.5]], angles: [-6.0, 6.0] };
    let volume = |program: &Program, setup: &Setup| {
        let machining = Machining::new(program, setup, LengthUnit::Mm, &mut Vec::new()).unwrap();
        let mut sum = 0.0;
        machining
            .simulate_layers(&LayerRunOptions::new(0.25), &SilentWatcher, &mut |motion| {
                sum += motion.volume_mm3()
            })
            .unwrap();
        sum
    };
    let plain = setup("", 0.0);
    let own = volume(&rocking.program(), &setup(&tilting_table(77.5, "tcp: false"), 0.0));
    let small = volume(&rocking.small_steps(60), &plain);
    let straight = volume(&rocking.program(), &plain);
    assert!((own - small).abs() < 2e-3 * small, "{own} and {small}");
    assert!((straight - small).abs() > 0.02 * small, "{straight} and {small}");
}

#[test]
fn with_control_of_the_tip_the_axis_goes_over_the_cone() {
    let machine = tilting_table(77.5, "tcp: true").replace(
        "  table:\n",
        "  table:\n    - { name: C, kind: rotary, direction: [0, 0, 1], point: [0, 0, 0], max_speed: 1800, rapid: 9000, acceleration: 800 }\n",
    );
    // C turns by 40 degrees at a tilt of 30.
    let axis = |c: f64| {
        let ((sc, cc), (st, ct)) = (c.to_radians().sin_cos(), 30f64.to_radians().sin_cos());
        Vector3::new(st * cc, -st * sc, ct)
    };
    let text = format!(
        "TOOL PATH/A,TOOL,T1\nSPINDL/RPM,6000,CLW\nRAPID\n{}FEDRAT/MMPM,600.0000\n{}END-OF-PATH\n",
        Rocking::goto([-10.0, 0.0, -1.0].into(), axis(0.0)),
        Rocking::goto([10.0, 0.0, -1.0].into(), axis(40.0))
    );
    let (pieces, notes) = pieces_of(&program(&text), &setup(&machine, 5.0));
    assert!(pieces.len() > 4, "{}", pieces.len());
    for step in &pieces {
        assert!((step.piece.to.axis - axis(40.0 * step.to)).norm() < 1e-7);
        assert!((step.piece.to.point - Point3::new(-10.0 + 20.0 * step.to, 0.0, -1.0)).norm() < 1e-9);
        assert!((step.pace - 1.0).abs() < 1e-9, "{}", step.pace);
    }
    assert!(notes.len() == 1 && notes[0].message.contains("shortest turn"), "{notes:?}");
}

#[test]
fn what_is_programmed_stays_where_no_rotary_axis_turns() {
    let level = "TOOL PATH/A,TOOL,T1\nSPINDL/RPM,6000,CLW\nRAPID\nGOTO/-10,0,-1,0,0,1\nFEDRAT/MMPM,600.\nGOTO/10,0,-1\nEND-OF-PATH\n";
    let machine = tilting_table(77.5, "tcp: false");
    let (pieces, notes) = pieces_of(&program(level), &setup(&machine, 5.0));
    assert_eq!((pieces.len(), notes.len()), (1, 0), "{notes:?}");
    assert!(chain_of(&machine).rotary_axes().next().is_some());
    // A pose that the machine cannot give is taken as programmed, and told.
    let sideways = level.replace("GOTO/10,0,-1\n", "GOTO/10,0,-1,0,0.5,0.8660254\n");
    let (pieces, notes) = pieces_of(&program(&sideways), &setup(&machine, 0.0));
    assert_eq!(pieces.len(), 1);
    assert!(notes.len() == 1 && notes[0].message.contains("cannot reach"), "{notes:?}");
}
