//! These tests check that all outputs are made from one list of columns.

use super::*;
use crate::program::LengthUnit;

struct Cut {
    operation: String,
    line: usize,
    length_mm: f64,
    feeds: Option<[f64; 2]>,
    seconds: f64,
    chip: Option<(f64, usize)>,
    arcs: Vec<[f64; 2]>,
}

fn columns() -> Vec<Column<Cut>> {
    vec![
        Column::new("operation", ColumnUnit::None, |cut: &Cut| TableValue::text(&cut.operation))
            .left_aligned(),
        Column::new("line", ColumnUnit::None, |cut: &Cut| cut.line.into()).only_in_csv(),
        Column::new("length", ColumnUnit::Length, |cut: &Cut| cut.length_mm.into())
            .titled("at feed")
            .decimals(1),
        Column::new("feed", ColumnUnit::FeedPerMinute, |cut: &Cut| {
            cut.feeds.map_or(TableValue::Missing, TableValue::Range)
        }),
        Column::new("feed_time", ColumnUnit::Duration, |cut: &Cut| TableValue::Duration {
            seconds: cut.seconds,
            is_lower_bound: cut.feeds.is_none(),
        })
        .titled("time")
        .old_json_key("feed_seconds"),
        Column::new("chip_thickness", ColumnUnit::Length, |cut: &Cut| match cut.chip {
            Some((value, line)) => TableValue::Peak { value, place: PeakPlace::Line(Some(line)) },
            None => TableValue::Missing,
        })
        .titled("chip")
        .worded_as("thickest chip", 3)
        .decimals(3),
        Column::new("arcs", ColumnUnit::Angle, |cut: &Cut| TableValue::Intervals(&cut.arcs)),
    ]
}

fn cuts() -> [Cut; 2] {
    [
        Cut {
            operation: "ROUGH|1".to_owned(),
            line: 7,
            length_mm: 1270.0,
            feeds: Some([254.0, 508.0]),
            seconds: 75.0,
            chip: Some((0.127, 9)),
            arcs: vec![[0.0, 90.0], [180.0, 200.12345678]],
        },
        Cut {
            operation: "b, c".to_owned(),
            line: 8,
            length_mm: 0.1 + 0.2,
            feeds: None,
            seconds: 2.0,
            chip: None,
            arcs: Vec::new(),
        },
    ]
}

fn csv(units: DisplayUnits) -> String {
    let mut out = Vec::new();
    let mut table = CsvTable::begin(&columns(), units, &mut out).unwrap();
    cuts().iter().for_each(|cut| table.write_row(cut).unwrap());
    table.finish().unwrap();
    String::from_utf8(out).unwrap()
}

fn json(units: DisplayUnits, numbers: RecordNumbers) -> String {
    let columns = JsonColumns::new(&columns(), units, numbers);
    let text =
        cuts().iter().map(|cut| serde_json::to_string(&columns.object(cut)).unwrap()).collect::<Vec<_>>();
    text.join("\n")
}

const PEOPLE: [&str; 5] = ["operation", "length", "feed", "feed_time", "chip_thickness"];

fn printed(looks: TableLooks) -> PrintedTable {
    PrintedTable::from_rows(&pick_columns(&columns(), &PEOPLE), &cuts(), looks)
}

const INCH: DisplayUnits = DisplayUnits { values_in: LengthUnit::Mm, shown_in: LengthUnit::Inch };

#[test]
fn csv_has_heads_with_units_and_empty_cells() {
    let lines = [
        "operation,line,length_mm,feed_mm_min,feed_time_s,chip_thickness_mm,arcs_deg",
        "ROUGH|1,7,1270.0,254 508,75.0,0.127,0 90; 180 200.123457",
        "\"b, c\",8,0.3,,2.0,,",
        "",
    ];
    assert_eq!(csv(DisplayUnits::MM), lines.join("\n"));
    let lines = [
        "operation,line,length_in,feed_in_min,feed_time_s,chip_thickness_in,arcs_deg",
        "ROUGH|1,7,50.0,10 20,75.0,0.005,0 90; 180 200.123457",
        "\"b, c\",8,0.011811,,2.0,,",
        "",
    ];
    assert_eq!(csv(INCH), lines.join("\n"));
}

