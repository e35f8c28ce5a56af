"""divot deforms terrain physically: bombs leave craters, what rolls leaves ruts.

    import divot
    world = divot.World({"terrain": {"grid": {"columns": 101, "rows": 101, "spacing": 0.1}, "material": "dry_sand"},
                         "bombs": [{"time": 0.5, "position": [0, 0], "yield": 0.001}]})
    world.run(3)
    print(world.craters[0].width)

A scene is a dict with the keys of a scene file, or the path of one. Beyond the file, `terrain.grid.height` may be a
function of x and y, and `terrain.mesh` a dict of the arrays `vertices` (n, 3) and `triangles` (m, 3).

Where the scene asks for new triangles (`terrain.refine`), take_topology() says which came and went since the last call:
`triangles` (n, 2), ranges [first, last) that have other corners, `added` and `removed` vertices. What came is among
take_dirty()'s ranges too.

Arrays that a world hands out (`positions`, `triangles`, `materials`, those of `particles`) are views of its memory, without
a copy and not to be written. They are valid until the world's next step: take them anew then, or copy() what is to stay.
"""

import os

from . import _divot, _toml
from ._divot import (Body, Crater, Energy, Joint, Problem, Recorder, Report, Scene, SoilVolume, StepReport, __version__,
                     check)
from ._error import Error

__all__ = ["Body", "Crater", "Energy", "Error", "Joint", "Problem", "Recorder", "Report", "Scene", "SoilVolume",
           "StepReport", "World", "check", "load_scene", "scene", "__version__"]

FREE, CARRIED, ANCHOR, ASLEEP = range(4)  # what particles["hold"] says: forces, a body, nothing, nothing any more


def load_scene(path, changes=None):
    """Reads a scene file. `changes`: {dotted key: value}, as `--set` of the command line. Raises Error."""
    return _divot._load_scene(os.fspath(path), [(k, _toml.value_text(v)) for k, v in (changes or {}).items()])


def scene(settings, folder="."):
    """Makes a Scene of a dict; relative paths in it start at `folder`. Raises Error."""
    settings = dict(settings)
    terrain = dict(settings.get("terrain", {}))
    grid = terrain.get("grid")
    height = mesh = None
    if isinstance(grid, dict) and callable(grid.get("height")):
        terrain["grid"] = {key: value for key, value in grid.items() if key != "height"}
        height = grid["height"]
    if isinstance(terrain.get("mesh"), dict):
        mesh = terrain.pop("mesh")
        terrain["grid"] = {"columns": 2, "rows": 2, "spacing": 1.0}  # stands in until the mesh is set
    if "terrain" in settings:
        settings["terrain"] = terrain
    made = _divot._parse_scene(_toml.document(settings), os.fspath(folder))
    if height is not None:
        made._set_height(height)
    if mesh is not None:
        made._set_mesh(mesh["vertices"], mesh["triangles"])
    return made


class World(_divot.World):
    """Ground, bodies and bombs that move together. `scene`: a dict, a path or a Scene. `threads`: 0 takes all cores;
    results do not depend on it. `changes` go on top of a scene file. `state`: what save() gave of a world of that scene,
    which goes on from there with the same bits. Raises Error."""

    def __init__(self, scene, threads=1, changes=None, state=None):
        if isinstance(scene, (str, os.PathLike)):
            scene = load_scene(scene, changes)
        elif isinstance(scene, dict):
            if changes:
                raise TypeError("changes are for scene files; change the dict instead")
            scene = globals()["scene"](scene)
        super().__init__(scene, threads, state)

    def run(self, until=None):
        """Steps until the time `until`, s, or the scene's duration. Returns what happened, as step() does."""
        until = self.duration if until is None else until
        return self.step(max(0, round((until - self.time) / self.dt)))

    def spawn(self, **body):
        """Adds a body now, with the keys of `[[bodies]]`; returns its index in `bodies`. Raises Error."""
        return self._spawn(_alone(bodies=[body]))[0]

    def add_bomb(self, **bomb):
        """Adds a bomb, with the keys of `[[bombs]]`; one whose time has passed goes off in the next step. Raises Error."""
        self._add_bombs(_alone(bombs=[bomb]))


def _alone(**what):
    return scene({"terrain": {"grid": {"columns": 2, "rows": 2, "spacing": 1.0}}, **what})
