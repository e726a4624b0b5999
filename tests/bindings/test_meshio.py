"""test_meshio.py SCENES: meshes of meshio become meshes of abut.solid. Expected values are those of the boxes that the files hold."""
import pathlib
import sys
import tempfile
import unittest
import warnings

import meshio
import numpy as np

from abut import solid

SCENES = pathlib.Path(sys.argv.pop(1))


def two_boxes():
    """A box of hexahedra of 1 m^3 beside one of tetrahedra of 8 m^3, with sets of cells, of faces below, and of points on top."""
    boxes = [solid.structured_box((0, 0, 0), (1, 1, 1), (2, 2, 2)),
             solid.structured_box((2, 0, 0), (4, 2, 2), (2, 2, 2), shape="tetra")]
    first = [0, len(boxes[0].points)]
    points = np.vstack([box.points for box in boxes])
    cells = [(box.cells[0][0], box.cells[0][1] + n) for box, n in zip(boxes, first)]
    feet = []
    for box, n in zip(boxes, first):
        faces, offsets = box.surface["faces"], box.surface["offsets"]
        feet.append(np.array([faces[offsets[f]:offsets[f + 1]] for f in box.groups["zmin"]]) + n)
    cells += [("quad", feet[0]), ("triangle", feet[1])]
    sizes = [len(data) for _, data in cells]
    chosen = lambda *of: [np.arange(size) if k in of else np.array([], int) for k, size in enumerate(sizes)]
    top = np.flatnonzero((points[:, 2] == 1.0) & (points[:, 0] <= 1.0))
    return meshio.Mesh(points, cells, cell_sets={"stone": chosen(0), "wood": chosen(1), "foot": chosen(2, 3)}, point_sets={"top": top})


def area_of(mesh, group):
    faces, offsets = mesh.surface["faces"], mesh.surface["offsets"]
    area = 0.0
    for f in mesh.groups[group]:
        x = mesh.points[faces[offsets[f]:offsets[f + 1]]]
        area += 0.5 * np.linalg.norm(sum(np.cross(x[i] - x[0], x[i + 1] - x[0]) for i in range(1, len(x) - 1)))
    return area


