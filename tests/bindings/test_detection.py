"""abut.detect and abut.CollisionManager: distances by formula, areas by formula, meshes of trimesh's and meshio's kind."""
import doctest
import pathlib
import tempfile
import types
import unittest

import numpy as np

import abut
import abut.detection

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
UP, DOWN = [[0, 1, 2, 3]], [[3, 2, 1, 0]]
CUBE = np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], dtype=float)
OUTSIDE = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]


def moved(x=0.0, y=0.0, z=0.0, about_z=0.0):
    matrix = np.eye(4)
    c, s = np.cos(about_z), np.sin(about_z)
    matrix[:2, :2] = [[c, -s], [s, c]]
    matrix[:3, 3] = x, y, z
    return matrix


class Detection(unittest.TestCase):
    def test_two_squares_share_what_lies_over_each_other(self):
        for faces in (UP, [[0, 1, 2], [0, 2, 3]]):
            found = abut.detect({"lower": (SQUARE, faces), "upper": (SQUARE, DOWN)}, transforms={"upper": moved(x=0.25, z=0.05)},
                                distance=0.1)
            (contact,) = found.contacts
            self.assertEqual(contact.names, ("lower", "upper"))
            self.assertAlmostEqual(contact.area, 0.75, delta=1e-14)
            self.assertAlmostEqual(contact.gap, 0.05, delta=1e-15)
            self.assertAlmostEqual(found.nearest.distance, 0.05, delta=1e-15)
            np.testing.assert_allclose(contact.overlaps["normal"], [[0, 0, 1]] * len(contact.overlaps), atol=1e-15)
            self.assertLess(contact.overlaps["face_1"].max(), len(faces))
            self.assertEqual(set(contact.overlaps["face_2"]), {0})

    def test_a_mesh_that_turns_comes_nearer_by_the_formula_of_its_corner(self):
        manager = abut.CollisionManager()
        manager.add_object("wall", (SQUARE[:, [2, 0, 1]] + [2.0, -0.5, -0.5], UP))  # at x = 2
        manager.add_object("plate", (SQUARE - 0.5 * np.array([1.0, 1.0, 0.0]), UP))
        for angle in np.linspace(0.0, np.pi / 2, 7):
            manager.set_transform("plate", moved(about_z=angle))
            reach = 0.5 * np.sqrt(2.0) * np.cos(abs(np.pi / 4 - angle % (np.pi / 2)))
            distance, names, data = manager.min_distance_internal(return_names=True, return_data=True)
            self.assertAlmostEqual(distance, 2.0 - reach, delta=1e-14)
            self.assertEqual(names, ("wall", "plate"))
            self.assertAlmostEqual(np.linalg.norm(data.points[1] - data.points[0]), distance, delta=1e-15)
            self.assertEqual(data.points[0][0], 2.0)
            self.assertFalse(manager.in_collision_internal())

    def test_meshes_of_trimesh_and_meshio_are_taken_and_cells_by_their_boundary(self):
        outside = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
        triangles = [[a, b, c] for f in outside for a, b, c in ((f[0], f[1], f[2]), (f[0], f[2], f[3]))]
        block = types.SimpleNamespace(type="hexahedron", data=np.array([[0, 1, 2, 3, 4, 5, 6, 7]]))
        one = types.SimpleNamespace(vertices=CUBE, faces=np.array(triangles))
        two = types.SimpleNamespace(points=CUBE, cells=[block])
        for meshes in ([one, two], [two, one], [two, two], [one, one]):
            found = abut.detect(meshes, transforms=[None, moved(x=0.3, z=1.05)], distance=0.1)
            self.assertEqual(len(found.contacts), 1)
            self.assertAlmostEqual(found.contacts[0].area, 0.7, delta=1e-14)
            self.assertAlmostEqual(found.nearest.distance, 0.05, delta=1e-14)
        twice = types.SimpleNamespace(points=np.vstack([CUBE, CUBE[4:] + [0, 0, 1]]), cells=[types.SimpleNamespace(
            type="hexahedron", data=np.array([[0, 1, 2, 3, 4, 5, 6, 7], [4, 5, 6, 7, 8, 9, 10, 11]]))])
        self.assertEqual(len(abut.detection._Surface(twice).offsets) - 1, 10)  # the face between the two is no boundary
        try:
            import meshio
        except ImportError:
            return
        found = abut.detect([meshio.Mesh(CUBE, {"hexahedron": np.arange(8)[None]}), one], transforms=[None, moved(z=1.5)])
        self.assertAlmostEqual(found.nearest.distance, 0.5, delta=1e-15)

    def test_collisions_name_their_pairs(self):
        manager = abut.CollisionManager()
        for name, place in (("a", moved()), ("b", moved(x=5.0)), ("c", moved(x=5.5, y=0.5, z=0.0, about_z=0.3))):
            manager.add_object(name, (SQUARE, UP), place)
        self.assertEqual(manager.in_collision_internal(return_names=True), (True, {("b", "c")}))
        self.assertEqual([found.names for found in manager.all_nearest()], [("b", "c"), ("a", "b"), ("a", "c")])
        manager.set_transform("c", moved(x=5.5, z=0.5))
        self.assertEqual(manager.in_collision_internal(return_names=True), (False, set()))
        manager.set_vertices("c", SQUARE + [0.0, 0.0, 0.25])
        self.assertEqual(manager.min_distance_internal(return_names=True), (0.25, ("a", "c")))
        manager.remove_object("a")
        self.assertEqual(manager.names, ["b", "c"])

    def test_a_body_that_is_wholly_inside_of_another_is_told_and_one_in_a_hollow_is_not(self):
        outwards = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
        around = [[10.0 * x - 5.0 for x in corner] for corner in CUBE.tolist()]
        manager = abut.CollisionManager()
        manager.add_object("small", (CUBE - 0.5, outwards))
        manager.add_object("large", (np.array(around), outwards))
        nearest = manager.nearest()
        self.assertEqual((nearest.distance, nearest.inside), (4.5, "small"))
        self.assertEqual(manager.in_collision_internal(return_names=True), (True, {("small", "large")}))
        manager.set_transform("small", moved(x=20.0))
        self.assertEqual((manager.nearest().distance, manager.nearest().inside), (14.5, None))
        self.assertFalse(manager.in_collision_internal())
        # Of two parts one is outside.
        manager.set_transform("small", None)
        n = len(CUBE)
        far = outwards + [[corner + n for corner in face] for face in outwards]
        manager.add_object("small", (np.concatenate([CUBE - 0.5, CUBE - 0.5 + [20.0, 0.0, 0.0]]), far))
        self.assertIsNone(manager.nearest().inside)
        near = (np.concatenate([CUBE - 0.5, CUBE - 0.5 + [3.0, 0.0, 0.0]]), far)
        manager.add_object("small", near)
        self.assertEqual(manager.nearest().inside, "small")
        # A cavity, whose normals look into it, and a box without its lid hold bodies, and have no inside.
        manager.set_transform("small", None)
        for faces in ([face[::-1] for face in outwards], outwards[:1] + outwards[2:]):
            manager.add_object("large", (np.array(around), faces))
            self.assertIsNone(manager.nearest().inside)
            self.assertFalse(manager.in_collision_internal())

    def test_meshes_that_cross_are_as_deep_as_the_face_of_one_is_below_that_of_the_other(self):
        one, other = (CUBE, OUTSIDE), (CUBE + [0.25, 0.0, 0.875], OUTSIDE)
        found = abut.detect(one, other, distance=0.01)
        self.assertEqual(found.nearest.distance, 0.0)
        self.assertAlmostEqual(found.nearest.depth, 0.125, delta=1e-15)
        self.assertIn("'mesh_0' and 'mesh_1' cross each other, 0.125 m deep, at (", repr(found))
        self.assertEqual(abut.detect(one, (CUBE + [0.0, 0.0, 1.0], OUTSIDE)).nearest.depth, 0.0)  # they touch
        self.assertAlmostEqual(abut.detect(one, (CUBE + [0.0, 0.0, 1.5], OUTSIDE)).nearest.depth, -0.5, delta=1e-15)

    def test_files_are_meshes_and_what_touches_goes_back_to_meshio(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("meshio is not installed")
        with tempfile.TemporaryDirectory() as folder:
            paths = [pathlib.Path(folder, name) for name in ("lower.obj", "upper.stl")]
            triangles = [[a, b, c] for f in OUTSIDE for a, b, c in ((f[0], f[1], f[2]), (f[0], f[2], f[3]))]
            meshio.Mesh(CUBE, [("triangle", np.array(triangles))]).write(paths[0])
            meshio.Mesh(CUBE + [0.3, 0.0, 1.05], [("triangle", np.array(triangles))]).write(paths[1])
            for found in (abut.detect(paths, distance=0.1), abut.detect(*map(str, paths), distance=0.1)):
                self.assertEqual(found.contacts[0].names, ("lower", "upper"))
                self.assertAlmostEqual(found.contacts[0].area, 0.7, delta=1e-7)  # of STL in single precision
                self.assertEqual(repr(found).splitlines()[1], "'lower' and 'upper': 0.7 m^2 lie opposite each other within 0.1 m")
                self.assertIn("<td>lower</td><td>upper</td><td>0.7</td>", found._repr_html_())
            mesh = found.to_meshio()
            area, number = (np.concatenate(mesh.cell_data[name]) for name in ("area [m^2]", "mesh"))
            self.assertEqual((len(mesh.points), len(area)), (16, 24))
            self.assertAlmostEqual(area[number == 0].sum(), 0.7, delta=1e-7)
            self.assertAlmostEqual(area[number == 1].sum(), 0.7, delta=1e-7)
            pathlib.Path(folder, "broken.obj").write_text("v 0 0\nf 1 2 3\n")
            with self.assertRaisesRegex(ValueError, "'broken': "):
                abut.detect(paths[0], pathlib.Path(folder, "broken.obj"))

    def test_what_cannot_be_is_refused_by_name(self):
        manager = abut.CollisionManager()
        manager.add_object("a", (SQUARE, UP))
        for call, error, words in (
                (lambda: manager.set_transform("b", None), KeyError, "no object 'b'"),
                (lambda: manager.set_transform("a", np.eye(3)), ValueError, "(4, 4)"),
                (lambda: manager.set_transform("a", np.diag([1.0, 1, -1, 1])), ValueError, "inside out"),
                (lambda: manager.min_distance_internal(), ValueError, "two objects"),
                (lambda: manager.add_object("c", 3), TypeError, "vertices and faces"),
                (lambda: abut.detect(["cube.obj", "cube.stl"]), FileNotFoundError, "cube.obj: there is no such file"),
                (lambda: manager.add_object("c", (SQUARE, [])), ValueError, "no faces"),
                (lambda: abut.detect([(SQUARE, UP)] * 2, transforms=[None]), ValueError, "1 transforms for 2 meshes"),
                (lambda: abut.detect([(SQUARE, UP), (SQUARE, [[0, 1, 9]])]), ValueError, "names vertex 9, but there are 4"),
                (lambda: abut.detect([(SQUARE, UP), (SQUARE * np.nan, UP)]), ValueError, "vertex 0 is not finite"),
                (lambda: abut.detect([(SQUARE, UP), (SQUARE, UP)], distance=-1.0), ValueError, "distance is -1.0; 0 m or more")):
            with self.assertRaises(error) as caught:
                call()
            self.assertIn(words, str(caught.exception))

    def test_the_examples_of_the_page_are_right(self):
        self.assertEqual(doctest.testmod(abut.detection).failed, 0)


if __name__ == "__main__":
    unittest.main()
