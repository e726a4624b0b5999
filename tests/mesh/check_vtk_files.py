#!/usr/bin/env python3
"""VTU and VTP files, with VTK and meshio as judges: check_vtk_files.py VTK_FILES, the program of vtk_files.cpp.

What Abut writes is read alike by Abut, VTK and meshio; what VTK and meshio write, in all encodings, is read by Abut as by them.
All bits of all values are compared. Needs python3-vtk9 and python3-meshio; exits with 77 where one is missing.
"""
import itertools
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import meshio
    import numpy
    from vtkmodules import vtkCommonCore as core, vtkCommonDataModel as model, vtkIOXML as xml
    from vtkmodules.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print(f"left out: {error}")
    sys.exit(77)

PROGRAM = sys.argv[1]
failures = []


def same(a, b):
    a, b = numpy.asarray(a, float).ravel(), numpy.asarray(b, float).ravel()
    return len(a) == len(b) and a.tobytes() == b.tobytes()


def check(good, what):
    if not good:
        failures.append(what)
        print("FAILED:", what)


class Grid:
    """Points, cells as (type, corners), and arrays by name as (number of components, values)."""

    def __init__(self):
        self.points, self.cells, self.error = [], [], None
        self.data = {"point_data": {}, "cell_data": {}}


def read_by_abut(paths):
    text = subprocess.run([PROGRAM, "read", *map(str, paths)], capture_output=True, text=True, check=True).stdout
    grids = []
    for line in text.splitlines():
        kind, rest = line.split("\t", 1)
        if kind == "file":
            grids.append(Grid())
        elif kind == "error":
            grids[-1].error = rest
        elif kind == "points":
            grids[-1].points = [float.fromhex(x) for x in rest.split()]
        elif kind == "cell":
            words = rest.split()
            grids[-1].cells.append((int(words[0]), tuple(map(int, words[1:]))))
        else:
            name, n_components, values = rest.split("\t")
            grids[-1].data[kind][name] = (int(n_components), [float.fromhex(x) for x in values.split()])
    return grids


def arrays_of(data):
    result = {}
    for i in range(data.GetNumberOfArrays()):
        array = data.GetArray(i)
        n = array.GetNumberOfComponents()
        values = [array.GetComponent(t, k) for t in range(array.GetNumberOfTuples()) for k in range(n)]
        result[array.GetName()] = (n, values)
    return result


def as_grid(data):
    """Of a data set of VTK. In a file of poly data a cell is one of four kinds; VTK tells single vertices, triangles and the
    like apart when it is asked."""
    grid = Grid()
    grid.points = vtk_to_numpy(data.GetPoints().GetData()).copy() if data.GetNumberOfPoints() else []
    kinds = {1: 2, 3: 4, 5: 7, 9: 7} if isinstance(data, model.vtkPolyData) else {}
    ids = core.vtkIdList()
    for c in range(data.GetNumberOfCells()):
        data.GetCellPoints(c, ids)
        kind = data.GetCellType(c)
        grid.cells.append((kinds.get(kind, kind), tuple(ids.GetId(i) for i in range(ids.GetNumberOfIds()))))
    grid.data = {"point_data": arrays_of(data.GetPointData()), "cell_data": arrays_of(data.GetCellData())}
    return grid


READERS = {".vtu": xml.vtkXMLUnstructuredGridReader, ".vtp": xml.vtkXMLPolyDataReader,
           ".pvtu": xml.vtkXMLPUnstructuredGridReader, ".pvtp": xml.vtkXMLPPolyDataReader}


def vtk_data(path):
    reader = READERS[path.suffix]()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def compare(grid, wanted, what):
    check(grid.error is None, f"{what}: {grid.error}")
    if grid.error:
        return
    check(same(grid.points, wanted.points), f"{what}: points")
    check(grid.cells == wanted.cells, f"{what}: cells")
    for kind, arrays in wanted.data.items():
        check(set(grid.data[kind]) == set(arrays), f"{what}: {kind} {sorted(grid.data[kind])}, not {sorted(arrays)}")
        for name in set(arrays) & set(grid.data[kind]):
            n, values = arrays[name]
            check(grid.data[kind][name][0] == n and same(grid.data[kind][name][1], values), f"{what}: {kind} '{name}'")


