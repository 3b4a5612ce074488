//! Codes of simulation (`CL05xx`): what it needs to know, and what it found.

super::area! {
    TOOL_SHAPE = "CL0501", Error, "a tool whose shape is not known, or cannot be",
        "Describe the tool under `tools:` in the recipe's `setup:`, or in a setup file.",
        "A simulation needs the shape of every tool that cuts. It takes what the CL file says (NX `TLDATA`, `CUTTER`), \
         and an entry of `setup.tools` completes or overrides it:\n\n\
         \x20 setup:\n\
         \x20   tools:\n\
         \x20     - { match: { number: 3 }, diameter: 10, corner_radius: 1, flute_length: 22 }\n\n\
         A diameter is never guessed. Corner radius, taper and angle of the bottom count as 0 when neither file gives them, \
         and a note (CL0505) says so. A shape that cannot be is nearly always a typing mistake or a wrong unit: a \
         corner radius larger than half the diameter, flutes that end below the corner. Lathe tools and wires are no \
         milling cutters; leave their operations to another program.";
    TEETH_MISSING = "CL0502", Error, "the number of teeth of a tool is not known",
        "Add `teeth:` to the tool's entry under `setup.tools`.",
        "Chip thickness and cutting forces are per tooth, and CL data never says how many teeth a cutter has:\n\n\
         \x20 setup:\n\
         \x20   tools:\n\
         \x20     - { match: { number: 3 }, teeth: 4, helix: 30 }\n\n\
         The shape of the tool may still come from the CL file: an entry says only what it wants to add.";
    STOCK_MISSING = "CL0503", Error, "a simulation without stock",
        "Add `stock:` to the recipe's `setup:`, or to a setup file.",
        "What a tool cuts depends on what is there to be cut, and CL data says nothing about it. The stock is a block, \
         a cylinder, an STL file, what an earlier run has left, or several of them together, in the coordinates of the \
         program:\n\n\
         \x20 stock: { block: { from: [0, 0, -30], to: [120, 80, 0] } }\n\
         \x20 stock: { cylinder: { diameter: 60, from: [0, 0, 0], to: [0, 0, 70] } }\n\
         \x20 stock: { stl: casting.stl, allowance: 1.5 }\n\
         \x20 stock: { file: after-op10.clstock }";
    STOCK_FILE = "CL0504", Error, "a stock file that cannot be used",
        "The path is relative to the folder of the file that names it.",
        "The file that `stock:` names cannot be read, or it is no closed solid. An STL file must be watertight: a \
         missing or turned triangle lets the material run out, and a stock with a hole would show air where there is \
         steel. Its numbers are in the unit (`units:`) of the file that names it, for STL itself has none. A .clstock \
         file is one that clsmith has saved.";
    ASSUMPTION = "CL0505", Note, "a simulation that had to assume something",
        "Say it under `setup:` if the assumption is wrong.",
        "Neither the CL file nor the setup says something that the simulation needs, so it takes the usual value: no \
         corner radius, no taper, a flat bottom, flutes as long as the tool, a shank as thick as the cutter, no \
         holder. Most of the time that is right for the path and wrong for collisions. The message lists what was \
         assumed for which tool.";
    MATERIAL_MISSING = "CL0506", Error, "cutting forces without a material",
        "Add `material:` to the recipe's `setup:`, or to a setup file.",
        "Forces are computed from cutting coefficients of the material, but no material is given:\n\n\
         \x20 material: { file: steel-c45.yaml }\n\
         \x20 material: { k_tc: 1900 }\n\n\
         Files for common materials are in `configs/materials`. Their numbers are typical ones from the literature; \
         measured with your own cutter and spindle they may be a third higher or lower.";
    MATERIAL_FILE = "CL0507", Error, "a material file that cannot be read",
        "The path is relative to the folder of the file that names it.",
        "The recipe or setup file names a file with cutting coefficients under `material:`, and this file cannot be \
         read. Relative paths start at the folder of the file that names them, not at the folder that clsmith was \
         started in.";
    MACHINE_FILE = "CL0508", Error, "a machine file that cannot be read",
        "The path is relative to the folder of the file that names it.",
        "The setup names a file under `machine: { file: ... }`: a setup file whose `machine` counts where this one says nothing. \
         It cannot be read, or it names another machine file in turn. Relative paths start at the folder of the file that \
         names them. Files for common machines are in `configs/machines`.";
    RAPID_THROUGH_STOCK = "CL0510", Error, "a rapid goes through material",
        "Lift the rapid or make it a feed move; or correct the stock, if there is nothing there.",
        "In the simulation a rapid motion removes material: on the machine that is a crash at full speed. Where the stock in the setup is larger than the part in the vise, say it as it is (an earlier operation's result can be saved with \
         `--save-stock` and given as `stock: { file: ... }`). Less than a cell's cube is not reported.";
    COLLISION = "CL0511", Error, "shank or holder in material",
        "Take a longer tool, or describe flutes, shank and holder as they are under `setup.tools`.",
        "What stands above the flutes does not cut. On this motion it stands in material that is still there at that moment, so it \
         would be pushed into it. Depth is measured along the tool, and less than half a tenth or a cell does not count. \
         Flutes of unknown length are taken from the CL data's tool length, or as four diameters.";
    PILLAR = "CL0540", Warning, "the middle of an indexable cutter runs into material",
        "Let `correct_ramp` make the ramp shallower with `limit: survivable`, enter over a drilled hole, or take a cutter that cuts in its middle.",
        "An indexable cutter (an entry under `tools:` with an `insert`) does not cut within its diameter less twice the radius of its inserts: \
         D - 2r. On a descent a pillar stays there until the inserts on the other side pass over it. It may be as high as an insert cuts, h; \
         what is higher meets the body of the cutter. The message names the place, the pillar's height above the tip and what is left over \
         by the inserts. Straight on, a ramp of the angle a leaves (D - 2r) tan a, but where it turns back, by 180 degrees, 2 (D - 2r) tan a: \
         a ramp that keeps the limit of Zhou (2020) may touch. The material stays, and the simulation goes on. \
         Less than 0.01 mm does not count.";
    SPINDLE_STANDS = "CL0512", Error, "cutting while the spindle does not turn",
        "Put a SPINDL record before the first cut, or a `rewrite` step that does.",
        "The tool removes material, and no SPINDL with a speed and a sense is in force, or the last one switched it off. A milling \
         cutter that does not turn breaks. It is also what a speed in metres a minute looks like to a simulation: chip thickness \
         needs revolutions a minute.";
    CELL_TOO_COARSE = "CL0513", Error, "a cell that is too coarse for a cutter",
        "Take the cell that the message names, or none: then clsmith chooses.",
        "The simulation knows where material ends to half a cell. With fewer than ten cells across a cutter the thickness of its \
         chips would be a guess, and a feed made from it a gamble.";
    TOO_MUCH = "CL0514", Error, "a simulation that takes too much memory or time",
        "Take the coarser cell that the message names, or a stock that is no larger than the part.",
        "Before it begins, the simulation knows how many columns the stock has (8 bytes each) and about how often they are looked \
         at. Halving the cell makes both four times as much.";
    BELOW_MINIMUM = "CL0515", Warning, "a target that the lowest feed allowed does not keep",
        "Lower `min_feed`, or change the path so that less is cut at once.",
        "On this motion the load passes the target even at the lowest feed that the step may write. The lowest feed is written, \
         because a cutter that rubs at a crawl is not better off; the report shows by how much the target is passed.";
    FEED_UNKNOWN = "CL0516", Error, "a cut whose feed or spindle speed cannot be known",
        "Say the feed in mm/min or inch/min, and the spindle speed in rev/min.",
        "Chip thickness is feed over revolutions. This motion cuts, but no FEDRAT is in force before it, its feed is per revolution \
         and the spindle speed is not in rev/min, or the speed is a cutting speed in metres a minute, which the machine turns into \
         revolutions by a diameter that CL data does not say.";
    TARGET_EXCEEDED = "CL0517", Error, "the corrected program passes the target",
        "Look at the motions that the message names; a finer `cell` or a `split` may help.",
        "After the feeds were written, the corrected program was simulated again, and a motion that the step may change loads the \
         cutter more than the target by more than the simulation's own uncertainty. Nothing is written.";
    GOUGE = "CL0518", Error, "the part that shall be is cut into",
        "Look at the place that the message names; where the difference is wanted, give `--tolerance`.",
        "After the program, material is missing that the target part has, further from what is left than the tolerance. Either a motion \
         goes too deep, or target and program do not stand in the same coordinates or unit: then everything is far off. Thickness is \
         measured along z, so a wall that is a little too far in appears with its whole height. The target's surface is as exact \
         as its triangles: a chord tolerance of the STL that is coarser than `--tolerance` appears as a gouge.";
    NO_FLAT_MILL = "CL0520", Warning, "a tool whose chips in layers cannot be modelled",
        "Simulate it with `clsmith simulate`; or say its shape under `setup.tools`, if it is a flat end mill after all.",
        "`clsmith chips` knows the section of a layer with a cylinder that ends in a flat disc: an ellipse, cut off by a chord. \
         A corner radius, a ball, a taper or a drill's point has other sections, and none of them is guessed: the tool's motions are \
         left out. What they would remove stays in the workpiece, so chips of flat end mills that come after them may be \
         too large.";
    CHIP_REFUSED = "CL0521", Warning, "a motion whose chip cannot be modelled",
        "Look at the axis of this point and of the one before it.",
        "A layer cuts a cylinder in an ellipse as long as the diameter divided by the cosine of the axis' angle to z. Near 90 degrees it \
         has no end, so `clsmith chips` stops at 80 degrees; and where an axis turns by half a turn between two points, nobody can \
         tell which way. The motion is left out: what it would remove stays in the workpiece and is part of later chips, if any. \
         Motions that cannot reach the stock are not reported. For a part that is milled from its side, write the program in coordinates whose z \
         stands along most of the axes (`move_origin`).";
    STILL_MOTION = "CL0522", Note, "a motion that goes nowhere",
        "Delete the repeated point, or leave it: it cuts nothing.",
        "This point has the place and the axis of the one before it. Nothing moves, so there is no chip and no direction that \
         engagement could be measured from. CAM systems write such points between operations; in the middle of a \
         cut they stop some controls for a moment and leave a mark.";
    LAYERS = "CL0523", Error, "stock that cannot be cut into such layers",
        "Stock in layers is a block, a cylinder or a closed STL without allowance, at least as high as one layer.",
        "The workpiece is a stack of layers of equal thickness, from its lowest to its highest point; each is the section of the stock at the \
         layer's middle. A layer must be thinner than the stock is high, there must not be more of them than memory can hold, and the \
         section must consist of closed borders.";
    NO_MOTION_ASKED = "CL0524", Error, "lines without a motion",
        "Give lines that GOTO records stand on; `clsmith chips` without `--lines` reports all.",
        "`--lines A..B` asks for the motions that end on lines A to B of the file, both included. None does: they are beyond the \
         end of the file, or hold other records only. A motion counts by the line on which the statement that ends it begins.";
    NO_SUCH_LAYER = "CL0525", Error, "a height at which there is nothing to draw",
        "Give a height inside a layer that one of the moves cuts; the JSON and the CSV list them.",
        "`--at Z` chooses the layer that a picture shows by a height in mm, in the coordinates of the stock. None of the moves that are asked \
         for removes anything on the layer with this height, or the stock has no layer there.";
    NOT_IN_LAYERS = "CL0526", Error, "a motion whose engagement layers cannot compute",
        "Leave out `engagement: layers`: the columns know every cutter and every axis.",
        "With `engagement: layers` feeds are made from the exact chips of flat end mills, layer by layer. A tool with a corner radius, a ball, \
         a taper or a point has no such chip, nor has a motion whose axis is more than 80 degrees from z or turns by half a turn. Nothing \
         is guessed: without the engagement of one motion, its feed and what it leaves for later motions would both be wrong, so \
         the step stops.";
    TILTED_UNDERCUT = "CL0529", Error, "a dovetail, T-slot cutter or lollipop whose axis is tilted",
        "Give the tool without `dovetail_angle` and `upper_corner_radius`: more is removed then than in truth.",
        "What an upright cutter leaves standing above its widest place is computed exactly; for a tilted one it is not, and what it \
         removes would be a guess.";
    RESULT_NOT_SIMULATED = "CL0530", Warning, "a corrected program that could not be simulated",
        "Describe what the message names under `setup:`, or write `simulate: false` at the top of the recipe.",
        "Where the setup has a stock, `apply`, `hook`, `watch` and `batch` simulate the corrected program before they write it: a rapid \
         through the stock, a collision or a standing spindle stops the run, whichever outputs are asked for. This program could not be \
         simulated, so none of that is known of it.";
    NOT_CERTIFIED = "CL0531", Warning, "chips that are bounded by columns alone",
        "Do what the message says, or take a target that leaves room for what columns miss.",
        "`optimize_feed` bounds the largest chip of a block from the motions themselves, without a grid. That needs coordinates within a \
         kilometre, and tools that are nowhere narrower above their widest place: no dovetails, T-slot cutters and lollipops, and no inserts that leave a middle uncut. For others \
         the bound comes from columns, which miss slivers and ridges that are thinner than the columns are apart.";
    PASSED_BY_WINDOW = "CL0534", Warning, "a target that the paper's window passes",
        "Leave out `window: half_blocks`; then no block passes its target.",
        "With `window: half_blocks` the feed at a point follows from the halves of the blocks on both sides of it, as in the paper, so the \
         first half of a block runs at the feed of the block before it. Where the load jumps from one block to the next, it passes \
         the target there.";
    BOUND_REFUTED = "CL0533", Error, "a chip that is thicker than its certified bound",
        "Send the program to the makers of clsmith: this is a defect of clsmith. `engagement: columns` goes on without the bound.",
        "After the feeds were written, points of every block are tried by code of its own: whether they lie in the stock, and in no \
         earlier sweep. One of them cuts a thicker chip than the bound from which its feed was made, so the bound is wrong.";
    WIDE_BOUND = "CL0532", Note, "bounds that are wider than they could be",
        "Leave it, or divide the motions; the feeds are safe.",
        "The search for the largest chip of a block ends when its interval is as narrow as half a percent, or when its budget is used. Then the \
         upper end of the wider interval counts: no chip is thicker, but the feed may be lower than it had to be.";
    TOO_MANY_PIECES = "CL0535", Error, "a motion that would be cut into far too many pieces",
        "Look at the motion: a helix of so many turns, or a point so far away, is mostly a slip in the export. Divide it if it \
         is meant, or take coarser columns, layers of a larger tolerance or longer pieces.",
        "Motions are simulated in straight pieces, no further from a curve than a fiftieth of a column. A motion may have 100,000 of them: \
         they take about a gigabyte. A helix whose height was written without its decimal point has turns without end. It is told before \
         the simulation begins, and nothing is simulated.";
    PIECE_LIMIT = "CL0527", Warning, "a motion that is divided less finely than its tolerance asks for",
        "Look at the motion: a spline with a point far away is mostly a slip in the export.",
        "Splines are simulated as short straight pieces, no further from the curve than a fiftieth of a column. A spline gets 256 of them at \
         most between two of its knots. The motion is simulated all the same, with longer pieces. A motion that would need more than \
         100,000 is refused (CL0535).";
}
