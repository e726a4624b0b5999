#include "abut/mesh/io/write_vtp.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <string>

#include "abut/base/error.hpp"
#include "abut/mesh/io/vtk_output.hpp"

namespace abut::mesh {
namespace {

void add_polygon(vtkCellArray& polygons, const geometry::FaceSoup& faces, std::int32_t face) {
    const auto corners = faces.vertices_of(face);
    polygons.InsertNextCell(static_cast<int>(corners.size()));
    for (const std::int32_t vertex : corners) {
        if (vertex < 0 || static_cast<std::size_t>(vertex) >= faces.vertices.size())
            throw BadInput("write_vtp: face " + std::to_string(face) + " names vertex " + std::to_string(vertex) +
                           ", but there are " + std::to_string(faces.vertices.size()) + ". Leave it out.");
        polygons.InsertCellPoint(vertex);
    }
}

vtkSmartPointer<vtkPolyData> grid_of(const geometry::FaceSoup& faces) {
    geometry::check_offsets(faces);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->Allocate(static_cast<vtkIdType>(faces.vertices.size()));
    for (const Vector<3>& vertex : faces.vertices) points->InsertNextPoint(vertex.data());
    vtkNew<vtkCellArray> polygons;
    for (std::int32_t face = 0; face < faces.size(); ++face) add_polygon(*polygons, faces, face);
    auto grid = vtkSmartPointer<vtkPolyData>::New();
    grid->SetPoints(points);
    grid->SetPolys(polygons);
    return grid;
}

}  // namespace

void write_vtp(const geometry::FaceSoup& faces, const std::filesystem::path& path, const SurfaceFields& fields) {
    const auto grid = grid_of(faces);
    add_fields<3>(*grid->GetCellData(), fields.of_faces, static_cast<std::size_t>(faces.size()), "faces", "write_vtp");
    add_fields<3>(*grid->GetPointData(), fields.of_vertices, faces.vertices.size(), "vertices", "write_vtp");
    prepared_grid<vtkXMLPolyDataWriter>(*grid, path).move_into_place();
}

}  // namespace abut::mesh
