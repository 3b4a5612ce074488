//! Codes of recipes and setup files (`CL02xx`).

super::area! {
    YAML_SYNTAX = "CL0201", Error, "a recipe or setup file that is not YAML",
        "Compare the indentation and the quotes with the lines around it.",
        "The file cannot be read as YAML. What it is nearly always:\n\n\
         \x20 a tab in the indentation          YAML indents with spaces only\n\
         \x20 a key without a blank behind `:`  factor:0.5      -> factor: 0.5\n\
         \x20 a name that starts with `*`       [*ROUGH]        -> [\"*ROUGH\"]\n\
         \x20 a bracket or quote left open      { factor: 0.5   -> { factor: 0.5 }\n\
         \x20 a line indented too far, or too little\n\n\
         The place shown is where reading stopped; the cause may be in the line above it.";
    YAML_NOT_TEXT = "CL0202", Error, "a recipe or setup file that is not plain UTF-8 text",
        "Save the file as UTF-8, without control characters.",
        "Recipes are UTF-8 text. An umlaut saved by an old editor as Latin-1 is not, nor is a file saved as UTF-16, and a \
         stray control character often comes along when text is copied out of a terminal or a PDF. CL files may be in any \
         8-bit code page; recipes may not, because their names and comments must mean the same on every computer.";
    YAML_EMPTY = "CL0203", Error, "an empty recipe or setup file",
        "The shortest recipe is `version: 1` and `steps: []`.",
        "There is nothing in the file, or only comments. If it was not meant to be empty, it was probably saved to another \
         place or the export was cut off. A recipe that changes nothing says so:\n\n\
         \x20 version: 1\n\x20 steps: []";
    YAML_SEVERAL_DOCUMENTS = "CL0204", Error, "several YAML documents in one file",
        "Put each recipe in a file of its own, and remove the `---` between them.",
        "A line `---` ends one YAML document and starts the next. clsmith would have to guess which of them you mean, and a \
         recipe that is only half applied is the kind of mistake that is noticed at the machine. One file, one recipe.";
    YAML_TOO_LARGE = "CL0205", Error, "a recipe or setup file out of all proportion",
        "Recipes are a few pages of text; check that this is the right file.",
        "clsmith reads recipes and setup files of up to 1 MiB, nested up to 128 deep, that do not grow past 2 MiB when \
         their aliases are followed. Nothing written by hand comes near that. Most often a CL file was given where the \
         recipe belongs: `clsmith apply RECIPE INPUT`, in this order.";
    YAML_DUPLICATE_KEY = "CL0206", Error, "a key given twice",
        "Remove one of the two.",
        "The same key stands twice in one map. Some programs take the first, others the last; with two feeds or two depths, \
         one of them is not what you want. Two steps of the same kind are fine: each is an element of the list, with its \
         own `- `.";
    YAML_FEATURE = "CL0207", Error, "a YAML feature that recipes do without",
        "Write the value plainly.",
        "YAML can do more than recipes need: tags (`!name`), and whole lists or maps as keys. clsmith refuses them, because \
         they are usually typing mistakes: `!` or `{` in front of text that should be in quotes. Anchors and aliases \
         (`&name`, `*name`) are allowed, for a `where:` that several steps have in common.";
    UNKNOWN_KEY = "CL0210", Error, "an unknown key",
        "See `clsmith schema` for all keys.",
        "The key is not one of those that can stand here. It is an error rather than a warning because a misspelt limit is \
         no limit: with `max_fed: 3000` ignored, the tool runs at whatever feed the file has. If the spelling is right, \
         check the indentation: a key one level too far out belongs to another map.";
    UNKNOWN_STEP = "CL0211", Error, "an unknown step",
        "`clsmith transforms` lists the steps there are.",
        "A recipe's `steps:` is a list of transforms, each by its name. This name is none of them. If it was copied from \
         another recipe, that recipe may have been written for a newer clsmith.";
    UNKNOWN_CHOICE = "CL0212", Error, "a word that is none of the choices",
        "See `clsmith schema` for the choices.",
        "The value has to be one of a few words, written exactly so, in lower case: `units: mm` or `units: inch`.";
    MISSING_KEY = "CL0213", Error, "a required key is missing",
        "Add the key.",
        "This key has no default that would be right for everyone: a depth of cut, a target, a factor. clsmith does not \
         guess numbers that end up at the spindle. Look also at the indentation: a key that stands one level too far out is \
         missing where it belongs.";
    WRONG_TYPE = "CL0214", Error, "a value of the wrong kind",
        "Write a value of the kind that is asked for.",
        "Text where a number belongs, a single value where a list belongs, and the like. The common ones:\n\n\
         \x20 depth: 2 mm       -> depth: 2            units are set once, by `units:`\n\
         \x20 depth: 2,5        -> depth: 2.5          a decimal point, not a comma\n\
         \x20 tools: 3          -> tools: [3]          a list, even of one\n\
         \x20 operations: [100] -> operations: [\"100\"] a name that is only digits needs quotes";
    BAD_VALUE = "CL0215", Error, "a value out of its range",
        "Choose a value in the range that is asked for.",
        "The value is of the right kind but makes no sense here: a negative depth, a factor of zero, a fraction above one, an \
         infinite feed, a list of the wrong length, a name pattern with an open bracket. Each number's range belongs to the \
         number, so it is checked before anything is read or cut.";
    RECIPE_VERSION = "CL0216", Error, "the recipe's version is missing or not known",
        "Start the recipe with `version: 1`.",
        "`version:` says which rules the recipe was written by, so that a later clsmith can change the meaning of a key \
         without changing what old recipes do. This clsmith knows version 1. A higher number means that the recipe was \
         written for a newer clsmith; do not lower it to make it run, install that clsmith.";
    NOT_ONE_NAME = "CL0217", Error, "a step that is not one name with its settings",
        "A step is `- name: { key: value }`.",
        "Each element of `steps:` is one name, and the settings stand below it or in brackets:\n\n\
         \x20 steps:\n\
         \x20   - scale_feed: { factor: 0.8 }\n\
         \x20   - scale_feed:\n\
         \x20       factor: 0.8\n\n\
         In the second form the settings must be indented deeper than the name. In line with the name, YAML reads them as \
         neighbours of the name, and the step has no settings at all.";
    SETUP_FILE = "CL0220", Error, "the recipe's setup file cannot be read",
        "The path in `setup_file:` is relative to the folder of the recipe.",
        "The recipe names a setup file (machine, stock, tools), and this file cannot be read. Without it, limits of the \
         machine would be unknown, so nothing is done. Relative paths start at the recipe's folder, not at the folder \
         that clsmith was started in.";
}
