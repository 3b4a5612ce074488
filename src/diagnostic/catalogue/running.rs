//! Codes of running recipe steps (`CL03xx`).

super::area! {
    UNREADABLE_EDIT = "CL0301", Error, "a step would write something that is no CL statement",
        "Look at the step's parameters; for `rewrite`, at the text of its rules.",
        "Every text that a step makes is read back by the same grammar that read the file, before anything is written. This \
         one is not a well-formed statement: a rule of `rewrite` builds a broken record, or a number became too large to \
         print. The run stops here and nothing is written.";
    STEP_FAILED = "CL0302", Error, "a step cannot do what it is asked on this program",
        "The message names the place in the recipe and in the CL file that do not fit together.",
        "The recipe is well formed, but this program does not allow the step: a parameter is missing that the CL data does not \
         tell either (a tool's diameter, say), a selection is ambiguous, or a record stands in the way that the step cannot \
         change and must not ignore. Steps take programs whole: when one fails nothing of it is written.";
    NOTHING_SELECTED = "CL0303", Warning, "a step's `where` selects nothing in this program",
        "Check names with `clsmith stats`; globs are case-sensitive and `*` matches anything.",
        "The step ran, but no motion of this program is selected by its `where`: no operation, tool, motion class or feed fits. \
         In a batch over many programs that may be meant; for one program it is most often a misspelt operation name.";
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
         one, and nothing at the machine tells the difference until the tool is in the vise.";
    UNITS_DIFFER_FROM_RECIPE = "CL0307", Warning, "a recipe without `units` and a program in inches",
        "Write `units: inch` or `units: mm` into the recipe, whichever its numbers are meant in.",
        "The recipe says no `units`, so its lengths and feeds are in millimetres, but the program is in inches. clsmith converts: \
         `translate: [1, 0, 0]` moves such a program by 0.0394 inches. That is right if the recipe was written in millimetres, \
         and off by a factor of 25.4 if its author thought in inches like the program. Saying the unit settles it.";
    RULE_UNUSED = "CL0310", Warning, "a rule of `rewrite` applies to no statement",
        "Compare it with a statement of the file; a statement that an earlier rule takes does not reach this one.",
        "No statement of this program fits the rule's `match` where the step's `where` selects one. Spacing, case of letters and \
         the spelling of numbers do not matter, but the arguments and their number do: `COOLNT/ON` is not `COOLNT/ON,FLOOD`, \
         which `COOLNT/ON,$...` matches too. In a batch over many programs this may be meant. A rule whose `if` was false \
         everywhere is not reported: it found its statements, and nothing to correct.";
}
