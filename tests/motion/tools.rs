//! Which tool is in force, and its shape, in each dialect.

use crate::support::{clean_motions, program, program_of};
use clsmith::program::Dialect;
use clsmith::program::motion::Motion;
use clsmith::program::record::ToolWord;

fn numbers(found: &[Motion]) -> Vec<Option<u32>> {
    found.iter().map(|motion| motion.tool.as_ref().and_then(|tool| tool.number)).collect()
}

#[test]
fn nx_describes_the_tool_and_then_loads_it() {
    let text = "TOOL PATH/A,TOOL,MILL_D10\nTLDATA/MILL,10.0000,1.0000,75.0000,2.0000,45.0000\nLOAD/TOOL,3,ADJUST,3 \nGOTO/0,0,0\nEND-OF-PATH\n";
    let found = clean_motions(&program(text));
    let tool = found[0].tool.as_deref().unwrap();
    assert_eq!((tool.number, tool.name.as_deref(), tool.loaded), (Some(3), Some("MILL_D10"), true));
    let data = tool.data.as_ref().unwrap();
    assert_eq!(
        (data.word, data.diameter, data.corner_radius, data.length),
        (ToolWord::TlDataMill, Some(10.0), Some(1.0), Some(75.0))
    );
    assert_eq!((data.taper_degrees, data.tip_degrees), (Some(2.0), Some(45.0)));
}

#[test]
fn an_nx_drill_has_a_point_angle_and_flutes() {
    let text =
        "TOOL PATH/A,TOOL,D40\nTLDATA/DRILL,MILL,40.0000,0.0000,210.0000,150.0000,30.0000\nGOTO/0,0,0\n";
    let found = clean_motions(&program(text));
    let tool = found[0].tool.as_deref().unwrap();
    let data = tool.data.as_ref().unwrap();
    assert_eq!((data.word, data.diameter, data.length), (ToolWord::TlDataDrill, Some(40.0), Some(210.0)));
    assert_eq!((data.tip_degrees, data.flute_length, tool.loaded), (Some(150.0), Some(30.0), false));
}

#[test]
fn the_next_nx_path_with_the_same_tool_keeps_it_loaded() {
    let path = |tool: &str, load: &str| {
        format!("TOOL PATH/A,TOOL,{tool}\nTLDATA/MILL,10,0,75,0,0\n{load}GOTO/0,0,0\nEND-OF-PATH\n")
    };
    let text = [path("D10", "LOAD/TOOL,3,ADJUST,3\n"), path("D10", ""), path("D16", "")].concat();
    assert_eq!(numbers(&clean_motions(&program(text))), [Some(3), Some(3), None]);
}

#[test]
fn two_loadtl_of_one_number_are_one_tool_in_catia() {
    let text = "$$*CATIA0\n$$ P\n$$ 1 0 0 0\n$$ 0 1 0 0\n$$ 0 0 1 0\nCUTTER/ 10.000000,  2.000000,  3.000000,  2.000000, 45.000000,$\n         0.000000, 50.000000\nTOOLNO/2,   10.000000\nLOADTL/2\nGOTO/0,0,0\nLOADTL/2,1\nGOTO/1,0,0\n";
    let found = clean_motions(&program(text));
    assert_eq!(numbers(&found), [Some(2), Some(2)]);
    let data = found[1].tool.as_ref().unwrap().data.clone().unwrap();
    assert_eq!(
        (data.diameter, data.corner_radius, data.length, data.tip_degrees),
        (Some(10.0), Some(2.0), Some(50.0), Some(45.0))
    );
}

#[test]
fn a_catia_lathe_tool_has_the_diameter_of_its_nose() {
    let found = clean_motions(&program("CUTTER/    0.800000\nGOTO/0,0,0\n"));
    let data = found[0].tool.as_ref().unwrap().data.clone().unwrap();
    assert_eq!((data.diameter, data.length), (Some(0.8), None));
}

#[test]
fn creo_keeps_a_tool_over_features_that_do_not_load_it() {
    let text = "$$-> FEATNO / 1\nLOADTL / 4\n$$-> CUTTER / 0.500000\nGOTO / 0, 0, 0\n$$-> END / \n$$-> FEATNO / 2\nGOTO / 1, 0, 0\n$$-> END / \n";
    let found = clean_motions(&program(text));
    assert_eq!(numbers(&found), [Some(4), Some(4)]);
    assert_eq!(found[1].tool.as_ref().unwrap().data.as_ref().unwrap().diameter, Some(0.5));
    assert_eq!(found.iter().map(|motion| motion.operation).collect::<Vec<_>>(), [0, 1]);
}

#[test]
fn solidworks_describes_then_loads_and_selects_the_next() {
    let text = "TRNTYP/WORLD,0,0,0\nCUTTER/16.,0,8.,8.,45.,0,71.\nLOAD/TOOL,15\nSELECT/TOOL,16\nGOTO/0,0,0\nCUTTER/12.,0,6.,3.605164,31.,0,141.\nLOAD/TOOL,16\nGOTO/1,0,0\n";
    let found = clean_motions(&program(text));
    assert_eq!(numbers(&found), [Some(15), Some(16)]);
    let diameters: Vec<_> =
        found.iter().map(|motion| motion.tool.as_ref().unwrap().data.as_ref().unwrap().diameter).collect();
    assert_eq!(diameters, [Some(16.0), Some(12.0)]);
}

#[test]
fn select_alone_loads_nothing() {
    for select in ["SELECT/TOOL,45", "TOOLNO/4", "LOADTL/NOMORE"] {
        let found = clean_motions(&program_of(Dialect::MakinoFf, format!("{select}\nGOTO/0,0,0\n")));
        assert!(!found[0].tool.as_ref().is_some_and(|tool| tool.loaded), "{select}");
    }
}

#[test]
fn a_clt_cutter_ends_in_a_comma() {
    let text = "CUTTER/ 6.000000,0.000000,3.000000,1.802582,31.000000,0.000000,118.000000,\nGOTO/ 0,0,0 \n";
    let found = clean_motions(&program_of(Dialect::CamWorks, text));
    assert_eq!(found[0].tool.as_ref().unwrap().data.as_ref().unwrap().length, Some(118.0));
}

#[test]
fn the_name_goes_with_the_tool() {
    // A new number under an old name would let a setup match the wrong tool.
    let text = "TOOL PATH/A,TOOL,D10\nLOAD/TOOL,1\nGOTO/0,0,0\nLOAD/TOOL,2\nGOTO/1,0,0\n";
    let found = clean_motions(&program(text));
    let names: Vec<_> = found.iter().map(|motion| motion.tool.as_ref().unwrap().name.clone()).collect();
    assert_eq!(names, [Some("D10".to_owned()), None]);
}
