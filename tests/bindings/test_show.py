"""Pictures of meshes and results."""
import subprocess
import sys
import types
import unittest
import xml.etree.ElementTree
from unittest import mock

import numpy as np

import abut
from abut import solid

BOXES = {2: lambda name="box": solid.structured_box((0, 0), (2, 1), (4, 2), name=name),
         3: lambda: solid.structured_box((0, 0, 0), (1, 2, 3), (1, 2, 3))}


def moved():
    block = {"shape": "structured_box", "lower": [0, 0], "upper": [1, 1], "counts": [2, 2], "young": 1, "density": 1, "velocity": [1, 0]}
    return abut.run({"title": "a <block>", "dim": 2, "run": {"time": 1.0, "dt": 0.1}, "bodies": {"block": block}})


def colliding(**options):
    block = {"shape": "structured_box", "lower": [0, 0], "upper": [1, 1], "counts": [4, 4], "young": 1, "density": 1}
    return abut.run({"dim": 2, "run": {"time": 4.0}, "bodies": {"left": {**block, "velocity": [0.1, 0]}, "right": {**block, "place": [1.1, 0.1]}},
                     "output": {"probes": {"tip": {"body": "left", "point": [0.9, 0.5]}}}}, **options)


class Notebooks(unittest.TestCase):
    def test_a_mesh_is_well_formed_and_draws_what_is_seen_of_it(self):
        for dim, seen in ((2, 8), (3, 2 * 3 + 1 * 3 + 1 * 2)):  # cells; faces of three sides
            page = BOXES[dim]()._repr_html_()
            tree = xml.etree.ElementTree.fromstring(page)
            self.assertEqual(len(tree.findall(".//polygon")), seen)
            self.assertIn("xmin", page)
        self.assertIn("&lt;b&gt;", BOXES[2](name="<b>")._repr_html_())

    def test_a_result_tells_its_verdict_and_title(self):
        result = moved()
        page = result._repr_html_()
        xml.etree.ElementTree.fromstring(page)
        self.assertIn("a &lt;block&gt;", page)
        self.assertIn(result.verdict, page)

    def test_large_meshes_have_no_picture_within_a_page(self):
        self.assertNotIn("<svg", solid.structured_box((0, 0), (1, 1), (70, 70))._repr_html_())


