"""forces.py <scene> <file>: as forces.c, from Python."""
import sys

import numpy as np

import abut

OF_PAIR = ("face_1", "face_2", "normal", "gap_0", "gap_1", "area", "normal_force", "force", "active_share", "compression",
           "friction", "slip", "point")
OF_FACE = ("face", "normal_force", "force", "limit", "slip", "dissipated")

with open(sys.argv[1], "rb") as scene, open(sys.argv[2], "wb") as out:
    n_nodes, n_faces, n_steps = np.fromfile(scene, np.int32, 3)
    corners, body = np.fromfile(scene, np.int32, 4 * n_faces), np.fromfile(scene, np.int32, n_faces)
    depth, stiffness = np.fromfile(scene, np.float64, n_faces), np.fromfile(scene, np.float64, 2)
    shear_stiffness, friction = np.fromfile(scene, np.float64, 2), np.fromfile(scene, np.float64, 1)[0]
    x = np.fromfile(scene, np.float64).reshape(n_steps + 1, n_nodes, 3)
    contact = abut.NodalContact(x[0], corners.reshape(n_faces, 4), body, depth, stiffness, shear_stiffness=shear_stiffness,
                                friction=friction)
    for i in range(n_steps):
        force = np.zeros((n_nodes, 3))
        step = contact.step(0.01, x[i], x[i + 1], out=force, mode="end" if i % 2 else "mean")
        pairs, rubbing = contact.pairs, contact.friction
        force.tofile(out)
        np.array([step["energy_0"], step["energy"], len(pairs), step["friction_energy"], step["dissipated"],
                  len(rubbing)]).tofile(out)
        np.column_stack([pairs[name] for name in OF_PAIR]).tofile(out)
        np.column_stack([rubbing[name] for name in OF_FACE]).tofile(out)
