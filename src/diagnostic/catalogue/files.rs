//! Codes of files: reading what is there, writing what is wanted (`CL04xx`).

super::area! {
    UNREADABLE = "CL0401", Error, "a file that cannot be read",
        "Check the path and that you may read the file; a network drive may be disconnected.",
        "The operating system refused to hand over the file, and the message says why. The usual reasons: a typing error in \
         the name or in `setup_file:`, a path meant from another folder, a folder given where a file belongs, a file that \
         the CAM system still holds open, or a network drive that is not mounted on this machine.\n\n\
         Nothing is written: a run that misses one of its inputs is not the run you asked for.";
    UNWRITABLE = "CL0402", Error, "an output that cannot be written",
        "Check that the folder exists, that you may write to it and that the disk is not full.",
        "An output is first written in full beside its place, under a name like `.clsmith-Xa81Qz.tmp`, and takes its name \
         only once every byte is on the disk. One of these operations was refused by the operating system: the folder does not \
         exist, it or the file is write-protected, the disk or your quota is full, or another program holds the old file \
         open.\n\n\
         What stood there before still stands there, whole: clsmith does not leave half a program where a machine could \
         fetch it. A write-protected output is left alone on purpose; protecting a released program is a good habit. Give \
         another name or lift the protection.";
    TOO_LARGE = "CL0403", Error, "a file of 4 GiB or more",
        "Export the operations to separate files and run clsmith on each.",
        "clsmith remembers places in a file as 32-bit numbers, which end at 4 GiB. A CL line has some 40 bytes, so such a \
         file holds about a hundred million points; most often it is not a CL file at all, or the tolerance of the export \
         was set a few zeros too fine. Split the export by operation, or have the CAM system output arcs (`CIRCLE`) \
         instead of short chords.";
    OUTPUT_IS_INPUT = "CL0404", Error, "an output that would overwrite an input",
        "Give the output another name or folder.",
        "The output's path leads to a file this run reads: the CL file, the recipe or a setup file. Two different names can \
         lead to one file, by a symbolic link, a hard link or another spelling of the path.\n\n\
         The export is the only proof of what the CAM system meant. A correction applied to its own result corrects twice: \
         a feed scaled by 0.8 and scaled again runs at 0.64, and nothing in the file shows it. So the input always stays and \
         the output goes beside it; this cannot be allowed away.";
    PASSED_ORIGINAL = "CL0410", Warning, "the untouched program was handed on",
        "Correct what the errors above name, export and post again; do not run the program before somebody has checked it.",
        "The hook could not correct the program, for the errors shown before this one, and its options say to continue all the same \
         (`--on-error pass-original`). So the post got the CAM system's export as it was, byte for byte. What the recipe is there \
         for, a feed limit or a safe ramp, is missing from the program that now goes to the machine. The log says so, too: \
         its outcome is `passed_original`.";
    POST_MISSING = "CL0411", Error, "the post-processor is not there",
        "Check the path after `--`; a script also needs the interpreter that its first line names.",
        "The hook corrected the program and wanted to start the post-processor that stands after `--`, and the operating system \
         did not find it: a typing error, a program that is not on the PATH of whoever the CAM system runs as, a script whose first \
         line names an interpreter that this machine does not have, or a network drive that is not connected. No post ran, so any NC \
         program that stands in the folder is an old one. The exit code is 127, as of a shell.";
    POST_NOT_STARTED = "CL0412", Error, "the post-processor cannot be started",
        "Check that it is a program, made for this machine, and that you may execute it.",
        "The post-processor that stands after `--` is there, but the operating system refused to run it: the file is not marked \
         executable, it is a folder or a text without a `#!` line, it was built for another system, or its arguments are too long. \
         No shell is involved, so what only a shell knows (an alias, a built-in command) cannot be named here. No post ran. The exit \
         code is 126, as of a shell.";
    POST_TIMED_OUT = "CL0413", Error, "the post-processor took too long and was stopped",
        "Find out why it hangs (it waits for an answer or for a licence), or allow more time by `--timeout`.",
        "The post-processor had not ended when the time of `--timeout` was over, so it was asked to end and two seconds later \
         killed, together with every process that it had started. What it left beside the corrected program is thrown away, \
         since half a program must not reach a machine; what it wrote elsewhere by its own means still stands there: do not use \
         it. Its standard input is empty, so a post that asks a question gets no answer. The exit code is 124.";
    POST_KILLED = "CL0414", Error, "the post-processor was ended by a signal",
        "It crashed or somebody stopped it. Read its own messages above, and do not use what it wrote.",
        "The post-processor did not end by itself: it crashed, ran out of memory, or was killed. What it left beside the corrected \
         program is thrown away, since half a program must not reach a machine. The exit code is 128 and the number of the signal: \
         139 for a segmentation fault, 137 for a kill.";
    EXIT_CODE_SHARED = "CL0415", Warning, "the post-processor ended with a code that the hook uses, too",
        "Read this run's line of `--log`: `outcome` and `post` show which of the two it was.",
        "The hook ends with the post's own exit code, and with 124 to 127 or above 128 where no post ended by itself. This time the \
         post itself ended with such a code, so a script that only checks the number may misread it. The messages and the log do \
         not: where the hook stopped, one of the codes CL0411 to CL0414 or the recipe's errors stand here instead of this one.";
    NO_RULE = "CL0416", Error, "no rule chooses a recipe for a program",
        "Add a rule that fits, or say what else to do: `otherwise: pass`, or `otherwise: { recipe: name.yaml }`.",
        "The program was compared with every rule of the selection, from the first to the last, and none fits; `otherwise` is \
         `stop`, or is left out, which means the same. The finding lists what the program states about itself. Names are compared in \
         whole, upper and lower case differ, and `*` stands for any text; a program without a MACHIN record, such as any of \
         NX, has no machine that a rule could ask for.";
    WATCHED_FOLDERS = "CL0417", Error, "folders of a watch that lie in each other",
        "Give three folders side by side: exports, `--output` and `--refused`.",
        "The folder for corrected or refused programs, or the file for the log or the state, lies in the watched folder, or the \
         watched folder lies in one for outputs. What the watch writes would then be taken for a new export and corrected \
         again: a feed scaled by 0.8 would be scaled by 0.64 next, and so on. Links are followed before folders are compared.";
    WATCHED_ALREADY = "CL0418", Error, "another watch is at work in a folder",
        "Stop the other one first. On a network drive, it may run on another machine.",
        "A watch holds a lock, `.clsmith-watch.lock`, in the folder that it watches and in the one that it writes to, as long as \
         it runs. Two of them would correct every export twice and move refused ones away from under each other. The lock is \
         the operating system's, so it ends with its process however that dies, and the empty file that remains means nothing.";
    LEAVES_FOLDER = "CL0419", Warning, "a symbolic link that leads out of the watched folder",
        "Export into the folder itself, or watch the folder that the link leads to.",
        "The watch only takes files that lie in the folder it was given. This name is a link to somewhere else, and whoever may \
         write into the folder could have made it point at anything: it is left alone. Linked folders are not entered either, so \
         no circle of links can keep the watch busy.";
    NOTHING_MATCHES = "CL0420", Error, "a pattern or path of a batch that leads to no file",
        "Check the spelling and the folder it starts in; put the pattern in quotes, so that clsmith expands it and not the shell.",
        "A batch was given a pattern that fits no file, a path where there is none, or a folder. `*` and `?` stay within a \
         folder, `**` goes through all folders below; `programs/**/*.cls` is every CLS file below `programs`. Case counts \
         (`*.cls` is not `PART.CLS`; write `*.{cls,CLS}`), hidden files count only where the pattern names their dot, and \
         the output folder is never searched.\n\n\
         Patterns of a jobs file start in the folder of the jobs file. Nothing runs: a batch that quietly does half of what \
         it was asked is found out at the machine.";
    OUTPUTS_COLLIDE = "CL0421", Error, "two outputs of a batch under one name",
        "Give the jobs different `out` folders, or one pattern with `**`, which keeps the folders below its fixed part.",
        "Each output is called like its input, with the folders below the part of the pattern in front of the first \
         wildcard: `programs/**/*.cls` makes `a/x.cls` of `programs/a/x.cls`. A file that is named without a wildcard keeps only \
         its own name, so `a/x.cls b/x.cls`, also when a shell made that of `*/x.cls`, are both `x.cls`. Names that differ \
         in case only count as one, since they are one file on many disks and in many controls.\n\n\
         Also refused are outputs under a name that the batch needs itself (results, journal) or that another output needs \
         as a folder. Nothing runs, since which of the two stayed would depend on which came last.";
    OUTSIDE_OUTPUT = "CL0422", Error, "an output that would leave the output folder",
        "Remove the link, or choose an output folder without one; a job's `out` is a folder inside the output folder.",
        "All outputs of a batch stay inside its output folder. A job's `out:` with `..` or a drive or root in front leads out \
         of it; so does a symbolic link that stands in the folder where an output or one of its folders belongs. What is \
         written there lands somewhere else, perhaps over a program that somebody released. The output folder itself may be a \
         link: that one you named.";
    OUTPUT_IN_USE = "CL0423", Error, "an output folder that another batch is writing to",
        "Wait until the other batch is done, or choose another output folder.",
        "A batch locks its output folder (`.clsmith-batch.lock`), so that two do not write the same files and journal at once. \
         The lock belongs to the running process: when that ends or is killed, the lock is gone with it, and the file that \
         stays does no harm. Shards of one batch may share a folder; the same shard twice, shards of different batches, and a \
         shard beside a whole batch may not.";
    INPUT_CHANGED = "CL0424", Error, "a file that was changed while it was read",
        "Wait until the CAM system has finished the export, then run the batch again with --resume.",
        "The file's size, time or content is not what it was when it was read. Most often an export was still being \
         written, and what was read is the first part of a program: correct to the last line, and without its retract. So \
         nothing was written for it.\n\n\
         The same is said of a setup or model that was changed while a batch ran, since some files may have been done with \
         the old one and some with the new.";
    OVER_BUDGET = "CL0425", Warning, "a file that may need more memory than the batch has",
        "Give the batch more with --memory, or split the program by operation.",
        "Before a file of a batch begins, its need is estimated from its size, and it waits until that much of --memory \
         is free. This one needs more than all of it, so it runs while no other does, and may take more memory than was \
         granted. On a cluster such a job may be killed by the scheduler: ask for more memory there, too.";
    LINK_LOOP = "CL0426", Warning, "a link to a folder that it is in",
        "Remove the link if it is not needed.",
        "While looking for files, a symbolic link led back to a folder on its own path. Following it would find the same \
         files again and again under ever longer names, so it was passed by; every file is still found under its short \
         name.";
    BAD_RESULTS = "CL0427", Error, "a file that is no results file of a batch",
        "Give the `results*.jsonl` that `clsmith batch` wrote; if it was cut off when it was copied, copy it again.",
        "Results are lines of JSON: the first says which batch and which part of it, each other one what became of a file. \
         The line shown is none of these. Results are written whole or not at all, so a torn line was torn later, or the file \
         is something else.";
    NOT_ONE_BATCH = "CL0428", Error, "results that do not belong together",
        "Merge one results file for each shard of one batch.",
        "Results can be merged when they are of one batch (the same files, recipes, setups, options and version of clsmith), of \
         one split (all of `--shard …/8`), and each part is given once. If machines saw different files or had different \
         recipes, they did not process the same batch, and a merged result would have no meaning.";
    RESULTS_MISSING = "CL0429", Error, "results of a batch that are not complete",
        "Run the missing shards, with --resume, and merge again.",
        "A shard of the batch, or a file of a shard, is not among the results: a machine has not finished, was stopped, or \
         its results were not copied. Nothing is merged, since a result that looks whole and is not would let programs go \
         to the machine uncorrected.";
    NO_RUN_REPORT = "CL0430", Error, "a file that is no report of a run",
        "Give the file that `clsmith apply --json FILE` wrote in the run that is to be undone.",
        "`clsmith undo` needs the report that the run itself wrote with `apply --json`: it holds the old bytes of every place that the \
         recipe changed. The page of `--report` and the table of `--summary` are for people and do not hold them, nor do the log \
         of a hook or the results of a batch. A report that was cut off, by a full disk or a broken transfer, is of no use: half of the \
         old bytes is not a program. The original itself is the other way back: clsmith never writes over its input.";
    NEWER_RUN_REPORT = "CL0431", Error, "a report of a newer clsmith",
        "Undo with the version of clsmith that made the file, or a newer one.",
        "The report's structure has a version, and this one is higher than what this clsmith knows. Its undo may need what this clsmith \
         cannot read, and guessing would give a program that looks right. The key `clsmith` in the report names the version that \
         wrote it.";
    OTHER_FILE = "CL0432", Error, "a file that does not belong to the report",
        "Find the file that the run wrote, or the report that belongs to this file; nothing is written meanwhile.",
        "The report names the SHA-256 of the file that the run wrote, and this file has another: it was edited afterwards, corrected once \
         more, or belongs to another report. Putting old bytes at their places in it would mix two programs. The report has a \
         checksum of each 1024 bytes, so the finding says between which lines the first difference lies; line ends that something \
         converted are reported as such.\n\n\
         After two runs, undo the second with its report first, and its result with the report of the first.";
    BAD_UNDO = "CL0433", Error, "a report that does not give the original back",
        "Take the original itself; clsmith never writes over its input.",
        "The file is the one that the run wrote, but the old bytes in the report do not give the original: its places do not lie in the \
         file one after the other, or the result's SHA-256 is not the one that the report names. The report was changed after the run wrote \
         it. Nothing is written, since a program that is nearly the original is worse than none.";
    STALE_COMMENTS = "CL0434", Warning, "comments of an earlier run that are not true any more",
        "Let this recipe say `provenance: comments`, too; its own lines then follow the earlier ones.",
        "The file was corrected before by a recipe with `provenance: comments`, so comments in it state what that run changed: \
         `$$ clsmith scale_feed: 250.0000 -> 200.0000`. This run has changed some of the same records again and was not asked for comments, so the \
         numbers there are not those of the records below them. clsmith does not take comments out of a file by itself. With \
         `provenance: comments` in this recipe, or `--provenance comments`, the new lines stand below the earlier ones and the file tells \
         its whole history.";
    DEFECT = "CL0440", Error, "a defect of clsmith itself",
        "Send this message, the program, the recipe and the setup to whoever maintains clsmith for you; this file was not written.",
        "clsmith came to a state that cannot be: an index beyond the end of a list, a sum that does not come out. It is a fault          of clsmith and not of your files, though some unusual thing in this file brought it to light. The message names what          was wrong and the place in clsmith's source, so with the program, the recipe and the setup the fault can be found.\n\n         Nothing of this file is written. `batch`, `watch` and `apply` go on with the next file; `hook` posts nothing and ends with          125, as for any other program that cannot be corrected.";
    TIME_LIMIT = "CL0441", Error, "a program that takes longer than it may",
        "Allow more by `--time-limit`, simulate with a coarser `cell`, or split the program by operation.",
        "The run was given a longest time for each program (`--time-limit SECONDS`), and this one was not done by then. It was stopped \
         between two parts of the work, and nothing of it is written; other programs of the run are not touched by that. A single \
         coordinate with a lost decimal point may be the reason: see whether CL0115 is among the findings.";
    MEMORY_LIMIT = "CL0442", Error, "a program that takes more memory than it may",
        "Allow more by `--memory`, simulate with a coarser `cell`, or split the program by operation.",
        "The run was given a limit of memory (`--memory SIZE`). Before the work the size of the program is held against it, about 4 bytes \
         for a byte and 320 for a line, and so is the stock of a simulation; during the work it is what the process really takes. This \
         program needs more. It was stopped, and nothing of it is written.\n\n\
         Without a limit the code says that the system has no memory for the stock of a simulation or for a mesh: the size comes from \
         the setup's stock and `cell`, or from the file. `batch`, `watch` and `hook` go on as with any program that cannot be corrected.";
    OLDER_RESULT = "CL0443", Warning, "the result of an earlier run, set aside",
        "Correct the program and run it again. What was set aside belongs to an earlier run.",
        "This time nothing was written or posted, and the result of an earlier run still stood there. Under its own name it would \
         look like the result of this export and could go to the machine. So it was renamed: `part.cls` is `part.cls.outdated` now, \
         and what a post made, `part.nc`, is `part.nc.outdated`. The next export that goes through writes `part.cls` anew. `hook`, \
         `watch` and `batch` do so.";
}
