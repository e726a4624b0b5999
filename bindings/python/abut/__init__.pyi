import os
from typing import Any, Callable, Iterable, Mapping, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import solid as solid
from .detection import CollisionManager as CollisionManager
from .detection import detect as detect
from .solid import Memm2D, Memm3D, Mesh2D, Mesh3D, State2D, State3D

__version__: str

_Doubles = NDArray[np.float64]
_Integers = NDArray[np.int32]
_Scene = Union[str, os.PathLike[str], Mapping[str, Any]]

class Error(Exception):
    status: int
    face_1: int
    face_2: int
    cell: int
    value: float
    allowed: float

class BadInput(Error): ...
class Misuse(Error): ...
class Diverged(Error): ...
class TooDeep(Error): ...
class LimitExceeded(Error): ...
class Cancelled(Error): ...
class InternalError(Error): ...

class NodalContact:
    def __init__(self, nodes: _Doubles, faces: ArrayLike, body: ArrayLike, depth: ArrayLike, stiffness: ArrayLike,
                 offsets: Optional[ArrayLike] = ..., *, shear_stiffness: Optional[ArrayLike] = ...,
                 wanted: Optional[Callable[[int, int], bool]] = ..., cancel: Optional[Callable[[], bool]] = ...,
                 log: Optional[Callable[[int, str], Any]] = ..., law_of: Optional[Callable[[int, int], int]] = ...,
                 laws: list[dict[str, float]] = ..., own_coefficient: Optional[Callable[[float, float, float], float]] = ...,
                 **kwargs: Any) -> None: ...
    def step(self, dt: float, x_0: _Doubles, x_1: _Doubles, out: Optional[_Doubles] = ..., mode: str = ...) -> dict[str, Any]: ...
    def evaluate(self, x: _Doubles, out: Optional[_Doubles] = ...) -> float: ...
    @property
    def pairs(self) -> NDArray[np.void]: ...
    @property
    def bodies(self) -> NDArray[np.void]: ...
    @property
    def body_pairs(self) -> NDArray[np.void]: ...
    @property
    def friction(self) -> NDArray[np.void]: ...
    @property
    def report(self) -> dict[str, Any]: ...
    def stable_step(self, mass: ArrayLike, omega_free: float) -> dict[str, Any]: ...
    def state(self) -> bytes: ...
    def restore(self, state: bytes) -> None: ...
    def surface_replaced(self, nodes: _Doubles, faces: ArrayLike, body: ArrayLike, depth: ArrayLike, stiffness: ArrayLike,
                         old_face_of: ArrayLike, offsets: Optional[ArrayLike] = ..., *,
                         shear_stiffness: Optional[ArrayLike] = ...) -> None: ...

def find_overlaps(nodes: _Doubles, faces: ArrayLike, body: ArrayLike, distance: float,
                  offsets: Optional[ArrayLike] = ...) -> NDArray[np.void]: ...
def limit_threads(n: int) -> None: ...
def skin_stiffness(modulus: float, depth: ArrayLike) -> float: ...
def surface_of(points: _Doubles, cells: Any, body: Optional[ArrayLike] = ..., *, with_cells: bool = ...) -> dict[str, NDArray[Any]]: ...

class Frames:
    step: NDArray[np.int64]
    time: _Doubles
    displacement: _Doubles
    velocity: _Doubles
    stress: _Doubles
    von_mises: _Doubles
    contact_pressure: _Doubles
    point_displacement: _Doubles
    def __init__(self, fields: Mapping[str, Any]) -> None: ...
    def __len__(self) -> int: ...

class Result(dict[str, Any]):
    name: str
    title: str
    comment: str
    mesh: Union[Mesh2D, Mesh3D]
    ledger: NDArray[np.void]
    probes: dict[str, NDArray[np.void]]
    forces: NDArray[np.void]
    frames: Frames
    displacement: _Doubles
    start: list[dict[str, Any]]
    end: list[dict[str, Any]]
    steps: int
    resumed_after: int
    dt: float
    stable_dt: float
    complete: bool
    energy_scale: float
    contact: dict[str, Any]
    warnings: list[str]
    verdict: str
    good: bool
    seconds: float
    summary: dict[str, Any]
    table: str
    out: Optional[os.PathLike[str]]
    def __init__(self, figures: Mapping[str, Any]) -> None: ...
    def show(self, field: Optional[str] = ..., frame: int = ...) -> Any: ...
    def to_pyvista(self, frame: int = ...) -> Any: ...

def run(scene: _Scene, set: Optional[Mapping[str, Any]] = ..., look: Optional[Callable[[Union[State2D, State3D]], Any]] = ...,
        **options: Any) -> Result: ...
def memm(scene: _Scene, set: Optional[Mapping[str, Any]] = ..., outside: Iterable[str] = ..., **options: Any) -> Union[Memm2D, Memm3D]: ...
