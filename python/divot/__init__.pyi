import os
from typing import Any, Mapping, Optional, Sequence, Tuple, TypedDict, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

Triple = Tuple[float, float, float]
Path = Union[str, "os.PathLike[str]"]

__version__: str
FREE: int
CARRIED: int
ANCHOR: int
ASLEEP: int

class Problem:
    file: str
    line: int
    key: str
    problem: str
    expected: str

class Error(ValueError):
    problems: list[Problem]
    def __init__(self, problems: Sequence[Problem]) -> None: ...

class Scene:
    name: str
    @property
    def duration(self) -> float: ...
    @property
    def dt(self) -> float: ...

class StepReport:
    substeps: int
    substeps_limited: bool
    refinement_limited: bool
    not_finite: bool

class Crater:
    position: Triple
    yield_t: float
    width: float
    depth: float
    lip_height: float
    volume: float
    paper_width: float

class SoilVolume:
    displaced: float
    compacted: float
    deposited: float
    relative_error: float

class Energy:
    bodies_kinetic: float
    bodies_potential: float
    ground_kinetic: float

class Body:
    name: str
    radius: float
    mass: float
    position: Triple
    velocity: Triple
    angular_velocity: Triple
    orientation: Tuple[float, float, float, float]
    sinkage: float
    max_sinkage: float
    touching: bool
    off_terrain: bool

class Joint:
    name: str
    position: float
    speed: float
    motor_force: float

class Topology(TypedDict):
    triangles: NDArray[np.uint32]
    added: NDArray[np.uint32]
    removed: NDArray[np.uint32]

class Refinement(TypedDict):
    on: bool
    edge: float
    base_vertices: int
    vertices: int
    most: int
    budget: int
    halved: int
    joined: int
    short_steps: int

class Particles(TypedDict):
    vertices: NDArray[np.uint32]
    x: NDArray[np.float32]
    y: NDArray[np.float32]
    z: NDArray[np.float32]
    vx: NDArray[np.float32]
    vy: NDArray[np.float32]
    vz: NDArray[np.float32]
    mass: NDArray[np.float32]
    hold: NDArray[np.uint8]

class Raster(TypedDict):
    height: NDArray[np.float32]
    change: NDArray[np.float32]
    sinkage: NDArray[np.float32]
    transform: Tuple[float, float, float, float, float, float]
    extent: Tuple[float, float, float, float]
    crs: str
    file_crs: str

class World:
    def __init__(self, scene: Union[Mapping[str, Any], Path, Scene], threads: int = ...,
                 changes: Optional[Mapping[str, Any]] = ..., state: Optional[bytes] = ...) -> None: ...
    def save(self) -> bytes: ...
    def step(self, count: int = ...) -> StepReport: ...
    def run(self, until: Optional[float] = ...) -> StepReport: ...
    def spawn(self, **body: Any) -> int: ...
    def add_bomb(self, **bomb: Any) -> None: ...
    @property
    def time(self) -> float: ...
    @property
    def steps(self) -> int: ...
    @property
    def dt(self) -> float: ...
    @property
    def duration(self) -> float: ...
    @property
    def name(self) -> str: ...
    @property
    def origin(self) -> Triple: ...
    @property
    def spacing(self) -> float: ...
    @property
    def positions(self) -> NDArray[np.float32]: ...
    @property
    def triangles(self) -> NDArray[np.uint32]: ...
    @property
    def materials(self) -> NDArray[np.uint8]: ...
    @property
    def material_names(self) -> list[str]: ...
    @property
    def particles(self) -> Particles: ...
    @property
    def bodies(self) -> list[Body]: ...
    @property
    def joints(self) -> list[Joint]: ...
    @property
    def craters(self) -> list[Crater]: ...
    @property
    def soil_volume(self) -> SoilVolume: ...
    @property
    def energy(self) -> Energy: ...
    @property
    def stages(self) -> dict[str, dict[str, float]]: ...
    @property
    def refinement(self) -> Refinement: ...
    @property
    def state_hash(self) -> int: ...
    def sinkage(self) -> NDArray[np.float32]: ...
    def pressure(self) -> NDArray[np.float32]: ...
    def ground_height(self, x: ArrayLike, y: ArrayLike) -> Any: ...
    def raster(self, spacing: float = ...) -> Optional[Raster]: ...
    def take_dirty(self) -> NDArray[np.uint32]: ...
    def take_topology(self) -> Topology: ...
    def set_motor(self, joint: int, speed: float, force: float) -> None: ...
    def set_steering(self, joint: int, angle_deg: float) -> None: ...

class Recorder:
    def __init__(self, folder: str) -> None: ...
    def add_bodies(self, world: World) -> None: ...
    def write_frame(self, world: World) -> None: ...
    def finish(self, world: World, wall_s: float = ...) -> None: ...

class Report:
    def __init__(self, scene_text: str = ...) -> None: ...
    def add(self, world: World) -> None: ...
    def write(self, path: str, world: World, wall_s: float = ...) -> None: ...

def check(scene: Scene) -> list[Problem]: ...
def load_scene(path: Path, changes: Optional[Mapping[str, Any]] = ...) -> Scene: ...
def scene(settings: Mapping[str, Any], folder: Path = ...) -> Scene: ...
