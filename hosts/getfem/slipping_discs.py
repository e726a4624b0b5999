"""Contact in GetFEM: two discs of triangles run into each other off centre and slip off. GetFEM assembles, Abut gives the forces of contact.

R = E = rho = 1, nu = 0.3, plane strain, small strain, at +-0.05 along x, centres 0.8 apart along y. Other codes of this kind find that
the left disc leaves at (-0.0279, -0.0400). --scheme memm takes mean forces over steps, so that the pseudo-energy H~ is kept. With
--friction MU, up to 0.08, they slide all along: H~, with what faces that stick hold, falls by what friction takes, and that is what
rigid discs lose, to 5 %.
"""
import argparse
import pathlib
import sys

import getfem
import numpy as np

import abut

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "dolfinx"))
from discs import slipping_discs  # noqa: E402  points and cells

arguments = argparse.ArgumentParser(description=__doc__)
arguments.add_argument("--scheme", choices=("central", "memm"), default="central")
arguments.add_argument("--rings", type=int, default=13)
arguments.add_argument("--friction", type=float, default=0.0)
is_memm = (args := arguments.parse_args()).scheme == "memm"
lam, mu, speed, end, frictionless = 0.3 / (1.3 * 0.4), 0.5 / 1.3, 0.05, 15.0, np.array([-0.0279, -0.0400])

points, triangles, n_left, _ = slipping_discs(2, args.rings)
mesh = getfem.Mesh("empty", 2)
mesh.add_convex(getfem.GeoTrans("GT_PK(2,1)"), np.moveaxis(points[triangles], -1, 0).transpose(0, 2, 1))
mf, mim, mf_data = getfem.MeshFem(mesh, 2), getfem.MeshIm(mesh, 2), getfem.MeshFem(mesh, 1)
mf.set_fem(getfem.Fem("FEM_PK(2,1)"))
mf_data.set_fem(getfem.Fem("FEM_PK(2,0)"))
constant = np.ones(mf_data.nbdof())
stiffness = getfem.asm_linear_elasticity(mim, mf, mf_data, lam * constant, mu * constant)
mass = getfem.asm_mass_matrix(mim, mf).mult(np.ones(mf.nbdof())).reshape(-1, 2)  # lumped

# What the coupling takes: nodes are pairs of degrees of freedom, cells are rows of nodes.
rest = np.ascontiguousarray(mf.basic_dof_nodes().T[::2])
dofs, begin = mf.basic_dof_from_cvid()
cells = dofs[begin[:-1, None] + np.arange(0, 6, 2)] // 2
body = (np.arange(len(cells)) >= n_left).astype(int)
surface = abut.surface_of(rest, cells, body)
k = abut.skin_stiffness(lam + 2.0 * mu, surface["depth"])
k_t = abut.skin_stiffness(mu, surface["depth"])  # friction alone reads it
contact = abut.NodalContact(rest, **surface, stiffness=[k, k], shear_stiffness=[k_t, k_t], friction=args.friction,
                            log=lambda severity, text: print(text))
rows, columns = stiffness.csc_ind()
omega = np.sqrt((np.add.reduceat(np.abs(stiffness.csc_val()), rows[:-1]) / mass.ravel()).max())  # Gershgorin's bound
dt = contact.stable_step(mass[:, 0], omega)["dt"]

left = np.zeros(len(rest), bool)
left[cells[body == 0]] = True
v = np.where(left[:, None], [speed, 0.0], [-speed, 0.0])
u, v_old, f = np.zeros_like(rest), v.copy(), np.zeros_like(rest)
K_0 = 0.5 * (mass * v**2).sum()


def elastic_force(u):
    q = u.copy()
    for of_body in (left, ~left):  # the way of a body times the round-off in the matrix is a force that grows
        q[of_body] -= q[of_body].mean(axis=0)
    return -stiffness.mult(q.ravel()).reshape(q.shape), q


def measure(W):
    """H, H~ and momentum."""
    force, q = elastic_force(u)
    p, V = 0.5 * mass * (v_old + v), -0.5 * (q * force).sum() + W
    return np.hstack([0.5 * (p**2 / mass).sum() + V, 0.5 * (v_old * mass * v).sum() + V, p.sum(axis=0)])


ledger, n_steps, taken = [measure(0.0)], int(end / dt) + 1, 0.0
for _ in range(n_steps):
    new = u + dt * v  # v at half steps
    f[:] = 0.0
    result = contact.step(dt, rest + u, rest + new, out=f, mode="mean" if is_memm else "end")
    f += elastic_force(0.5 * (u + new) if is_memm else new)[0]
    u = new
    v_old, v = v, v_old + 2.0 * dt * f / mass if is_memm else v + dt * f / mass
    taken += result["dissipated"]
    ledger.append(measure(result["energy"] + result["friction_energy"] + taken))

ledger, missed = np.array(ledger), contact.report["missed_contacts"]
drift = np.abs(ledger - ledger[0]).max(axis=0) / np.array([K_0, K_0] + 2 * [np.abs(mass[:, 0] * speed).sum()])
velocity = (mass * v)[left].sum(axis=0) / mass[left].sum(axis=0)
print(f"GetFEM, {args.scheme}: {len(rest)} nodes, {len(cells)} triangles, {n_steps} steps of {dt:.4f}, left disc leaves at "
      f"({velocity[0]:.5f}, {velocity[1]:.5f})")
checks = [("momentum", drift[2:].max(), 1e-13), ("max |H - H0|/K0", drift[0], 1e-2), ("contacts missed", missed, 0)]
if args.friction == 0.0:
    checks += [("velocity, off other codes'", np.linalg.norm(velocity - frictionless) / 0.0488, 0.01)]
else:  # rigid discs meet with this normal impulse over m, and each kg m/s along their faces slows sliding by 3/m on each disc
    impulse = np.linalg.norm(frictionless - [speed, 0.0])
    sliding = 2.0 * speed * abs(frictionless[1]) / impulse
    expected = args.friction * impulse * (sliding - 3.0 * args.friction * impulse) / speed**2
    checks += [("taken by friction, off rigid discs'", abs(taken / K_0 - expected) / expected, 0.05)]
if is_memm:
    checks += [("max |H~ - H~0|/K0", drift[1], 1e-12), ("max |H - H~|/K0", np.abs(ledger[:, 0] - ledger[:, 1]).max() / K_0, 1e-2)]
for name, value, allowed in checks:
    print(f"  {name:34}{value:9.2g}   allowed {allowed:<6g}{'' if value <= allowed else '  FAILED'}".rstrip())
sys.exit(0 if all(value <= allowed for _, value, allowed in checks) else 1)
