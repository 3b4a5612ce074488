//! This module writes a first setup and a first recipe for a program, from what its CL file states. Guesses
//! are marked as such, and most of them are comments.
//!
//! Both files are valid without any change. Lengths and feeds are in the program's unit.

use crate::number::format_trimmed_number;
use crate::program::LengthUnit;
use crate::report::stats::{ProgramStats, ToolStats};
use std::fmt::Write;

/// Lines from which editors know the schemas. `clsmith init` writes these beside the files, under these
/// names.
const RECIPE_SCHEMA: &str = "# yaml-language-server: $schema=clsmith-recipe.schema.json";
const SETUP_SCHEMA: &str = "# yaml-language-server: $schema=clsmith-setup.schema.json";

/// The margin of the proposed stock around the feed motions in x and y, in diameters of the widest tool.
const SIDE_ROOM: f64 = 0.5;

/// Returns a commented setup for a program: machine, stock around its cuts, every tool that moves, and the
/// words that are not known.
pub fn write_starter_setup(stats: &ProgramStats, unknown_words: &[String]) -> String {
    let unit = stats.units.unit;
    let mut out = format!(
        "{SETUP_SCHEMA}\n# What {} does not say. Every key is in configs/README.md; numbers behind # are guesses.\nunits: {}\n\n",
        quote_comment(&stats.file),
        unit_name(unit)
    );
    append_machine(&mut out, stats);
    append_stock(&mut out, stats);
    append_tools(&mut out, stats);
    append_words(&mut out, unknown_words);
    out
}

/// Appends the words that are not known, so that a user can give their meanings.
fn append_words(out: &mut String, unknown_words: &[String]) {
    const MOST_WORDS: usize = 40;
    if unknown_words.is_empty() {
        return;
    }
    out.push_str(
        "\n# Words of the program that are not known. A word may be an operation, operation_end, tool_change, frame,\n\
         # channel, spindle, feed or text. As text nothing is said of it, whatever numbers are in it.\n# words:\n",
    );
    for word in unknown_words.iter().take(MOST_WORDS) {
        let _ = writeln!(out, "#   {}: text", quote_yaml(word));
    }
}

/// Returns a commented recipe for a program. `setup_file` is the name of its setup file.
pub fn write_starter_recipe(stats: &ProgramStats, setup_file: &str) -> String {
    let unit = stats.units.unit;
    let mut out = format!(
        "{RECIPE_SCHEMA}\n# A first recipe for {}. `clsmith transforms` tells every step.\nversion: 1\nunits: {}\nsetup_file: {}\n\
         # The stock in the setup is a guess. Take this line away once it is right: then rapids through it stop the run.\n\
         simulate: false\nsteps:\n",
        quote_comment(&stats.file),
        unit_name(unit),
        quote_yaml(setup_file)
    );
    out.push_str("  # Ramps and leads into the material run at half the feed.\n");
    out.push_str("  - scale_feed: { factor: 0.5, where: { motions: [engage], required: false } }\n");
    append_operations(&mut out, stats);
    if let Some(feed) = stats.feed {
        let _ = writeln!(
            out,
            "\n  # Feeds of the program: {} to {} {}/min.\n  # - clamp_feed: {{ max: {} }}",
            number(feed.min),
            number(feed.max),
            unit_name(unit),
            number(feed.max)
        );
    }
    let target = match unit {
        LengthUnit::Mm => "0.05",
        LengthUnit::Inch => "0.002",
    };
    let _ = writeln!(
        out,
        "\n  # The feed of every block from the chip that it really cuts, in {}; needs stock and teeth in the setup.\n  # - optimize_feed: {{ target: {target} }}",
        unit_name(unit)
    );
    out
}

fn append_machine(out: &mut String, stats: &ProgramStats) {
    let [feed, rapid, acceleration] = match stats.units.unit {
        LengthUnit::Mm => [10_000.0, 20_000.0, 60_000.0],
        LengthUnit::Inch => [400.0, 800.0, 2_400.0],
    };
    let unit = unit_name(stats.units.unit);
    out.push_str("machine:\n");
    if let Some(programmed) = stats.feed {
        let _ =
            writeln!(out, "  # The fastest feed of the program is {} {unit}/min.", number(programmed.max));
    }
    if let Some(speed) = stats.spindle_rpm.filter(|speed| speed.max.is_finite()) {
        let _ =
            writeln!(out, "  # The spindle turns at {} to {} rev/min.", number(speed.min), number(speed.max));
    }
    let _ = writeln!(out, "  # max_feed: {}            # {unit}/min", number(feed));
    let _ = writeln!(out, "  # max_acceleration: {}    # ({unit}/min)/s", number(acceleration));
    let _ = writeln!(
        out,
        "  rapid_feed: {}            # {unit}/min; a guess: put your machine's\n",
        number(rapid)
    );
}

