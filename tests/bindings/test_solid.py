"""Meshes, solids and runs from Python."""
import csv
import os
import pathlib
import signal
import tempfile
import threading
import unittest

import numpy as np

import abut
from abut import solid

ROD = dict(lower=(0.0, 0.0), upper=(2.0, 1.0), counts=(6, 3))


def two_boxes():
    lower = solid.structured_box((0.0, 0.0), (1.0, 1.0), (4, 4), name="lower")
    upper = solid.structured_box((0.1, 1.01), (0.9, 1.8), (3, 3), shape="triangle", name="upper")
    return solid.combine([lower, upper])


def falling(**options):
    """The upper box falls on the lower one, which lies on rollers."""
    return dict(materials=[solid.Material()] * 2, velocity=[(0.0, 0.0), (0.0, -0.1)], rollers=["lower.ymin", "lower.xmin"],
                **options)


def faces_by_group(mesh):
    """The points of each face, whatever their order."""
    faces, offsets = mesh.surface["faces"], mesh.surface["offsets"]
    return {name: {frozenset(faces[offsets[f]:offsets[f + 1]].tolist()) for f in rows} for name, rows in mesh.groups.items()}


class Meshes(unittest.TestCase):
    def test_arrays_in_and_out_keep_the_mesh(self):
        for given in (solid.structured_box(**ROD), two_boxes(), solid.sphere(size=0.5),
                      solid.structured_box((0, 0, 0), (1, 2, 3), (2, 2, 2), shape="wedge")):
            again = solid.mesh(given.points, given.cells, given.body, given.body_names)
            self.assertEqual(len(again.measures), len(given.measures))
            of_input = np.empty_like(again.measures)
            of_input[again.label] = again.measures  # cells are renumbered, and say which they were
            np.testing.assert_allclose(of_input, given.measures, rtol=1e-12)
            self.assertEqual(again.body_names, given.body_names)

    def test_cells_may_be_a_dict_pairs_or_blocks(self):
        class Block:
            type, data = "quad", np.array([[0, 1, 2, 3]])
        points = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]])
        for cells in ({"quad": [[0, 1, 2, 3]]}, [("quad", [[0, 1, 2, 3]])], [Block()]):
            mesh = solid.mesh(points, cells, groups={"foot": [[0, 1]], "sides": [[1, 2], [3, 0]]})
            np.testing.assert_array_equal(mesh.measures, [2.0])
            self.assertEqual({name: len(rows) for name, rows in mesh.groups.items()}, {"foot": 1, "sides": 2})
            offsets = mesh.surface["offsets"]
            foot = mesh.surface["faces"][offsets[mesh.groups["foot"][0]]:][:2]
            np.testing.assert_array_equal(mesh.points[foot][:, 1], [0.0, 0.0])

    def test_a_file_written_is_the_mesh_read(self):
        with tempfile.TemporaryDirectory() as folder:
            for dim, mesh in ((2, two_boxes()), (3, solid.structured_box((0, 0, 0), (1, 1, 1), (2, 3, 4)))):
                path = pathlib.Path(folder) / f"mesh{dim}.vtu"
                mesh.write_vtu(path)
                again = solid.read_mesh(path, dim)
                np.testing.assert_array_equal(again.points, mesh.points)
                np.testing.assert_array_equal(again.body, mesh.body)
                self.assertEqual(again.body_names, mesh.body_names)
                self.assertEqual(faces_by_group(again), faces_by_group(mesh))

    def test_the_surface_of_cells_is_that_of_the_mesh_they_make(self):
        for mesh in (two_boxes(), solid.sphere(size=0.5), *(solid.structured_box((0, 0, 0), (1, 2, 3), (2, 2, 2), shape=shape)
                                                           for shape in ("hexahedron", "wedge", "pyramid", "tetra"))):
            ours, found = mesh.surface, abut.surface_of(mesh.points, mesh.cells, mesh.body, with_cells=True)
            of = lambda surface, cell: sorted(zip(cell.tolist(), (sorted(surface["faces"][a:b].tolist()) for a, b in
                                                                  zip(surface["offsets"], surface["offsets"][1:])), surface["depth"].round(9)))
            self.assertEqual(of(ours, mesh.surface_cells), of(found, found["cell"]))
            self.assertEqual(np.bincount(ours["body"]).tolist(), np.bincount(found["body"]).tolist())

    def test_a_surface_goes_to_contact_on_nodes(self):
        mesh = two_boxes()
        surface = mesh.surface
        overlap = abut.find_overlaps(mesh.points, surface["faces"], surface["body"], 0.02, offsets=surface["offsets"])
        np.testing.assert_allclose(surface["depth"][surface["body"] == 0], 0.5 / 4.0, rtol=1e-12)
        self.assertEqual(len(mesh.surface_cells), len(surface["body"]))
        contact = abut.NodalContact(mesh.points, **surface, stiffness=[1.0, 1.0])
        pressed = mesh.points
        pressed[np.unique(surface["faces"].reshape(-1, 2)[surface["body"] == 1])] -= [0.0, 0.03]
        contact.step(1.0, mesh.points, mesh.points)
        self.assertAlmostEqual(contact.step(1.0, mesh.points, pressed)["energy"], 0.5 * 0.5 * 0.02**2 * 0.8, delta=1e-15)
        self.assertAlmostEqual(overlap["area"].sum(), 0.8, delta=1e-14)
        np.testing.assert_allclose(overlap["gap"], 0.01, atol=1e-14)

    def test_values_of_cells_come_to_points(self):
        mesh = solid.structured_box(**ROD)
        np.testing.assert_allclose(mesh.at_points(np.ones(len(mesh.measures))), 1.0, rtol=1e-15)
        inside = (np.abs(mesh.points - [1.0, 0.5]) < [0.9, 0.4]).all(axis=1)
        np.testing.assert_allclose(mesh.at_points(mesh.centroids)[inside], mesh.points[inside], atol=1e-15)

    def test_what_is_wrong_is_refused_by_name(self):
        points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
        for error, text, call in (
                (ValueError, "cells in 2D is 'tetra', which is none of 'triangle', 'quad'", lambda: solid.mesh(points, {"tetra": [[0, 1, 2, 0]]})),
                (ValueError, r"shape \(n, 3\)", lambda: solid.mesh(points, {"triangle": [[0, 1]]})),
                (ValueError, "each of the 1 cells", lambda: solid.mesh(points, {"triangle": [[0, 1, 2]]}, body=[0, 1])),
                (ValueError, r"\(n, 2\) or \(n, 3\)", lambda: solid.mesh([1.0, 2.0], {"triangle": [[0, 1, 2]]})),
                (TypeError, "must be an array of integers", lambda: solid.mesh(points, {"triangle": [[0, 1.9, 2.2]]})),
                (ValueError, "must be within", lambda: solid.mesh(points, {"triangle": [[2**32, 1, 2]]})),
                (TypeError, "body must be", lambda: solid.mesh(points, {"triangle": [[0, 1, 2]]}, body=[0.9])),
                (ValueError, "number 2147483647 for 1 cells",
                 lambda: solid.mesh(points, {"triangle": [[0, 1, 2]]}, body=[2**31 - 1])),
                (TypeError, "groups.'foot'", lambda: solid.mesh(points, {"triangle": [[0, 1, 2]]}, groups={"foot": [[0.9, 1]]})),
                (ValueError, "no meshes", lambda: solid.combine([])),
                (abut.BadInput, "vertex 5", lambda: solid.mesh(points, {"triangle": [[0, 1, 5]]})),
                (abut.BadInput, "no such file", lambda: solid.read_mesh("nothing.msh", 2)),
                (abut.BadInput, "no such file", lambda: solid.read_mesh(os.fsdecode(b"not\xffutf8.msh"), 2)),
                (ValueError, "dim is 4", lambda: solid.read_mesh("nothing.msh", 4)),
                (abut.BadInput, "radius", lambda: solid.disc(radius=-1.0))):
            with self.assertRaisesRegex(error, text):
                call()


    def test_every_part_is_made(self):
        for mesh, measure, tolerance in ((solid.box((0, 0), (2, 1), 0.3), 2.0, 1e-12),
                                         (solid.box((0, 0, 0), (2, 1, 1), 0.5), 2.0, 1e-12),
                                         (solid.disc(size=0.1), np.pi, 0.01),
                                         (solid.cylinder(length=0.5, size=0.2), 0.5 * np.pi, 0.03),
                                         (solid.sphere(size=0.2), 4.0 / 3.0 * np.pi, 0.05)):
            self.assertAlmostEqual(mesh.measures.sum() / measure, 1.0, delta=tolerance)
            self.assertGreater(len(mesh.groups), 0)


