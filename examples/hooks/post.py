#!/usr/bin/env python3
"""A post-processor to try hooks with: reads CL data (NX, CATIA, Creo, ISO) and prints something like G-code.

    post.py part.cls              to standard output
    post.py -o part.nc part.cls   to a file
    post.py --beside part.cls     to part.nc beside part.cls, as many posts do

Exit codes: 0 done, 1 a file cannot be read or written, 2 wrong command line, 3 a record that it cannot post.
It knows points, rapids, feeds, spindle, tool, coolant and drilling; arcs become their chords. Not for a machine.
"""

import argparse
import os
import re
import sys

# Words that have no code in the output.
SILENT = {
    "TOOL PATH", "TLDATA", "MSYS", "CSYS", "PAINT", "PARTNO", "UNITS", "MACHIN", "CUTTER", "MULTAX", "TLAXIS", "CUTCOM",
    "TOOLNO", "TPRINT", "PPRINT", "INTOL", "OUTTOL", "LOADTL",
}


class CannotPost(Exception):
    """A record that has no code here."""


def records(text):
    """Number of the first line, major word and fields of each record; a `$` at the end of a line goes on in the next."""
    record, start = "", 0
    for number, line in enumerate(text.splitlines(), 1):
        line = line.split("$$")[0].rstrip()
        start = start if record else number
        if line.endswith("$"):
            record += line[:-1]
            continue
        word, _, fields = (record + line).partition("/")
        record = ""
        if word.strip():
            yield start, word.strip().upper(), [field.strip() for field in fields.split(",")]


def code(text):
    """The lines of the output."""
    yield "%"
    block, rapid, feed, cycle = 0, False, None, None
    for line, word, fields in records(text):
        numbers = [field for field in fields if re.fullmatch(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", field)]
        out = None
        if word == "RAPID":
            rapid = True
        elif word == "FEDRAT" and numbers:
            feed = float(numbers[0])
        elif word in ("GOTO", "FROM") and len(numbers) >= 3:
            place = " ".join(f"{axis}{float(value):.4f}" for axis, value in zip("XYZ", numbers))
            if cycle:
                out = f"{place} {cycle}"
            else:
                out = f"G0 {place}" if rapid or feed is None else f"G1 {place} F{feed:g}"
            rapid = False
        elif word == "CIRCLE":
            yield "(an arc, here its chord)"
        elif word == "CYCLE":
            given = dict(zip(fields, fields[1:]))
            off = fields[0] == "OFF"
            cycle = None if off else f"G81 R{given.get('RAPTO', '?')} Z{given.get('FEDTO', '?')} F{fields[-1]}"
            out = "G80" if off else None
        elif word == "SPINDL" and numbers:
            out = f"S{float(numbers[0]):g} {'M4' if 'CCLW' in fields else 'M3'}"
        elif word in ("LOAD", "LOADTL") and numbers:
            out = f"T{int(float(numbers[0]))} M6"
        elif word == "COOLNT":
            out = "M9" if "OFF" in fields else "M8"
        elif word in ("END-OF-PATH", "END", "FINI"):
            out = "M1"
        elif word not in SILENT:
            raise CannotPost(f"line {line}: {word} is too much for this post")
        if out:
            block += 10
            yield f"N{block} {out}"
    yield f"N{block + 10} M30"
    yield "%"


def main():
    parser = argparse.ArgumentParser(description="CL data to something like G-code; to try hooks with.")
    parser.add_argument("-o", "--output", help="the output; standard output if not given")
    parser.add_argument("--beside", action="store_true", help="write beside the input, as .nc")
    parser.add_argument("input")
    options = parser.parse_args()
    output = os.path.splitext(options.input)[0] + ".nc" if options.beside else options.output
    try:
        with open(options.input, encoding="latin-1") as file:
            lines = "\n".join(code(file.read())) + "\n"
        if output:
            with open(output, "w", encoding="latin-1") as file:
                file.write(lines)
        else:
            sys.stdout.write(lines)
    except OSError as error:
        sys.exit(f"post.py: {error}")
    except CannotPost as error:
        print(f"post.py: {options.input}: {error}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
