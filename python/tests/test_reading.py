"""Programs, motions and findings."""

import clsmith
import numpy as np
import pytest


def test_a_path_and_bytes_are_the_same_program(pocket):
    by_path, by_bytes = clsmith.read(str(pocket)), clsmith.read(pocket.read_bytes(), name="part.cls")
    assert by_path.to_bytes() == by_bytes.to_bytes() == pocket.read_bytes()
    assert (by_path.dialect, by_path.units) == ("nx", "mm")
    assert by_bytes.name == "part.cls"
    assert "POCKET_ROUGH" in by_path.operations
    assert by_path.findings == [] and by_path.check() == []


def test_motions_are_arrays():
    text = b"LOAD/TOOL,7\r\nRAPID\r\nGOTO/0,0,2\r\nFEDRAT/MMPM,300.\r\nGOTO/0,0,-1,0.6,0,0.8\r\nGOTO/30,0,-1\r\n"
    motions = clsmith.read(text).motions()
    assert len(motions) == motions.count == 3
    assert motions.points.tolist() == [[0, 0, 2], [0, 0, -1], [30, 0, -1]]
    assert motions.starts.tolist() == [[0, 0, 2], [0, 0, 2], [0, 0, -1]]
    assert np.allclose(motions.axes[1], [0.6, 0, 0.8])
    assert motions.lengths.tolist() == [0, 3, 30]
    assert np.isnan(motions.feeds[0]) and motions.feeds[1:].tolist() == [300, 300]
    assert [clsmith.KINDS[kind] for kind in motions.kinds][0] == "rapid"
    assert motions.rapids.tolist() == [True, False, False]
    assert motions.lines.tolist() == [3, 5, 6]
    assert motions.tools.tolist() == [7, 7, 7]
    assert motions.points.dtype == motions.feeds.dtype == np.float64
    assert motions.kinds.dtype == np.uint8 and motions.lines.dtype == np.int64


def test_arrays_are_memory_of_their_own_and_not_copies_of_each_access(pocket):
    motions = clsmith.read(pocket).motions()
    assert motions.points is motions.points
    assert motions.points.flags["C_CONTIGUOUS"] and motions.points.base is not None
    before = clsmith.read(pocket).to_bytes()
    motions.points[:] = 0
    assert clsmith.read(pocket).to_bytes() == before


@pytest.mark.parametrize("end", [b"\n", b"\r\n", b"\r"])
def test_lines_count_every_line_end(end):
    text = end.join([b"FEDRAT/MMPM,1.", b"", b"GOTO/1,2,3", b"$$ words", b"GOTO/2,3,4", b""])
    program = clsmith.read(text)
    assert program.motions().lines.tolist() == [3, 5]
    assert program.text(program.statement_at(5)).startswith(b"GOTO/2")


def test_feeds_have_two_units():
    text = b"UNITS/INCHES\nSPINDL/RPM,1000,CLW\nGOTO/0,0,0\nFEDRAT/0.01,IPR\nGOTO/1,0,0\n"
    motions = clsmith.read(text, dialect="catia").motions()
    assert motions.feeds[-1] == 0.01
    assert motions.feeds_mm_min[-1] == pytest.approx(0.01 * 25.4 * 1000)


def test_findings_are_objects():
    program = clsmith.read(b"RAPID\nGOTO/10.000,12.5O00,-4.0000\n", name="part.cls")
    (found,) = program.findings
    assert (found.code, found.severity) == ("CL0003", "error")
    assert (found.file, found.line, found.column) == ("part.cls", 2, 13)
    assert program.to_bytes()[slice(*found.span)] == b"12.5O00"
    assert found.message == "`12.5O00` is not a number" and "decimal point" in found.help
    assert found.places[0].span == found.span
    assert str(found) == "part.cls:2:13: CL0003: `12.5O00` is not a number"
    assert found.code in [one.code for one in program.check()]


def test_a_check_tells_more_than_reading():
    program = clsmith.read(b"SPINDL/RPM,5000,CLW\nFROM/0,0,50\nGOTO/0,0,0\n")
    assert program.findings == []
    assert [found.severity for found in program.check()] == ["warning", "note"]


def test_what_is_no_file_is_an_exception_with_a_code(tmp_path):
    with pytest.raises(clsmith.ClsmithError) as raised:
        clsmith.read(tmp_path / "missing.cls")
    assert raised.value.code.startswith("CL") and "missing.cls" in raised.value.message
    with pytest.raises(TypeError):
        clsmith.read(7)
    with pytest.raises(ValueError, match="nx"):
        clsmith.read(b"GOTO/1,2,3\n", dialect="nx12")


def test_an_empty_program_has_no_motions():
    motions = clsmith.read(b"$$ nothing\n").motions()
    assert motions.points.shape == (0, 3) and motions.feeds.shape == (0,)
