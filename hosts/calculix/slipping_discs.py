"""CalculiX with contact by Abut, coupled through its restart file: two discs run into each other off centre and slip off.

R = E = rho = 1, nu = 0.3, plane strain, at +-0.05 along x, centres 0.8 apart along y. Other codes find that the left disc leaves
at (-0.0279, -0.0400). Each step is one launch of ccx with one increment of *DYNAMIC, EXPLICIT; README.md says what that costs,
and why it is central differences all the same.
"""
import argparse
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import time

import numpy as np

import abut

lam, mu = 0.3 / (1.3 * 0.4), 0.5 / 1.3
core, wing, half_width = 16, 6, 0.48  # elements along a side of the inner square and from there to the rim
speed, duration = 0.05, 10.0  # they are apart again at 6.9
instant = 1e-9  # an increment so short that the velocity it makes is that of the acceleration at its start, to all digits


def disc(centre, turn):
    """Nodes and quadrangles, counter-clockwise, of a disc: a square and four blocks between its sides and the rim."""
    s = np.linspace(-1.0, 1.0, core + 1)
    side, rim = half_width * np.stack([np.ones_like(s), s], -1), np.stack([np.cos(np.pi / 4 * s), np.sin(np.pi / 4 * s)], -1)
    block = side + np.linspace(0.0, 1.0, wing + 1)[:, None, None] * (rim - side)
    blocks = [half_width * np.stack(np.meshgrid(s, s, indexing="ij"), -1)]
    blocks += [block @ np.linalg.matrix_power([[0, 1], [-1, 0]], k) for k in range(4)]
    points = np.vstack([b.reshape(-1, 2) for b in blocks])
    quads, first = [], 0
    for b in blocks:
        i = first + np.arange(b.shape[0] * b.shape[1]).reshape(b.shape[:2])
        quads.append(np.stack([i[:-1, :-1], i[1:, :-1], i[1:, 1:], i[:-1, 1:]], -1).reshape(-1, 4))
        first = i[-1, -1] + 1
    _, kept, merged = np.unique(points.round(9), axis=0, return_index=True, return_inverse=True)
    c, s = np.cos(turn), np.sin(turn)
    return centre + points[kept] @ [[c, s], [-s, c]], merged.reshape(-1)[np.vstack(quads)]


