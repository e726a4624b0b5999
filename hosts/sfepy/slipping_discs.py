"""Contact in SfePy: two discs of triangles run into each other off centre and slip off. SfePy assembles, Abut gives the forces of contact.

R = E = rho = 1, nu = 0.3, plane strain, small strain, at +-0.05 along x, centres 0.8 apart along y. Other codes of this kind find that
the left disc leaves at (-0.0279, -0.0400). --scheme memm takes mean forces over steps, so that the pseudo-energy H~ is kept.
"""
import argparse
import pathlib
import sys

import numpy as np
from sfepy.base.base import output
from sfepy.discrete import Equation, Equations, FieldVariable, Integral, Material, Problem
from sfepy.discrete.fem import FEDomain, Field, Mesh
from sfepy.mechanics.matcoefs import stiffness_from_youngpoisson
from sfepy.terms import Term

import abut

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "dolfinx"))
from discs import slipping_discs  # noqa: E402  points and cells

arguments = argparse.ArgumentParser(description=__doc__)
arguments.add_argument("--scheme", choices=("central", "memm"), default="central")
arguments.add_argument("--rings", type=int, default=13)
is_memm = (args := arguments.parse_args()).scheme == "memm"
lam, mu, speed, end = 0.3 / (1.3 * 0.4), 0.5 / 1.3, 0.05, 15.0
output.set_output(quiet=True)

points, triangles, n_left, _ = slipping_discs(2, args.rings)
mesh = Mesh.from_data("discs", points, None, [triangles.astype(np.int32)], [np.zeros(len(triangles), np.int32)], ["2_3"])
everywhere = FEDomain("domain", mesh).create_region("everywhere", "all")
field = Field.from_args("displacement", np.float64, "vector", everywhere, approx_order=1)
trial, test = FieldVariable("u", "unknown", field), FieldVariable("w", "test", field, primary_var_name="u")
material = Material("m", D=stiffness_from_youngpoisson(2, 1.0, 0.3, plane="strain"), rho=1.0)
terms = [Term.new(text, Integral("i", order=2), everywhere, m=material, w=test, u=trial)
         for text in ("dw_lin_elastic(m.D, w, u)", "dw_volume_dot(m.rho, w, u)")]
equations = [Equation(name, term) for name, term in zip(("stiffness", "mass"), terms)]
problem = Problem("discs", equations=Equations(equations))
problem.time_update()
problem.update_materials()
stiffness = equations[0].evaluate(mode="weak", dw_mode="matrix", asm_obj=problem.mtx_a.copy())
consistent = equations[1].evaluate(mode="weak", dw_mode="matrix", asm_obj=problem.mtx_a.copy())
mass = np.asarray(consistent.sum(axis=1)).reshape(-1, 2)  # lumped

# What the coupling takes: rows of the matrices are points of the mesh, two by two, and cells rows of points.
rest, cells = np.ascontiguousarray(field.get_coor()), field.econn
body = (np.arange(len(cells)) >= n_left).astype(int)
surface = abut.surface_of(rest, cells, body)
k = abut.skin_stiffness(lam + 2.0 * mu, surface["depth"])
contact = abut.NodalContact(rest, **surface, stiffness=[k, k], log=lambda severity, text: print(text))
omega = np.sqrt((np.asarray(abs(stiffness).sum(axis=1)).ravel() / mass.ravel()).max())  # Gershgorin's bound
dt = contact.stable_step(mass[:, 0], omega)["dt"]

left = np.zeros(len(rest), bool)
left[cells[body == 0]] = True
v = np.where(left[:, None], [speed, 0.0], [-speed, 0.0])
u, v_old, f = np.zeros_like(rest), v.copy(), np.zeros_like(rest)
K_0 = 0.5 * (mass * v**2).sum()


def elastic_force(u):
    q = u.copy()
    for of_body in (left, ~left):  # the path of a body times the round-off in the matrix is a force that grows
        q[of_body] -= q[of_body].mean(axis=0)
    return -(stiffness @ q.ravel()).reshape(q.shape), q


def measure(W):
    """H, H~ and momentum."""
    force, q = elastic_force(u)
    p, V = 0.5 * mass * (v_old + v), -0.5 * (q * force).sum() + W
    return np.hstack([0.5 * (p**2 / mass).sum() + V, 0.5 * (v_old * mass * v).sum() + V, p.sum(axis=0)])


ledger, n_steps = [measure(0.0)], int(end / dt) + 1
for _ in range(n_steps):
    new = u + dt * v  # v at half steps
    f[:] = 0.0
    result = contact.step(dt, rest + u, rest + new, out=f, mode="mean" if is_memm else "end")
    f += elastic_force(0.5 * (u + new) if is_memm else new)[0]
    u = new
    v_old, v = v, v_old + 2.0 * dt * f / mass if is_memm else v + dt * f / mass
    ledger.append(measure(result["energy"]))

ledger, missed = np.array(ledger), contact.report["missed_contacts"]
drift = np.abs(ledger - ledger[0]).max(axis=0) / np.array([K_0, K_0] + 2 * [np.abs(mass[:, 0] * speed).sum()])
velocity = (mass * v)[left].sum(axis=0) / mass[left].sum(axis=0)
print(f"SfePy, {args.scheme}: {len(rest)} nodes, {len(cells)} triangles, {n_steps} steps of {dt:.4f}, left disc leaves at "
      f"({velocity[0]:.5f}, {velocity[1]:.5f})")
checks = [("velocity, off other codes'", np.linalg.norm(velocity - [-0.0279, -0.0400]) / 0.0488, 0.01),
          ("momentum", drift[2:].max(), 1e-13), ("max |H - H0|/K0", drift[0], 1e-2), ("contacts missed", missed, 0)]
if is_memm:
    checks += [("max |H~ - H~0|/K0", drift[1], 1e-12), ("max |H - H~|/K0", np.abs(ledger[:, 0] - ledger[:, 1]).max() / K_0, 1e-2)]
for name, value, allowed in checks:
    print(f"  {name:34}{value:9.2g}   allowed {allowed:<6g}{'' if value <= allowed else '  FAILED'}".rstrip())
sys.exit(0 if all(value <= allowed for _, value, allowed in checks) else 1)
