#!/usr/bin/env python3
"""Compares `clsmith chips` with solids: the hull of the cutter before and after each move, cut from the stock.

    python3 benches/swept_volumes.py target/release/clsmith

Needs `pip install manifold3d numpy`. Both get the same 400 moves of a leaning, swinging end mill of 10 mm through a block
(the path of benches/chips.rs), on one thread. The hull holds what a cutter covers between two poses, but for what bulges out
between them where its axis turns; solids are prisms, here of three finenesses. For each the time of the processor, the chips'
volume, and how far single chips are from the ones of the finest layers.
"""
import json
import math
import os
import resource
import subprocess
import sys
import tempfile

import manifold3d
import numpy

RADIUS, LENGTH, MOVES = 5.0, 75.0, 400
BLOCK = ([-20.0, -30.0, -10.0], [220.0, 30.0, 0.0])


def pose(number):
    """The tip and the axis at a place of the path, as the program tells them."""
    s = number * 0.5
    lean, towards = 0.25 + 0.2 * math.sin(s / 9), s / 15
    axis = (math.sin(lean) * math.cos(towards), math.sin(lean) * math.sin(towards), math.cos(lean))
    tip = (s, 12 * math.sin(s / 20), -8 + math.cos(s / 11))
    return [float(f"{value:.6f}") for value in tip + axis]


def program():
    """The path in CL data."""
    goto = lambda number: "GOTO/" + ",".join(f"{value:.6f}" for value in pose(number))
    head = ["LOAD/TOOL,1", "SPINDL/RPM,5000,CLW", "RAPID", goto(0), "FEDRAT/MMPM,1000."]
    return "\n".join(head + [goto(number) for number in range(1, MOVES + 1)]) + "\n"


def seconds(who):
    """Seconds of the processor, of this process or of those that it ran."""
    used = resource.getrusage(who)
    return used.ru_utime + used.ru_stime


def layers(command, folder, layer_mm):
    """The chips' volumes by layers, and the time."""
    outputs = ["--json", "chips.json"]
    before = seconds(resource.RUSAGE_CHILDREN)
    arguments = [command, "chips", "wind.cls", "--setup", "shop.yaml", "--layer", str(layer_mm), "--threads", "1", "-q"]
    subprocess.run(arguments + outputs, cwd=folder, check=True)
    took = seconds(resource.RUSAGE_CHILDREN) - before
    with open(os.path.join(folder, "chips.json"), encoding="utf-8") as file:
        motions = json.load(file)["motions"]
    return [motion["volume_mm3"] for motion in motions], sum(len(motion["layers"]) for motion in motions), took


def placed(cutter, number):
    """The cutter at a place of the path."""
    *tip, i, j, k = pose(number)
    axis = numpy.array([i, j, k]) / math.sqrt(i * i + j * j + k * k)
    across = numpy.cross([0.0, 1.0, 0.0], axis)
    across /= numpy.linalg.norm(across)
    turn = numpy.column_stack([across, numpy.cross(axis, across), axis, tip])
    return cutter.transform(turn)


def solids(segments):
    """The chips' volumes by hulls of the cutter, and the time."""
    cutter = manifold3d.Manifold.cylinder(LENGTH, RADIUS, circular_segments=segments)
    low, high = BLOCK
    size = [upper - lower for lower, upper in zip(low, high)]
    before = seconds(resource.RUSAGE_SELF)
    stock = manifold3d.Manifold.cube(size).translate(low) - placed(cutter, 0)
    left, volumes = stock.volume(), []
    for number in range(MOVES):
        swept = manifold3d.Manifold.batch_hull([placed(cutter, number), placed(cutter, number + 1)])
        stock = stock - swept
        now = stock.volume()
        volumes.append(left - now)
        left = now
    return volumes, seconds(resource.RUSAGE_SELF) - before


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    command = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "wind.cls"), "w", encoding="utf-8") as file:
            file.write(program())
        with open(os.path.join(folder, "shop.yaml"), "w", encoding="utf-8") as file:
            file.write(f"stock: {{ block: {{ from: {BLOCK[0]}, to: {BLOCK[1]} }} }}\n")
            file.write(f"tools: [ {{ match: {{}}, diameter: {2 * RADIUS}, flute_length: {LENGTH}, teeth: 4 }} ]\n")
        right, _, _ = layers(command, folder, 0.05)

        def tell(name, volumes, took):
            off = [abs(found - real) for found, real in zip(volumes, right)]
            print(
                f"{name:<28} {took:7.2f} s {MOVES / took:8.1f} moves/s {sum(volumes):10.1f} mm3, "
                f"a chip is off by {sum(off) / sum(right) * 100:.2f} % in the mean"
            )

        tell("layers of 0.05 mm", right, layers(command, folder, 0.05)[2])
        for layer_mm in (1.0, 0.5, 0.2):
            volumes, sections, took = layers(command, folder, layer_mm)
            tell(f"layers of {layer_mm} mm", volumes, took)
            print(f"{'':<28} {sections / took:.0f} sections of layers a second, the JSON included")
        for segments in (32, 64, 128):
            tell(f"hulls of {segments} sides", *solids(segments))


if __name__ == "__main__":
    main()
