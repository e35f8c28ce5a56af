import ast
import gc
import os
import pathlib

import numpy as np
import pytest

import divot

SCENES = pathlib.Path(os.environ["DIVOT_SCENES"])
GRID = {"columns": 41, "rows": 31, "spacing": 0.1}


def small(**more):
    return {"terrain": {"grid": GRID, "material": "mud"},
            "bodies": [{"name": "ball", "shape": {"sphere": {"radius": 0.4}}, "mass": 300, "position": [0, 0]}], **more}


def test_a_scene_file_gives_the_bits_of_the_library():
    one, four = (divot.World(SCENES / "paper.toml", threads=n, changes={"duration": 1.0}) for n in (1, 4))
    one.run(), four.run()
    assert one.time == pytest.approx(1) and one.state_hash == four.state_hash
    from_scene = divot.World(divot.load_scene(SCENES / "paper.toml", {"duration": 1.0}))
    from_scene.step(one.steps)
    assert from_scene.state_hash == one.state_hash


def test_views_are_the_world_s_own_memory():
    world = divot.World(small())
    positions = world.positions
    assert positions.shape == (41 * 31, 3) and positions.dtype == np.float32
    assert not positions.flags.owndata and not positions.flags.writeable
    assert np.shares_memory(positions, world.positions)
    assert world.triangles.shape == (2 * 40 * 30, 3) and np.shares_memory(world.triangles, world.triangles)
    with pytest.raises(ValueError):
        positions[0, 0] = 1
    before = positions.copy()
    world.run(1)
    moved = np.flatnonzero((world.positions != before).any(axis=1))
    assert 0 < len(moved) < len(before)
    # The array keeps the world's memory alive.
    del world
    gc.collect()
    assert np.isfinite(positions).all()


def test_dirty_ranges_name_all_that_moved():
    world = divot.World(small())
    world.take_dirty()
    before = world.positions.copy()
    world.run(0.5)
    dirty = world.take_dirty()
    assert dirty.dtype == np.uint32 and dirty.shape[1] == 2
    named = np.zeros(len(before), bool)
    for first, last in dirty:
        named[first:last] = True
    assert named[(world.positions != before).any(axis=1)].all()
    assert len(world.take_dirty()) == 0


def test_topology_follows_new_triangles():
    settings = small()
    settings["terrain"] = {"grid": {"columns": 11, "rows": 9, "spacing": 0.4}, "material": "mud",
                           "refine": {"min_edge": 0.1}}
    world = divot.World(settings)
    assert len(world.take_topology()["triangles"]) == 0
    before = world.triangles.copy()
    world.run(0.5)
    topology = world.take_topology()
    named = np.zeros(len(world.triangles), bool)
    for first, last in topology["triangles"]:
        named[first:last] = True
    assert named[len(before):].all()
    assert named[:len(before)][(world.triangles[:len(before)] != before).any(axis=1)].all()
    assert len(topology["added"]) - len(topology["removed"]) == world.refinement["vertices"] > 0
    assert (topology["added"] >= world.refinement["base_vertices"]).all()
    assert world.raster()["height"].shape == (9, 11) and world.raster(0.1)["height"].shape == (33, 41)


def test_joints_are_driven():
    settings = small()
    settings["bodies"][0]["above_ground"] = True
    settings["joints"] = [{"name": "axle", "type": "hinge", "second": "ball", "axis": [0, 1, 0]}]
    world = divot.World(settings)
    world.set_motor(0, 3.0, 1e5)
    world.run(0.5)
    assert world.joints[0].name == "axle" and world.joints[0].speed == pytest.approx(3, rel=0.05)
    with pytest.raises(IndexError):
        world.set_steering(1, 10)


def test_particles_are_those_awake():
    world = divot.World(small())
    world.run(0.1)
    p = world.particles
    assert len(p["vertices"]) == len(p["x"]) == len(p["hold"]) > 10
    assert (np.diff(p["vertices"].astype(int)) > 0).all()
    assert np.allclose(np.stack([p["x"], p["y"], p["z"]], 1), world.positions[p["vertices"]])
    assert set(p["hold"]) <= {divot.FREE, divot.CARRIED, divot.ANCHOR, divot.ASLEEP}


def test_heights_may_be_a_function():
    world = divot.World({"terrain": {"grid": {**GRID, "height": lambda x, y: 0.5 * x + y}}})
    assert world.ground_height(0.7, -0.3) == pytest.approx(0.05, abs=1e-6)
    heights = world.ground_height(np.array([0.0, 1.0, 99.0]), 0.0)
    assert heights[:2] == pytest.approx([0, 0.5], abs=1e-6) and np.isnan(heights[2])


