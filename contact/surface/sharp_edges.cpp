#include "abut/contact/surface/sharp_edges.hpp"

#include <algorithm>

#include "abut/contact/surface/ridges.hpp"

namespace abut::contact {
namespace {

template <int Dim>
bool is_sharp(const SurfaceView<Dim>& surface, const Ridge& ridge) {
    const double cosine = surface.normal[ridge.face_1].dot(surface.normal[ridge.face_2]);
    return cosine < sharp_edge_cosine - cosine_rounding && is_convex(surface, ridge);
}

}  // namespace

template <int Dim>
std::vector<std::uint8_t> steps_to_sharp_edge(const SurfaceView<Dim>& surface) {
    check_sizes(surface);
    std::vector<std::uint8_t> steps(static_cast<std::size_t>(surface.size()), far_from_sharp_edge);
    const std::vector<Ridge> all = ridges(surface);
    for (const Ridge& ridge : all)
        if (is_sharp(surface, ridge)) steps[ridge.face_1] = steps[ridge.face_2] = 0;
    for (std::uint8_t next = 1; next < far_from_sharp_edge; ++next)
        for (const Ridge& ridge : all) {
            std::uint8_t &steps_1 = steps[ridge.face_1], &steps_2 = steps[ridge.face_2];
            if (steps_1 + 1 == next) steps_2 = std::min(steps_2, next);
            if (steps_2 + 1 == next) steps_1 = std::min(steps_1, next);
        }
    return steps;
}

template std::vector<std::uint8_t> steps_to_sharp_edge<2>(const SurfaceView<2>&);
template std::vector<std::uint8_t> steps_to_sharp_edge<3>(const SurfaceView<3>&);

}  // namespace abut::contact
