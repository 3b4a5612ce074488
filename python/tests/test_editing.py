"""Edits, byte for byte."""

import clsmith
import pytest

TEXT = b"FEDRAT/ 1200.0000, MMPM  $$ roughing\r\nGOTO/  40.0000,0.0000,-1.0000\r\nGOTO/  50.0000,0.0000,-1.0000"


def test_only_the_number_changes():
    program = clsmith.read(TEXT)
    editor = program.edit()
    editor.set_numbers(0, {0: 600.0})
    assert editor.finish().to_bytes() == TEXT.replace(b"1200.0000", b"600.0000")
    assert program.to_bytes() == TEXT


def test_statements_are_inserted_replaced_and_deleted():
    editor = clsmith.read(TEXT).edit()
    editor.insert_before(1, b"COOLNT/ON")
    editor.insert_after(2, b"COOLNT/OFF")
    editor.set_text(1, b"GOTO/1,2,3\r\n")
    editor.delete(0)
    edited = editor.finish()
    assert edited.to_bytes() == b"COOLNT/ON\r\nGOTO/1,2,3\r\nGOTO/  50.0000,0.0000,-1.0000\r\nCOOLNT/OFF"
    assert edited.motions().lines.tolist() == [2, 3]
    assert [edited.text(at) for at in edited.statements()][0].strip() == b"COOLNT/ON"


def test_what_is_no_statement_is_refused():
    program = clsmith.read(TEXT)
    editor = program.edit()
    with pytest.raises(clsmith.ClsmithError) as raised:
        editor.set_text(1, b"GOTO/1,2,3O")
    assert raised.value.code.startswith("CL")
    with pytest.raises(IndexError):
        editor.delete(99)
    with pytest.raises(clsmith.ClsmithError):
        editor.set_numbers(1, {7: 1.0})
    editor.finish()
    with pytest.raises(RuntimeError):
        editor.finish()
    assert program.to_bytes() == TEXT


def test_it_is_written_whole(tmp_path):
    out = tmp_path / "Gehäuse 7" / "out.cls"
    program = clsmith.read(TEXT)
    with pytest.raises(OSError):
        program.write(out)
    out.parent.mkdir()
    program.write(out)
    assert out.read_bytes() == TEXT
    assert [path.name for path in out.parent.iterdir()] == ["out.cls"]


def test_an_edited_program_is_checked_by_its_own_text():
    program = clsmith.read(b"FEDRAT/MMPM,1.\nGOTO/0,0,0\nGOTO/1,0,O\n")
    editor = program.edit()
    editor.set_numbers(1, {0: 5.0})
    assert "CL0003" in [found.code for found in editor.finish().check()]
