"""step_cost.py <scene> <calls>: as step_cost.c, from Python."""
import sys
import time

import numpy as np

import abut

with open(sys.argv[1], "rb") as scene:
    n_nodes, n_faces = np.fromfile(scene, np.int32, 2)
    corners, body = np.fromfile(scene, np.int32, 3 * n_faces), np.fromfile(scene, np.int32, n_faces)
    depth, stiffness = np.fromfile(scene, np.float64, n_faces), np.fromfile(scene, np.float64, 2)
    rest, x_0, x_1 = np.fromfile(scene, np.float64).reshape(3, n_nodes, 3)
calls = int(sys.argv[2])
force = np.zeros((n_nodes, 3))
contact = abut.NodalContact(rest, corners.reshape(n_faces, 3), body, depth, stiffness)
contact.step(1.0, rest, x_0, out=force)
start = time.process_time()
for _ in range(calls):
    step = contact.step(1.0, x_0, x_1, out=force)
seconds = time.process_time() - start
print(f"{1e6 * seconds / calls:.4f} {step['active_pairs']} {step['energy']:.16e}")
