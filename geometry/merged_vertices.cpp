#include "abut/geometry/merged_vertices.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <numeric>

namespace abut::geometry {
namespace {

template <int Dim>
struct Position {
    std::array<double, Dim> x;
    std::int32_t vertex;
    friend auto operator<=>(const Position&, const Position&) = default;
};

}  // namespace

template <int Dim>
std::vector<std::int32_t> merged_vertices(std::span<const Vector<Dim>> vertices) {
    std::vector<std::int32_t> first(vertices.size());
    std::iota(first.begin(), first.end(), 0);
    std::vector<Position<Dim>> positions;
    positions.reserve(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (!vertices[i].allFinite()) continue;
        Position<Dim>& position = positions.emplace_back();
        std::copy(vertices[i].begin(), vertices[i].end(), position.x.begin());
        position.vertex = static_cast<std::int32_t>(i);
    }
    // No coordinate is NaN: the partial order of doubles is a total one, in which 0 and -0 are equal.
    std::sort(positions.begin(), positions.end(), [](const auto& a, const auto& b) { return a < b; });
    for (std::size_t i = 1; i < positions.size(); ++i)
        if (positions[i].x == positions[i - 1].x)
            first[static_cast<std::size_t>(positions[i].vertex)] = first[static_cast<std::size_t>(positions[i - 1].vertex)];
    return first;
}

template std::vector<std::int32_t> merged_vertices<2>(std::span<const Vector<2>>);
template std::vector<std::int32_t> merged_vertices<3>(std::span<const Vector<3>>);

}  // namespace abut::geometry