class CalculiX:
    """One layer of C3D8 of thickness 1 whose nodes stay in their planes, so that front and back move alike. Here a node is a front
    node together with the back node behind it."""

    def __init__(self, folder, nodes, quads, digits=None, nlgeom=False):
        self.folder, self.n, self.digits = folder, len(nodes), digits
        self.step_card = "*STEP,NLGEOM" if nlgeom else "*STEP"
        lines = ["*NODE,NSET=ALL"]
        for z in (0, 1):
            lines += [f"{i + z * self.n + 1},{x:.13e},{y:.13e},{z}" for i, (x, y) in enumerate(nodes)]
        lines += ["*ELEMENT,TYPE=C3D8,ELSET=SOLID"]
        lines += [",".join(map(str, [e + 1, *q + 1, *q + self.n + 1])) for e, q in enumerate(quads)]
        lines += ["*MATERIAL,NAME=M", "*ELASTIC", "1.,.3", "*DENSITY", "1.", "*SOLID SECTION,ELSET=SOLID,MATERIAL=M",
                  "*BOUNDARY", "ALL,3,3", ""]
        log = self._launch("\n".join(lines), instant)
        self.model = self._written()  # at rest; displacements and velocities are put into it
        self.omega = 2.0 / float(re.search(r"stable time increment:\s*(\S+)", log)[1])

    def _launch(self, model, dt, cards="", count=1):
        """Some increments, and the log. Of *DYNAMIC, EXPLICIT the fourth entry counts: ccx takes it or its Courant step, whichever
        is less, and 0 where it is left out."""
        (self.folder / "job.inp").write_text(
            f"{model}*RESTART,WRITE\n{self.step_card},INC={count}\n{cards}*DYNAMIC,DIRECT,EXPLICIT,ALPHA=0\n"
            f"{dt!r},{dt * count!r},,{dt!r}\n*EL PRINT,ELSET=SOLID,TOTALS=ONLY\nELSE\n*END STEP\n")
        (self.folder / "job.rout").unlink(missing_ok=True)
        run = subprocess.run(["ccx", "job"], cwd=self.folder, capture_output=True, text=True,
                             env=os.environ | {"OMP_NUM_THREADS": "1"})
        if run.returncode != 0 or "*ERROR" in run.stdout:
            raise RuntimeError(f"ccx ended with {run.returncode}:\n{run.stdout[-2000:]}")
        selected = float(re.search(r"SELECTED time increment:\s*(\S+)", run.stdout)[1])
        if abs(selected - dt) > 1e-6 * dt:
            raise RuntimeError(f"ccx took increments of {selected} instead of {dt}")
        return run.stdout

    def _written(self):
        return bytearray((self.folder / "job.rout").read_bytes())

    def _fields(self, restart):
        """Displacements and velocities, each (layers, nodes, 2), where they lie in a restart file: its two records of Fortran
        with four doubles a node, of which the first is the temperature."""
        views, at = [], 0
        while at < len(restart):
            (size,) = struct.unpack_from("i", restart, at)
            if size == 64 * self.n:
                views.append(np.frombuffer(restart, np.float64, 8 * self.n, at + 4).reshape(2, self.n, 4)[:, :, 1:3])
            at += size + 8
        displacement, velocity = views
        return displacement, velocity

    def _rounded(self, values):
        """What a text file with so many digits keeps."""
        return values if self.digits is None else np.vectorize(lambda v: float(f"{v:.{self.digits - 1}e}"))(values)

    def increments(self, u, v, dt, cards="", count=1):
        """From displacements and velocities to those after some increments."""
        for field, values in zip(self._fields(self.model), (u, v)):
            field[:] = self._rounded(values)
        (self.folder / "job.rin").write_bytes(self.model)
        self._launch("*RESTART,READ\n", dt, cards, count)
        displacement, velocity = self._fields(self._written())
        return self._rounded(displacement[0]), self._rounded(velocity[0])

    def acceleration(self, u):
        """And the strain energy, with the seven digits of the .dat file."""
        _, v = self.increments(u, np.zeros_like(u), instant)
        return v / instant, float((self.folder / "job.dat").read_text().split()[-1])

    def mass(self):
        """Lumped masses, from how fast a unit force makes the nodes."""
        zero = np.zeros((self.n, 2))
        _, v = self.increments(zero, zero, instant, "*CLOAD\nALL,1,1.\n")
        return 2.0 * instant / v[:, 0]

    def remove(self, elements):
        zero = np.zeros((self.n, 2))
        lines = "".join(f"{e + 1}\n" for e in elements)
        self.increments(zero, zero, instant, f"*MODEL CHANGE,TYPE=ELEMENT,REMOVE\n{lines}")
        self.model = self._written()


def skin(quads):
    """Edges that one element alone has, with the outside on their right, and the element behind each."""
    edges = {}
    for e, q in enumerate(quads):
        for a, b in zip(q, np.roll(q, -1)):
            if edges.pop((b, a), None) is None:
                edges[a, b] = e
    return np.array(list(edges)), np.array(list(edges.values()))


