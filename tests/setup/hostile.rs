//! Files that nobody writes by hand must not crash or hang, and what they say must be usable.

use super::load;
use crate::support::{named_tool, within_seconds};
use clsmith::program::LengthUnit;
use proptest::prelude::*;

const PIECES: &[&str] = &[
    "units: inch\n",
    "machine: ",
    "max_acceleration: ",
    "stock: ",
    "block: ",
    "cylinder: ",
    "stl: ",
    "file: ",
    "bodies: ",
    "allowance: ",
    "from: ",
    "to: ",
    "diameter: ",
    "[0, 0, 0]",
    "[1, 2, 3]",
    "tools:\n",
    "  - match: ",
    "{}",
    "{ number: 3 }",
    "{ name: \"*\" }",
    "\n    ",
    "corner_radius: ",
    "taper: ",
    "tip: ",
    "point: ",
    "flute_length: ",
    "shank: ",
    "holder: ",
    "length: ",
    "teeth: ",
    "pitch: ",
    "[180, 180]",
    "helix: ",
    "runout: ",
    "insert: ",
    "height: ",
    "radius: ",
    "material: ",
    "k_tc: ",
    "k_te: ",
    "name: ",
    "5",
    "0",
    "-1",
    "1e308",
    ".inf",
    "90",
    "360",
    "a.stl",
    "~",
    "{ ",
    " }",
    "[",
    "]",
    ", ",
    "\n",
    "  ",
    "- ",
    "&a ",
    "*a",
    "'",
    "\"",
    "#",
];

proptest! {
    #![proptest_config(crate::support::property(2000))]

    #[test]
    fn anything_like_a_setup_is_read_or_refused(pieces in proptest::collection::vec(proptest::sample::select(PIECES), 0..40)) {
        survive(&pieces.concat())?;
    }

    #[test]
    fn any_numbers_make_a_tool_or_a_finding(
        keys in proptest::sample::subsequence(KEYS, 0..KEYS.len()),
        values in proptest::collection::vec(value(), KEYS.len()),
        inch in any::<bool>(),
    ) {
        let mut text = format!("units: {}\ntools:\n  - match: {{}}\n", if inch { "inch" } else { "mm" });
        for (key, value) in keys.iter().zip(values) {
            text += &format!("    {}\n", key.replace('#', &value.to_string()));
        }
        survive(&text)?;
    }

    #[test]
    fn any_numbers_make_a_stock_or_a_finding(
        from in proptest::array::uniform3(-5.0..5.0_f64),
        to in proptest::array::uniform3(prop_oneof![-5.0..5.0_f64, Just(0.0), Just(1e200)]),
        cylinder in any::<bool>(),
    ) {
        let kind = if cylinder { "cylinder: { diameter: 3, " } else { "block: { " };
        survive(&format!("stock: {{ {kind} from: {from:?}, to: {to:?} }} }}\n"))?;
    }
}

const KEYS: &[&str] = &[
    "diameter: #",
    "corner_radius: #",
    "taper: #",
    "tip: #",
    "point: #",
    "flute_length: #",
    "shank: { diameter: #, length: # }",
    "holder: { diameter: #, length: # }",
    "teeth: 3",
    "pitch: [100, 100, 160]",
    "helix: #",
    "runout: #",
    "runout: [#, #, #]",
    "insert: { height: #, radius: # }",
];

fn value() -> impl Strategy<Value = f64> {
    prop_oneof![0.0..50.0_f64, 0.0..400.0_f64, Just(0.0), Just(90.0), Just(1e-300), Just(1e300)]
}

fn survive(text: &str) -> Result<(), TestCaseError> {
    match load(text) {
        Ok(setup) => {
            let tool = named_tool(Some(3), Some("A"));
            let source = super::source(text);
            for units in [LengthUnit::Mm, LengthUnit::Inch] {
                match setup.resolve_cutter(&tool, units) {
                    Ok(found) => {
                        prop_assert!(found.cutter.radius_mm().is_finite() && found.cutter.radius_mm() > 0.0);
                        prop_assert!(found.cutter.collars.iter().all(|collar| collar.to_mm > collar.from_mm));
                    }
                    Err(gap) => prop_assert!(!gap.diagnostic(&source, Default::default()).message.is_empty()),
                }
            }
            for body in setup.stock.iter().flat_map(|stock| &stock.bodies) {
                prop_assert!(body.place.value_span().to_range().end <= text.len());
            }
        }
        Err(errors) => {
            prop_assert!(!errors.is_empty());
            for diagnostic in &errors {
                prop_assert!(diagnostic.is_error() && !diagnostic.labels.is_empty());
                for label in &diagnostic.labels {
                    prop_assert!(label.span.to_range().end <= text.len());
                }
            }
        }
    }
    Ok(())
}

#[test]
fn large_files_are_read_in_time() {
    let entries =
        "  - { match: { number: 1 }, diameter: 5, shank: { diameter: 5, length: 9 } }\n".repeat(12_000);
    let tools = within_seconds(20.0, || load(format!("tools:\n{entries}")).unwrap().tools);
    assert_eq!(tools.len(), 12_000);
    let bodies = "    - block: { from: [0, 0, 0], to: [1, 1, 0] }\n".repeat(20_000);
    let found = within_seconds(20.0, || load(format!("stock:\n  bodies:\n{bodies}")).unwrap_err());
    assert_eq!(found.len(), 20);
}