class Meshes(unittest.TestCase):
    def check_two_boxes(self, mesh, names=("stone", "wood"), groups=("foot", "top")):
        volume = {name: mesh.measures[mesh.body == b].sum() for b, name in enumerate(mesh.body_names)}
        self.assertEqual(set(volume), set(names))
        for name, expected in zip(names, (1.0, 8.0)):
            self.assertAlmostEqual(volume[name], expected, delta=1e-12)
        for group, expected in zip(("foot", "top"), (5.0, 1.0)):
            if group in groups:
                self.assertAlmostEqual(area_of(mesh, group), expected, delta=1e-12)

    def test_sets_of_cells_are_bodies_and_sets_of_faces_and_points_are_groups(self):
        self.check_two_boxes(solid.mesh(two_boxes()))

    def test_files_of_other_codes_come_in(self):
        given, read = two_boxes(), []
        foot = given.cell_sets.pop("foot")  # of two blocks, of which meshio's .inp keeps the last
        none = [np.array([], int)] * len(foot)
        given.cell_sets |= {"foot": [*none[:2], foot[2], none[3]], "wide foot": [*none[:3], foot[3]]}
        for name in ("boxes.inp", "boxes.vtk", "boxes.vtu", "boxes.med", "boxes.exo", "boxes.bdf", "boxes.xdmf"):
            with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
                warnings.simplefilter("ignore")
                path = pathlib.Path(folder) / name
                try:
                    meshio.write(path, given)
                    again = meshio.read(path)
                except ImportError:
                    continue  # h5py or netCDF4 is not there
            mesh = solid.mesh(again)
            volumes = sorted(mesh.measures[mesh.body == b].sum() for b in range(len(mesh.body_names)))
            np.testing.assert_allclose(volumes, [1.0, 8.0], rtol=1e-6, err_msg=name)  # .bdf has few digits
            read.append(name)
            if name == "boxes.inp":
                self.assertEqual(mesh.body_names, ["stone", "wood"])
                for group, expected in (("foot", 1.0), ("wide foot", 4.0), ("top", 1.0)):
                    self.assertAlmostEqual(area_of(mesh, group), expected, delta=1e-12)
        self.assertLessEqual({"boxes.inp", "boxes.vtk", "boxes.vtu", "boxes.bdf"}, set(read))

    def test_numbers_of_med_stand_for_several_sets(self):
        given = two_boxes()
        numbers = {"hexahedron": -1, "tetra": -2, "quad": -3, "triangle": -4}
        tagged = meshio.Mesh(given.points, given.cells,
                             cell_data={"cell_tags": [np.full(len(block.data), numbers[block.type]) for block in given.cells]})
        tagged.cell_tags = {-1: ["stone"], -2: ["wood"], -3: ["foot"], -4: ["foot", "wide"]}
        mesh = solid.mesh(tagged)
        self.check_two_boxes(mesh, groups=("foot",))
        self.assertAlmostEqual(area_of(mesh, "wide"), 4.0, delta=1e-12)

    def test_a_file_of_ours_gives_its_groups_back(self):
        box = solid.structured_box((0, 0, 0), (1, 2, 3), (2, 2, 2), shape="wedge")
        with tempfile.TemporaryDirectory() as folder:
            box.write_vtu(f"{folder}/box.vtu")
            again = solid.mesh(meshio.read(f"{folder}/box.vtu"))
        self.assertEqual(set(again.groups), set(box.groups))
        self.assertEqual(again.body_names, box.body_names)
        for group, area in (("xmin", 6.0), ("ymax", 3.0), ("zmin", 2.0)):
            self.assertAlmostEqual(area_of(again, group), area, delta=1e-12)
        self.assertAlmostEqual(again.measures.sum(), 6.0, delta=1e-12)

    def test_files_of_ours_of_any_size_are_read(self):
        """meshio rewrites offsets of arrays while it looks arrays up by their offsets."""
        with tempfile.TemporaryDirectory() as folder:
            for n in range(2, 30):
                box = solid.structured_box((0, 0), (1, 1), (n, 2))
                box.write_vtu(f"{folder}/box.vtu")
                self.assertEqual(len(solid.mesh(meshio.read(f"{folder}/box.vtu")).groups), len(box.groups))

    def test_numbers_of_gmsh_are_bodies_by_their_names(self):
        for name in ("card_house", "arch"):
            ours, theirs = solid.read_mesh(SCENES / f"{name}.msh", 2), solid.mesh(meshio.read(SCENES / f"{name}.msh"))
            self.assertEqual(sorted(ours.body_names), sorted(theirs.body_names))
            for b, body in enumerate(ours.body_names):
                other = theirs.body == theirs.body_names.index(body)
                np.testing.assert_allclose(np.sort(ours.measures[ours.body == b]), np.sort(theirs.measures[other]), rtol=1e-12)

    def test_parts_without_a_set_are_bodies_each_and_smaller_sets_count(self):
        given = two_boxes()
        every = [np.arange(len(block.data)) if block.type in ("hexahedron", "tetra") else np.array([], int) for block in given.cells]
        self.check_two_boxes(solid.mesh(meshio.Mesh(given.points, given.cells)), ("body_1", "body_2"), ())
        within = meshio.Mesh(given.points, given.cells, cell_sets={"stone": given.cell_sets["stone"], "all": every})
        self.check_two_boxes(solid.mesh(within), ("stone", "all"), ())
        crossed = [every[0][:3], every[1][:3], *every[2:]]
        with self.assertRaisesRegex(ValueError, "cells of the set 'crossed' are in 'stone' and 'wood' as well"):
            solid.mesh(meshio.Mesh(given.points, given.cells, cell_sets={**given.cell_sets, "crossed": crossed}))

    def test_of_equal_sets_the_first_names_the_body(self):
        given = two_boxes()
        sets = {**given.cell_sets, "Volume1": given.cell_sets["stone"], "Volume2": given.cell_sets["wood"]}
        self.check_two_boxes(solid.mesh(meshio.Mesh(given.points, given.cells, cell_sets=sets)), groups=("foot",))

    def test_a_set_of_sets_in_an_inp_file_is_refused_by_its_name(self):
        text = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,1,1,1\n*ELEMENT,TYPE=C3D4,ELSET=a\n1,1,2,3,4\n" \
               "*ELEMENT,TYPE=C3D4,ELSET=b\n2,2,3,4,5\n*ELSET,ELSET=both\n"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.inp"
            path.write_text(text + "a\n")
            with self.assertRaisesRegex(ValueError, "the set of cells 'both' has 1 lists of cells, the mesh has 2 blocks.*write its elements"):
                solid.mesh(meshio.read(path))
            path.write_text(text + "1,2\n")
            self.assertEqual(solid.mesh(meshio.read(path)).measures.shape, (2,))

    def test_numbers_of_points_and_cells_that_are_not_there_are_refused_with_their_place(self):
        points = np.array([[0, 0], [1, 0], [0, 1]], float)
        for corners, what in (([0, 1, -1], -1), ([0, 1, 3], 3)):
            with self.assertRaisesRegex(ValueError, rf"block 0 of cells \('triangle'\) names the point {what}, there are 0 to 2"):
                solid.mesh(meshio.Mesh(points, [("triangle", [corners])]))
        for nodes in ([-1, 0], [0, 3]):
            with self.assertRaisesRegex(ValueError, "the set of points 'top' names the point"):
                solid.mesh(meshio.Mesh(points, [("triangle", [[0, 1, 2]])], point_sets={"top": nodes}))
        for rows in ([-1], [1]):
            with self.assertRaisesRegex(ValueError, "the set of cells 'stone' of block 0 .* names the cell .*, there are 0 to 0"):
                solid.mesh(meshio.Mesh(points, [("triangle", [[0, 1, 2]])], cell_sets={"stone": [np.array(rows)]}))

    def test_numbers_of_su2_and_of_vtk_files_of_gmsh_are_sets(self):
        points = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [2, 0]], float)
        cells = [("triangle", [[0, 1, 2], [0, 2, 3], [1, 4, 2]]), ("line", [[0, 1], [4, 2]])]
        for key in ("su2:tag", "CellEntityIds"):
            mesh = solid.mesh(meshio.Mesh(points, cells, cell_data={key: [np.array([7, 7, 8]), np.array([1, 2])]}))
            self.assertEqual((mesh.body_names, sorted(mesh.groups)), (["set_7", "set_8"], ["set_1", "set_2"]))
            self.assertEqual([mesh.measures[mesh.body == b].sum() for b in (0, 1)], [1.0, 0.5])

    def test_curved_cells_are_straightened_with_a_word_and_loose_points_go(self):
        points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.5, -0.1, 0], [0.5, 0.5, 0], [0, 0.5, 0], [9, 9, 0]], float)
        with self.assertWarnsRegex(RuntimeWarning, "straight sides"):
            mesh = solid.mesh(meshio.Mesh(points, [("triangle6", [[0, 1, 2, 3, 4, 5]])]))
        self.assertEqual((mesh.measures.tolist(), len(mesh.points)), ([0.5], 3))

    def test_what_fills_no_body_is_refused(self):
        points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 1]], float)
        with self.assertRaisesRegex(ValueError, "has faces alone, and is not in a plane: z goes from 0 to 1 m"):
            solid.mesh(meshio.Mesh(points, [("triangle", [[0, 1, 2]])]))
        with self.assertRaisesRegex(ValueError, "no cells that fill a body; it has line"):
            solid.mesh(meshio.Mesh(points, [("line", [[0, 1]])]))
        with self.assertRaisesRegex(TypeError, "mesh needs cells beside points, or a meshio.Mesh alone"):
            solid.mesh(points)


if __name__ == "__main__":
    unittest.main()
