#include "abut/contact/overlap/overlap_checks.hpp"

#include <cmath>
#include <cstdint>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/contact/surface/face_name.hpp"

namespace abut::contact {
namespace {

using geometry::IndexPair;

template <int Dim>
void check_faces(const SurfaceView<Dim>& surface, IndexPair pair, const std::string& name) {
    for (const std::int32_t face : {pair.first, pair.second})
        if (face < 0 || face >= surface.size())
            throw BadInput("overlaps: " + name + " names face " + std::to_string(face) + ", but there are " +
                               std::to_string(surface.size()) + " faces. Correct `pairs`.",
                           {.face_1 = pair.first, .face_2 = pair.second});
}

template <int Dim>
void check_displacement(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> displacement, IndexPair pair) {
    for (const std::int32_t face : {pair.first, pair.second})
        if (!displacement[static_cast<std::size_t>(face)].allFinite())
            throw Diverged("overlaps: the displacement of " + face_name(surface, face) +
                               " is not finite: the run has diverged. Take a smaller time step.",
                           {.face_1 = face});
}

template <int Dim>
bool all_finite(std::span<const Vector<Dim>> vectors) {
    const auto zero = [&](std::ptrdiff_t i) { return std::abs((0.0 * vectors[static_cast<std::size_t>(i)]).sum()); };
    return largest(static_cast<std::ptrdiff_t>(vectors.size()), zero) == 0.0;  // NaN where a number is not finite
}

std::string name_of(std::size_t pair) { return "pair " + std::to_string(pair); }

}  // namespace

template <int Dim>
void check_arrays(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> displacement) {
    check_sizes(surface);
    if (displacement.size() != surface.area.size())
        throw BadInput("overlaps: `displacement` has " + std::to_string(displacement.size()) + " entries, " +
                           std::to_string(surface.size()) + " are needed: one per face.",
                       {.value = static_cast<double>(displacement.size()), .allowed = static_cast<double>(surface.size())});
}

template <int Dim>
void check_indices(const SurfaceView<Dim>& surface, std::span<const IndexPair> pairs) {
    const std::int32_t n = surface.size();
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (pairs[i].first < 0 || pairs[i].first >= n || pairs[i].second < 0 || pairs[i].second >= n)
            check_faces(surface, pairs[i], name_of(i));
}

template <int Dim>
void check_pairs(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> displacement,
                 std::span<const IndexPair> pairs) {
    check_indices(surface, pairs);
    // The faces of pairs are all over the memory: looking up one pair takes as long as going through ten faces in order.
    if (displacement.size() < 10 * pairs.size() && all_finite(displacement)) return;
    for (const IndexPair pair : pairs) check_displacement(surface, displacement, pair);
}

template <int Dim>
void check_pair(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> displacement, IndexPair pair) {
    check_faces(surface, pair, "the pair");
    check_displacement(surface, displacement, pair);
}

#define ABUT_INSTANTIATE(Dim)                                                                                          \
    template void check_arrays<Dim>(const SurfaceView<Dim>&, std::span<const Vector<Dim>>);                            \
    template void check_indices<Dim>(const SurfaceView<Dim>&, std::span<const IndexPair>);                             \
    template void check_pairs<Dim>(const SurfaceView<Dim>&, std::span<const Vector<Dim>>, std::span<const IndexPair>); \
    template void check_pair<Dim>(const SurfaceView<Dim>&, std::span<const Vector<Dim>>, IndexPair);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::contact
