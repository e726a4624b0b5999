"""A finite element code in numpy with contact by Abut: two discs of triangles run into each other off centre and slip off.

R = E = rho = 1, nu = 0.3, plane strain, small strain, at +-0.05 along x, centres 0.8 apart along y; central differences. Other
codes of this kind find that the left disc leaves at (-0.0279, -0.0400). With --friction MU, up to 0.08, they slide all along, and
friction takes what it takes from rigid discs, to 5 %.
"""
import argparse
import sys

import numpy as np

import abut

arguments = argparse.ArgumentParser(description=__doc__)
arguments.add_argument("--friction", type=float, default=0.0)
friction = arguments.parse_args().friction
lam, mu, rings, frictionless = 0.3 / (1.3 * 0.4), 0.5 / 1.3, 13, np.array([-0.0279, -0.0400])


def disc(centre, turn):
    """Nodes, triangles and boundary faces of a disc: ring r has 6 r nodes."""
    def node(r, k):
        return 0 if r == 0 else 1 + 3 * r * (r - 1) + k % (6 * r)
    x = [centre] + [np.add(centre, r / rings * np.array([np.cos(a), np.sin(a)]))
                    for r in range(1, rings + 1) for a in 2 * np.pi * np.arange(6 * r) / (6 * r) + turn]
    triangles, behind = [], []
    for r in range(1, rings + 1):
        for out in range(6 * r):
            side, k = divmod(out, r)
            inner = side * (r - 1) + k
            if r == rings:
                behind.append(len(triangles))
            triangles.append([node(r - 1, inner), node(r, out), node(r, out + 1)])
            if k < r - 1:
                triangles.append([node(r - 1, inner), node(r, out + 1), node(r - 1, inner + 1)])
    faces = [[node(rings, k), node(rings, k + 1)] for k in range(6 * rings)]
    return np.array(x), np.array(triangles), np.array(faces), np.array(behind)


left, right = disc((0.0, 0.0), 0.0), disc((np.sqrt(2.02**2 - 0.8**2), 0.8), 0.1)
n = len(left[0])
rest = np.vstack([left[0], right[0]])
triangles = np.vstack([left[1], right[1] + n])
faces = np.vstack([left[2], right[2] + n])
behind = np.concatenate([left[3], right[3] + len(left[1])])

corners = rest[triangles]  # (elements, 3, 2)
p, q = np.roll(corners, -1, axis=1), np.roll(corners, -2, axis=1)
slope = np.stack([p[..., 1] - q[..., 1], q[..., 0] - p[..., 0]], axis=-1)
area = 0.5 * (slope[:, 1, 0] * slope[:, 2, 1] - slope[:, 1, 1] * slope[:, 2, 0])
slope /= 2.0 * area[:, None, None]
mass = np.zeros(2 * n)
np.add.at(mass, triangles, area[:, None] / 3.0)
omega = np.sqrt(3.0 * (lam + 3.0 * mu) * (slope**2).sum(axis=(1, 2)).max())

depth = area[behind] / np.linalg.norm(rest[faces[:, 1]] - rest[faces[:, 0]], axis=1)
k = abut.skin_stiffness(lam + 2.0 * mu, depth)
body = np.repeat([0, 1], len(left[2]))
k_t = mu / (lam + 2.0 * mu) * k  # friction alone reads it
contact = abut.NodalContact(rest, faces, body, depth, [k, k], shear_stiffness=[k_t, k_t], friction=friction,
                            log=lambda severity, text: print(text))
dt = contact.stable_step(mass, omega)["dt"]

x, v, f = rest.copy(), np.zeros_like(rest), np.zeros_like(rest)
v[:n, 0], v[n:, 0] = 0.05, -0.05
for step in range(int(15.0 / dt) + 1):
    new = x + dt * v
    f[:] = 0.0
    contact.step(dt, x, new, out=f, mode="end")
    x = new
    g = np.einsum("eia,eib->eab", (x - rest)[triangles], slope)
    stress = lam * np.trace(g, axis1=1, axis2=2)[:, None, None] * np.eye(2) + mu * (g + g.transpose(0, 2, 1))
    np.subtract.at(f, triangles, area[:, None, None] * np.einsum("eab,eib->eia", stress, slope))
    v += dt * f / mass[:, None]

velocity = (mass[:n, None] * v[:n]).sum(axis=0) / mass[:n].sum()
print(f"{step + 1} steps of {dt:.4f}, left disc: ({velocity[0]:.4f}, {velocity[1]:.4f}), momentum of both "
      f"{np.linalg.norm((mass[:, None] * v).sum(axis=0)):.0e}, {contact.report['missed_contacts']} missed")
is_right = contact.report["missed_contacts"] == 0
if friction == 0.0:
    is_right &= np.linalg.norm(velocity - frictionless) < 0.01 * 0.0488
else:  # rigid discs meet with this normal impulse over m, and each kg m/s along their faces slows sliding by 3/m on each disc
    impulse = np.linalg.norm(frictionless - [0.05, 0.0])
    sliding = 0.1 * abs(frictionless[1]) / impulse
    taken = contact.report["friction_dissipated"] / (0.5 * mass.sum() * 0.05**2)  # over K0
    expected = friction * impulse * (sliding - 3.0 * friction * impulse) / 0.05**2
    print(f"friction took {taken:.4f} of K0, {expected:.4f} of rigid discs")
    is_right &= abs(taken - expected) < 0.05 * expected
sys.exit(0 if is_right else 1)
