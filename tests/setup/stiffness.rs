//! How stiff a tool is: stick-out, stepped shank, material of the tool, and what is missing.

use super::{close, good, load, seen, source, tool};
use clsmith::cutter::{BeamStep, NonCuttingKind};
use clsmith::program::LengthUnit;
use clsmith::setup::Setup;
use clsmith::source::Span;

const STEPPED: &str = "tools: [ { match: {}, diameter: 10, flute_length: 22, corner_radius: 1, holder: { diameter: 40, length: 50 }, \
    shank: [ { diameter: 9.5, length: 37 }, { diameter: 12, length: 80 } ], stick_out: 60, tool_material: carbide } ]";

#[test]
fn a_stepped_shank_is_clamped_where_the_holder_begins() {
    let resolved = good(STEPPED).resolve_cutter(&tool(""), LengthUnit::Mm).unwrap();
    let beam = resolved.beam.unwrap();
    let step = |from_mm, to_mm, diameter_mm| BeamStep { from_mm, to_mm, diameter_mm };
    assert_eq!(beam.steps(), [step(0.0, 22.0, 8.0), step(22.0, 37.0, 9.5), step(37.0, 60.0, 12.0)]);
    let collars: Vec<_> =
        resolved.cutter.collars.iter().map(|at| (at.kind, at.radius_mm, at.from_mm, at.to_mm)).collect();
    let shank = NonCuttingKind::Shank;
    let wanted =
        [(shank, 4.75, 22.0, 37.0), (shank, 6.0, 37.0, 60.0), (NonCuttingKind::Holder, 20.0, 60.0, 110.0)];
    assert_eq!(collars, wanted);
    // A number instead of a material, another factor, and without a clamp the holder tells it.
    let text = STEPPED
        .replace("stick_out: 60, tool_material: carbide", "youngs_modulus: 290, flute_diameter_factor: 0.75");
    let other = good(&text).resolve_cutter(&tool(""), LengthUnit::Mm).unwrap().beam.unwrap();
    close(other.stick_out_mm(), 80.0);
    close(other.steps()[0].diameter_mm, 7.5);
    let stiff = |beam: &clsmith::cutter::ToolBeam, at: f64| beam.deflection_mm_per_n(at, at);
    assert!(stiff(&other, 79.0) > 0.0 && stiff(&beam, 60.0) == 0.0);
    // In inch.
    let inch = "units: inch\ntools: [ { match: {}, diameter: 0.5, flute_length: 1, corner_radius: 0, stick_out: 2, \
        shank: { diameter: 0.5, length: 3 }, tool_material: hss } ]";
    let beam = good(inch).resolve_cutter(&tool(""), LengthUnit::Inch).unwrap().beam.unwrap();
    close(beam.stick_out_mm(), 50.8);
    close(beam.steps()[1].diameter_mm, 12.7);
}

#[test]
fn faults_of_stiffness() {
    let setups = [
        "tools: [ { match: {}, shank: [ { diameter: 10, length: 40 }, { diameter: 12, length: 30 } ] } ]",
        "tools: [ { match: {}, shank: [] } ]",
        "tools: [ { match: {}, shank: { diameter: 10 } } ]",
        "tools: [ { match: {}, shank: [ { diameter: 10, length: 40, lenght: 3 } ] } ]",
        "tools: [ { match: {}, flute_length: 30, stick_out: 25 } ]",
        "tools: [ { match: {}, shank: { diameter: 10, length: 40 }, stick_out: 45 } ]",
        "tools: [ { match: {}, tool_material: wood } ]",
        "tools: [ { match: {}, tool_material: carbide, youngs_modulus: 600 } ]",
        "tools: [ { match: {}, youngs_modulus: 0 } ]",
        "tools: [ { match: {}, flute_diameter_factor: 1.2 } ]",
    ];
    let found: Vec<_> = setups
        .iter()
        .flat_map(|text| load(text).err().unwrap_or_else(|| panic!("no fault in {text}")))
        .collect();
    assert!(found.len() >= setups.len());
    seen("stiffness_faults", &found);
}

#[test]
fn what_is_missing_for_a_beam_is_named() {
    let part = source("GOTO/0,0,0\n");
    let said = |text: &str| {
        let setup = if text.is_empty() { Setup::default() } else { good(text) };
        assert!(
            setup.resolve_cutter(&tool("TLDATA/MILL,10,0,75,0,0\n"), LengthUnit::Mm).unwrap().beam.is_none()
        );
        let missing =
            setup.report_missing_stiffness(&tool("TLDATA/MILL,10,0,75,0,0\n"), &part, Span::new(0, 4));
        assert_eq!(missing.code.id(), "CL0807");
        format!("{} {}", missing.message, missing.help.unwrap_or_default())
    };
    let nothing = said("");
    assert!(
        nothing.contains("stick_out") && nothing.contains("tool_material") && nothing.contains("tools: ["),
        "{nothing}"
    );
    let modulus = said("tools: [ { match: {}, stick_out: 40, shank: { diameter: 10, length: 60 } } ]");
    assert!(modulus.contains("youngs_modulus") && !modulus.contains("stick_out:"), "{modulus}");
    let shank = said("tools: [ { match: {}, flute_length: 20, stick_out: 40, tool_material: carbide } ]");
    assert!(shank.contains("`shank`") && !shank.contains("tool_material:"), "{shank}");
}