class Runs(unittest.TestCase):
    def test_one_material_is_that_of_all_bodies_and_without_velocities_they_begin_at_rest(self):
        bodies = solid.combine([solid.structured_box(lower=(2.0 * i, 0), upper=(2.0 * i + 1, 1), counts=(2, 2)) for i in range(2)])
        stuff = solid.Material(young=1e6, density=1000)
        short, long = (solid.simulate(bodies, *given, acceleration=[(0, -10), (0, -10)], time=0.01, frames=0)
                       for given in ((stuff,), ([stuff, stuff], np.zeros((2, 2)))))
        np.testing.assert_array_equal(short["displacement"], long["displacement"])
        self.assertIn("4 cells, 1 body>", repr(solid.structured_box(lower=(0, 0), upper=(1, 1), counts=(2, 2))))
        with self.assertRaisesRegex(TypeError, "has no value 'yung'. Did you mean 'young'?"):
            solid.Material(yung=1)

    def test_a_thrown_body_follows_a_parabola(self):
        for mesh, v, g in ((solid.disc(size=0.4), (1.0, 2.0), (0.0, -10.0)),
                           (solid.sphere(size=0.6), (1.0, 2.0, 0.5), (0.0, -10.0, 1.0))):
            memm = solid.memm(mesh, [solid.Material(young=1000.0, density=2.0)], [v], acceleration=[g])
            memm.step(25)
            exact = memm.time * np.array(v) + 0.5 * memm.time**2 * np.array(g)
            np.testing.assert_allclose(memm.displacement, np.broadcast_to(exact, memm.displacement.shape), atol=1e-10)
            self.assertAlmostEqual(memm.masses.sum(), 2.0 * mesh.measures.sum(), delta=1e-12)

    def test_a_rod_under_tension_stays_in_its_equilibrium(self):
        p, nu = 1e-3, 0.3  # plane strain, E = 1
        stretch = p * np.array([1.0 - nu**2, -nu * (1.0 + nu)])
        memm = solid.memm(solid.structured_box(**ROD), [solid.Material()], [(0.0, 0.0)], rollers=["xmin", "ymin"],
                          traction={"xmax": (p, 0.0)}, displacement=lambda x: x * stretch)
        before = memm.displacement
        memm.step(200)
        np.testing.assert_allclose(memm.displacement, before, atol=1e-15)
        np.testing.assert_allclose(memm.stress, np.broadcast_to([[p, 0.0], [0.0, 0.0]], memm.stress.shape), atol=1e-15)

    def test_messages_name_options_as_python_does(self):
        with self.assertRaisesRegex(abut.BadInput, r"laboratory.levels \(levels\) is for memm_async"):
            solid.simulate(two_boxes(), **falling(), steps=1, levels=3)

    def test_steps_one_by_one_have_the_bits_of_a_run(self):
        mesh = two_boxes()
        for options in ({}, dict(filter="neutral", restart=20), dict(law="reconstruction", corners="fixed", weighting="half")):
            result = solid.simulate(mesh, **falling(), steps=120, interval=1, **options)
            memm = solid.memm(mesh, **falling(), **options)
            for _ in range(120):
                memm.step()
                memm.record()
            np.testing.assert_array_equal(memm.displacement, result["displacement"])
            np.testing.assert_array_equal(memm.ledger, result["ledger"])
            self.assertGreater(result["contact"]["events"], 0)
            ledger = result["ledger"]
            self.assertLess(np.ptp(ledger["pseudo_energy"] - ledger["work"]), 1e-13 * ledger["energy"][0])

    def test_friction_is_an_option_and_its_balance_is_in_the_ledger(self):
        def thrown(**options):
            return dict(materials=[solid.Material()] * 2, velocity=[(0.0, 0.0), (0.1, -0.1)], **options)
        mesh, sticking = two_boxes(), []
        for options in ({}, dict(friction=1.0), dict(law="reconstruction"), dict(kinematics="floating"), dict(sliding_friction=0.1, decay_slip=0.01)):
            result = solid.simulate(mesh, **thrown(**{"friction": 0.3, **options}), steps=120, interval=1)
            ledger, contact = result["ledger"], result["contact"]
            scale = ledger["energy"][0]
            self.assertGreater(ledger["dissipated"][-1], 1e-4 * scale)
            self.assertEqual(ledger["dissipated"][-1], contact["friction_dissipated"])
            self.assertGreater(ledger["friction_energy"].max(), 0.0)
            self.assertEqual(ledger["sliding_faces"].max(), contact["sliding_faces_max"])
            self.assertGreater(contact["sliding_faces_max"], 0)
            sticking.append(contact["sticking_faces_max"])
            self.assertLess(contact["friction_ratio_max"], 1.0 + 1e-12)
            kept = ledger["pseudo_energy"] + ledger["dissipated"] - ledger["work"] - ledger["restart_jumps"]
            self.assertLess(np.ptp(kept), 1e-12 * scale)
        self.assertGreater(max(sticking), 0)
        memm = solid.memm(mesh, **thrown(friction=0.3))
        memm.step(60)
        memm.record()
        self.assertEqual(memm.ledger["dissipated"][-1], memm.contact["friction_dissipated"])
        without = solid.simulate(mesh, **thrown(), steps=60)["ledger"]
        self.assertEqual((without["dissipated"][-1], without["friction_energy"].max()), (0.0, 0.0))
        with self.assertRaisesRegex(ValueError, "friction is -1; 0 or above"):
            solid.simulate(mesh, **thrown(friction=-1.0), steps=1)

    def test_bodies_move_as_their_kinematics_say_in_one_call_and_step_by_step(self):
        def struck(**options):
            return dict(materials=[solid.Material()] * 2, velocity=[(0.0, 0.0), (0.0, -0.1)], **options)
        mesh, ends = two_boxes(), {}
        for kinematics in ("small", "floating", "finite", "rigid"):
            result = solid.simulate(mesh, **struck(kinematics=kinematics), steps=40)
            memm = solid.memm(mesh, **struck(kinematics=kinematics))
            for _ in range(result["steps"]):
                memm.step()
            np.testing.assert_array_equal(memm.displacement, result["displacement"])
            ends[kinematics] = result["displacement"]
        for one, other in (("small", "floating"), ("floating", "finite"), ("finite", "rigid")):
            self.assertGreater(np.abs(ends[one] - ends[other]).max(), 1e-9)
        picked = solid.simulate(mesh, **struck(kinematics="automatic"), steps=40)
        self.assertTrue(any(np.array_equal(picked["displacement"], end) for end in ends.values()))
        with self.assertRaisesRegex(abut.BadInput, "automatic is for simulate"):
            solid.memm(mesh, **struck(kinematics="automatic"))
        with self.assertRaises(abut.BadInput):
            solid.simulate(mesh, **falling(kinematics="automatic", steps=1))

    def test_files_and_ledger_say_the_same(self):
        with tempfile.TemporaryDirectory() as folder:
            result = solid.simulate(two_boxes(), **falling(), steps=40, out=folder, frames=3)
            with open(pathlib.Path(folder) / "energy.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
            self.assertEqual(len(rows), len(result["ledger"]))
            energy = "pseudo_energy [J/m]"
            np.testing.assert_array_equal([float(row[energy]) for row in rows], result["ledger"]["pseudo_energy"])
            frames = sorted(pathlib.Path(folder).glob("frames/bodies_0*.vtu"))
            self.assertEqual(len(frames), 3)
            for frame in frames:
                np.testing.assert_allclose(solid.read_mesh(frame, 2).measures.sum(), two_boxes().measures.sum(), rtol=1e-12)
            self.assertGreater((pathlib.Path(folder) / "summary.json").stat().st_size, 0)
            self.assertEqual(result["contact"]["missed_contacts"] + result["contact"]["inadmissible_overlaps"], 0)

    def test_look_sees_each_step_and_may_end_the_run(self):
        seen, kept = [], []

        def look(state):
            kept.append(state)
            seen.append((state.steps, state.velocity[:, 1].min(), state.contact_pressure.max()))
            return state.steps == 29  # the next step is the last

        mesh = two_boxes()
        result = solid.simulate(mesh, **falling(), steps=100, look=look)
        self.assertEqual([step for step, _, _ in seen], list(range(31)))
        self.assertEqual((result["steps"], result["complete"]), (30, False))
        self.assertGreater(max(pressure for _, _, pressure in seen), 0.0)
        with self.assertRaisesRegex(abut.Misuse, "while look is called"):
            kept[0].displacement

    def test_an_exception_and_ctrl_c_end_a_run(self):
        def fails(state):
            raise KeyError("of look")

        with self.assertRaises(KeyError):
            solid.simulate(two_boxes(), **falling(), steps=10, look=fails)
        steps = []

        def interrupts(state):
            steps.append(state.steps)
            if state.steps == 5:
                os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(KeyboardInterrupt):
            solid.simulate(two_boxes(), **falling(), steps=1000, look=interrupts)
        self.assertLess(len(steps), 10)

    def test_ctrl_c_ends_many_steps(self):
        memm = solid.memm(two_boxes(), **falling())
        timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            memm.step(10**9)
        self.assertGreater(memm.steps, 0)

    def test_a_run_in_use_is_left_alone(self):
        memm = solid.memm(two_boxes(), **falling())
        stepping = threading.Thread(target=memm.step, args=(200000,))
        stepping.start()
        refused = 0
        while stepping.is_alive():
            for call in (memm.step, memm.record, lambda: memm.displacement, lambda: memm.ledger):
                try:
                    call()
                except abut.Misuse:
                    refused += 1
        self.assertGreater(refused, 0)
        self.assertGreaterEqual(memm.steps, 200000)

    def test_a_load_from_outside_gives_its_work(self):
        run = solid.memm(two_boxes(), outside=["upper.xmax"], **falling(restart=20))
        n = len(run.faces("upper.xmax")["area"])
        start, work = run.ledger["pseudo_energy"][0], 0.0
        for i in range(60):
            if i == 30:
                with self.assertWarnsRegex(RuntimeWarning, r"by more than 5 %.*run\.clock\(\)"):
                    run.set_step(0.7 * run.dt, "restart")
            faces = run.faces("upper.xmax")
            traction = 1e-3 * np.array([np.sin(0.1 * i), 0.3 * np.cos(i)]) * np.arange(1, n + 1)[:, None]
            run.set_traction("upper.xmax", traction)
            run.step()
            now = run.faces("upper.xmax")
            np.testing.assert_array_equal(now["traction"], traction)
            work += np.sum(faces["area"][:, None] * traction * faces["motion"])
        run.record()
        booked, last = run.outside_work, run.ledger[-1]
        self.assertAlmostEqual(booked["steps"], work, delta=1e-12 * abs(work))
        gained = last["pseudo_energy"] + booked["held"] - start - last["restart_jumps"]
        self.assertAlmostEqual(gained, booked["steps"] + booked["changes"], delta=1e-12 * last["kinetic"])
        self.assertNotEqual(last["restart_jumps"], 0.0)
        np.testing.assert_array_equal(now["normal"], np.tile([1.0, 0.0], (n, 1)))
        np.testing.assert_array_equal(now["bonded"], np.zeros(n))

    def test_a_clock_takes_loads_at_any_times_and_goes_back_with_the_same_bits(self):
        run = solid.memm(two_boxes(), outside=["upper.xmax"], **falling(restart=20))
        clock = run.clock()
        random = np.random.default_rng(5)
        n, work = len(clock.faces("upper.xmax")["area"]), 0.0

        def go(steps):
            nonlocal work
            for _ in range(steps):
                d = min(random.uniform(0.1, 1.0) * run.dt, clock.time_to_node)
                faces, motion = clock.faces("upper.xmax"), clock.motion("upper.xmax", d)
                traction = 1e-3 * random.uniform(-1.0, 1.0, (n, 2)) + [2e-3, 0.0]
                clock.set_traction("upper.xmax", traction)
                clock.advance(d)
                work += np.sum(faces["area"][:, None] * traction * motion)

        go(60)
        faces, d = clock.faces("upper.xmax"), clock.time_to_node
        work += np.sum(faces["area"][:, None] * faces["traction"] * clock.motion("upper.xmax", d))
        clock.advance(d)
        self.assertEqual(clock.time, run.time)
        self.assertAlmostEqual(run.outside_work["steps"], work, delta=1e-12 * abs(work))
        state, seed = clock.state(), random.bit_generator.state
        go(30)
        end = clock.displacement
        clock.restore(state)
        clock.advance(5.3 * run.dt)
        clock.restore(state)
        random.bit_generator.state = seed
        go(30)
        np.testing.assert_array_equal(clock.displacement, end)
        for d in (0.0, -1.0, np.nan):
            with self.assertRaisesRegex(abut.BadInput, "give a finite time > 0"):
                clock.advance(d)
        with self.assertRaisesRegex(abut.BadInput, "until the next node"):
            clock.motion("upper.xmax", 2.0 * run.dt)
        with self.assertRaisesRegex(ValueError, "none of 'as_given', 'trapezoid'"):
            run.clock("given")

    def test_loads_from_outside_that_cannot_be_are_refused(self):
        run = solid.memm(two_boxes(), outside=["upper.xmax"], **falling())
        n = len(run.faces("upper.xmax")["area"])
        with self.assertRaisesRegex(abut.BadInput, "upper.xmax.*not finite"):
            run.set_traction("upper.xmax", np.full((n, 2), np.nan))
        with self.assertRaisesRegex(abut.BadInput, "given for"):
            run.set_traction("upper.xmax", np.zeros((n + 1, 2)))
        with self.assertRaisesRegex(ValueError, "shape"):
            run.set_traction("upper.xmax", np.zeros((n, 3)))
        with self.assertRaisesRegex(abut.BadInput, "lower.xmin"):
            run.faces("lower.xmin")
        with self.assertRaisesRegex(ValueError, "keep"):
            run.set_step(run.dt, "jump")
        with self.assertRaises(abut.BadInput):
            run.set_step(-1.0, "keep")
        with self.assertRaisesRegex(abut.BadInput, "above the stable step"):
            run.set_step(1.01 * run.stable_dt, "keep")
        run.set_step(run.stable_dt, "keep")

    def test_a_run_goes_on_without_cells_and_tells_what_has_left(self):
        # In flight nothing is strained: the cells take along their mass, momentum and kinetic energy, and no more.
        mesh, v = solid.structured_box((0, 0), (2, 1), (8, 4)), np.array([0.3, -0.1])
        run = solid.memm(mesh, [solid.Material(density=2.0)], [v], kinematics="finite")
        run.step(20)
        gone = [5, 0]
        mass = 2.0 * mesh.measures[gone].sum()
        left = run.remove_cells(gone)
        self.assertEqual(left["cells"], 2)
        self.assertAlmostEqual(left["mass"], mass, delta=1e-14)
        np.testing.assert_allclose(left["momentum"], mass * v, atol=1e-14)
        self.assertAlmostEqual(left["kinetic"], 0.5 * mass * v @ v, delta=1e-14)
        self.assertAlmostEqual(left["potential"], 0.0, delta=1e-14)
        np.testing.assert_array_equal(run.mesh.centroids, np.delete(mesh.centroids, gone, axis=0))
        run.step(20)
        np.testing.assert_allclose(run.velocity, np.tile(v, (30, 1)), atol=1e-13)
        with self.assertRaisesRegex(abut.BadInput, "given twice"):
            run.remove_cells([1, 1])
        with self.assertRaisesRegex(abut.BadInput, "does not exist"):
            run.remove_cells([30])
        self.assertEqual(run.steps, 40)

    def test_a_clamped_bar_sinks_by_its_weight_in_space(self):
        # Uniaxial strain under a load of its own: sides on rollers, u = rho g / (2 M) (h^2 - (h - z)^2), M = lambda + 2 mu.
        h, g, steps = 1.0, 1e-3, 1500
        mesh = solid.structured_box((0, 0, 0), (0.5, 0.5, h), (3, 3, 6))
        result = solid.simulate(mesh, [solid.Material(poisson=0.0)], [(0.0, 0.0, 0.0)], acceleration=[(0.0, 0.0, -g)],
                                held={"zmin": (0.0, 0.0, 0.0)}, rollers=["xmin", "xmax", "ymin", "ymax"], energy_scale=1e-6,
                                displacement=lambda x: [0.0, 0.0, -0.5 * g * (h**2 - (h - x[2])**2)], steps=steps)
        exact = -0.5 * g * (h**2 - (h - mesh.centroids[:, 2])**2)
        self.assertLess(np.abs(result["displacement"][:, 2] - exact).max(), 0.1 * 0.5 * g)  # it begins at its rest, and stays there

    def test_presets_stand_below_other_options_and_switches_take_words_and_truths(self):
        mesh = two_boxes()
        of = lambda **options: solid.simulate(mesh, **falling(), steps=3, **options)["ledger"]["pseudo_energy"].tolist()
        self.assertEqual(of(preset="fast"), of(cfl=0.99, events=False))
        self.assertEqual(of(preset="exact", cfl=0.9), of(filter="neutral"))
        self.assertEqual(of(events="off"), of(events=False))
        self.assertEqual(of(broad_phase="brute_force", self_contact="off"), of())

    def test_a_run_in_python_goes_on_from_its_checkpoint(self):
        mesh = two_boxes()
        with tempfile.TemporaryDirectory() as folder:
            run = lambda name, **more: solid.simulate(mesh, **falling(), steps=40, out=f"{folder}/{name}", frames=0,
                                                      interval=1, checkpoint_steps=10, **more)
            whole = run("whole")
            seen = []
            run("part", look=lambda state: seen.append(state.steps) or state.steps == 25)
            rest = run("part", resume=True)
            self.assertEqual(rest["ledger"]["pseudo_energy"][-1], whole["ledger"]["pseudo_energy"][-1])
            np.testing.assert_array_equal(rest["displacement"], whole["displacement"])

    def test_materials_have_units_and_names(self):
        steel = solid.Material("steel S235")  # EN 1993-1-1, EN 1991-1-1, EN 10025-2
        self.assertEqual((steel.young, steel.poisson, steel.density, steel.yield_stress), (210e9, 0.3, 7850.0, 0.0))
        self.assertEqual(solid.Material("steel S235", law="j2").yield_stress, 235e6)
        self.assertEqual(solid.Material("steel S235", law="j2", yield_stress="300 MPa").yield_stress, 300e6)
        tabled = solid.Material("steel S235", law="j2", hardening_table=[[0, "300 MPa"], (0.1, 4e8)])
        self.assertEqual(tabled.yield_stress, 300e6)
        self.assertEqual(tabled.hardening_table, [(0.0, 300e6), (0.1, 400e6)])
        with self.assertRaisesRegex(TypeError, "rows"):
            solid.Material(law="j2", hardening_table=[1, 2])
        self.assertEqual(solid.Material("steel S235", density="8 g/cm^3").density, 8000.0)
        ply = solid.Material(young="140 GPa", density=1600, law="orthotropic", young_2="10 GPa", shear_12="5 GPa", axis_1=[1, 1, 0],
                             axis_angle="30 deg")
        self.assertEqual((ply.law, ply.young_2, ply.shear_12, ply.axis_1), ("orthotropic", 1e10, 5e9, [1.0, 1.0, 0.0]))
        self.assertAlmostEqual(ply.axis_angle, np.pi / 6.0)
        rubber = solid.Material(young="1 MPa", density=1000, stiffness_damping="0.2 ms")
        self.assertEqual((rubber.young, rubber.density, rubber.stiffness_damping), (1e6, 1000.0, 0.0002))
        rubber.young = "2 MPa"
        self.assertEqual(rubber.young, 2e6)
        known = solid.known_materials()
        self.assertEqual(known["steel S235"]["yield_stress"], 235e6)
        self.assertIn("EN 1993-1-1", known["steel S235"]["source"])
        self.assertTrue(all(solid.Material(name).young == values["young"] for name, values in known.items()))
        for error, text, make in ((ValueError, "'steel', which is none of .*'steel S235'", lambda: solid.Material("steel")),
                                  (abut.BadInput, "young is '2 kg': ", lambda: solid.Material(young="2 kg")),
                                  (TypeError, "young cannot be 'hard'", lambda: solid.Material(young="hard")),
                                  (TypeError, "poisson cannot be None", lambda: solid.Material(poisson=None)),
                                  (TypeError, "no value 'yung'", lambda: solid.Material(yung=1.0))):
            with self.assertRaisesRegex(error, text):
                make()

    def test_warm_bodies_expand_or_press_as_closed_forms_say(self):
        # plane strain: free (1 + nu) alpha T in the plane, and a bar between two walls -E alpha T/(1 - nu) along it
        material = solid.Material(young=2.0, poisson=0.25, density=1.0, thermal_expansion=1e-5, mass_damping=4.0)
        bar = solid.structured_box((0, 0), (1, 0.5), (4, 2), name="bar")
        free = solid.simulate(bar, [material], [(0, 0)], temperature_rise={"bar": 80}, rollers=["xmin", "ymin"], time=30.0)
        np.testing.assert_allclose(free.displacement, 1.25 * 80e-5 * bar.centroids, rtol=0, atol=1e-12)
        # rubber of finite strains in space, held by nothing: 1 + alpha T in all directions
        rubber = solid.Material(young=2.0, poisson=0.25, density=1.0, law="neo_hookean", thermal_expansion=1e-3, mass_damping=1.0)
        block = solid.structured_box((0, 0, 0), (1, 0.8, 0.8), (5, 4, 4), name="block")
        hot = solid.simulate(block, [rubber], [(0, 0, 0)], kinematics="finite", time=60.0,
                             temperature_rise={"block": lambda t, x: 150.0 * (1.0 - np.cos(np.pi * min(t / 20.0, 1.0)))})
        arms = block.centroids - block.centroids.mean(axis=0)
        np.testing.assert_allclose(hot.displacement, 0.3 * arms, rtol=0, atol=1e-6)
        rises = []

        def rise(t, x):
            rises.append(t)
            return 80.0 * min(t / 10.0, 1.0) * (1.0 + 0.0 * x[0])

        run = solid.memm(bar, [material], [(0, 0)], temperature_rise={"bar": rise}, rollers=["xmin", "xmax", "ymin"])
        start = run.ledger["pseudo_energy"][0]
        while run.time < 40.0:
            run.step(10)
        run.record()
        np.testing.assert_allclose(run.stress[:, 0, 0], -2.0 * 80e-5 / 0.75, rtol=1e-2)
        end = run.ledger[-1]
        self.assertNotEqual(end["work"], 0.0)
        self.assertLess(abs(end["pseudo_energy"] + end["dissipated"] - start - end["work"]), 1e-12 * 80e-5**2)
        self.assertGreater(len(set(rises)), 10)

        def fails(t, x):
            if t > 0.0:
                raise RuntimeError("too hot")
            return 0.0

        for error, text, warm in ((abut.BadInput, r"temperature_rise\['lid'\]: there is no body .*'bar'", {"lid": 1.0}),
                                  (TypeError, r"temperature_rise\['bar'\] is a number", {"bar": "hot"}),
                                  (TypeError, r"temperature_rise\['bar'\] gave 'hot'", {"bar": lambda t, x: "hot"}),
                                  (RuntimeError, "too hot", {"bar": fails})):
            with self.assertRaisesRegex(error, text):
                solid.simulate(bar, [material], [(0, 0)], temperature_rise=warm, steps=5)

    def test_options_have_units(self):
        mesh = two_boxes()
        result = solid.simulate(mesh, **falling(), time="10 ms", dt="1 ms")
        self.assertEqual((result.steps, result.dt), (10, 0.001))
        with self.assertRaisesRegex(abut.BadInput, "time is '3 m': "):
            solid.simulate(mesh, **falling(), time="3 m")

    def test_errors_carry_their_facts(self):
        mesh = two_boxes()
        with self.assertRaises(abut.BadInput) as raised:
            solid.simulate(mesh, **falling(), steps=10, cfl=2.0)
        self.assertAlmostEqual(raised.exception.value / raised.exception.allowed, 2.0)
        with self.assertRaises(abut.Diverged):
            solid.simulate(mesh, **falling(), steps=4000, cfl=1.4, allow_unstable=True, contact=False)
        for error, text, options in ((TypeError, "no option 'tim'; there are .*time", dict(tim=1.0)),
                                     (ValueError, "integrator is 'euler', which is none of 'memm'", dict(integrator="euler")),
                                     (TypeError, "steps cannot be 'many'", dict(steps="many")),
                                     (ValueError, "frames is -1; 0 or more is needed", dict(frames=-1)),
                                     (ValueError, "events is 'maybe', which is none of 'off', 'on'", dict(events="maybe")),
                                     (ValueError, "preset is 'best', which is none of 'fast'", dict(preset="best")),
                                     (abut.BadInput, "materials: 1 given", dict(materials=[solid.Material()]))):
            with self.assertRaisesRegex(error, text):
                solid.simulate(mesh, **{**falling(), **options})
        with self.assertRaisesRegex(ValueError, r"velocity must have the shape \(n, 2\)"):
            solid.simulate(mesh, [solid.Material()] * 2, [1.0, 2.0])
        for name in ("out", "time", "steps", "threads", "integrator", "levels"):
            with self.assertRaisesRegex(TypeError, f"memm takes no '{name}'"):
                solid.memm(mesh, **falling(), **{name: 1})
        with self.assertRaisesRegex(ValueError, "restart is -5; 0 or more is needed"):
            solid.memm(mesh, **falling(), restart=-5)
        with self.assertRaisesRegex(abut.BadInput, r"^run\.time \(time\), run\.dt \(dt\): "):  # keys, and the words of Python
            solid.simulate(mesh, **falling())
        with self.assertRaisesRegex(ValueError, "n is -1"):
            solid.memm(mesh, **falling()).step(-1)
        with self.assertRaisesRegex(ValueError, r"displacement\(x\) must be 2 numbers"):
            solid.memm(mesh, **falling(), displacement=lambda x: 1.0)
        overlapping = solid.combine([solid.disc(size=0.4, name="a"), solid.disc(size=0.4, variant=1, name="b")])
        for run in (solid.memm, lambda *given: solid.simulate(*given, steps=3)):
            with self.assertRaisesRegex(abut.BadInput, "overlap"):
                run(overlapping, [solid.Material()] * 2, [(0.1, 0.0), (0.0, 0.0)])
        lost = solid.memm(mesh, **falling(), cfl=1.5, allow_unstable=True, contact=False)
        with self.assertRaisesRegex(abut.Diverged, "step [0-9]+, t = "):
            for _ in range(100):
                lost.step(100)
                lost.record()


if __name__ == "__main__":
    unittest.main()
