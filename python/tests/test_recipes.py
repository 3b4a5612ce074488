"""Recipes from dicts, text and files; progress, Ctrl-C, exceptions."""

import json
import os
import signal
import subprocess
import sys
import threading
import time

import clsmith
import pytest

SLOWER = {"version": 1, "steps": [{"scale_feed": {"factor": 0.5}}]}
PART = b"FEDRAT/MMPM,800.\nGOTO/0,0,0\nGOTO/9,0,0\n"


def test_a_dict_a_text_and_a_path_are_the_same_recipe(tmp_path):
    text = "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n"
    path = tmp_path / "slower.yaml"
    path.write_text(text)
    for recipe in (SLOWER, text, path, str(path), json.dumps(SLOWER, indent=1)):
        assert clsmith.apply(PART, recipe).program.to_bytes() == PART.replace(b"800.", b"400.")


def test_the_example_is_corrected_as_by_the_command(pocket, examples):
    corrected = clsmith.apply(pocket, examples / "pocket/recipe.yaml")
    text = corrected.program.to_bytes()
    assert text.count(b"FEDRAT/MMPM,600.0000") == 1 and b"COOLNT/THRU" in text
    assert text != pocket.read_bytes()


def test_an_edited_program_goes_through_a_recipe():
    editor = clsmith.read(PART).edit()
    editor.set_numbers(0, {0: 600.0})
    assert clsmith.apply(editor.finish(), SLOWER).program.to_bytes().startswith(b"FEDRAT/MMPM,300.")


def test_a_mistake_in_a_recipe_is_an_exception_with_its_place():
    with pytest.raises(clsmith.ClsmithError) as raised:
        clsmith.apply(PART, "version: 1\nsteps:\n  - scale_feed: { factor: -2 }\n")
    error = raised.value
    assert (error.file, error.line, error.column) == ("recipe", 3, 27)
    assert error.span[0] < error.span[1] and error.code.startswith("CL")
    assert error.code in str(error)


def test_a_mistake_in_the_program_is_an_exception_and_no_program():
    with pytest.raises(clsmith.ClsmithError) as raised:
        clsmith.apply(b"FEDRAT/MMPM,800.\nGOTO/0,0,O\n", SLOWER)
    assert raised.value.code == "CL0003" and raised.value.line == 2 and raised.value.help


def test_codes_are_allowed_and_denied():
    with pytest.raises(ValueError, match="CL9999"):
        clsmith.apply(PART, SLOWER, allow=["CL9999"])
    without_feed = b"SPINDL/RPM,5000,CLW\nFROM/0,0,50\nGOTO/0,0,0\n"
    (code,) = {one.code for one in clsmith.apply(without_feed, SLOWER).findings if one.severity == "warning" and one.line == 3}
    with pytest.raises(clsmith.ClsmithError):
        clsmith.apply(without_feed, SLOWER, deny=["warnings"])
    assert any(one.allowed for one in clsmith.apply(without_feed, SLOWER, deny=["warnings"], allow=[code]).findings)


def test_progress_is_told_on_the_calling_thread():
    told = []
    clsmith.apply(PART, SLOWER, progress=lambda phase, part: told.append((phase, part, threading.get_ident())))
    assert {"reading", "correcting"} <= {phase for phase, _, _ in told}
    assert all(0 <= part <= 1 and thread == threading.get_ident() for _, part, thread in told)


def test_an_exception_of_the_callback_ends_the_work():
    def refuse(phase, part):
        raise LookupError(phase)

    with pytest.raises(LookupError):
        clsmith.apply(PART, SLOWER, progress=refuse)


LONG = """
import clsmith, sys
turns = "".join(f"GOTO/{(k * 37) % 200},{(k * 91) % 200},-{1 + k % 9}\\n" for k in range(200000))
part = ("LOAD/TOOL,3\\nSPINDL/RPM,5000,CLW\\nFEDRAT/MMPM,900.\\n" + turns).encode()
shop = {"stock": {"block": {"from": [0, 0, -20], "to": [200, 200, 0]}},
        "tools": [{"match": {}, "diameter": 4, "flute_length": 30, "teeth": 2}]}
def told(phase, part):
    if phase == "simulating":
        print("running", flush=True)
try:
    clsmith.engagement(part, shop, progress=told)
except KeyboardInterrupt:
    print("stopped", flush=True)
    sys.exit(7)
"""


@pytest.mark.skipif(os.name == "nt", reason="a signal to one process alone is of other systems")
def test_ctrl_c_is_a_keyboard_interrupt():
    with subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout.readline() == "running\n"
        begun = time.monotonic()
        child.send_signal(signal.SIGINT)
        rest, _ = child.communicate(timeout=120)
        assert rest.splitlines()[-1] == "stopped" and child.returncode == 7
        assert time.monotonic() - begun < 30


def test_threads_of_python_run_beside_it():
    results = []
    threads = [threading.Thread(target=lambda: results.append(clsmith.apply(PART, SLOWER).program.to_bytes()))
               for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 4 and len(set(results)) == 1
