import os
from collections.abc import Callable, Iterable, Sequence
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

__version__: str
KINDS: tuple[str, ...]

_Path = str | os.PathLike[str]
_Program = Program | _Path | bytes
_Yaml = dict[str, Any] | _Path
_Progress = Callable[[str, float], object]

@final
class Place:
    file: str
    line: int
    column: int
    span: tuple[int, int]
    message: str

@final
class Finding:
    code: str
    severity: str
    message: str
    help: str | None
    step: int | None
    allowed: bool
    places: list[Place]
    text: str
    @property
    def file(self) -> str | None: ...
    @property
    def line(self) -> int | None: ...
    @property
    def column(self) -> int | None: ...
    @property
    def span(self) -> tuple[int, int] | None: ...

class ClsmithError(Exception):
    findings: list[Finding]
    code: str
    message: str
    help: str | None
    file: str | None
    line: int | None
    column: int | None
    span: tuple[int, int] | None
    def __init__(self, findings: Iterable[Finding]) -> None: ...

@final
class Motions:
    points: NDArray[np.float64]
    axes: NDArray[np.float64]
    lengths: NDArray[np.float64]
    feeds: NDArray[np.float64]
    feeds_mm_min: NDArray[np.float64]
    spindles: NDArray[np.float64]
    kinds: NDArray[np.uint8]
    rapids: NDArray[np.bool_]
    lines: NDArray[np.int64]
    statements: NDArray[np.int64]
    operations: NDArray[np.int64]
    tools: NDArray[np.int64]
    count: int
    @property
    def starts(self) -> NDArray[np.float64]: ...
    def __len__(self) -> int: ...

@final
class Editor:
    def set_numbers(self, statement: int, numbers: dict[int, float]) -> None: ...
    def set_text(self, statement: int, text: bytes) -> None: ...
    def insert_before(self, statement: int, text: bytes) -> None: ...
    def insert_after(self, statement: int, text: bytes) -> None: ...
    def delete(self, statement: int) -> None: ...
    def finish(self) -> Program: ...

@final
class Program:
    @property
    def name(self) -> str: ...
    @property
    def dialect(self) -> str: ...
    @property
    def units(self) -> str: ...
    @property
    def findings(self) -> list[Finding]: ...
    @property
    def operations(self) -> list[str]: ...
    def check(self) -> list[Finding]: ...
    def motions(self) -> Motions: ...
    def text(self, statement: int) -> bytes: ...
    def statements(self) -> list[int]: ...
    def statement_at(self, line: int) -> int: ...
    def edit(self) -> Editor: ...
    def to_bytes(self) -> bytes: ...
    def write(self, path: _Path) -> None: ...
    def __len__(self) -> int: ...

@final
class Correction:
    program: Program
    findings: list[Finding]
    @property
    def reports(self) -> list[dict[str, Any]]: ...

@final
class Simulation:
    findings: list[Finding]
    volumes_mm3: tuple[float, float, float]
    cell_mm: float
    faults: tuple[int, int, int]
    @property
    def columns(self) -> dict[str, NDArray[np.float64] | list[str]]: ...
    def __getitem__(self, name: str, /) -> NDArray[np.float64] | list[str]: ...

@final
class Engagement:
    removed_mm3: NDArray[np.float64]
    axial_depth_mm: NDArray[np.float64]
    radial_depth_mm: NDArray[np.float64]
    advance_ratio: NDArray[np.float32]
    advance_ratio_bound: NDArray[np.float32]
    low_mm: NDArray[np.float32]
    high_mm: NDArray[np.float32]
    findings: list[Finding]

def read(
    source: _Path | bytes,
    *,
    name: str | None = None,
    dialect: str | None = None,
    setup: _Yaml | None = None,
) -> Program: ...
def apply(
    program: _Program,
    recipe: _Yaml,
    *,
    setup: _Yaml | None = None,
    allow: Sequence[str] = (),
    deny: Sequence[str] = (),
    notes: bool = False,
    progress: _Progress | None = None,
) -> Correction: ...
def simulate(
    program: _Program,
    setup: _Yaml,
    *,
    cell_mm: float | None = None,
    certified: bool = True,
    progress: _Progress | None = None,
) -> Simulation: ...
def engagement(
    program: _Program,
    setup: _Yaml,
    *,
    cell_mm: float | None = None,
    progress: _Progress | None = None,
) -> Engagement: ...
