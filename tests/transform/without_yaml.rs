//! Transforms built in Rust, and run without a recipe.

use super::apply;
use crate::support;
use clsmith::parameters::{Degrees, Factor, Finite, Positive};
use clsmith::program::LengthUnit;
use clsmith::setup::Setup;
use clsmith::transform::*;
use nalgebra::Vector3;

const PART: &str = "TOOL PATH/A,TOOL,T1
TLDATA/MILL,10.0000,0.0000,60.0000,0.0000,0.0000
SPINDL/RPM,1000,CLW
FEDRAT/MMPM,1000.0000
GOTO/0.0000,0.0000,5.0000,0.0000000,0.0000000,1.0000000
GOTO/8.0000,4.0000,-1.0000
END-OF-PATH
";

fn run(steps: &[&dyn Transform]) -> Result<String, clsmith::diagnostic::Failure> {
    let outcome = run_steps(steps, LengthUnit::Mm, &Setup::default(), support::program(PART))?;
    assert!(outcome.findings.is_empty(), "{:?}", outcome.findings);
    Ok(String::from_utf8(outcome.program.to_bytes()).unwrap())
}

#[test]
fn steps_built_in_rust_do_what_a_recipe_does() {
    let scale = ScaleFeed::new(Factor::new(0.5).unwrap());
    let clamp = ClampFeed { max: Positive::new(400.0), ..ClampFeed::default() };
    let rule = RewriteRule::replacing("SPINDL/RPM,$N,CLW", "SPINDL/RPM,$N,CCLW").unwrap();
    let rewrite = Rewrite::new(vec![rule.only_if("$N > 500").unwrap()]);
    let axis = DirectionSpec(Vector3::z_axis());
    let turn = MoveOrigin {
        rotate: Some(RotationSpec { axis, degrees: Degrees::new(90.0).unwrap(), about: None }),
        translate: Some([0.0, 0.0, 2.0].map(|value| Finite::new(value).unwrap())),
        ..MoveOrigin::default()
    };
    let convert = ConvertUnits { from: Some(LengthUnit::Mm), ..ConvertUnits::new(LengthUnit::Inch) };
    let (wanted, _) = apply(
        "  - scale_feed: { factor: 0.5 }\n  - clamp_feed: { max: 400 }\n  - rewrite: { rules: [{ match: 'SPINDL/RPM,$N,CLW', \
         replace: 'SPINDL/RPM,$N,CCLW', if: $N > 500 }] }\n  - move_origin: { rotate: { axis: z, degrees: 90 }, translate: [0, 0, 2] }\n",
        PART,
    );
    assert_eq!(run(&[&scale, &clamp, &rewrite, &turn]).unwrap(), wanted);
    let program = support::program(PART);
    let outcome = run_steps(&[&convert], LengthUnit::Mm, &Setup::default(), program).unwrap();
    assert_eq!(outcome.program.feed_length_unit(), Some(LengthUnit::Inch));
}

#[test]
fn the_large_steps_can_be_built_too_and_say_what_is_missing_without_a_place() {
    let optimize = OptimizeFeed::new(Positive::new(0.1).unwrap());
    let steps: [&dyn Transform; 2] = [&optimize, &ClampFeed::default()];
    for step in steps {
        let found = run(&[step]).unwrap_err().into_findings();
        assert_eq!(found.last().unwrap().code.id(), "CL0302", "{found:?}");
        assert!(found.last().unwrap().labels.is_empty(), "{found:?}");
        assert!(step.measures());
    }
    assert_eq!(run(&[&CorrectRamp::default()]).unwrap(), PART);
    let compensate: &dyn Transform = &CompensateZ::default();
    assert!(compensate.measures() && compensate.reads().is_empty());
}

#[test]
fn a_rule_built_in_rust_is_checked() {
    assert!(RewriteRule::replacing("SPINDL/$N", "SPINDL/$M").is_err());
    assert!(RewriteRule::deleting("SPINDL/$N").unwrap().only_if("$M > 1").is_err());
}