class Discs:
    """Positions and velocities at the same time, with the accelerations by ccx and the forces of contact that belong to them."""

    def __init__(self, folder, divide, **options):
        left, right = disc((0.0, 0.0), 0.0), disc((np.sqrt(2.02**2 - 0.8**2), 0.8), 0.1)
        self.n_left, self.rest = len(left[0]), np.vstack([left[0], right[0]])
        self.quads = np.vstack([left[1], right[1] + self.n_left])
        self.alive = np.full(len(self.quads), True)
        self.ccx = CalculiX(folder, self.rest, self.quads, **options)
        self.mass = self.ccx.mass()
        surface = self._surface()
        self.k = [abut.skin_stiffness(lam + 2.0 * mu, surface[-1])] * 2
        self.contact = abut.NodalContact(*surface, self.k, log=lambda severity, text: print(text))
        self.dt = round(self.contact.stable_step(self.mass, self.ccx.omega)["dt"] / divide, 6)
        self.x, self.v = self.rest.copy(), np.zeros_like(self.rest)
        self.v[:, 0] = np.where(np.arange(len(self.rest)) < self.n_left, speed, -speed)
        self.a, self.f = np.zeros_like(self.x), np.zeros_like(self.x)

    def _surface(self):
        numbers = np.flatnonzero(self.alive)
        self.faces, behind = skin(self.quads[numbers])
        self.behind = numbers[behind]
        p = self.rest[self.quads[self.behind]]
        area = 0.5 * np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1])
        depth = 0.5 * area / np.linalg.norm(self.rest[self.faces[:, 1]] - self.rest[self.faces[:, 0]], axis=1)
        return self.rest, self.faces, (self.faces[:, 0] >= self.n_left).astype(np.int32), depth

    def free_step(self, x, v, a):
        """Velocity Verlet by one increment of ccx, contact left out. The increment is Newmark's with the acceleration of the
        predictor u + dt v + dt^2/4 a, and that makes it velocity Verlet for the predictor; but each launch begins with the
        acceleration of u. So the predictor goes in as u, and the half of dt^2/2 a that it lacks as velocity."""
        w = v + 0.25 * self.dt * a
        u_1, w_1 = self.ccx.increments(x - self.rest, w, self.dt)
        a_1 = 2.0 * (w_1 - w) / self.dt - a
        return self.rest + u_1 - 0.25 * self.dt**2 * a_1, w_1 - 0.25 * self.dt * a, a_1

    def step(self):
        kicked = self.v + 0.5 * self.dt * self.f / self.mass[:, None]
        x_1, v_1, self.a = self.free_step(self.x, kicked, self.a)
        self.f[:] = 0.0
        self.contact.step(self.dt, self.x, x_1, out=self.f, mode="end")
        self.x, self.v = x_1, v_1 + 0.5 * self.dt * self.f / self.mass[:, None]

    def conserved(self):
        """Momentum, angular momentum, energy."""
        p = self.mass[:, None] * self.v
        _, elastic = self.ccx.acceleration(self.x - self.rest)
        energy = 0.5 * (p * self.v).sum() + elastic + self.contact.evaluate(self.x)
        return np.array([*p.sum(axis=0), np.cross(self.x, p).sum(), energy])

    def velocity_of_left(self):
        m = self.mass[:self.n_left, None]
        return (m * self.v[:self.n_left]).sum(axis=0) / m.sum()

    def erode(self, elements):
        """Takes elements away that share no node, so that every node keeps one."""
        old = {tuple(face): i for i, face in enumerate(self.faces)}
        self.alive[elements] = False
        self.ccx.remove(elements)
        self.mass = self.ccx.mass()
        surface = self._surface()
        old_face_of = np.array([old.get(tuple(face), -1) for face in self.faces], np.int32)
        self.contact.surface_replaced(*surface, self.k, old_face_of)
        self.a, _ = self.ccx.acceleration(self.x - self.rest)
        self.f[:] = 0.0
        self.contact.evaluate(self.x, out=self.f)

    def save(self, file):
        np.savez(file, x=self.x, v=self.v, a=self.a, f=self.f, alive=self.alive, mass=self.mass, ccx=self.ccx.model,
                 contact=np.frombuffer(self.contact.state(), np.uint8))

    def restore(self, file):
        """Into discs that have not moved."""
        saved = np.load(file)
        self.x, self.v, self.a, self.f, self.alive, self.mass = (saved[k] for k in ("x", "v", "a", "f", "alive", "mass"))
        self.ccx.model = bytearray(saved["ccx"])
        self.contact = abut.NodalContact(*self._surface(), self.k)
        self.contact.restore(saved["contact"].tobytes())


