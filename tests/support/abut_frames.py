"""Fields of cells and boundary faces in frames of `abut run`, read by VTK (python3-vtk9)."""
import numpy
from vtkmodules import vtkIOXML
from vtkmodules.util.numpy_support import vtk_to_numpy


class Fields:
    """Values by name, and centres (n, 3) at rest [m], of the cells or boundary faces in a file."""

    def __init__(self, path):
        reader = vtkIOXML.vtkXMLUnstructuredGridReader() if path.suffix == ".vtu" else vtkIOXML.vtkXMLPolyDataReader()
        reader.SetFileName(str(path))
        reader.Update()
        grid = reader.GetOutput()
        points = vtk_to_numpy(grid.GetPoints().GetData())
        self.centres = numpy.array([points[corners_of(grid, i)].mean(axis=0) for i in range(grid.GetNumberOfCells())])
        data = grid.GetCellData()
        self.values = {data.GetArrayName(k).split(" [")[0]: vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}

    def __getitem__(self, name):
        return self.values[name]


def corners_of(grid, cell):
    corners = grid.GetCell(cell).GetPointIds()
    return [corners.GetId(k) for k in range(corners.GetNumberOfIds())]


def last_cells(done):
    """Fields of the cells in the last frame of a Run."""
    return Fields(max((done.out / "frames").glob("bodies_0*.vtu")))


def last_faces(done):
    """Fields of the boundary faces in the last frame of a Run."""
    return Fields(max((done.out / "frames").glob("bodies_surface_0*.vtp")))