def test_terrain_may_be_a_mesh():
    vertices = np.array([[0, 0, 0], [4, 0, 1], [4, 4, 2], [0, 4, 1]], float)
    world = divot.World({"terrain": {"mesh": {"vertices": vertices, "triangles": [[0, 1, 2], [0, 2, 3]]}}})
    assert world.ground_height(3, 1) == pytest.approx(1)
    assert world.raster() is None
    with pytest.raises(divot.Error, match="no triangle faces up"):
        divot.World({"terrain": {"mesh": {"vertices": vertices, "triangles": [[0, 2, 1]]}}})


def test_errors_are_those_of_the_command_line(tmp_path):
    file = tmp_path / "bad.toml"
    file.write_text("duration = -1\n[terrain]\ngrid = { columns = 5, rows = 5, spacing = 1 }\nmaterail = 'mud'\n")
    with pytest.raises(divot.Error) as caught:
        divot.World(file)
    text = str(caught.value)
    assert f"{file}:1: duration: -1 is out of range; expected a number > 0" in text
    assert f"{file}:4: terrain.materail: unknown key; the nearest known key is material" in text
    assert [p.line for p in caught.value.problems] == [1, 4]
    with pytest.raises(divot.Error, match=r"^bodies\[0\].mass: -3 is out of range; expected a number > 0"):
        divot.World(small(bodies=[{"shape": {"sphere": {"radius": 1}}, "mass": -3, "position": [0, 0]}]))
    with pytest.raises(divot.Error, match="does not exist|cannot be read|No such file"):
        divot.World(tmp_path / "none.toml")
    with pytest.raises(TypeError, match="a scene cannot hold"):
        divot.World({"terrain": {"grid": GRID}, "seed": object()})


def test_things_are_added_while_it_runs():
    world = divot.World({"terrain": {"grid": GRID, "material": "dry_sand"}})
    assert world.spawn(name="late", shape={"sphere": {"radius": 0.2}}, mass=50, position=[1, 0]) == 0
    world.add_bomb(position=[-1, 0], **{"yield": 1e-5})
    world.run(1.5)
    assert world.bodies[0].name == "late" and world.craters[0].depth > 0.01
    assert world.sinkage().max() == pytest.approx(-(world.raster()["change"].min()), rel=0.2)
    assert world.soil_volume.displaced > 0 and world.energy.bodies_kinetic >= 0
    with pytest.raises(divot.Error, match="yield: -1"):
        world.add_bomb(position=[0, 0], **{"yield": -1})


def test_goes_on_from_saved_state():
    world = divot.World(small())
    world.run(0.1)
    other = divot.World(small(), threads=2, state=world.save())
    assert other.time == world.time
    for w in (world, other):
        w.run(0.3)
    assert other.state_hash == world.state_hash
    with pytest.raises(divot.Error, match="the state of a world is damaged"):
        divot.World(small(), state=b"no")


def test_results_are_written(tmp_path):
    world = divot.World(small(output={"formats": ["vtp", "obj"]}))
    recorder = divot.Recorder(str(tmp_path / "out"))
    recorder.write_frame(world)
    world.run(0.2)
    recorder.add_bodies(world)
    recorder.finish(world)
    for name in ("frame_000000.vtp", "terrain_final.obj", "summary.json", "bodies.csv", "frames.pvd"):
        assert (tmp_path / "out" / name).stat().st_size > 0
    (tmp_path / "file").write_text("")
    with pytest.raises(divot.Error, match="cannot be written"):
        divot.Recorder(str(tmp_path / "file" / "inside"))


def test_stubs_name_what_is_there():
    stub = ast.parse((pathlib.Path(divot.__file__).parent / "__init__.pyi").read_text())
    for node in stub.body:
        if isinstance(node, ast.FunctionDef):
            assert callable(getattr(divot, node.name))
        if not isinstance(node, ast.ClassDef) or node.name in ("Particles", "Raster", "Refinement", "Topology"):
            continue
        members = {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
        members |= {n.target.id for n in node.body if isinstance(n, ast.AnnAssign)}
        real = {name for name in dir(getattr(divot, node.name)) if not name.startswith("_")} - set(dir(ValueError))
        assert real - {"problems"} == {m for m in members if not m.startswith("_")} - {"problems"}, node.name
    assert set(divot.__all__) <= set(dir(divot))
