from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def examples() -> Path:
    """The examples of the project."""
    return ROOT / "examples"


@pytest.fixture
def pocket(examples: Path) -> Path:
    return examples / "pocket/part.cls"


@pytest.fixture
def slot() -> bytes:
    """A slot of 10 mm, 2 deep, with four teeth."""
    return b"LOAD/TOOL,3\nSPINDL/RPM,5000,CLW\nRAPID\nGOTO/-10,0,-2\nFEDRAT/MMPM,1000.\nGOTO/30,0,-2\n"


@pytest.fixture
def shop() -> dict:
    return {
        "stock": {"block": {"from": [0, -20, -10], "to": [60, 20, 0]}},
        "tools": [{"match": {}, "diameter": 10, "flute_length": 20, "teeth": 4}],
    }