def difference_of_launches(discs, count=10):
    """Between so many increments of ccx in as many launches and in one, without contact, relative to displacement and speed."""
    x, a = discs.rest.copy(), np.zeros_like(discs.rest)
    v = start = speed * np.sin(3.0 * discs.rest[:, ::-1])
    for _ in range(count):
        x, v, a = discs.free_step(x, v, a)
    u, v_1 = discs.ccx.increments(np.zeros_like(x), start, discs.dt, count=count)
    u_1 = x - discs.rest + 0.25 * discs.dt**2 * a
    return max(abs(u - u_1).max() / abs(u).max(), abs(v - v_1).max() / speed)


def main():
    arguments = argparse.ArgumentParser(description="Two discs by CalculiX slip off each other.")
    arguments.add_argument("--nlgeom", action="store_true", help="finite strain")
    arguments.add_argument("--digits", type=int, help="round all that goes to and comes from ccx to so many digits")
    arguments.add_argument("--erode", action="store_true", help="at a third of the run remove two elements under contact")
    arguments.add_argument("--divide", type=int, default=1, help="the stable step by this")
    options = arguments.parse_args()

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        discs = Discs(folder, options.divide, digits=options.digits, nlgeom=options.nlgeom)
        launches = difference_of_launches(discs)
        steps, faces = int(duration / discs.dt) + 1, len(discs.faces)
        begin = at_start = discs.conserved()
        drift, begun = np.zeros(4), time.perf_counter()
        for step in range(steps):
            if step == steps // 3:
                if options.erode:
                    hardest = discs.contact.pairs[np.argmax(discs.contact.pairs["normal_force"])]
                    removed = [discs.behind[hardest["face_1"]], discs.behind[hardest["face_2"]]]
                    discs.erode(removed)
                    begin = discs.conserved()
                discs.save(folder / "state.npz")
            if step == steps // 3 + 20:
                after_20 = discs.x.tobytes() + discs.v.tobytes()
            discs.step()
            if step % 10 == 9 or step == steps - 1:
                drift = np.maximum(drift, abs(discs.conserved() - begin))
        seconds = (time.perf_counter() - begun) / steps
        again = Discs(folder, options.divide, digits=options.digits, nlgeom=options.nlgeom)
        again.restore(folder / "state.npz")
        for _ in range(20):
            again.step()
        same_bits = again.x.tobytes() + again.v.tobytes() == after_20

    velocity, report = discs.velocity_of_left(), discs.contact.report
    off = np.linalg.norm(velocity - [-0.0279, -0.0400]) / 0.0488
    print(f"{steps} steps of {discs.dt}, {seconds:.2f} s each; 10 launches and one of 10 increments differ by {launches:.0e}")
    print(f"left disc: ({velocity[0]:.4f}, {velocity[1]:.4f}), {100.0 * off:.1f} % off; {report['missed_contacts']} missed, "
          f"{len(discs.contact.pairs)} pairs at the end")
    print(f"momentum moved by {drift[:2].max():.0e}, angular momentum by {drift[2] / begin[2]:.0e} of its value, energy by "
          f"{drift[3] / at_start[3]:.1e} K0")
    print(f"restart: {'the same' if same_bits else 'other'} bits")
    ok = same_bits and report["missed_contacts"] == 0 and len(discs.contact.pairs) == 0
    if options.erode:
        print(f"{len(removed)} of {len(discs.quads)} elements removed, {faces} faces became {len(discs.faces)}")
    else:
        ok = ok and (options.nlgeom or off < 0.01)
    if options.digits is None:
        ok = ok and launches < 1e-11 and drift[:2].max() < 1e-13 and (not options.nlgeom or drift[2] < 1e-13)
    return 0 if ok else 1


if __name__ == "__main__":
    sys.exit(main())