def check_numbers(data, what):
    """The time of a frame, and the numbers of bodies."""
    check(data.GetArray("TimeValue") and data.GetArray("TimeValue").GetValue(0) == 1.0 / 3.0, f"{what}: time")
    body = data.GetArray("body: box")
    check("points" in what or (body and body.GetValue(0) == 0), f"{what}: body")


def check_written_by_abut(folder):
    subprocess.run([PROGRAM, "write", str(folder)], check=True)
    paths = sorted(path for path in folder.rglob("*") if path.suffix in (".vtu", ".vtp"))
    check(len(paths) == 19, f"files that Abut wrote: {len(paths)}")
    for path, grid in zip(paths, read_by_abut(paths)):
        data = vtk_data(path)
        compare(grid, as_grid(data), path.name)
        tensor = data.GetCellData().GetArray("stress [Pa]")
        if tensor:
            names = [tensor.GetComponentName(i) for i in range(6)]
            check(names == ["XX", "YY", "ZZ", "XY", "YZ", "XZ"], f"{path.name}: components {names}")
        if path.name != "gear.vtp":
            check_numbers(data.GetFieldData(), path.name)
        if path.suffix == ".vtu":
            mesh = meshio.read(path)
            check(mesh.field_data["TimeValue"][0] == 1.0 / 3.0, f"{path.name}: time of meshio")
            check(same(mesh.points, grid.points), f"{path.name}: points of meshio")
            of = sorted if mesh.cells[0].type == "wedge" else tuple  # meshio puts wedges in an order of its own
            corners = [of(map(int, row)) for block in mesh.cells for row in block.data]
            check(corners == [of(corners) for _, corners in grid.cells], f"{path.name}: cells of meshio")
            for name, blocks in mesh.cell_data.items():
                check(same(numpy.concatenate(blocks), grid.data["cell_data"][name][1]), f"{path.name}: '{name}' of meshio")
    check(grid_names(folder) == {"body", "displacement", "a < b & \"c\" [J]", "stress [Pa]"}, "names of arrays")
    for kind in ("vtu", "vtp"):
        heads = folder / f"frames/pieces{'' if kind == 'vtu' else '_surface'}_000000.p{kind}"
        pieces = read_by_abut([heads.with_name(f"{heads.stem}_{i}.{kind}") for i in (0, 1)])
        whole = as_grid(vtk_data(heads))
        check_numbers(vtk_data(heads).GetFieldData(), heads.name)
        joined, n_points = Grid(), 0
        for piece in pieces:
            joined.points = [*joined.points, *piece.points]
            joined.cells += [(t, tuple(c + n_points for c in corners)) for t, corners in piece.cells]
            n_points += len(piece.points) // 3
            for of in ("point_data", "cell_data"):
                for name, (n, values) in piece.data[of].items():
                    joined.data[of][name] = (n, joined.data[of].get(name, (n, []))[1] + values)
        compare(joined, whole, heads.name)


def grid_names(folder):
    return set(read_by_abut([folder / "frames/plane_0_000000.vtu"])[0].data["cell_data"])


TYPES = {core.vtkSignedCharArray: (-2**7, 2**7), core.vtkUnsignedCharArray: (0, 2**8), core.vtkShortArray: (-2**15, 2**15),
         core.vtkUnsignedShortArray: (0, 2**16), core.vtkIntArray: (-2**31, 2**31), core.vtkUnsignedIntArray: (0, 2**32),
         core.vtkLongLongArray: (-2**53, 2**53), core.vtkUnsignedLongLongArray: (0, 2**53), core.vtkFloatArray: None,
         core.vtkDoubleArray: None, core.vtkBitArray: (0, 2)}


def add_arrays(data, n):
    random = numpy.random.default_rng(n)
    for i, (kind, limits) in enumerate(TYPES.items()):
        array = kind()
        array.SetName(kind.__name__)
        array.SetNumberOfComponents((1, 2, 3, 6, 9)[i % 5])
        array.SetNumberOfTuples(n)
        for t in range(n):
            for k in range(array.GetNumberOfComponents()):
                array.SetComponent(t, k, float(random.integers(*limits)) if limits else random.uniform(-1e30, 1e30))
        data.AddArray(array)


