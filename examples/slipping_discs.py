"""Two elastic discs run into each other off centre and slip off: the scene of two_discs.cpp, finer, from Python with a picture.

R = E = rho = 1, nu = 0.3, plane strain, at +-0.05 along x, centres 0.8 apart along y. Other programs find +-(0.0278, 0.0397).
"""
import sys

import numpy as np
from abut import solid

half = 0.5 * np.array([np.sqrt(4.0 - 0.8**2) + 0.02, 0.8])
mesh = solid.combine([solid.disc(centre=-half, name="left"), solid.disc(centre=half, variant=1, name="right")])
shots = []


def look(state):  # after each step
    if state.time > 2.5 * len(shots):
        shots.append((state.time, mesh.points + mesh.at_points(state.displacement), state.von_mises))


result = solid.simulate(mesh, [solid.Material()] * 2, [(0.05, 0.0), (-0.05, 0.0)], time=12.2, law="reconstruction",
                        look=look)
ledger, v = result["ledger"], result["end"][0]["velocity"]
drift = np.ptp(ledger["pseudo_energy"]) / result["energy_scale"]
excess = np.max(ledger["energy"] - ledger["pseudo_energy"]) / result["energy_scale"]
print(f"{result['steps']} steps of {result['dt']:.4f} s in {result['seconds']:.2f} s, left disc ({v[0]:.4f}, {v[1]:.4f}), "
      f"drift of H~ {drift:.0e}, H - H~ {excess:.0e}, {result['contact']['missed_contacts']} missed", *result["warnings"], sep="\n")

import matplotlib
matplotlib.use("Agg")
from matplotlib import pyplot

figure, axes = pyplot.subplots(1, len(shots), figsize=(3 * len(shots), 3), sharey=True, layout="constrained")
for axis, (time, x, stress) in zip(axes, shots):
    axis.tripcolor(x[:, 0], x[:, 1], mesh.cells[0][1], facecolors=stress, vmin=0.0, vmax=0.1)
    axis.set(title=f"t = {time:.1f} s", aspect="equal")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "slipping_discs.png")
sys.exit(0 if np.linalg.norm(v + [0.0278, 0.0397]) < 5e-4 and drift < 1e-12 and excess < 0.01 else 1)
