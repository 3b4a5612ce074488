//! Codes of cutting forces and materials (`CL08xx`).

super::area! {
    NO_FORCES_THERE = "CL0801", Error, "forces that are asked for where there are none to find",
        "Ask for the line of a GOTO at feed, of a tool with `teeth`, as the first column of `simulate --csv` tells it.",
        "`--tooth-period LINE`, `--edges LINE[..LINE]` and `--forces-along` need a motion at feed whose feed, spindle speed and teeth are known, a stock of blocks, \
         cylinders, closed meshes or what another program left, and a tool that is nowhere narrower above its widest place and cuts to its middle. One drawing holds 24 maps of edges.";
    OUTSIDE_MEASURED = "CL0802", Warning, "cuts outside the range in which the material was measured",
        "Measure cuts like these and calibrate again, or leave more room below your limits.",
        "A material file tells in `ranges:` with which chips, cutting speeds and depths its numbers were found. This program cuts thicker or \
         thinner chips, faster, slower or deeper. Coefficients change with all of these, so its forces are an extrapolation.";
    MEASURED_FORCES = "CL0803", Error, "measured forces that cannot be used",
        "`clsmith calibrate --help` lists the columns.",
        "A table of measured means is CSV with a head. Every column has its unit in its name (`fx_mean_N`, `power_kW`), every row says which \
         motions it is about (`line`, `line_from` and `line_to`, `operation`), and these motions cut at a known feed, with a tool whose \
         teeth are known. The fit is linear in the coefficients: rows of one chip thickness tell one number a direction.";
    NOT_SEPARABLE = "CL0804", Warning, "coefficients that measured rows do not tell apart",
        "Measure cuts of several feeds per tooth; depths alone scale everything.",
        "Where every row has the same chips, the force of the chip and that of the edge grow together, and no fit can tell which is which. \
         `--edge keep` takes the edge terms of the setup's material and fits the rest; `--edge one-number` fits one number a direction, \
         which holds for such chips alone. A direction that was not measured stays as the setup has it.";
    OUTLIER = "CL0805", Warning, "a measured row that does not fit the others",
        "Look at the row: a wrong line, a sign, a cut that was not steady.",
        "Without this row the fit explains the others well, and this one not at all. It was left out of the coefficients, and the table \
         of residuals still shows it.";
    LIKELY_VIBRATION = "CL0806", Warning, "a cut that takes more power than its mean force explains",
        "Listen to the cut: chatter costs power, and leaves the mean force as it is.",
        "The mean force of the row fits the others, its power is far above what such a force needs. Vibration, a worn bearing, or coolant \
         on the spindle do that. The forces of the row are in the fit; its power is not.";
    STIFFNESS_MISSING = "CL0807", Error, "how stiff a tool is is not known",
        "Add `stick_out`, `tool_material` and, where the tool is longer than its flutes, `shank` to the tool's entry under `setup.tools`.",
        "How far a tool bends, and with what stress, depends on how far it stands out of its holder, how thick it is there, and what it is \
         made of; CL data says none of it:\n\n\
         \x20 setup:\n\
         \x20   tools:\n\
         \x20     - { match: { number: 3 }, flute_length: 22, shank: { diameter: 10, length: 60 }, stick_out: 45, tool_material: carbide }\n\n\
         A stepped shank is a list, from the flutes upwards: `shank: [ { diameter: 9.5, length: 40 }, { diameter: 12, length: 80 } ]`. All \
         lengths count from the tip. The flutes bend like a cylinder of 80 % of their diameter unless `flute_diameter_factor` says otherwise.";
    FIT_ERROR_MISSING = "CL0808", Error, "a margin from the error of a fit that the material does not have",
        "Calibrate the material with `clsmith calibrate`, or leave out `fit_error_margin`.",
        "`fit_error_margin` lowers the limits of forces by what the measured cuts differed from the law. A file that `clsmith calibrate` \
         wrote tells that as `residual`; numbers from a table or a paper do not, and then no margin is right.";
    SEVERAL_TOOLS = "CL0809", Warning, "measured cuts of several tools in one fit",
        "Make a table of rows for each tool, and calibrate each on its own.",
        "Coefficients are those of a material and an edge: another rake, rounding or state of wear has others. The fit over several tools is \
         their mean, and none of them may cut with such forces.";
}