def random_points(n):
    points = core.vtkPoints()
    points.SetDataTypeToDouble()
    for x in numpy.random.default_rng(1).normal(size=(n, 3)):
        points.InsertNextPoint(x)
    return points


def unstructured_grid(n):
    """Cells of all types that Abut reads, and others; data in more than one block of bytes."""
    grid = model.vtkUnstructuredGrid()
    grid.SetPoints(random_points(n))
    random = numpy.random.default_rng(2)
    for kind, size in [(1, 1), (3, 2), (4, 5), (5, 3), (6, 5), (7, 6), (8, 4), (9, 4), (10, 4), (11, 8), (12, 8), (13, 6),
                       (14, 5), (22, 6), (24, 10), (25, 20)] * (n // 8):
        grid.InsertNextCell(kind, size, [int(i) for i in random.integers(0, n, size)])
    add_arrays(grid.GetPointData(), n)
    add_arrays(grid.GetCellData(), grid.GetNumberOfCells())
    return grid


def poly_data(n):
    data = model.vtkPolyData()
    data.SetPoints(random_points(n))
    random = numpy.random.default_rng(3)
    for setter, sizes in ((data.SetVerts, (1, 2)), (data.SetLines, (2, 5)), (data.SetPolys, (3, 4, 6)), (data.SetStrips, (4, 7))):
        cells = model.vtkCellArray()
        for size in sizes * (n // 8):
            cells.InsertNextCell(size, [int(i) for i in random.integers(0, n, size)])
        setter(cells)
    add_arrays(data.GetPointData(), n)
    add_arrays(data.GetCellData(), data.GetNumberOfCells())
    return data


def write_by_vtk(writer, data, path, mode, compressor, big_endian, wide_header, wide_ids):
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    {"ascii": writer.SetDataModeToAscii, "binary": writer.SetDataModeToBinary}.get(mode, writer.SetDataModeToAppended)()
    writer.SetEncodeAppendedData(mode == "base64")
    {"zlib": writer.SetCompressorTypeToZLib, "lz4": writer.SetCompressorTypeToLZ4, "lzma": writer.SetCompressorTypeToLZMA,
     "none": writer.SetCompressorTypeToNone}[compressor]()
    (writer.SetByteOrderToBigEndian if big_endian else writer.SetByteOrderToLittleEndian)()
    (writer.SetHeaderTypeToUInt64 if wide_header else writer.SetHeaderTypeToUInt32)()
    (writer.SetIdTypeToInt64 if wide_ids else writer.SetIdTypeToInt32)()
    check(writer.Write() == 1, f"VTK writes {path.name}")


def check_written_by_vtk(folder):
    for n in (9, 1000):
        for data, writer, suffix in ((unstructured_grid(n), xml.vtkXMLUnstructuredGridWriter, ".vtu"),
                                     (poly_data(n), xml.vtkXMLPolyDataWriter, ".vtp")):
            modes = [("ascii", "none", False, False, False), ("ascii", "lz4", False, False, False)]
            modes += [mode for mode in itertools.product(("binary", "base64", "raw"), ("none", "zlib"), *[(False, True)] * 3)
                      if n == 9 or mode[2:] in ((False, False, True), (True, True, False))]
            paths = [folder / ("_".join(map(str, (n, *mode))) + suffix) for mode in modes]
            for path, mode in zip(paths, modes):
                write_by_vtk(writer(), data, path, *mode)
            wanted = as_grid(data)
            for path, mode, grid in zip(paths, modes, read_by_abut(paths)):
                compare(grid, as_grid(vtk_data(path)) if mode[0] == "ascii" else wanted, path.name)
            for compressor in ("lz4", "lzma"):
                path = folder / f"{n}_{compressor}{suffix}"
                write_by_vtk(writer(), data, path, "raw", compressor, False, False, True)
                said = read_by_abut([path])[0].error or "nothing"
                check("Convert it: open it in ParaView and save it with the compressor ZLib" in said, f"{path.name}: {said}")


def check_pieces_and_steps(folder):
    """Several pieces, with what VTK makes of them as a judge; of several time steps the first."""
    for data, writer, suffix in ((unstructured_grid(9), xml.vtkXMLUnstructuredGridWriter, ".vtu"),
                                 (poly_data(9), xml.vtkXMLPolyDataWriter, ".vtp")):
        if suffix == ".vtp":  # of strips in several pieces VTK takes the data of other cells
            data.SetStrips(model.vtkCellArray())
            data.GetCellData().Initialize()
            add_arrays(data.GetCellData(), data.GetNumberOfCells())
        whole = folder / f"one_piece{suffix}"
        write_by_vtk(writer(), data, whole, "ascii", "none", False, False, True)
        text = whole.read_text()
        piece = re.search("<Piece.*</Piece>", text, re.DOTALL).group()
        empty = re.sub('"[0-9]+"', '"0"', piece.splitlines()[0]) + "</Piece>"
        path = folder / f"three_pieces{suffix}"
        path.write_text(text.replace(piece, piece + (empty if suffix == ".vtp" else "") + piece))
        compare(read_by_abut([path])[0], as_grid(vtk_data(path)), path.name)
        outside = folder / f"outside{suffix}"
        outside.write_text(text.replace(piece, piece + re.sub(r'(Name="connectivity"[^>]*>\s*)\d+', r"\g<1>9", piece)))
        said = read_by_abut([outside])[0].error or "nothing"
        check("a cell has the point 9, the piece has 9. Write the mesh again." in said, f"{outside.name}: {said}")

        path, first = folder / f"steps{suffix}", as_grid(data)
        steps = writer()
        steps.SetFileName(str(path))
        steps.SetInputData(data)
        steps.SetNumberOfTimeSteps(2)
        steps.Start()
        steps.WriteNextTime(0.0)
        data.GetPoints().SetPoint(0, 7.0, 7.0, 7.0)
        data.GetPoints().Modified()
        data.Modified()
        steps.WriteNextTime(1.0)
        steps.Stop()
        compare(read_by_abut([path])[0], first, path.name)


def check_written_by_meshio(folder):
    random = numpy.random.default_rng(4)
    numbers = {"tetra": 10, "hexahedron": 12}
    cells = [("tetra", random.integers(0, 500, (700, 4))), ("hexahedron", random.integers(0, 500, (300, 8)))]
    point_data = {"u": random.normal(size=(500, 3)), "n": random.integers(-9, 9, 500).astype(numpy.int32)}
    cell_data = {"p": [random.normal(size=700).astype(numpy.float32), random.normal(size=300).astype(numpy.float32)]}
    mesh = meshio.Mesh(random.normal(size=(500, 3)), cells, point_data, cell_data)
    wanted = Grid()
    wanted.points = mesh.points
    wanted.cells = [(numbers[kind], tuple(map(int, row))) for kind, rows in cells for row in rows]
    wanted.data = {"point_data": {"u": (3, point_data["u"]), "n": (1, point_data["n"])},
                   "cell_data": {"p": (1, numpy.concatenate(cell_data["p"]))}}
    for i, options in enumerate(({"compression": None}, {"compression": "zlib"},
                                 {"compression": None, "header_type": "UInt64"},
                                 {"compression": "zlib", "header_type": "UInt64"}, {"binary": False})):
        path = folder / f"meshio_{i}.vtu"
        meshio.vtu.write(path, mesh, **options)
        if not options.get("binary", True):  # rounded
            wanted.points, wanted.data["point_data"]["u"] = meshio.read(path).points, (3, meshio.read(path).point_data["u"])
        compare(read_by_abut([path])[0], wanted, f"meshio {options}")


with tempfile.TemporaryDirectory() as name:
    for checks in (check_written_by_abut, check_written_by_vtk, check_pieces_and_steps, check_written_by_meshio):
        folder = pathlib.Path(name) / checks.__name__
        folder.mkdir()
        checks(folder)
print(f"{len(failures)} failures")
sys.exit(1 if failures else 0)
