#include "abut/contact/surface/ridges.hpp"

#include <algorithm>
#include <tuple>

#include "abut/geometry/merged_vertices.hpp"

namespace abut::contact {
namespace {

/// A ridge as one face has it.
struct HalfRidge {
    std::int32_t lower, upper;  // merged vertices of its ends
    std::int32_t body;
    std::int32_t face;

    [[nodiscard]] auto ridge() const { return std::tie(lower, upper, body); }
};

template <int Dim>
std::vector<HalfRidge> half_ridges(const SurfaceView<Dim>& surface) {
    const std::vector<std::int32_t> merged = geometry::merged_vertices<Dim>(surface.vertices);
    std::vector<HalfRidge> all;
    all.reserve(surface.face_vertices.size());
    for (std::int32_t face = 0; face < surface.size(); ++face) {
        const auto corners = surface.vertices_of(face);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const std::size_t next = Dim == 2 ? i : (i + 1) % corners.size();
            const auto [lower, upper] =
                std::minmax(merged[static_cast<std::size_t>(corners[i])], merged[static_cast<std::size_t>(corners[next])]);
            all.push_back({lower, upper, surface.body[face], face});
        }
    }
    std::ranges::sort(all, {}, [](const HalfRidge& half) { return std::tie(half.lower, half.upper, half.body, half.face); });
    return all;
}

}  // namespace

template <int Dim>
std::vector<Ridge> ridges(const SurfaceView<Dim>& surface) {
    const std::vector<HalfRidge> all = half_ridges(surface);
    std::vector<Ridge> found;
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
        while (end < all.size() && all[end].ridge() == all[begin].ridge()) ++end;
        if (end - begin == 2) found.push_back({all[begin].face, all[begin + 1].face, all[begin].lower, all[begin].upper});
    }
    return found;
}

template std::vector<Ridge> ridges<2>(const SurfaceView<2>&);
template std::vector<Ridge> ridges<3>(const SurfaceView<3>&);

}  // namespace abut::contact
