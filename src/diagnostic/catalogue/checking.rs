//! Codes of checking (`CL01xx`): what is readable, but not what a program should do.
//!
//! 010x arcs and points, 011x axes, 012x feed and spindle, 013x tools, 014x compensation and cycles, 015x
//! structure, 016x units, 017x text, 018x records that a step has left behind.

super::area! {
    RAPID_WITHOUT_MOTION = "CL0100", Warning, "a RAPID without a motion",
        "Remove the RAPID, or put it directly before the GOTO it was meant for.",
        "RAPID makes the next motion, and only that, a rapid. Here a FEDRAT, a second RAPID or the end of the file comes \
         first. Posts differ: some forget the RAPID at the FEDRAT, others keep it and drive the next GOTO, perhaps into \
         the material, at rapid.";
    ARC_WITHOUT_END = "CL0101", Error, "an arc without an end point",
        "Put the GOTO with the arc's end directly after it, or remove the record.",
        "CIRCLE and MOVARC describe the arc, INDIRV its first direction; the end point comes in the GOTO (in CATIA: the \
         TLON) after it. Here something else follows. A post drops the arc, or applies it to the next point that comes, \
         however far away.";
    ARC_END_OFF_CIRCLE = "CL0102", Error, "the end of an arc is not on its circle",
        "Export the operation again; if the point was edited by hand, correct centre, radius and end point together.",
        "The distance of the end point from the arc's axis is not the radius. Controls compare the two and stop with an \
         alarm beyond some hundredths of a millimetre, or cut a spiral. Most often a point or a centre was edited without \
         the other. Below 0.01 mm the finding is CL0104.";
    ARC_RADIUS_DIFFERS = "CL0103", Error, "the radius of an arc is not the distance of its start from the centre",
        "Compare the printed radius with the point before the arc; one of them was changed.",
        "The record prints a radius, and the tool stands at another distance from the arc's axis when the arc starts. A \
         post that writes R cuts another arc than one that writes I and J. Either the radius or centre was edited, or the \
         point before the arc was moved or lost. Below 0.01 mm the finding is CL0104.";
    ARC_ROUGH = "CL0104", Warning, "the radii of an arc differ by a few thousandths",
        "Export with more decimals, or set the control's circle tolerance to suit.",
        "The distances of the arc's start and end from its axis, or the printed radius, differ by more than rounding to \
         four decimals explains, but by less than 0.01 mm. Controls with a tight circle tolerance refuse such a block.";
    UNKNOWN_START = "CL0105", Error, "an arc, a spline or a GODLTA from an unknown position",
        "Begin with a FROM or GOTO; after a bare GOHOME, GOTO a point before the arc.",
        "An arc and a step (GODLTA) start where the tool is, and no statement before it says where that is: the file starts \
         with it, or a GOHOME without coordinates went before. The machine would start it from wherever it stands. \
         Excerpts of programs have this at their first record.";
    TANGENT_MISMATCH = "CL0106", Error, "the start direction (INDIRV) does not fit the arc",
        "INDIRV is the tangent at the start of the arc; correct it, or export the operation again.",
        "CATIA gives an arc by its start direction, circle and end. Here the direction is not a tangent of the circle, or \
         it leads to the end on the other side of it than `2,INTOF` (more than half a turn) says. The post has to choose \
         one of the two arcs, and one of them gouges.";
    BROKEN_SPLINE = "CL0107", Error, "NURBS, KNOT and CNTRL do not fit each other",
        "Export the operation again, or with linear output.",
        "A NURBS block has a row of rising knots and two control points more than knots (measured in every NX file). Here \
         the counts do not fit, the knots fall, or a CNTRL stands without NURBS: a line was lost. Until it is repaired \
         clsmith sees a straight move to the last control point.";
    ASSUMED_SENSE = "CL0108", Note, "the sense of an arc is not stated",
        "Compare the arc with the CAM system's display; `--dialect` sets the rule of a known system.",
        "The axis of a CIRCLE is left-hand in NX and right-hand in SolidWorks, and others write a word. This file states \
         nothing, and the motion before the arc is not tangent to it, so clsmith has assumed right-hand: axis +z is \
         counter-clockwise.";
    RAPID_ARC = "CL0109", Warning, "an arc or spline at rapid",
        "Give the motion a feed, or make it a straight rapid.",
        "Controls have no rapid along an arc. A post writes the arc at the last feed, at some maximal feed, or a straight \
         G0 to the end point: through whatever the arc went around.";

    AXIS_NOT_UNIT = "CL0110", Warning, "an axis whose length is not 1",
        "Correct the component that is wrong; CAM systems print axes of length 1 to the last decimal.",
        "The tool axis of a GOTO, TLAXIS or FROM, and the axis of an arc, are unit vectors. The length here is off by more \
         than 0.001, which is more than rounding to three decimals explains. A post scales it back to 1 and turns the rotary \
         axes with what comes out: a length off by 0.001 can hide a tilt of more than two degrees.";
    NO_AXIS = "CL0111", Error, "three numbers that cannot be an axis",
        "Write two points as two GOTOs; otherwise correct the axis.",
        "The last three numbers should be a direction of length 1, and are off by more than a tenth. Most often a line end \
         was lost and two points stand in one GOTO, or coordinates and axis were swapped. A zero vector has no direction at \
         all. A post would turn the rotary axes to whatever angle comes out.";
    AXIS_WITHOUT_MULTAX = "CL0112", Warning, "the tool axis changes without MULTAX",
        "Put MULTAX (Creo: MULTAX / ON) before the first GOTO whose axis changes.",
        "CATIA and Creo announce GOTOs with a changing axis by MULTAX; without it posts read x, y, z and ignore i, j, k, or \
         stop. A TLAXIS record may change the axis at any time and is not meant.";
    AXIS_JUMP = "CL0113", Warning, "the tool axis turns far within one feed motion",
        "Retract before the turn, or let the CAM system interpolate the axis (a smaller maximal angle step).",
        "Between these two points the axis turns by more than 45 degrees in a single straight feed move. What the tool tip \
         and flank do in between depends on the machine's kinematics and on the post's linearisation; near a pole the \
         rotary axes may turn by half a turn at once.";
    REPEATED_POINT = "CL0114", Note, "a motion to where the tool is already",
        "Remove the repeated point; with compensation on it matters.",
        "The point and axis are those the tool has already. Most controls skip such a block, but it breaks the look-ahead \
         of cutter compensation on some, stops others for an instant (a mark on the wall), and a RAPID or FEDRAT before it \
         is used up by it.";
    FAR_AWAY = "CL0115", Warning, "a coordinate farther away than machines are large",
        "Check the decimal point and the unit.",
        "A coordinate lies more than 100 metres away. Usually a decimal point was lost, an inch file is read as millimetres \
         twice, or two numbers have run together.";
    NO_MOTION = "CL0116", Error, "a program without any motion",
        "Check that the export was complete.",
        "Not one GOTO, FROM or arc is in the file. Either it is not the file you meant, or nothing was selected when it was \
         exported.";
    LEFT_IN_CUT = "CL0117", Warning, "the tool is left in a cut",
        "Let the operation end with a retract; export it again if its end was lost.",
        "The last motion before a tool change, or of the whole program, is marked as a cut, and nothing retracts the tool. \
         The post's own retract then starts inside the material, often as a rapid to the tool change position. A file that \
         was cut off looks like this too.";
    SENSE_FROM_ANGLE = "CL0118", Note, "the angle of an arc tells its sense",
        "Nothing has to be done where the arc is meant so; newer posts turn the normal over instead.",
        "MOVARC is counter-clockwise about its normal. Older posts print the same normal for both senses, and only ANGLE fits \
         the sense that is meant. The end point and the angle agree for the other sense here, so that one was taken.";
    OTHER_SENSE_FITS = "CL0119", Warning, "an arc whose other sense would be tangent at both ends",
        "Compare the arc with the CAM system's path; where it is a corner, its axis has the wrong sign.",
        "The path comes to this arc in one direction and leaves it in another, and the arc turns back against both: as it is \
         written it goes round most of its circle. The other sense would go on smoothly at both ends. That is what a lost \
         sign or a wrong dialect looks like, and the tool would gouge.";

    CUT_WITHOUT_FEED = "CL0120", Warning, "a feed motion before any feed",
        "Put a FEDRAT before it, or RAPID if it was meant as one.",
        "The motion is no rapid, and no FEDRAT stands before it (nor a feed in its cycle). The control takes the feed that \
         was in force before the program, or stops.";
    ZERO_FEED = "CL0121", Error, "a cut with a feed of zero",
        "Give it the feed the CAM operation should have had.",
        "The feed in force is 0. The control stops with an alarm, or stands still and rubs. An operation without a feed in \
         the CAM system exports like this.";
    IMPLAUSIBLE_FEED = "CL0122", Warning, "a feed that no cut has",
        "Check the number and whether it is meant per minute or per revolution.",
        "Feeds above 100 m/min, above 25 mm/rev or below 0.5 mm/min are taken as slips: a lost decimal point, MMPR for MMPM \
         (250 mm per revolution) or MMPM for MMPR (0.1 mm per minute). Nothing is changed; the finding only asks.";
    FEED_PER_REVOLUTION_WITHOUT_SPINDLE = "CL0123", Warning, "a feed per revolution while the spindle does not turn",
        "Put SPINDL before the cut, or give the feed per minute.",
        "The feed is per revolution (MMPR, IPR, PERREV), and at the motion that uses it no spindle turns. The axes wait for \
         a revolution that never comes, or the post computes a feed of zero.";
    INVERSE_TIME = "CL0124", Note, "an inverse-time feed",
        "Make sure the post repeats it in every block (G93).",
        "The feed says how many such motions fit into a minute, not a speed. It belongs to one motion, and must stand with \
         each: after a change of point spacing (by a transform, too) it is another speed.";
    CUT_WITHOUT_SPINDLE = "CL0125", Warning, "a feed motion while the spindle does not turn",
        "Put SPINDL before the first cut, and after every SPINDL/OFF.",
        "The file starts its spindle elsewhere, but at this feed motion it has not been started yet, or was switched off. \
         Probing and broaching do so on purpose; for everything else it is a broken tool. Reported once for each stop.";
    NO_SPINDLE = "CL0126", Note, "the program never starts a spindle",
        "Let the post or the operator start it; NX writes SPINDL only when a speed is set in the operation.",
        "The file cuts, but no SPINDL is in it. CAMWorks CLT files never have one, and NX files only when the operation has \
         a speed: the post then takes it from the tool table or leaves it to the operator. Wire erosion is not asked.";
    ZERO_SPEED = "CL0127", Warning, "a spindle started with speed 0",
        "Give the operation a speed, or write SPINDL/OFF.",
        "SPINDL with a sense or unit but a speed of 0: the post writes S0 M3. An operation without a speed in the CAM \
         system exports like this.";
    SPINDLE_NOT_RESTARTED = "CL0128", Warning, "a cut after a tool change without a SPINDL",
        "Put the new tool's SPINDL after the tool change.",
        "The tool change stops the spindle, and the speed in force is still the old tool's. The file has SPINDL records, \
         but none between this tool change and the first cut after it. Some posts repeat the last speed, others start \
         nothing.";
    NO_COOLANT = "CL0129", Note, "a cut without the coolant that the file uses elsewhere",
        "Add COOLNT/ON if it was forgotten.",
        "Coolant is switched on somewhere in the file, but it is off at this cut. That can be right (cast iron, dry \
         finishing). Reported once for each time it is off.";

    CUT_WITHOUT_TOOL = "CL0130", Warning, "a feed motion before any tool",
        "Put the tool's records before the first cut.",
        "The file loads or describes a tool later, but cuts before it does: with whatever is in the spindle. Statements may \
         have been reordered or the head of the operation lost.";
    NO_TOOL = "CL0131", Note, "the program never names a tool",
        "Let the setup sheet or the recipe (`setup: tools:`) say which tool it is.",
        "No LOAD, LOADTL, TOOLNO, TLDATA or CUTTER is in the file. The post writes no tool change, and whatever needs the \
         shape of the tool (simulation, chip thickness) needs it from the recipe.";
    TOOL_SHAPE_MISSING = "CL0132", Note, "a tool whose shape the file does not give",
        "Give its shape in the recipe (`setup: tools:`) where a step needs it.",
        "The tool is loaded by number, but no TLDATA or CUTTER describes it. That suffices for the post; simulation and \
         feed optimisation need the diameter.";
    IMPOSSIBLE_TOOL = "CL0133", Warning, "a tool that cannot exist",
        "Correct the tool in the CAM system and export again.",
        "The diameter is zero, or the corner radius is larger than half the diameter. The path was computed with another \
         shape than the tool has, or with none (a centre-line path): simulation and compensation will be wrong.";
    TOOL_SHAPES_DIFFER = "CL0134", Warning, "one tool number, two shapes",
        "Give the two tools different numbers, or the same shape.",
        "Earlier in the file the same tool number cut with another diameter or corner radius. There is one tool in that \
         pocket of the magazine: one of the two operations cuts with the wrong one.";
    TOOL_NUMBERS_DIFFER = "CL0135", Warning, "the tool that is loaded is not the one that was described",
        "Make TOOLNO and LOADTL agree.",
        "TOOLNO describes one number and the load that follows it, before any cut, names another. Post and operator see \
         different tools.";
    POINT_APART = "CL0136", Warning, "a point far outside everything else",
        "Check the decimal point and the number of digits.",
        "One coordinate lies 500 mm or more outside those of all other points of its operation, and more than ten times as far off \
         as the middle half of them is wide. Such a point is most often a lost decimal point or a digit too many: the machine \
         would run into its end stops or through the vise on the way. Rapids before the first feed motion of an operation and \
         behind the last one are not looked at, and two points that lie out there together neither.";

    THREAD_PITCH_DIFFERS = "CL0137", Warning, "a thread whose feed and speed do not make the pitch of its tool",
        "Make the feed the pitch times the speed, or call the tool by its right name.",
        "The feed divided by the spindle speed is not the pitch that the name of the tool gives (M10x1.5, TAP M6, 1/4-20 UNC), that \
         the cycle states (PITCH, TPI), that a FEDRAT inside the cycle makes, or that the same tap has cut before; or SPINDL changes \
         between two holes and the feed does not. A tap in a chuck without compensation breaks, or the thread has the wrong pitch. A \
         tap without a pitch in its name (TAP M6) has the coarse one.";

    CUTCOM_LEFT_ON = "CL0140", Warning, "cutter compensation is left on",
        "Put CUTCOM/OFF before the last retract of the operation.",
        "The operation, the tool or the program ends and CUTCOM was not switched off. The next approach then moves by the \
         radius to the side, or the control refuses the tool change.";
    CUTCOM_AT_ARC = "CL0141", Warning, "cutter compensation is switched in an arc",
        "Add a straight lead-in (or lead-out) longer than the tool's radius, and switch there.",
        "The motion after CUTCOM is an arc. Controls switch compensation on and off along a straight move only and stop \
         with an alarm in an arc (Fanuc 034, Sinumerik 10750 and others).";
    CUTCOM_RAPID = "CL0142", Warning, "a rapid while cutter compensation is on",
        "Switch compensation off (CUTCOM/OFF) on a feed move before the rapid.",
        "The tool leaves at rapid with compensation still on. The control looks ahead over the rapid for the next contour \
         move and may cut the corner where the tool still is. Reported once for each CUTCOM.";
    CUTCOM_CHANGES_SIDE = "CL0143", Note, "cutter compensation changes its side without OFF",
        "Switch it off and on again if the control does not change sides in motion.",
        "LEFT follows RIGHT, or the other way, with no OFF in between. Controls allow it, but the tool crosses the contour \
         at the change.";
    CYCLE_LEFT_ON = "CL0144", Warning, "a drilling cycle is left on",
        "Put CYCLE/OFF after the last hole.",
        "The operation, the tool or the program ends and the cycle was not switched off. Every GOTO after it is another \
         hole: the approach of the next operation drills.";
    CYCLE_WITHOUT_HOLE = "CL0145", Note, "a drilling cycle without a hole",
        "Remove the cycle, or add its points.",
        "Between this CYCLE and its end stands no GOTO, so nothing is drilled. Where the point stands before the CYCLE, as \
         some systems write it, this post convention has to be known.";
    CYCLE_WITHOUT_DEPTH = "CL0146", Warning, "a drilling cycle without a depth",
        "Add the depth (FEDTO, DEPTH, or the first number).",
        "The cycle names no depth, neither by a word nor as its first number. A post takes the depth of the cycle before, or \
         zero: the holes are too deep, or missing.";
    CYCLE_CUTS_NOTHING = "CL0147", Note, "a drilling cycle that does not go down",
        "Right for centre marks programmed at the bottom; otherwise correct the depth.",
        "The depth is 0, or in NX (which prints the depth as a coordinate, negative is down) above the point. The tool stops \
         at the GOTO's point. NX exports this when the points already are the bottoms of the holes.";
    CYCLE_BELOW_POINT = "CL0148", Warning, "a drilling cycle whose clearance lies below the point",
        "The clearance (RAPTO, CLEAR) is a positive distance above the point.",
        "The tool goes to the clearance at rapid. Here that is below the hole's point: in the material, if the point is on \
         the surface.";

    UNKNOWN_WORD = "CL0150", Note, "a word that clsmith does not know",
        "Nothing, if your post knows it: it is kept and passed on.",
        "The word is neither of the standard nor of the dialects clsmith was measured on. It is kept byte for byte. If it \
         moves the tool, the motions that clsmith computes lack that.";
    MISSPELT_WORD = "CL0151", Warning, "a word one letter away from one that matters",
        "Correct the spelling.",
        "clsmith and most posts do not know the word, but it differs from a known one by a single letter (FEDRATE, SPINDLE, \
         GO TO). Posts skip words they do not know: then a feed, a spindle start or a whole motion is missing.";
    OPERATION_OPEN = "CL0152", Warning, "an operation that is not closed",
        "Export the operation again; its end was lost.",
        "The dialect closes operations (NX END-OF-PATH, Creo `$$-> END`, CLT OPFEATEND), and this one is not closed before \
         the next starts or the file ends. Its last statements, the retract among them, may be missing.";
    EMPTY_OPERATION = "CL0153", Note, "an operation without a motion",
        "Generate the tool path in the CAM system, or leave the operation out.",
        "The operation has a start and an end, but nothing moves. In the CAM system its path was probably not generated or \
         came out empty.";
    AFTER_END = "CL0154", Warning, "statements after the end of the program",
        "Remove them, or the FINI/END before them.",
        "FINI and END end the program: a post reads no further, so what follows is never machined. Either it is stray text, \
         or two programs were joined and everything after the first FINI would be lost without a word.";
    MISSING_END = "CL0155", Warning, "the program does not end in FINI",
        "Check that the file is complete; then add FINI.",
        "This dialect ends every program with FINI (or END). Without it the post does not write the program's end, and the \
         file may have been cut off while it was exported or copied.";
    FRAME_SKEWED = "CL0156", Warning, "a frame whose axes are not perpendicular unit vectors",
        "Correct the axes; export them again if you can.",
        "A frame (MSYS, CSYS, CAMERA, $$*CATIA0) has three axes of length 1 at right angles. These are not, by more than \
         their printed decimals explain: a post that applies the frame distorts the part.";
    FRAME_LEFT_HANDED = "CL0157", Warning, "a left-handed frame",
        "Mirror the tool path in the CAM system instead of the frame.",
        "The axes are perpendicular, but x, y, z follow the left hand: the frame mirrors. A mirrored path cuts the other \
         hand of the part, turns climb into conventional milling, and arcs and CUTCOM change their sense, which posts that \
         apply frames do not expect.";
    BROKEN_FRAME = "CL0158", Warning, "a $$*CATIA0 mark without its matrix",
        "Restore the three rows of four numbers after the mark.",
        "CATIA writes where the part's frame stands into comments: the mark, a name, and three rows of four numbers. The \
         rows are missing or incomplete, so a post that reads them finds none.";

    POINTS_MISSING = "CL0159", Warning, "statements between motions that may be points",
        "Tell what the word means, or rewrite it; until then lengths and times are not to be trusted.",
        "A word that clsmith does not know has three numbers, as a point has, and stands between motions; or it is a drive \
         motion of a form that is not understood; or it is a line that reads like a record of the path, behind a text whose \
         `$` takes it. If the post moves there, the path that clsmith sees lacks these points: \
         lengths, times, boxes and simulations are wrong, and steps that move points leave them behind.";
    UNITS_DIFFER = "CL0160", Error, "the unit of lengths changes within the program",
        "Export all operations in one unit.",
        "Two UNITS records disagree. clsmith and most posts know one unit in a program; every coordinate on one side of the \
         change is off by a factor of 25.4.";
    UNITS_LATE = "CL0161", Warning, "the unit of lengths comes after motions",
        "Move UNITS to the head of the program.",
        "The first UNITS stands behind motions. clsmith reads the whole program in that unit, but a post that goes line by line \
         reads the motions before it in its own default unit, off by a factor of 25.4 when that is the other one.";
    FEED_UNITS_MIXED = "CL0162", Warning, "feeds and lengths in different units",
        "Give all feeds in the unit of the lengths.",
        "A feed in inches (IPM, IPR) stands in a metric program, a metric one in an inch program, or both kinds in one \
         file. Posts that read only the number are off by a factor of 25.4. Reported once for each kind.";

    MISSING_COMMA = "CL0170", Note, "two fields with a comma missing between them",
        "Nothing, if it is CAMWorks CLT and your post is made for it; otherwise add the comma.",
        "Fields are divided by commas. Here only blanks stand between two of them. clsmith reads them as two; a post may \
         read one, or run the digits together.";
    UNUSUAL_NUMBER = "CL0171", Note, "a number with an exponent or a plus sign",
        "Write it as a plain decimal.",
        "No CAM system measured writes exponents (1.2E-5) or plus signs, and not every post reads them: some stop at the \
         letter and take 1.2.";
    LONG_LINE = "CL0172", Warning, "a line longer than 72 columns",
        "Break the statement with `$` before column 72.",
        "CATIA and Creo keep to 72 columns, because the processors that read their files ignore what stands in columns 73 to \
         80 (once the sequence number). Digits that stand there are lost without a word. Comments and free text are not \
         asked.";
    MIXED_LINE_ENDS = "CL0173", Note, "lines end in different ways",
        "Convert the file to one kind of line end.",
        "Some lines end in LF and others in CRLF: the file was joined or edited on two systems. Some posts see one long line \
         or a stray character.";
    NO_LAST_LINE_END = "CL0174", Note, "the last line has no end",
        "Add a line end.",
        "The file ends in the middle of a line. Some readers drop such a line, which here is a statement; it is also what a \
         file looks like that was cut off.";
    BYTE_ORDER_MARK = "CL0175", Warning, "a UTF-8 byte order mark in front of the program",
        "Save the file without the mark (UTF-8 without BOM, or ANSI).",
        "An editor has put three invisible bytes in front of the first word. A post does not know that word then: PARTNO, \
         UNITS or TOOL PATH is lost.";
}
