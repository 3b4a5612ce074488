//! Codes of files: reading what is there, writing what is wanted (`CL04xx`).

super::area! {
    UNREADABLE = "CL0401", Error, "a file that cannot be read",
        "Check the path and that you may read the file; a network share may have gone away.",
        "The operating system refused to hand over the file, and the message says why. The usual reasons: a typing error in \
         the name or in `setup_file:`, a path meant from another folder, a folder given where a file belongs, a file that \
         the CAM system still holds open, or a network share that is not mounted on this machine.\n\n\
         Nothing is written: a run that misses one of its inputs is not the run you asked for.";
    UNWRITABLE = "CL0402", Error, "an output that cannot be written",
        "Check that the folder exists, that you may write to it and that the disk has room.",
        "An output is first written in full beside its place, under a name like `.clsmith-Xa81Qz.tmp`, and takes its name \
         only once every byte is on the disk. Somewhere on that way the operating system said no: the folder does not \
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
         a feed scaled by 0.8 and scaled again runs at 0.64, and nothing in the file tells. So the input always stays and \
         the output goes beside it; this cannot be allowed away.";
}
