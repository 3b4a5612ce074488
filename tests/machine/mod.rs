//! Machines: axes, values over programs, the tip between two points, and times.

mod closed_forms;
mod faults;
mod findings;
mod long_program;
mod measured;
mod neutral;
mod random_machines;
mod shared_cases;
mod shared_times;
mod shipped;
mod times;
mod true_path;

use clsmith::machine::{AxisKind, AxisMount, KinematicChain, MachineAxis};
use clsmith::setup::Setup;
use clsmith::source::Source;
use nalgebra::{Point3, Unit, Vector3};
use std::sync::Arc;

/// An axis with speeds that no test looks at.
fn axis(name: &str, mount: AxisMount, kind: AxisKind, direction: [f64; 3], point: [f64; 3]) -> MachineAxis {
    MachineAxis {
        name: name.to_owned(),
        mount,
        kind,
        direction: Unit::new_normalize(Vector3::from(direction)),
        point: Point3::from(point),
        limits: None,
        max_speed: 6000.0,
        rapid: 12000.0,
        acceleration: 2000.0,
        jerk: None,
    }
}

fn linears() -> [MachineAxis; 3] {
    let linear = |name, direction| axis(name, AxisMount::Head, AxisKind::Linear, direction, [0.0; 3]);
    [linear("X", [1.0, 0.0, 0.0]), linear("Y", [0.0, 1.0, 0.0]), linear("Z", [0.0, 0.0, 1.0])]
}

fn chain(axes: Vec<MachineAxis>) -> KinematicChain {
    KinematicChain::new(axes, Vector3::z_axis()).unwrap()
}

/// The chain of a setup file.
#[track_caller]
fn chain_of(text: &str) -> Arc<KinematicChain> {
    let setup = Setup::load(&Source::new("machine.yaml", text.as_bytes().to_vec()).unwrap());
    let setup = setup.unwrap_or_else(|failure| panic!("{:?}\n{text}", failure.into_findings()));
    setup.machine.chain.expect("the setup has axes")
}
