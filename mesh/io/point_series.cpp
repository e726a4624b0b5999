#include "abut/mesh/io/point_series.hpp"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <array>
#include <utility>

#include "abut/mesh/io/series_files.hpp"
#include "abut/mesh/io/vtk_output.hpp"

namespace abut::mesh {
namespace {

constexpr const char* extension = ".vtp";

template <int Dim>
vtkSmartPointer<vtkPolyData> grid_of_points(std::span<const Vector<Dim>> position) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> vertices;
    for (const Vector<Dim>& x : position) {
        std::array<double, 3> tuple{};
        fill(tuple.data(), x);
        const vtkIdType point = points->InsertNextPoint(tuple.data());
        vertices->InsertNextCell(1, &point);
    }
    auto grid = vtkSmartPointer<vtkPolyData>::New();
    grid->SetPoints(points);
    grid->SetVerts(vertices);
    return grid;
}

}  // namespace

template <int Dim>
PointSeries<Dim>::PointSeries(std::filesystem::path directory, std::string basename)
    : directory_(std::move(directory)), basename_(std::move(basename)) {
    make_directory(directory_);
}

template <int Dim>
void PointSeries<Dim>::write(const PointFrame<Dim>& frame) {
    const auto grid = grid_of_points(frame.position);
    add_fields<Dim>(*grid->GetPointData(), frame.fields, frame.position.size(), "points", "PointSeries");
    auto times = times_;
    times.push_back(frame.time);
    auto file = prepared_grid<vtkXMLPolyDataWriter>(*grid, directory_ / frame_name(basename_, times_.size(), extension));
    auto list = prepared_list(directory_, basename_, extension, times);
    file.move_into_place();
    list.move_into_place();
    times_ = std::move(times);
}

template <int Dim>
void PointSeries<Dim>::go_on_after(std::vector<double> times) {
    require_frames(directory_, basename_, extension, times.size());
    prepared_list(directory_, basename_, extension, times).move_into_place();
    times_ = std::move(times);
}

template class PointSeries<2>;
template class PointSeries<3>;

}  // namespace abut::mesh
