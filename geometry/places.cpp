#include "abut/geometry/places.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace abut::geometry {
namespace {

struct Place {
    double x, y, z;
    std::int32_t vertex;

    [[nodiscard]] bool is_that_of(const Place& other) const { return x == other.x && y == other.y && z == other.z; }
    friend bool operator<(const Place& a, const Place& b) {
        if (a.x != b.x) return a.x < b.x;
        if (a.y != b.y) return a.y < b.y;
        if (a.z != b.z) return a.z < b.z;
        return a.vertex < b.vertex;
    }
};

}  // namespace

std::vector<std::int32_t> first_at_same_place(std::span<const Vector<3>> vertices) {
    std::vector<std::int32_t> first(vertices.size());
    std::iota(first.begin(), first.end(), 0);
    std::vector<Place> places;
    places.reserve(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (vertices[i].allFinite())
            places.push_back({vertices[i].x(), vertices[i].y(), vertices[i].z(), static_cast<std::int32_t>(i)});
    std::sort(places.begin(), places.end());
    for (std::size_t i = 1; i < places.size(); ++i)
        if (places[i].is_that_of(places[i - 1]))
            first[static_cast<std::size_t>(places[i].vertex)] = first[static_cast<std::size_t>(places[i - 1].vertex)];
    return first;
}

}  // namespace abut::geometry
