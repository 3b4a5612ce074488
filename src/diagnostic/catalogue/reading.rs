//! Codes of reading CL text (`CL00xx`).

super::area! {
    MALFORMED = "CL0001", Error, "a statement the grammar cannot read",
        "Repair the statement in the CAM system or by hand; it is kept byte for byte until then.",
        "CL text is a list of statements: a major word, then `/` and its arguments, or a bare word, a comment (`$$`), or \
         free text after words such as PPRINT. This one is none of them: an unclosed parenthesis or quote, a line that \
         starts with punctuation, or bytes that are no text. clsmith keeps such a line exactly as it is and reads on, but \
         does not know what it means, so nothing is written unless you say `--allow CL0001`.";
    BAD_ARGUMENTS = "CL0002", Error, "a known record with the wrong arguments",
        "Compare with the record's form: `clsmith explain CL0002` lists the common ones.",
        "The major word is known but its arguments do not fit it. The common records:\n\n\
         \x20 GOTO/x,y,z            GOTO/x,y,z,i,j,k        FROM and GOHOME alike\n\
         \x20 CIRCLE/cx,cy,cz,i,j,k[,r,...]                 then GOTO/ the end point\n\
         \x20 FEDRAT/MMPM,f         FEDRAT/f,MMPM           FEDRAT/f\n\
         \x20 SPINDL/RPM,n,CLW      SPINDL/n,RPM,CLW        SPINDL/OFF\n\
         \x20 MSYS/ox,oy,oz,xi,xj,xk,yi,yj,yk\n\n\
         The statement is kept byte for byte and has no effect on the motions that clsmith computes, which is why this is \
         an error: everything after it may be misunderstood.";
    BAD_NUMBER = "CL0003", Error, "something that is not a number where a number belongs",
        "Numbers are digits with at most one decimal point, an optional sign and an optional exponent.",
        "A coordinate, feed or dimension cannot be read as a number: two decimal points, a letter O for a zero, a decimal \
         comma, a value too large for a machine. Posts differ in what they make of such a field, from a stop to a zero; \
         a zero coordinate drives the tool into the part.";
    CONTINUES_PAST_END = "CL0004", Error, "a statement continues (`$`) but the file ends",
        "The export was cut off, or the last line ends in a stray `$`.",
        "A single `$` says that the statement goes on in the next line. Here there is no next line: most often the export \
         was interrupted or the file was cut while it was copied. Export it again rather than removing the `$`.";
    APT_PART_PROGRAM = "CL0010", Error, "an APT part program, not cutter-location data",
        "Run it through an APT processor first; clsmith reads the CL data that comes out.",
        "The file defines geometry (`L1 = LINE/...`), variables, macros or loops. That is the source an APT processor \
         compiles; the cutter locations are its output. clsmith reads the output: the CL print or CL file.";
    NOT_TEXT = "CL0011", Error, "the file is not 8-bit text",
        "Save or export it as plain text (ASCII, Latin-1, UTF-8 or another 8-bit code page).",
        "The file starts with the mark of UTF-16 or holds mostly NUL bytes. Posts read 8-bit text; so does clsmith. Binary \
         CL files (NX .cls in binary form, APT CLTAPE) must be converted to text by the CAM system.";
    NOT_CL_DATA = "CL0012", Error, "a file of another kind, given by mistake",
        "Give clsmith the file that the CAM system writes for the post: .cls, .aptsource, .ncl, .apt or .clt.",
        "The file is what comes behind the post (G-code, Heidenhain, a robot program), an intermediate file of another \
         system (Mastercam NCI), a model or drawing (STEP, STL, DXF), a document, a table, XML or an archive. clsmith corrects CL data, which come before the post; in an NC \
         program there are no operations, tools or frames left to work with. Nothing of the file was read.";
}
