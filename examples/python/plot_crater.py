"""A charge on dry sand: the crater from above and as a profile, at three times.

    python3 plot_crater.py [PICTURE]

Read it from top to bottom; each part stands for a cell of a notebook.
"""
import sys

import matplotlib.pyplot as plt
import numpy as np

import divot

# --- The scene: keys as in a scene file, the ground as a function.
world = divot.World({
    "terrain": {"grid": {"columns": 201, "rows": 201, "spacing": 0.05,
                         "height": lambda x, y: 0.08 * np.sin(1.5 * x) * np.cos(1.2 * y)},
                "material": "dry_sand"},
    "bombs": [{"time": 0.0, "position": [0, 0], "yield": 0.001}]})  # a kilogram of TNT

# --- Heights along a line, before, during and after.
x = np.linspace(-3, 3, 400)
profiles = [("at the start", world.ground_height(x, 0.0))]
for time in (0.05, 3.0):
    world.run(time)
    profiles.append((f"after {time:g} s", world.ground_height(x, 0.0)))

# --- The crater in numbers.
crater, soil = world.craters[0], world.soil_volume
print(f"{crater.width:.2f} m wide, {crater.depth:.2f} m deep, lip {crater.lip_height:.3f} m")
print(f"displaced {soil.displaced:.3f} m3, compacted {soil.compacted:.3f}, deposited {soil.deposited:.3f}")

# --- And in a picture.
raster = world.raster()
figure, (above, side) = plt.subplots(1, 2, figsize=(12, 4.5), constrained_layout=True)
most = np.abs(raster["change"]).max()
shown = above.imshow(raster["change"], extent=raster["extent"], cmap="RdBu", vmin=-most, vmax=most)
above.set(xlim=(-3, 3), ylim=(-3, 3), xlabel="x, m", ylabel="y, m", title="Change of height")
figure.colorbar(shown, ax=above, label="m")
for name, heights in profiles:
    side.plot(x, heights, label=name)
side.set(xlabel="x, m", ylabel="height, m", title="Profile")
side.set_aspect("equal", "datalim")
side.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "crater.png", dpi=110)