#[test]
fn json_has_keys_with_units() {
    let lines = [
        "{\"operation\":\"ROUGH|1\",\"length_mm\":1270.0,\"feed_mm_min\":{\"min\":254.0,\"max\":508.0},\
         \"feed_seconds\":75.0,\"chip_thickness_mm\":{\"value\":0.127,\"line\":9},\
         \"arcs_deg\":[[0.0,90.0],[180.0,200.123457]]}",
        "{\"operation\":\"b, c\",\"length_mm\":0.3,\"feed_mm_min\":null,\
         \"feed_seconds\":2.0,\"chip_thickness_mm\":null,\"arcs_deg\":[]}",
    ];
    assert_eq!(json(DisplayUnits::MM, RecordNumbers::Rounded), lines.join("\n"));
    let inch = json(INCH, RecordNumbers::Rounded);
    assert!(inch.contains("\"length_in\":50.0"), "{inch}");
    assert!(inch.contains("\"chip_thickness_in\":{\"value\":0.005"), "{inch}");
    assert!(json(DisplayUnits::MM, RecordNumbers::Exact).contains("0.30000000000000004"));
}

#[test]
fn people_read_text_markdown_and_html() {
    let lines = [
        "  operation  at feed, mm  feed, mm/min     time  chip, mm",
        "  ROUGH|1        1,270.0    254 .. 508     1:15     0.127",
        "  b, c               0.3             -  > 2.0 s         -",
        "",
    ];
    assert_eq!(printed(TableLooks::plain(DisplayUnits::MM)).to_text(), lines.join("\n"));
    let inch = printed(TableLooks::plain(INCH)).keep_rows(1).to_text();
    assert!(inch.contains("at feed, in") && inch.contains("50.00") && inch.contains("10 .. 20"), "{inch}");
    assert!(inch.ends_with("  and 1 more\n"), "{inch}");
    let markup = printed(TableLooks::markup(DisplayUnits::MM));
    let lines = [
        "| operation | at feed, mm | feed, mm/min | time | chip, mm |",
        "| --- | ---: | ---: | ---: | ---: |",
        "| ROUGH\\|1 | 1,270.0 | 254 to 508 | 1:15 | 0.127 |",
        "| b, c | 0.3 |  | \\> 2.0 s |  |",
        "",
        "",
    ];
    assert_eq!(markup.to_markdown(), lines.join("\n"));
    let mut html = Vec::new();
    markup.write_html(&mut html).unwrap();
    let html = String::from_utf8(html).unwrap();
    assert!(html.contains("<th>operation</th><th class=\"n\">at feed, mm</th>"), "{html}");
    assert!(html.contains("<tr><td>b, c</td><td class=\"n\">0.3</td><td class=\"n\"></td>"), "{html}");
}

#[test]
fn figures_stand_side_by_side() {
    let [before, after] = cuts();
    let columns = pick_columns(&columns(), &["length", "feed_time", "chip_thickness"]);
    let looks = TableLooks::markup(DisplayUnits::MM);
    let lines = [
        "|  | before | after | change |",
        "| --- | ---: | ---: | ---: |",
        "| at feed, mm | 1,270.0 | 0.3 | -100.0 % |",
        "| time | 1:15 | \\> 2.0 s | -97.3 % |",
        "| thickest chip, mm | 0.127 |  |  |",
        "",
        "",
    ];
    let table = compare_figures(&columns, Some(&before), Some(&after), looks);
    assert_eq!(table.to_markdown(), lines.join("\n"));
    let lines = ["|  | value |", "| --- | ---: |", "| at feed, mm | 0.3 |", "| time | \\> 2.0 s |", "", ""];
    assert_eq!(list_figures(&columns, Some(&after), looks).to_markdown(), lines.join("\n"));
}

#[test]
fn a_peak_is_told_with_its_place() {
    let [before, after] = cuts();
    let columns = pick_columns(&columns(), &["chip_thickness"]);
    let tell = |cut, units| TableLooks::plain(units).word_peak(&columns[0], cut);
    assert_eq!(tell(&before, DisplayUnits::MM).unwrap(), "thickest chip: 0.127 mm on line 9");
    assert_eq!(tell(&before, INCH).unwrap(), "thickest chip: 0.0050 in on line 9");
    assert_eq!(tell(&after, INCH), None);
}
