#include "abut/run/files/failure_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "abut/dynamics/integrator.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/run/drawing/cell_map.hpp"
#include "abut/run/files/files.hpp"
#include "abut/run/values/sight.hpp"

namespace abut::run {
namespace {

constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

/// Speeds of the cells by which the state is shown [m/s]: those of the lost one, else of the sound one.
template <int Dim>
std::vector<double> speeds(const Failure& failure, const Sight<Dim>& sound) {
    if (failure.lost) return failure.lost_speed;
    std::vector<double> speed;
    for (const Vector<Dim>& v : sound.velocity) speed.push_back(v.norm());
    return speed;
}

/// The two axes along which the cells reach farthest, in their order.
template <int Dim>
std::array<int, 2> widest_axes(const std::vector<Vector<Dim>>& position) {
    Vector<Dim> low = position.front(), high = position.front();
    for (const Vector<Dim>& x : position) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    int narrowest = Dim - 1;
    if constexpr (Dim == 3) (high - low).minCoeff(&narrowest);
    if (Dim == 2 || narrowest == 2) return {0, 1};
    return narrowest == 0 ? std::array{1, 2} : std::array{0, 2};
}

/// The slowest cells first: a picture shows what comes last on top.
template <int Dim>
void write_table(const std::filesystem::path& path, const mesh::Mesh<Dim>& mesh, const std::vector<Vector<Dim>>& position,
                 const std::vector<double>& speed) {
    std::vector<std::size_t> order(speed.size());
    for (std::size_t c = 0; c < order.size(); ++c) order[c] = c;
    const auto rank = [&](std::size_t c) { return std::isnan(speed[c]) ? HUGE_VAL : speed[c]; };
    std::ranges::stable_sort(order, {}, rank);
    std::string text = Dim == 2 ? "body,cell,x [m],y [m],speed [m/s]\n" : "body,cell,x [m],y [m],z [m],speed [m/s]\n";
    for (const std::size_t c : order) {
        text +=
            fmt::format("{},{}", in_csv(mesh.body_names[static_cast<std::size_t>(mesh.cell_body[c])]), mesh.cell_label[c]);
        for (const double x : position[c]) text += fmt::format(",{:.9g}", x);
        text += fmt::format(",{:.9g}\n", speed[c]);
    }
    write_whole(path, text);
}

template <int Dim>
void write_frame(const std::filesystem::path& directory, const std::string& series, const Failure& failure,
                 const std::vector<double>& speed, const Sight<Dim>& sound) {
    mesh::Frame<Dim> frame{.time = failure.sound.time,
                           .displacement = sound.displacement,
                           .vertex_displacement = {},
                           .cell_fields = {{"velocity [m/s]", sound.velocity}},
                           .boundary_fields = {}};
    if (failure.lost) frame.cell_fields.push_back({"speed when lost [m/s]", speed});
    mesh::VtuSeries<Dim>(directory, failure_series(series), *sound.mesh).write(frame);
}

/// Range of the colours: at most six decades; where all are about as fast, one colour in the middle.
std::pair<double, double> speed_range(const std::vector<double>& speed) {
    double slowest = HUGE_VAL, fastest = 0.0;
    for (const double v : speed) {
        if (!(v > 0.0) || !std::isfinite(v)) continue;
        slowest = std::min(slowest, v);
        fastest = std::max(fastest, v);
    }
    if (fastest == 0.0) return {0.1, 1.0};
    if (slowest > 0.5 * fastest) return {0.25 * slowest, 4.0 * fastest};
    return {std::max(slowest, 1e-6 * fastest), fastest};
}

/// Map of where `cells` are, in rings.
template <int Dim>
CellMap cell_map(const mesh::Mesh<Dim>& mesh, const std::vector<Vector<Dim>>& position, const std::vector<double>& speed,
                 const Failure& failure, const std::vector<std::int32_t>& cells) {
    const auto [first, second] = widest_axes(position);
    const auto in_plane = [first = first, second = second](const Vector<Dim>& x) { return std::array{x[first], x[second]}; };
    const auto [slowest, fastest] = speed_range(speed);
    CellMap map{
        .title = fmt::format("Last sound state, step {}, t = {:.4g} s, coloured by {}", failure.sound.steps,
                             failure.sound.time, failure.lost ? "the speeds with which the run was given up" : "its speeds"),
        .subtitle = {},
        .x_label = fmt::format("{} [m]", axis_names[static_cast<std::size_t>(first)]),
        .y_label = fmt::format("{} [m]", axis_names[static_cast<std::size_t>(second)]),
        .value_label = "speed [m/s]",
        .position = {},
        .value = speed,
        .lower = slowest,
        .upper = fastest,
        .rings = {}};
    for (const Vector<Dim>& x : position) map.position.push_back(in_plane(x));
    for (const std::int32_t cell : cells) {
        const auto& x = position[static_cast<std::size_t>(cell)];
        map.rings.push_back(in_plane(x));
        map.subtitle += (map.subtitle.empty() ? "Ring: " : ", ") + name_of_cell<Dim>(mesh, cell, x);
    }
    return map;
}

}  // namespace

template <int Dim>
std::string write_failure(const std::filesystem::path& directory, const std::string& series, const Failure& failure,
                          const Sight<Dim>& sound) {
    const mesh::Mesh<Dim>& mesh = *sound.mesh;
    const std::vector<double> speed = speeds(failure, sound);
    std::vector<std::int32_t> cells = failure.cells;
    if (cells.empty()) cells = {worst_cell<Dim>(sound.displacement, sound.velocity).cell};
    std::vector<Vector<Dim>> position = sound.displacement;
    for (std::size_t c = 0; c < position.size(); ++c) position[c] += mesh.cell_centroid[c];
    write_frame(directory, series, failure, speed, sound);
    write_table(directory / (std::string(failure_name) + ".csv"), mesh, position, speed);
    const std::string picture = std::string(failure_name) + ".svg";
    write_whole(directory / picture, drawing_file(cell_map<Dim>(mesh, position, speed, failure, cells)));
    return picture + " shows where it failed, " + failure_series(series) + ".pvd holds the last sound state, step " +
           std::to_string(failure.sound.steps) + ".";
}

template std::string write_failure<2>(const std::filesystem::path&, const std::string&, const Failure&, const Sight<2>&);
template std::string write_failure<3>(const std::filesystem::path&, const std::string&, const Failure&, const Sight<3>&);

}  // namespace abut::run
