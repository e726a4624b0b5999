#include "abut/mesh/io/point_series.hpp"

#include <cstdint>
#include <numeric>
#include <utility>

#include "abut/mesh/io/series_files.hpp"
#include "abut/mesh/io/vtk_output.hpp"
#include "abut/mesh/io/write_vtu.hpp"

namespace abut::mesh {
namespace {

constexpr const char* extension = ".vtp";

template <int Dim>
OutputGrid grid_of(const PointFrame<Dim>& frame) {
    if (frame.faces.size() == 0) {
        std::vector<std::int64_t> points(frame.position.size()), ends(frame.position.size());
        std::iota(points.begin(), points.end(), 0);
        std::iota(ends.begin(), ends.end(), 1);
        return output_grid("PolyData", "Verts", frame.position, points, ends);
    }
    const std::vector<std::int64_t> corners(frame.faces.values.begin(), frame.faces.values.end());
    const std::vector<std::int64_t> ends(frame.faces.offsets.begin() + 1, frame.faces.offsets.end());
    return output_grid("PolyData", Dim == 2 ? "Lines" : "Polys", frame.position, corners, ends);
}

}  // namespace

template <int Dim>
PointSeries<Dim>::PointSeries(std::filesystem::path directory, std::string basename)
    : directory_(std::move(directory)), basename_(std::move(basename)) {
    make_folders(directory_);
}

template <int Dim>
void PointSeries<Dim>::write(const PointFrame<Dim>& frame) {
    auto grid = grid_of(frame);
    grid.field_data = field_time(frame.time);
    for (const NamedNumber& number : frame.numbers) grid.field_data += field_number(number.name, number.value);
    add_fields<Dim>(grid.point_data, frame.fields, frame.position.size(), "points", "PointSeries");
    auto times = times_;
    times.push_back(frame.time);
    auto file = prepared_grid(grid, directory_ / frame_path(basename_, times_.size(), extension));
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
