//! What the keys of a setup mean.

use super::{close, good};
use clsmith::parameters::Positive;
use clsmith::program::LengthUnit;
use clsmith::setup::{CutterInsert, Setup, StockBodyShape, ToolCylinder};
use std::path::Path;

#[test]
fn a_machine_has_limits() {
    let machine = good("machine: { max_feed: 8000, rapid_feed: 30000, max_acceleration: 2000 }").machine;
    assert_eq!(machine.max_acceleration, Positive::new(2000.0));
    let inches = good("units: inch\nmachine: { max_acceleration: 100 }").machine;
    assert_eq!(inches.max_acceleration, Positive::new(2540.0));
}

#[test]
fn nothing_said_is_nothing_known() {
    for text in ["units: mm", "stock:", "tools:", "material:", "machine:\ntools: []"] {
        assert_eq!(good(text), Setup::default(), "{text}");
    }
}

#[test]
fn a_block_has_any_two_opposite_corners() {
    let stock =
        good("stock: { block: { from: [10, 0, 0], to: [0, 20, -5] }, allowance: 1.5 }").stock.unwrap();
    let low_high = StockBodyShape::Block { low: [0.0, 0.0, -5.0], high: [10.0, 20.0, 0.0] };
    assert_eq!(stock.bodies[0].shape, low_high);
    close(stock.allowance_mm, 1.5);
    assert_eq!(
        stock.place.source().slice(stock.bodies[0].place.value_span()),
        b"{ from: [10, 0, 0], to: [0, 20, -5] }"
    );
}

#[test]
fn a_cylinder_may_point_anywhere_and_inches_become_millimetres() {
    let text =
        "units: inch\nstock: { cylinder: { diameter: 2, from: [0, 0, 0], to: [1, 0, 1] }, allowance: 0.1 }";
    let stock = good(text).stock.unwrap();
    let StockBodyShape::Cylinder { diameter, from, to } = stock.bodies[0].shape else { panic!() };
    close(diameter, 50.8);
    assert_eq!((from, to), ([0.0; 3], [25.4, 0.0, 25.4]));
    close(stock.allowance_mm, 2.54);
}

#[test]
fn files_lie_beside_the_file_that_names_them() {
    let stock = good("units: inch\nstock: { stl: parts/casting.stl }").stock.unwrap();
    let StockBodyShape::Stl { file, units } = &stock.bodies[0].shape else { panic!() };
    assert_eq!(file.path, Path::new("shop/parts/casting.stl"));
    assert_eq!((file.written.as_str(), *units), ("parts/casting.stl", LengthUnit::Inch));
    let stock = good("stock: { file: /tmp/op10.clstock }").stock.unwrap();
    let StockBodyShape::Saved(file) = &stock.bodies[0].shape else { panic!() };
    assert_eq!(file.path, Path::new("/tmp/op10.clstock"));
    let found = file.make_stock_finding("it is empty");
    assert_eq!(found.code.id(), "CL0504");
    assert_eq!(found.labels[0].source.slice(found.labels[0].span), b"/tmp/op10.clstock");
}

#[test]
fn several_bodies_are_one_stock() {
    let text = "stock:\n  bodies:\n    - block: { from: [0, 0, 0], to: [1, 1, 1] }\n    - stl: a.stl\n    - file: b.clstock\n";
    let stock = good(text).stock.unwrap();
    assert_eq!(stock.bodies.len(), 3);
    let place = &stock.bodies[1].place;
    assert_eq!(place.source().slice(place.value_span()), b"a.stl");
}

#[test]
fn a_tool_entry_in_inches_is_in_millimetres_and_radians() {
    let text = "units: inch\ntools:\n  - match: { number: 3, name: \"MILL*\" }\n    diameter: 1\n    corner_radius: \
         0.1\n    taper: 3\n    tip: 10\n    flute_length: 2\n    shank: { diameter: 0.5, length: 3 }\n    holder: { \
         diameter: 2, length: 4 }\n    insert: { height: 0.2, radius: 0.3 }\n";
    let entry = &good(text).tools[0];
    close(entry.diameter_mm.unwrap(), 25.4);
    close(entry.corner_radius_mm.unwrap(), 2.54);
    close(entry.flute_length_mm.unwrap(), 50.8);
    close(entry.taper_rad.unwrap(), 3_f64.to_radians());
    close(entry.tip_rad.unwrap(), 10_f64.to_radians());
    assert_eq!(entry.shank, [ToolCylinder { diameter_mm: 12.7, length_mm: 76.19999999999999 }]);
    assert_eq!(entry.holder, Some(ToolCylinder { diameter_mm: 50.8, length_mm: 101.6 }));
    let Some(insert) = entry.insert else { panic!() };
    let CutterInsert { height_mm: height, radius_mm: radius } = insert.of_cutter(0.0);
    close(height, 5.08);
    close(radius, 7.62);
}

#[test]
fn a_point_angle_is_the_angle_of_the_bottom_otherwise_said() {
    let entry = &good("tools: [ { match: {}, point: 118 } ]").tools[0];
    close(entry.tip_rad.unwrap(), 31_f64.to_radians());
    close(good("tools: [ { match: {}, point: 180 } ]").tools[0].tip_rad.unwrap(), 0.0);
}

#[test]
fn a_recipe_says_the_same_under_setup() {
    let text = "version: 1\nunits: inch\nsetup: { stock: { stl: part.stl }, tools: [ { match: {}, diameter: 1 } ] }\nsteps: []\n";
    let source = clsmith::source::Source::new("jobs/recipe.yaml", text.as_bytes().to_vec()).unwrap();
    let recipe = clsmith::transform::Recipe::load(&source).unwrap();
    close(recipe.setup.tools[0].diameter_mm.unwrap(), 25.4);
    let StockBodyShape::Stl { file, .. } = &recipe.setup.stock.as_ref().unwrap().bodies[0].shape else {
        panic!()
    };
    assert_eq!(file.path, Path::new("jobs/part.stl"));
    assert_eq!(file.place.source().slice(file.place.key_span()), b"stl");
}
