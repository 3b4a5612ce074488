//! Codes of running recipe steps (`CL03xx`).

super::area! {
    UNREADABLE_EDIT = "CL0301", Error, "a step would write something that is no CL statement",
        "Check the parameters of the step; for `rewrite`, check the text of its rules.",
        "Every text that a step makes is read back by the same grammar that read the file, before anything is written. This \
         one is not a well-formed statement: a rule of `rewrite` builds a broken record, or a number became too large to \
         print. The run stops here and nothing is written.";
    STEP_FAILED = "CL0302", Error, "a step cannot do what it is asked on this program",
        "The message names the place in the recipe and in the CL file that do not fit together.",
        "The recipe is well formed, but this program does not allow the step: a parameter is missing that the CL data does not \
         tell either (a tool's diameter, say), a selection is ambiguous, or a record stands in the way that the step cannot \
         change and must not ignore. Steps take programs whole: when one fails nothing of it is written.";
    NOTHING_SELECTED = "CL0303", Error, "a step's `where` selects nothing in this program",
        "Check the names; they are case-sensitive and `*` matches anything. Write `required: false` into the `where` of a \
         step that may find nothing.",
        "No motion or statement of this program is selected by the step's `where`: no operation, tool, motion class or feed fits. \
         It is most often a misspelt name, and a program that passes as corrected when it is not breaks a cutter. In a batch over \
         many programs a step may find nothing in some of them; its `where` then says `required: false`, and this is a note.";
    STALE_RECORD = "CL0304", Warning, "a record still describes the program as it was before a step",
        "Change or remove it with a `rewrite` step, or export the program anew from the place it now has.",
        "The step moved, turned or rescaled the path. This record states a place, height or size in words that only the CAM \
         system or the post understands (a matrix in a comment, an escape height, a stock size in a text for the operator); \
         clsmith does not guess a new one. If the post reads it, it now contradicts the path.";
    NOT_CHANGED = "CL0305", Warning, "a record that the step should have changed was left as it is",
        "Handle it by hand or by a `rewrite` rule, and check the result.",
        "The step changes records of this kind, but this one has a form it does not understand well enough to change safely. \
         It stands as it was, so it may contradict the records around it.";
    COMMENT_FRAME = "CL0306", Warning, "a frame that only comments state was changed",
        "Make sure that the post reads the matrix in the comments; else change the points: `change: points`.",
        "CATIA writes the frame of a program in comments (`$$*CATIA0`). The step moved that frame and left the points as they \
         are. A post that reads the matrix machines the part in the new place; one that skips comments machines it in the old \
         one, and nobody at the machine sees the difference until the tool is in the vise.";
    UNITS_DIFFER_FROM_RECIPE = "CL0307", Warning, "a recipe without `units` and a program in inches",
        "Write `units: inch` or `units: mm` into the recipe, whichever its numbers are meant in.",
        "The recipe says no `units`, so its lengths and feeds are in millimetres, but the program is in inches. clsmith converts: \
         `translate: [1, 0, 0]` moves such a program by 0.0394 inches. That is right if the recipe was written in millimetres, \
         and off by a factor of 25.4 if its author thought in inches like the program. Saying the unit settles it.";
    NO_SUCH_STATEMENT = "CL0308", Error, "a step edits a statement that is not there",
        "Please report it with the recipe and the program: it is a fault of the step, not of your files.",
        "Steps change statements that stand in the program. This one wants to change or take out a statement that it, or a step \
         before it, has taken out already, or one that the program never had. What it means to do is then not what would be \
         written, so the run stops here and nothing is written. clsmith's own steps never do that; a step of another program \
         that uses clsmith as a library may.";
    THREADS_KEPT = "CL0309", Warning, "taps and thread passes keep their feed",
        "Change the spindle speed instead (`set_spindle` with `feeds: follow`), or the pitch in the CAM system.",
        "A tap and a threading tool move by one pitch in each turn of the spindle, so their feed is no choice. A step that \
         scales or limits feeds leaves them as they are, in `CYCLE/TAP` and between `THREAD/...` and `THREAD/OFF`.";
    RULE_UNUSED = "CL0310", Warning, "a rule of `rewrite` applies to no statement",
        "Compare it with a statement of the file; a statement that an earlier rule takes does not reach this one.",
        "No statement of this program fits the rule's `match` where the step's `where` selects one. Spacing, case of letters and \
         the spelling of numbers do not matter, but the arguments and their number do: `COOLNT/ON` is not `COOLNT/ON,FLOOD`, \
         which `COOLNT/ON,$...` matches too. In a batch over many programs this may be meant. A rule whose `if` was false \
         everywhere is not reported: it found its statements, and nothing to correct.";
    UNUSUAL_VALUE = "CL0311", Warning, "a value that looks like a slip of units or of a decimal point",
        "Compare it with what the program does; `clsmith stats` and `clsmith simulate` tell.",
        "The value can be meant, but it is far from what is milled: a factor outside 0.05 to 10, a target that is 20 times \
         above or below what the program does today, a limit that makes every feed 20 times slower, a move by more than 10 m, \
         100,000 rev/min. Most often a percentage was not divided by 100, or inches were taken for \
         millimetres.";
    ABSURD_VALUE = "CL0312", Error, "a value that no machine can mean",
        "Correct the value; `--allow CL0312` lets it pass.",
        "The value is so far from anything that is milled that it must be a slip: a factor outside 0.01 to 50, a feed of more \
         than 20 times what the machine can do, a chip thicker than the tool's radius, a target 500 times below what the \
         program does, a move by more than 1 km, 400,000 rev/min. Nothing is written while it stands.";
    FEED_ABOVE_MACHINE = "CL0313", Warning, "a feed above what the machine can do",
        "Put `clamp_feed: {}` behind the other steps, or correct `machine: { max_feed: ... }` in the setup.",
        "A feed of the corrected program is above the setup's `machine: { max_feed: ... }`. The control runs it at its own limit, \
         so the program takes longer than its feeds say, and a feed per tooth is not what was programmed.";
    TARGET_NOT_REACHED = "CL0314", Warning, "a target that no motion comes near",
        "Look at `max_feed` and `max_ratio` of the step and at `max_feed` of the machine: one of them holds every feed down.",
        "`optimize_feed` raises feeds until the load reaches its target. Here the highest feed allowed was reached first \
         everywhere, so the target decides nothing.";
    THREAD_PITCH_CHANGED = "CL0315", Warning, "a step parts the feed and the speed of a thread",
        "Change feed and speed of a tap together: `set_spindle` with `feeds: follow` does.",
        "The feed of a tap is its pitch times the spindle speed. A step changed one of them and not the other, so the tool \
         would move by another length in each turn than the thread has: it breaks, or cuts the thread away.";
    DIALECT_CHANGED = "CL0316", Warning, "the corrected program reads as one of another CAM system",
        "Keep the record that tells the system, or give `--dialect` from now on.",
        "clsmith knows the CAM system of a file by marks that only one system writes: `TOOL PATH/`, `$$->`, `PPWORD`. A step put \
         such a mark in, or took the last one out, so whoever reads the corrected program takes it for one of another system. \
         The systems differ in what their words mean: the side to which arcs turn, what a depth is measured from, what an axis \
         stands for. Here no motion differs.";
    MOTIONS_OF_OTHER_DIALECT = "CL0317", Error, "the corrected program reads with other motions, as one of another CAM system",
        "Keep the record that tells the system; `--dialect` says what it is, here and whenever the file is read again.",
        "A step put a mark of another CAM system in, or took the last one of this system out, and that changes the path: the \
         same CIRCLE is left-hand in NX and right-hand in Creo, and the same TLAXIS is the axis of the tool or that of a setup. \
         The next run of clsmith would correct and simulate another path than this one did. Nothing is written while it stands.";
    LATHE_PLANE_LEFT = "CL0318", Warning, "a shift takes a lathe's path out of its plane",
        "Move along the plane alone, unless the post expects another zero across it.",
        "A lathe's tool moves in one plane: y = 0 (x is the radius), or z = 0 in NX programs of the plane XM-YM. The step shifts the \
         path across it. That is right if the post takes the zero from elsewhere and the other coordinate means nothing; \
         else the tool stands beside the centre. A turn or mirror that takes the path out of the plane is refused (CL0302).";
    RAMP_OUT_OF_LIMITS = "CL0320", Warning, "a ramp is too short or too steep for an indexable cutter",
        "The step corrects it; `--diff` shows the new points.",
        "An indexable cutter does not cut within D - 2r around its axis (D its diameter, r the radius of the inserts' bottom \
         circle). On a leg shorter than D - 2r a core is left standing under it, on a descent steeper than atan(h / (D - 2r)), h \
         the inserts' cutting height, the core rises above the inserts: either way the body of the cutter rubs on it and the \
         cutter breaks. The finding gives the ramp's shortest leg and steepest angle with their limits; lengths are measured \
         across the tool axis, of a helix its diameter.";
    RAMP_IMPOSSIBLE = "CL0321", Error, "a ramp that an indexable cutter does not survive cannot be corrected",
        "Widen `region`, choose a smaller cutter, make space for the ramp in the CAM system, or set `if_impossible: keep`.",
        "Every longer ramp was tried: on the circle through the ramp's ends, on its mirror side, along the chord between the ends, and \
         along the operation's first cutting pass. None of them stays where the tool may go, or the statements of the ramp cannot \
         be written anew, or no cutting follows at the level where the descent ends, so that nothing says what it is for. A ramp is \
         never corrected in part: nothing is written. With `if_impossible: keep` it stays as it was and is reported as CL0322.";
    RAMP_KEPT = "CL0322", Warning, "a ramp that an indexable cutter does not survive was kept",
        "Do not run it with this cutter as it stands: correct it in the CAM system, or widen `region`.",
        "The ramp is too short or too steep for the cutter and could not be corrected, and the recipe says `if_impossible: keep`, or \
         it is a straight descent and the recipe says `plunges: keep`. It stands as the CAM system wrote it. A descent beside the \
         stock does no harm; one in material breaks an indexable cutter.";
    NO_INSERTS = "CL0323", Note, "ramps of a tool without inserts were not checked",
        "If it is an indexable cutter, say so: `insert: { height: ..., radius: ... }` for it under `setup.tools`.",
        "The limits of `correct_ramp` are those of indexable cutters, which do not cut at their centre. The step says no `tool:`, and no \
         entry of `setup.tools` that fits this tool has an `insert:`, so it is taken for a solid cutter that may go down as its CAM \
         system made it. Other tools of the setup have inserts; when none has, the step fails instead, since then it can judge nothing.";
    UNREACHABLE = "CL0330", Warning, "the ball does not reach a part of the profile",
        "Finish it with a smaller ball, or accept what is left.",
        "A ball touches a profile only where nothing beside keeps it away: a fillet or corner tighter than its radius, and anything below \
         an overhang, is left standing. The compensated path goes over such a place without cutting into its sides. The finding \
         gives the range along the pass (u counts from its beginning) and how much is left.";
    BALL_GOUGES = "CL0331", Error, "the compensated cutter cuts into the part",
        "Use a smaller ball there, or change the tool axis or the path in the CAM system.",
        "With contact normals every point is compensated by itself, and nothing in it knows its neighbours: where the part is \
         hollower than the ball, the ball that touches one point cuts into another. The finding shows both points and the depth. Against a model it is \
         found between passes, where a link or rapid was programmed too low. Nothing is written while it stands.";
}