class Pictures(unittest.TestCase):
    def test_the_mesh_of_a_result_has_its_methods_without_another_import(self):
        code = ("import abut; block = dict(shape='structured_box', lower=[0, 0], upper=[1, 1], counts=[2, 2], young=1, density=1); "
                "mesh = abut.run(dict(dim=2, run=dict(steps=1), bodies=dict(block=block))).mesh; "
                "assert 'block' in mesh._repr_html_() and callable(mesh.show) and callable(mesh.to_pyvista)")
        subprocess.run([sys.executable, "-c", code], check=True)

    def test_matplotlib_draws_bodies_where_they_are(self):
        matplotlib = self.needs("matplotlib")
        matplotlib.use("Agg")
        axes = BOXES[2]().show(displacement=np.full((15, 2), 3.0))
        self.assertEqual((axes.get_xlim(), axes.get_ylim()), ((3.0, 5.0), (3.0, 4.0)))
        self.assertEqual(BOXES[3]().show(values=np.arange(6.0)).get_zlim(), (0.0, 3.0))
        figure = moved().show("speed")
        self.assertEqual([round(x, 9) for x in figure.axes[0].get_xlim()], [1.0, 2.0])  # 1 m/s for 1 s
        self.assertIn("speed [m/s], t = 1 s", figure.axes[0].get_title())
        with self.assertRaisesRegex(ValueError, "field is 'strain'; 'von_mises', 'speed'"):
            moved().show("strain")

    def test_several_frames_stand_side_by_side_with_one_scale_of_colours(self):
        self.needs("matplotlib").use("Agg")
        result = colliding(frames=4)
        figure = result.show(frame=[0, 2, -1])
        titles = [axes.get_title() for axes in figure.axes]
        for i in (0, 2, 3):
            self.assertIn(f"von Mises stress [Pa], t = {result.frames.time[i]:.4g} s", titles)
        scales = {axes.collections[0].get_clim() for axes in figure.axes if "Mises" in axes.get_title()}
        self.assertEqual(scales, {(result.frames.von_mises[[0, 2, 3]].min(), result.frames.von_mises[[0, 2, 3]].max())})

    def test_forces_are_0_where_nothing_touches_and_probes_are_drawn_by_column(self):
        self.needs("matplotlib").use("Agg")
        result = colliding()
        line, = result.show_forces().lines  # without friction nothing rubs
        self.assertEqual(line.get_label(), "left on right")
        times, force = line.get_data()
        self.assertEqual((len(times), force[0], np.count_nonzero(force)), (len(result.ledger), 0.0, len(result.forces)))
        self.assertEqual(force.max(), result.forces["normal_force"].max())
        axes = result.show_probes("velocity_x")
        self.assertEqual([line.get_label() for line in axes.lines], ["tip"])
        np.testing.assert_array_equal(axes.lines[0].get_ydata(), result.probes["tip"]["velocity_x"])
        with self.assertRaisesRegex(ValueError, "no probe has 'speed'; there are displacement_x, "):
            result.show_probes("speed")
        with self.assertRaisesRegex(ValueError, "this result has no probes"):
            moved().show_probes("velocity_x")

    def test_a_name_with_signs_of_formulas_stands_as_it_is(self):
        matplotlib = self.needs("matplotlib")
        matplotlib.use("Agg")
        block = {"shape": "structured_box", "lower": [0, 0], "upper": [1, 1], "counts": [2, 2], "young": 1, "density": 1}
        for title in ("$a_ $", "5 $ and 6 $", "one $ alone", "_plate_1_", r"a\_b"):
            result = abut.run({"title": title, "dim": 2, "run": {"steps": 1}, "bodies": {"block": block}, "output": {"frames": 2}})
            figure = result.show()
            figure.canvas.draw()  # which is where a formula that is none would fail
            drawn = figure.axes[-1].title.get_text()
            self.assertFalse(matplotlib.cbook.is_math_text(drawn))
            self.assertEqual(drawn.replace(r"\$", "$"), title)  # matplotlib takes the backslash away, as there is no formula

    def test_pyvista_gets_the_cells_of_vtk(self):
        class Grid:
            def __init__(self, cells, types, points):
                self.cells, self.types, self.points, self.cell_data = cells, types, points, {}
        with mock.patch.dict(sys.modules, pyvista=types.SimpleNamespace(UnstructuredGrid=Grid)):
            grid = moved().to_pyvista()
        self.assertEqual((grid.types.tolist(), grid.cells[::5].tolist()), ([9] * 4, [4] * 4))
        np.testing.assert_allclose([grid.points[:, 0].min(), grid.points[:, 2].max()], [1.0, 0.0], atol=1e-12)
        self.assertEqual(set(grid.cell_data), {"body", "velocity", "stress", "von_mises"})
        np.testing.assert_allclose(grid.cell_data["velocity"][:, 0], 1.0)

    def test_what_is_not_installed_is_said(self):
        with mock.patch.dict(sys.modules, {"pyvista": None, "matplotlib": None}):
            with self.assertRaisesRegex(ImportError, "pyvista is not installed; install it"):
                BOXES[2]().to_pyvista()
            with self.assertRaisesRegex(ImportError, "matplotlib is not installed; install it .apt install python3-matplotlib"):
                BOXES[2]().show()

    def needs(self, module):
        try:
            return __import__(module)
        except ImportError:
            self.skipTest(f"{module} is not there")


if __name__ == "__main__":
    unittest.main()
