//! Codes of machines (`CL07xx`): what their axes cannot do.

super::area! {
    MACHINE_WITHOUT_AXES = "CL0700", Error, "a machine whose axes are not described",
        "List its axes under `machine: { table: [...], head: [...] }` in the setup, or name a file: `machine: { file: ... }`.",
        "What the axes of a machine do follows from where they lie, and neither CL data nor the other keys of the machine say that. Files \
         for common machines are in `configs/machines`; copy one and put your own numbers in.";
    TIMING_LOG = "CL0710", Error, "a log of timed blocks that cannot be read",
        "Give a head with the columns that the row needs, and numbers above 0.",
        "`clsmith setup measure-time` reads CSV with a head and `#` before comments. A row with `corner_deg` is a corner, with \
         `feed_mm_min` and the time `lost_s`; one with `axis` a rapid of that axis from rest to rest, with `length_mm` and `seconds`; \
         any other a straight motion from rest to rest, with `length_mm`, `feed_mm_min` and `seconds`.";
    AXIS_UNREACHABLE = "CL0701", Error, "a tool axis that the machine cannot reach",
        "Tilt the operation less, clamp the part in another way, or take another machine.",
        "Two rotary axes reach directions up to an angle that their own directions give: a nutating head at 45 degrees goes no further \
         than lying flat, one rotary axis makes a single cone. No values of the axes give the tool this axis, whatever their limits.";
    ROTARY_LIMIT_EXCEEDED = "CL0702", Error, "a rotary axis beyond its limit",
        "Tilt the operation less, turn the part on the table, or correct `limits` in the setup's machine.",
        "Of all ways through the program, with both branches of the rotary axes and all their turns, clsmith takes the one with the \
         fewest values outside the limits. On this motion none is inside, so no post can find one either.";
    TRAVEL_EXCEEDED = "CL0703", Error, "a linear axis beyond its travel",
        "Clamp the part nearer to the middle, take a shorter tool, or correct `limits` in the setup's machine.",
        "The tip and the axis of this point, put on the machine, ask more of a linear axis than its limits. With rotary axes the travel \
         depends on where the part stands to them: `point` in the setup is told from the zero of the workpiece.";
    NEAR_POLE = "CL0704", Warning, "a motion near the pole of the machine",
        "Tilt the whole operation by some degrees, so that it stays away from the pole, or lower the feed here.",
        "Where the tool lies along the first rotary axis, this axis is free; near it, a small change of the tool axis turns it far. The \
         control slows down until the axis follows, the tool stands and rubs, and marks stay in the surface.";
    ROTARY_FLIP = "CL0705", Warning, "a rotary axis that changes to the other side of the pole",
        "Look at the motion: in a cut, tilt the operation so that it stays on one side.",
        "Every tool axis can be reached with the second rotary axis on either side of the pole. Here the shortest way through the program \
         changes the side: through the pole, which is harmless where the tool just tips over, or by half a turn of the first axis.";
    REWIND_IN_CUT = "CL0706", Warning, "a rotary axis that has to go back in a cut",
        "Divide the cut by a retract and an approach, so that the axis goes back in the air.",
        "The program winds further than the limits of a rotary axis allow, so the axis goes back by a turn. It does so between two points \
         of a cut: with control of the tip the tool runs around the part in the meantime, without, straight through it.";
    REWIND_IN_AIR = "CL0707", Note, "a rotary axis that goes back at rapid",
        "Nothing has to be done where the way is free.",
        "The program winds further than the limits of a rotary axis allow, so the axis goes back by a turn, here in a rapid. On the way \
         the part turns below the tool, so the retract must be high enough.";
    TIP_ERROR = "CL0708", Warning, "a tip that leaves its line between two points",
        "Put in more points (a smaller tolerance in the CAM system), or run the program with control of the tip (TCP).",
        "Without control of the tip all axes run evenly from one point to the next, and the tip makes a curve between them. For a step \
         of the angle `a` about an axis at the distance `r` it leaves the line by about `r a2 / 8`: 0.19 mm for 5 degrees at 200 mm. What is \
         allowed is `tip_tolerance` in the setup's machine, 0.01 mm when it is left out; `tcp: false` says that there is no control.";
    AXIS_SWING = "CL0712", Warning, "a tool axis that leaves the shortest turn between two points",
        "Put in more points (a smaller tolerance in the CAM system), or tilt the operation away from the pole.",
        "With control of the tip (TCP) the tip stays on its line, but the rotary axes turn evenly from one point to the next, so that \
         the tool axis goes over a cone and not the shortest way. The nearer to the pole and the larger the step, the further it swings aside, \
         and the flank of the tool and the holder with it. What is allowed is `tip_tolerance` in the setup's machine, 20 mm above the tip. \
         Without control of the tip, CL0708 says how far the tip itself is off.";
    TRUE_PATH = "CL0711", Note, "a simulation on the path of the machine",
        "Nothing has to be done; `linearize` puts in points where the path is too far from its line.",
        "Between two points the machine turns its rotary axes evenly. Without control of the tip (`tcp: false`) its linear axes run evenly, \
         too, so that the tip leaves its line; with it, the tip stays there and the tool axis goes over the cone that the rotary axes make. \
         Simulation, chips, certified engagement and drawings follow that path in straight pieces, as near to it as to arcs. Arcs and splines \
         on which rotary axes turn, and poses that the machine cannot reach, are taken as they are programmed.";
    AXIS_TOO_SLOW = "CL0709", Warning, "a feed that an axis cannot follow",
        "Lower the feed of this motion to what the message says, or put the points further apart.",
        "At the programmed feed of the tip an axis would have to move faster than its `max_speed`. The control slows down without a word, \
         so that chips are thinner and times longer than programmed.";
}
