"""The path of the tip before and after, as SVG: from above (x, y) and from the front (x, z), in one scale."""

import csv
import subprocess
from pathlib import Path

# A machine that any program fits on: only the tip's points are asked for.
MACHINE = "machine: { head: [ %s ] }\n" % ", ".join(
    f"{{ name: {name}, kind: linear, direction: {axis}, max_speed: 20000, rapid: 20000, acceleration: 4000 }}"
    for name, axis in [("X", [1, 0, 0]), ("Y", [0, 1, 0]), ("Z", [0, 0, 1])])
WIDTH, GAP, MARGIN = 720, 30, 12


def tips(clsmith: Path, work: Path, file: str) -> list[tuple[float, float, float]]:
    """Ends of the motions, mm."""
    text = (work / file).read_text("utf-8")
    # A vertical tool has the same tip, and needs no rotary axes.
    upright = "\n".join(",".join(line.split(",")[:3]) if line.startswith("GOTO/") else line for line in text.split("\n"))
    (work / "upright.cls").write_text(upright, "utf-8")
    (work / "machine.yaml").write_text(MACHINE, "utf-8")
    command = [clsmith, "axes", "upright.cls", "--setup", "machine.yaml", "--csv", "tips.csv", "-q"]
    subprocess.run(command, cwd=work, check=True, capture_output=True)
    with open(work / "tips.csv", encoding="utf-8", newline="") as table:
        return [tuple(float(row[f"tip_{axis}_mm"]) for axis in "xyz") for row in csv.DictReader(table)]


def draw(before: list, after: list) -> str:
    both = before + after
    low = [min(point[axis] for point in both) for axis in range(3)]
    high = [max(point[axis] for point in both) for axis in range(3)]
    size = [max(high[axis] - low[axis], 1e-9) for axis in range(3)]
    scale = (WIDTH - 2 * MARGIN) / size[0]
    # A view that would be higher than wide is made smaller, with the other one.
    scale = min(scale, 500 / max(size[1], size[2]))
    heights = [size[1] * scale, size[2] * scale]
    total = sum(heights) + GAP + 2 * MARGIN + 30

    def line(points: list, axis: int, top: float, look: str) -> str:
        at = lambda point: (MARGIN + (point[0] - low[0]) * scale, top + (high[axis] - point[axis]) * scale)  # noqa: E731
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(at, points))
        return f'<polyline points="{text}" fill="none" {look}/>\n'

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{total:.0f}" viewBox="0 0 {WIDTH} {total:.0f}" '
           'font-family="sans-serif" font-size="13">\n<rect width="100%" height="100%" fill="white"/>\n']
    top = MARGIN + 15
    for axis, height, name in [(1, heights[0], "x, y"), (2, heights[1], "x, z")]:
        out.append(f'<text x="{MARGIN}" y="{top - 5:.1f}">{name}</text>\n')
        out.append(line(before, axis, top, 'stroke="#b0b0b0" stroke-width="3"'))
        out.append(line(after, axis, top, 'stroke="black" stroke-width="1"'))
        top += height + GAP
    return "".join(out) + "</svg>\n"
