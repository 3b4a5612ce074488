"""One page of each transform: its description, its example run on a program, and pictures of before and after."""

import math
import shutil
import subprocess
import tempfile
from pathlib import Path

from . import path_picture
from .commands import say

# The program that shows most of it; `pocket` for those that are not here.
PROGRAMS = {
    "set_spindle": "slot", "optimize_feed": "slot", "compensate_z": "profile", "unwind": "winding",
    "linearize": "cradle", "inverse_time": "cradle", "correct_ramp": "web-pocket",
}
# What is drawn over the path, before and after: quantities of `clsmith plot`, or the path itself.
PICTURES = {
    "scale_feed": "feed", "clamp_feed": "feed", "set_spindle": "feed,chip", "optimize_feed": "feed,chip", "correct_ramp": "ramps",
    "move_origin": "path", "compensate_z": "path", "linearize": "path", "unwind": "path",
}
SHOWN = 40


def write(root: Path, clsmith: Path, pages: Path) -> list[tuple[str, str]]:
    folder = pages / "transforms"
    folder.mkdir()
    names = [line.split()[0] for line in say(clsmith, "transforms").splitlines() if line[:1].islower()]
    for name in names:
        told = say(clsmith, "transforms", name).rstrip()
        head, parameters = told.split("\nParameters:\n")
        words, example = head.split("\nExample:\n")
        recipe = "".join(f"{line[2:]}\n" for line in example.rstrip().splitlines())
        text = f"# {words.strip()}\n\n```yaml\n{recipe}```\n"
        with tempfile.TemporaryDirectory() as work:
            text += run(root, clsmith, Path(work), folder, name, recipe)
        text += f"\n## Parameters\n\n```text\n{parameters}\n```\n"
        (folder / f"{name}.md").write_text(text, "utf-8")
    return [(name, f"transforms/{name}.md") for name in names]


def run(root: Path, clsmith: Path, work: Path, folder: Path, name: str, recipe: str) -> str:
    """Applies the example to its program; gives the change as text and as pictures."""
    program = PROGRAMS.get(name, "pocket")
    prepare(root, work, program)
    (work / "recipe.yaml").write_text(recipe, "utf-8")
    command = ["apply", "recipe.yaml", "part.cls", "-o", "out.cls", "-q"]
    kind = PICTURES.get(name)
    if kind == "ramps":
        command += ["--plot", "ramps.svg"]
    clsmith_in(clsmith, work, *command)
    patch = clsmith_in(clsmith, work, "apply", "recipe.yaml", "part.cls", "--diff", "-q").splitlines()
    left = f"... {len(patch) - SHOWN} more lines\n" if len(patch) > SHOWN else ""
    text = "\n## Before and after\n\nWhat it changes in " + where_from(program) + ":\n\n```diff\n"
    text += "".join(f"{line}\n" for line in patch[2:SHOWN]) + left + "```\n"

    picture = folder / f"{name}.svg"
    if kind is None:
        return text + "\nThe tool goes the same path at the same feeds, so there is nothing to draw.\n"
    if kind == "ramps":
        shutil.copyfile(work / "ramps.svg", picture)
        return text + f"\n![ramps before and after]({name}.svg)\n"
    if kind == "path":
        before, after = (path_picture.tips(clsmith, work, file) for file in ["part.cls", "out.cls"])
        picture.write_text(path_picture.draw(before, after), "utf-8")
        return text + f"\n![the ends of the motions before (grey) and after (black), from above and from the front]({name}.svg)\n"
    clsmith_in(clsmith, work, "plot", "part.cls", "--after", "out.cls", "--of", kind, "--along", "path", "-o", picture, "-q",
               *(["--setup", "shop.yaml"] if (work / "shop.yaml").exists() else []))
    return text + f"\n![{kind} before (grey) and after, along the path]({name}.svg)\n"


def clsmith_in(clsmith: Path, work: Path, *words) -> str:
    done = subprocess.run([clsmith, *words], cwd=work, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"book: clsmith {' '.join(map(str, words))}\n{done.stderr}")
    return done.stdout


def where_from(program: str) -> str:
    if program == "winding":
        return "a ball that winds four times around a cylinder, tilted outwards"
    return f"`docs/programs/{program}.cls`" if program in ("slot", "profile") else f"`examples/{program}/part.cls`"


def prepare(root: Path, work: Path, program: str) -> None:
    """Puts the program into the folder as part.cls, with its setup where it has one."""
    own = root / "docs/programs" / f"{program}.cls"
    if program == "winding":
        own_text = winding()
        (work / "part.cls").write_text(own_text, "utf-8")
    else:
        shutil.copyfile(own if own.exists() else root / "examples" / program / "part.cls", work / "part.cls")
    if program == "slot":
        shutil.copyfile(root / "docs/programs/slot.yaml", work / "shop.yaml")


def winding() -> str:
    """A ball that winds four times around on top of a cylinder, tilted outwards by 20 degrees."""
    tilt = math.radians(20)

    def goto(step: int, height: float) -> str:
        turn = math.radians(10 * step)
        point = (20 * math.cos(turn), 20 * math.sin(turn), height)
        axis = (math.sin(tilt) * math.cos(turn), math.sin(tilt) * math.sin(turn), math.cos(tilt))
        return "GOTO/" + ",".join([f"{value:.5f}" for value in point] + [f"{value:.7f}" for value in axis]) + "\n"

    head = "TOOL PATH/A,TOOL,T1\nTLDATA/MILL,10.0000,5.0000,80.0000,0.0000,0.0000\nLOAD/TOOL,1\nSPINDL/RPM,6000,CLW\nRAPID\n"
    cut = "".join(goto(step, -0.5) for step in range(145))
    return head + goto(0, 30) + "FEDRAT/MMPM,800.0000\n" + cut + "RAPID\n" + goto(144, 40) + "END-OF-PATH\n"
