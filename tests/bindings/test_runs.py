"""test_runs.py SCENES: scenes in files and in dicts, run from Python."""
import copy
import csv
import doctest
import json
import pathlib
import pickle
import sys
import tempfile
import tomllib
import unittest

import numpy as np

import abut
from abut import _scenes, solid

SCENES = pathlib.Path(sys.argv.pop(1))
BARS = SCENES / "colliding_bars.toml"
STONE = {"young": 100.0, "density": 1.0}


def rows_of(path):
    """Heads without units, and lines of numbers."""
    with open(path, newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(line for line in file if not line.startswith("#"))
    return [[name.partition(" [")[0] for name in head], *rows]


def column_of(path, name):
    rows = rows_of(path)
    return np.array([float(row[rows[0].index(name)]) for row in rows[1:]])


class Scenes(unittest.TestCase):
    def test_arrays_are_what_the_files_hold(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name) / "bars"
            written = abut.run(BARS, steps=200, frames=3, out=folder)
            alone = abut.run(BARS, steps=200, frames=3)
            self.assertEqual((written.out, alone.out), (folder, None))
            for result in (written, alone):
                energy = next(column for column in rows_of(folder / "energy.csv")[0] if column.startswith("pseudo_energy"))
                np.testing.assert_array_equal(result.ledger["pseudo_energy"], column_of(folder / "energy.csv", energy))
                for probe in ("middle", "left", "right"):
                    for column in result.probes[probe].dtype.names[2:]:
                        np.testing.assert_array_equal(result.probes[probe][column],
                                                      column_of(folder / "probes.csv", f"{probe}.{column}"))
                self.assertEqual(list(result.forces.dtype.names), rows_of(folder / "forces.csv")[0])
                np.testing.assert_array_equal(result.forces["force_on_2_x"], column_of(folder / "forces.csv", "force_on_2_x"))
                self.assertEqual(result.forces["body_2"].tolist(), [row[3] for row in rows_of(folder / "forces.csv")[1:]])
                self.assertEqual(len(list(folder.glob("frames/bodies_0*.vtu"))), len(result.frames))
                np.testing.assert_array_equal(result.frames.displacement[-1], result.displacement)
                np.testing.assert_array_equal(result.frames.step[[0, -1]], [0, 200])
            summary = json.loads((folder / "summary.json").read_text())
            for one in (summary, written.summary):
                del one["seconds"]
            self.assertEqual(written.summary, summary)
            self.assertIn(written.verdict.split(".")[0], (folder / "report.html").read_text())

    def test_results_and_meshes_are_copied_and_pickled_with_all_that_they_have(self):
        for scene in ("colliding_bars", "tyred_wheel", "ball_of_stl"):
            result = abut.run(SCENES / f"{scene}.toml", steps=3, frames=2)
            for copied in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result)):
                self.assertEqual(list(copied), list(result))
                self.assertEqual((copied.verdict, copied.summary), (result.verdict, result.summary))
                np.testing.assert_array_equal(copied.ledger, result.ledger)
                np.testing.assert_array_equal(copied.frames.stress, result.frames.stress)
                for name in ("points", "body", "label", "surface_cells"):
                    np.testing.assert_array_equal(getattr(copied.mesh, name), getattr(result.mesh, name), name)
                for name in ("centroids", "measures"):  # sums over corners that may be in another order
                    np.testing.assert_allclose(getattr(copied.mesh, name), getattr(result.mesh, name), rtol=1e-12, atol=1e-15)
                self.assertEqual((copied.mesh.name, copied.mesh.body_names), (result.mesh.name, result.mesh.body_names))
                for name, rows in result.mesh.groups.items():
                    np.testing.assert_array_equal(copied.mesh.groups[name], rows)
            self.assertIs(copy.copy(result).mesh, result.mesh)

    def test_a_dict_is_the_scene_of_the_file_with_its_keys(self):
        for scene in ("colliding_bars", "rolling_disc", "two_blocks", "ring_of_discs", "half_punch"):
            path = SCENES / f"{scene}.toml"
            from_file, from_dict = (abut.run(given, steps=20, interval=1) for given in (path, tomllib.loads(path.read_text())))
            np.testing.assert_array_equal(from_file.ledger, from_dict.ledger)
            np.testing.assert_array_equal(from_file.displacement, from_dict.displacement)

    def test_values_are_set_by_dotted_keys_and_by_tables(self):
        mass = lambda changes: abut.run(BARS, set=changes, steps=2).start[0]["mass"]
        self.assertAlmostEqual(mass(None), 0.1, delta=1e-15)
        self.assertAlmostEqual(mass({"bodies.left.density": 2.0}), 0.2, delta=1e-15)
        self.assertAlmostEqual(mass({"bodies": {"left": {"density": np.float64(2.0)}}}), 0.2, delta=1e-15)
        self.assertAlmostEqual(mass({"bodies.left.density": "2000 g/m^3"}), 0.2, delta=1e-15)
        with self.assertRaisesRegex(abut.BadInput, "unit of a length"):
            mass({"bodies.left.density": "2 mm"})
        self.assertEqual(abut.run(BARS, set={"run.filter": "none", "output.frames": 4}, steps=8).frames.step.tolist(), [0, 3, 6, 8])

    def test_frames_are_at_the_times_that_are_given(self):
        plain = abut.run(BARS, time=0.1)
        end = plain.ledger["time"][-1]  # of the last step
        result = abut.run(BARS, time=0.1, times=[0.0, 0.0123, "50 ms", end])
        self.assertEqual(result.frames.time.tolist(), [0.0, 0.0123, 0.05, end])
        np.testing.assert_array_equal(result.ledger, plain.ledger)
        np.testing.assert_array_equal(result.frames.displacement[-1], plain.displacement)
        inside = abut.run(BARS, time=0.1, set={"output.times": [0.0123]})
        np.testing.assert_array_equal(inside.frames.displacement[0], result.frames.displacement[1])
        self.assertEqual(len(abut.run(BARS, time=0.1, frames=3, set={"output.times": [0.0123]}).frames.time), 3)
        for error, message, given in ((ValueError, "times: number 2 is 0.1 s, after 0.2 s", [0.2, 0.1]), (TypeError, "times cannot be", 0.1),
                                      (TypeError, "times cannot be", "0.1"), (abut.BadInput, "unit of a length", ["1 mm"]),
                                      (abut.BadInput, "output.times .times.: number 1 is 3 s, and the run ends at 0.1", [3.0])):
            with self.subTest(given), self.assertRaisesRegex(error, message):
                abut.run(BARS, time=0.1, times=given)
        with self.assertRaisesRegex(TypeError, "give one of both"):
            abut.run(BARS, time=0.1, times=[0.1], frames=3)

    def test_nothing_is_written_unless_a_folder_is_given(self):
        with tempfile.TemporaryDirectory() as name:
            scene = pathlib.Path(name) / "scene.toml"
            scene.write_text(BARS.read_text().replace("[output]", f'[output]\nout = "{name}/results"'))
            abut.run(scene, steps=2)
            self.assertEqual([path.name for path in pathlib.Path(name).iterdir()], ["scene.toml"])

    def test_a_mesh_of_arrays_is_a_body(self):
        mesh = solid.structured_box((0.0, 0.0), (1.0, 1.0), (2, 2), name="mine")
        scene = {"dim": 2, "run": {"steps": 4, "cfl": 0.5}, "bodies": {"low": {"mesh": mesh, **STONE}, "high": {"mesh": mesh, "place": [0, 1.5], **STONE}},
                 "supports": {"foot": {"group": "low.ymin"}}}
        result = abut.run(scene)
        self.assertEqual(result.mesh.body_names, ["low", "high"])
        np.testing.assert_allclose(result.mesh.points[:, 1].max(), 2.5)
        self.assertIn("high.ymin", result.mesh.groups)
        cube = solid.structured_box((0, 0, 0), (1, 1, 1), (1, 1, 1))
        with self.assertRaisesRegex(abut.BadInput, "bodies.low.mesh is a mesh of 3D in a scene of 2D"):
            abut.run(scene, set={"bodies.low.mesh": cube})

    def test_a_rigid_body_swings_on_a_spring(self):
        # x'' = -k x / m with m = 1 kg/m and k = 1 N/m: x = v sin(t), off by the phase of a second-order scheme.
        box = solid.structured_box((-0.5, -0.5), (0.5, 0.5), (2, 2))
        result = abut.run({"dim": 2, "run": {"time": 6.0, "cfl": 0.1}, "output": {"probes": {"middle": {"body": "box"}}},
                           "bodies": {"box": {"mesh": box, "kinematics": "rigid", "velocity": [0.1, 0.0], **STONE}},
                           "springs": {"spring": {"from": {"body": "box", "point": [0, 0]}, "to": {"point": [-1, 0]}, "stiffness": 1.0}}})
        middle = result.probes["middle"]
        self.assertLess(np.abs(middle["displacement_x"] - 0.1 * np.sin(middle["time"])).max(), 0.1 * 6.0 * result.dt**2 / 24.0 * 1.1)

    def test_an_obstacle_gives_back_the_momentum_that_its_forces_say(self):
        scene = {"dim": 2, "run": {"time": 1.5}, "output": {"sample_interval": 1},
                 "bodies": {"stone": {"shape": "structured_box", "lower": [0, 0.05], "upper": [1, 1.05], "counts": [3, 3],
                                      "kinematics": "floating", "velocity": [0, -0.1], **STONE}},
                 "obstacles": {"floor": {"shape": "plane", "point": [0, 0], "normal": [0, 1]}}}
        result = abut.run(scene)
        self.assertEqual(set(result.forces["body_1"]) | set(result.forces["body_2"]), {"stone", "floor"})
        sign = np.where(result.forces["body_2"] == "stone", 1.0, -1.0)
        impulse = np.sum(sign * result.forces["force_on_2_y"]) * result.dt
        gained = result.end[0]["mass"] * (result.end[0]["velocity"] - result.start[0]["velocity"])[1]
        self.assertGreater(gained, 0.1)
        self.assertAlmostEqual(impulse, gained, delta=1e-12)

    def test_each_body_has_its_kinematics_and_each_pair_its_friction(self):
        block = {"shape": "structured_box", "lower": [0, 0], "upper": [1, 1], "counts": [3, 3], **STONE}
        scene = {"dim": 2, "gravity": [0, -1], "run": {"time": 0.5}, "materials": {"stone": {**STONE, "poisson": 0.2}},
                 "bodies": {"low": {**block, "kinematics": "rigid"},
                            "high": {"shape": "structured_box", "lower": [0.1, 1.001], "upper": [0.9, 1.8], "counts": [2, 2], "material": "stone",
                                     "kinematics": "floating", "velocity": [0.3, 0]}},
                 "obstacles": {"floor": {"shape": "plane", "point": [0, 0], "normal": [0, 1]}},
                 "contact": {"pairs": [{"bodies": ["low", "high"], "friction": 0.4}]}}
        rubbed, smooth = abut.run(scene), abut.run(scene, set={"contact.pairs": []})
        self.assertGreater(rubbed.contact["friction_dissipated"], 0.0)
        self.assertEqual(smooth.contact["friction_dissipated"], 0.0)
        strain = lambda body: np.abs(rubbed.frames.stress[-1][rubbed.mesh.body == body]).max()
        self.assertGreater(strain(1), 0.0)
        self.assertEqual(strain(0), 0.0)  # a rigid body has none
        self.assertLess(rubbed.end[1]["velocity"][0], smooth.end[1]["velocity"][0])

    def test_a_run_is_taken_step_by_step_with_the_bits_of_one_call(self):
        whole = abut.run(BARS, steps=150)
        steps = abut.memm(BARS, filter="neutral")
        steps.step(150)
        np.testing.assert_array_equal(steps.displacement, whole.displacement)
        with self.assertRaisesRegex(TypeError, "memm takes no 'out'"):
            abut.memm(BARS, out="here")
        loaded = abut.memm(BARS, outside=["right.xmax"])
        loaded.set_traction("right.xmax", np.full((len(loaded.faces("right.xmax")["area"]), 2), 0.01))
        loaded.step(3)
        self.assertGreater(loaded.outside_work["steps"], -1.0)

    def test_a_run_that_goes_on_has_the_tables_of_all_of_it(self):
        with tempfile.TemporaryDirectory() as folder:
            options = dict(steps=60, frames=0, checkpoint_steps=10)
            whole = abut.run(BARS, out=f"{folder}/whole", **options)
            abut.run(BARS, out=f"{folder}/part", look=lambda state: state.steps == 25, **options)
            rest = abut.run(BARS, out=f"{folder}/part", resume=True, **options)
            self.assertGreater(rest.resumed_after, 0)
            np.testing.assert_array_equal(rest.probes["left"], whole.probes["left"])
            np.testing.assert_array_equal(rest.forces, whole.forces)
            np.testing.assert_array_equal(rest.ledger, whole.ledger)

    def test_cells_leave_by_limits_and_by_a_function_and_frames_keep_the_size_of_the_scene(self):
        bar = {"shape": "structured_box", "lower": [0, 0], "upper": [2, 0.3], "counts": [20, 3], "young": 1, "poisson": 0,
               "density": 1, "velocity": [0.1, 0]}
        scene = {"dim": 2, "run": {"time": 2.0}, "bodies": {"bar": bar}}

        def leaving(state):
            return [30, 31] if state.steps == 5 else None

        result = abut.run(scene, leaving=leaving, frames=5)
        self.assertEqual(result.eroded["cell"].tolist(), [30, 31])
        self.assertEqual(set(result.eroded["step"]), {5})
        self.assertEqual(result.summary["erosion"]["by"]["function"], 2)
        self.assertAlmostEqual(result.summary["erosion"]["mass_share"], 2 / 60)
        for values in (result.frames.velocity, result.frames.von_mises):
            self.assertEqual(values.shape[:2], (5, 60))
            self.assertFalse(np.isnan(values[0]).any())
            self.assertEqual(np.flatnonzero(np.isnan(values[-1].reshape(60, -1)[:, 0])).tolist(), [30, 31])
        np.testing.assert_allclose(np.nanmax(abs(result.frames.velocity[-1][:, 0] - 0.1)), 0, atol=1e-12)
        ledger = result.ledger
        kept = ledger["pseudo_energy"] + ledger["eroded_kinetic"] + ledger["eroded_potential"]
        np.testing.assert_allclose(kept, kept[0], rtol=1e-13)
        self.assertEqual(ledger["eroded_cells"][-1], 2)

        pulled = copy.deepcopy(scene)
        pulled["bodies"]["bar"]["erosion"] = {"stress": 0.01}
        pulled["tractions"] = {side: {"group": f"bar.{side}", "value": [f"{sign} * 0.02 * t", 0]}
                               for side, sign in (("xmin", -1), ("xmax", 1))}
        first = abut.run(pulled, frames=0).eroded["time"][0]
        self.assertTrue(0.5 < first < 0.7)  # the load is at the limit at 0.5 s, and goes through a cell in 0.1 s
        with self.assertRaisesRegex(TypeError, "leaving.state. gave 'some'; numbers of cells are needed"):
            abut.run(scene, leaving=lambda state: "some")

    def test_a_result_has_its_bonds_and_fragments(self):
        fracture = {"grain": 0.3, "strength": 1e-3, "fracture_energy": 1e-7}
        plate = {"shape": "structured_box", "lower": [0, 0], "upper": [1, 1], "counts": [12, 12], "young": 1, "poisson": 0,
                 "density": 1, "spin": 0.1, "kinematics": "floating", "fracture": fracture}  # it bursts
        scene = {"dim": 2, "run": {"time": 3.0}, "bodies": {"plate": plate}}
        result = abut.run(scene, frames=0)
        bonds = result.bonds
        energy = 1e-7 * sum(bond["area"] for bond in bonds["made"])
        self.assertEqual(bonds["broken_share"], 1.0)
        self.assertAlmostEqual(bonds["dissipated"], energy, delta=1e-3 * energy)
        self.assertGreater(abs(bonds["beyond_fracture_energy"]), 1e-9 * energy)  # more than rounding
        self.assertAlmostEqual(bonds["beyond_fracture_energy"], bonds["dissipated"] - energy, delta=1e-12 * energy)
        masses = np.array([fragment["mass"] for fragment in result.fragments])
        velocities = np.array([fragment["velocity"] for fragment in result.fragments])
        self.assertGreater(len(masses), 4)
        self.assertEqual(sum(fragment["cells"] for fragment in result.fragments), 144)
        self.assertAlmostEqual(masses.sum(), 1.0, delta=1e-13)
        np.testing.assert_allclose(masses @ velocities, 0.0, atol=1e-13)
        self.assertGreater(abs(velocities).max(), 0.01)

        del plate["fracture"]
        whole = abut.run(scene, frames=0, steps=2)
        self.assertEqual((whole.bonds["made"], whole.bonds["broken_share"], whole.bonds["beyond_fracture_energy"]), ([], 0.0, 0.0))
        self.assertEqual(whole.fragments, [])

    def test_errors_are_exceptions_in_the_words_of_the_program(self):
        box = {"shape": "disk", "yung": 1.0}
        with self.assertRaises(abut.BadInput) as raised:
            abut.run({"dim": 2, "run": {"time": 1.0}, "bodies": {"a": box}})
        for text in ("4 faults", "scene: bodies.a.shape is 'disk', which is none of its words. Did you mean 'disc'?",
                     "bodies.a.yung is an unknown key. Did you mean 'young'?", "bodies.a.density is missing"):
            self.assertIn(text, str(raised.exception))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "wrong.toml"
            path.write_text("dim = 2\n[bodies.a]\nshape = 'disk'\n")
            with self.assertRaisesRegex(abut.BadInput, r"wrong.toml:3:1: bodies.a.shape is 'disk'"):
                abut.run(path)
            with self.assertRaisesRegex(abut.Diverged, "step [0-9]+, t = .*In the same folder failed.svg shows where"):
                abut.run(BARS, out=f"{folder}/lost", set={"run.dt": 0.015, "run.allow_unstable": True})
        with self.assertRaisesRegex(abut.BadInput, "no_such.toml: there is no such file"):
            abut.run("no_such.toml")
        with self.assertRaisesRegex(abut.BadInput, "bodies.left.densty is an unknown key. Did you mean 'density'?"):
            abut.run(BARS, set={"bodies.left.densty": 2})
        with self.assertRaisesRegex(TypeError, "no option 'stepz'"):
            abut.run(BARS, stepz=3)
        with self.assertRaisesRegex(TypeError, "None cannot be a value of a scene"):
            abut.run(BARS, set={"bodies.left.density": None})
        result = abut.run(BARS, steps=2)
        with self.assertRaisesRegex(AttributeError, "a result has no 'leger'; it has .*ledger"):
            result.leger

    def test_names_with_any_letters_come_through(self):
        name = 'b"ö\\d.y'
        body = {"shape": "structured_box", "lower": [0, 0], "upper": [1, 1], "counts": [2, 2], **STONE}
        self.assertEqual(abut.run({"dim": 2, "run": {"steps": 2}, "bodies": {name: body}}).mesh.body_names, [name])


def load_tests(_loader, tests, _pattern):
    for module in (_scenes, solid):
        tests.addTests(doctest.DocTestSuite(module))
    tests.addTest(doctest.DocTestCase(doctest.DocTestParser().get_doctest(abut.surface_of.__doc__, {}, "abut.surface_of", None, 0)))
    return tests


if __name__ == "__main__":
    unittest.main()
