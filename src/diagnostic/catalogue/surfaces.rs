//! Codes of programs made over surfaces (`CL06xx`).

super::area! {
    SURFACE_OPTION = "CL0601", Error, "an option of `section` that is missing or cannot be",
        "`clsmith section --help` shows every option with its unit.",
        "A program over a surface needs the planes (`--plane zx`, `yz` or an angle in degrees from x), their distance (`--step`), the \
         ball's radius, the tolerance and the feed. Lengths are in the unit of `--units` (mm unless it says inch), radius, step, \
         tolerance and feeds are greater than 0. The place that is shown is the option in the command line.";
    MODEL_FILE = "CL0602", Error, "a model that cannot be gone over",
        "The file must be a closed STL; its numbers are in the unit of `--units`.",
        "The STL file cannot be read, has no triangle, or is not closed. A mesh with a hole has no inside, so it is undefined where its \
         top is and what a cutter would gouge. Most CAM and mesh programs have a command that closes holes and turns triangles that \
         face the wrong way.";
    NOTHING_TO_SURFACE = "CL0603", Error, "no plane has anything to go over",
        "Compare `--from`, `--to` and `--floor` with the part.",
        "None of the planes meets the part where the tip may go. Planes along zx are counted by y, along yz by x, and at an angle by the \
         distance to the left of their direction. Where the tip would have to go below the floor (the lowest place of the part \
         unless `--floor` says another), passes end.";
    NOT_WITHIN_TOLERANCE = "CL0604", Error, "passes that are farther from the part than the tolerance",
        "Of a part that is not the same in all planes, make heights over the whole mesh: `--against mesh`.",
        "After the program was made, every pass was measured again by another method: distances of the ball from the profile's or the \
         mesh's own points, which know nothing of how the passes came about. The deepest gouge or the largest gap is more than \
         `--tolerance`, so nothing is written. With `--against profile` that is what happens on a part that is not the same in all \
         planes: the ball touches beside the plane first, and gouges there (`--allow CL0604` writes it all the same). Otherwise please \
         report it.";
    TOLERANCE_TOO_FINE = "CL0605", Error, "a tolerance finer than the dialect's decimals",
        "Take a tolerance of ten last decimals or more, or a dialect with more decimals (Creo has ten).",
        "NX writes coordinates with four decimals, CATIA with five: rounding alone moves every point by up to half of the last one. A \
         path that is to keep its tolerance as printed needs room for that, and for chords longer than a rounding.";
    NOT_READ_BACK = "CL0606", Error, "a program that does not read back as it was meant",
        "Look at the names that were given for the operation, the tool and the part; otherwise please report it.",
        "Before a new program is written, it is read back and compared motion by motion with what was meant: end points, rapids, feeds, \
         arcs. Something is different, so nothing is written. A name with a comma or a dollar sign would do that, for instance.";
    NOT_REACHED = "CL0607", Warning, "places of the profile that the ball does not touch",
        "Take a smaller ball for these places, or finish them with another tool.",
        "A ball does not get into corners and hollows that are tighter than its radius, nor below overhangs. What is left there is told \
         as a distance from the ball where it comes nearest. The path is right all the same: it touches on both sides and gouges nothing.";
    SECTION_WITHOUT_SPINDLE = "CL0608", Warning, "a program made without a spindle speed",
        "Give `--spindle 8000`, or see to it that the post or the operator switches the spindle on.",
        "The program that `section` writes has a SPINDL record only where `--spindle` says a speed. Without it the tool would cut with a \
         standing spindle, unless the post or an earlier operation has switched it on.";
}