fn append_stock(out: &mut String, stats: &ProgramStats) {
    let Some(bounds) = &stats.box_of_feed else {
        out.push_str("# stock: { block: { from: [0, 0, -20], to: [100, 100, 0] } }\n\n");
        return;
    };
    let widest = stats.tools.iter().filter_map(|tool| tool.diameter).fold(0.0, f64::max);
    let room = (SIDE_ROOM * widest).max(0.0);
    let from = [bounds.min[0] - room, bounds.min[1] - room, bounds.min[2]];
    let to = [bounds.max[0] + room, bounds.max[1] + room, bounds.max[2]];
    let point = |point: [f64; 3]| point.map(number).join(", ");
    let _ = writeln!(
        out,
        "# A guess: the box of all feed motions ([{}] to [{}]) with half a diameter around.\nstock: {{ block: {{ from: [{}], to: [{}] }} }}\n",
        point(bounds.min),
        point(bounds.max),
        point(from),
        // A block needs an extent in every direction, even if all motions are in one plane.
        point([to[0].max(from[0] + 1.0), to[1].max(from[1] + 1.0), to[2].max(from[2] + 1.0)])
    );
}

fn append_tools(out: &mut String, stats: &ProgramStats) {
    if stats.tools.is_empty() {
        out.push_str("# tools: [ { match: { number: 1 }, diameter: 10, teeth: 4 } ]\n");
        return;
    }
    out.push_str("tools:\n");
    for tool in &stats.tools {
        append_tool(out, tool);
    }
}

fn append_tool(out: &mut String, tool: &ToolStats) {
    let matched = match (tool.number, &tool.name) {
        (Some(number), _) => format!("{{ number: {number} }}"),
        (None, Some(name)) => format!("{{ name: {} }}", quote_yaml(&escape_glob(name))),
        (None, None) => "{}".to_owned(),
    };
    let _ = write!(out, "  - match: {matched}");
    if let (Some(_), Some(name)) = (tool.number, &tool.name) {
        let _ = write!(out, "    # {}", quote_comment(name));
    }
    out.push('\n');
    let told = [
        ("diameter", tool.diameter),
        ("corner_radius", tool.corner_radius),
        ("taper", tool.taper_degrees.filter(|taper| *taper != 0.0)),
        ("tip", tool.tip_degrees.filter(|tip| *tip != 0.0)),
        ("flute_length", tool.flute_length),
    ];
    for (key, value) in told {
        match value {
            Some(value) => {
                let _ = writeln!(out, "    # {key}: {}    # the CL file says it", number(value));
            }
            None if matches!(key, "diameter" | "flute_length") => {
                let _ = writeln!(out, "    # {key}: ...    # the CL file does not say it");
            }
            None => {}
        }
    }
    out.push_str("    teeth: 2    # a guess: count them; chip thickness and optimize_feed depend on it\n");
}

fn append_operations(out: &mut String, stats: &ProgramStats) {
    let named: Vec<_> = stats.operations.iter().filter(|operation| !operation.name.is_empty()).collect();
    if named.is_empty() {
        return;
    }
    out.push_str("\n  # One operation alone, by its name (* and ? are wildcards):\n");
    for operation in named {
        let feeds = operation.feed.map_or_else(String::new, |feed| {
            format!("    # feeds {} to {}", number(feed.min), number(feed.max))
        });
        let name = quote_yaml(&escape_glob(&operation.name));
        let _ =
            writeln!(out, "  # - scale_feed: {{ factor: 0.8, where: {{ operations: [{name}] }} }}{feeds}");
    }
}

fn unit_name(unit: LengthUnit) -> &'static str {
    match unit {
        LengthUnit::Mm => "mm",
        LengthUnit::Inch => "inch",
    }
}

fn number(value: f64) -> String {
    format_trimmed_number(value, 4)
}

/// Replaces the wildcard characters of a name by `?`, which matches any character.
fn escape_glob(name: &str) -> String {
    name.chars()
        .map(|letter| if matches!(letter, '*' | '[' | ']' | '{' | '}') { '?' } else { letter })
        .collect()
}

/// Returns a text as a YAML scalar in double quotes. A string of JSON is one of YAML as well.
fn quote_yaml(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// Returns a text without control characters, because a line break would end the comment.
fn quote_comment(text: &str) -> String {
    text.chars().map(|letter| if letter.is_control() { ' ' } else { letter }).collect()
}
