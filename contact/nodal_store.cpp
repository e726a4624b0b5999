#include "abut/contact/nodal_store.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"

namespace abut::contact {
namespace {

constexpr std::int32_t gone = -1;

[[noreturn]] void refuse(std::size_t face, const std::string& what) {
    throw BadInput("nodal contact: new face " + std::to_string(face) + " " + what,
                   {.face_1 = static_cast<std::int64_t>(face)});
}

/// New number of each old facet.
template <int Dim>
std::vector<std::int32_t> new_facets(const NodalSurface<Dim>& before, const NodalSurface<Dim>& after,
                                     std::span<const std::int32_t> old_face_of) {
    if (old_face_of.size() != static_cast<std::size_t>(after.n_faces()))
        throw BadInput("nodal contact: old numbers of " + std::to_string(old_face_of.size()) +
                       " faces are given, the new surface has " + std::to_string(after.n_faces()) +
                       " faces; give one each, -1 for a face that was not there.");
    std::vector<std::int32_t> new_of_old(static_cast<std::size_t>(before.facets().size()), gone);
    for (std::size_t face = 0; face < old_face_of.size(); ++face) {
        const std::int32_t old = old_face_of[face];
        if (old == gone) continue;
        if (old < 0 || old >= before.n_faces())
            refuse(face, "is said to have been face " + std::to_string(old) + ", but there were " +
                             std::to_string(before.n_faces()) + " faces. Give -1 for a face that was not there.");
        const std::int32_t first = before.facet_offsets()[old], n = before.facet_offsets()[old + 1] - first;
        const std::int32_t new_first = after.facet_offsets()[face];
        if (after.facet_offsets()[face + 1] - new_first != n)
            refuse(face, "has not as many corners as old face " + std::to_string(old) + " had. Give -1 for another face.");
        if (new_of_old[first] != gone) refuse(face, "is old face " + std::to_string(old) + ", which another one is, too.");
        for (std::int32_t i = 0; i < n; ++i) new_of_old[first + i] = new_first + i;
    }
    return new_of_old;
}

/// Bodies may have become one, or rigid.
template <int Dim>
bool may_touch(const NodalSurface<Dim>& surface, std::int32_t facet_1, std::int32_t facet_2) {
    const SurfaceView<Dim> facets = surface.facets().view();
    return facets.body[facet_1] != facets.body[facet_2] && !(facets.is_rigid(facet_1) && facets.is_rigid(facet_2));
}

}  // namespace

template <int Dim>
PairStore carried_over(const PairStore& store, const NodalSurface<Dim>& before, const NodalSurface<Dim>& after,
                       std::span<const std::int32_t> old_face_of) {
    const std::vector<std::int32_t> new_of_old = new_facets(before, after, old_face_of);
    std::vector<std::pair<FacePair, PairMemory>> known;
    for (std::size_t p = 0; p < store.pairs().size(); ++p) {
        const auto [a, b] = store.pairs()[p];
        const auto [facet_1, facet_2] = std::minmax({new_of_old[number_of(a)], new_of_old[number_of(b)]});
        if (facet_1 != gone && may_touch(after, facet_1, facet_2))
            known.push_back({{SurfaceFace{facet_1}, SurfaceFace{facet_2}}, store.memory()[p]});
    }
    std::ranges::sort(known, {}, &std::pair<FacePair, PairMemory>::first);
    std::vector<FacePair> pairs;
    for (const auto& [pair, memory] : known) pairs.push_back(pair);
    PairStore carried;
    carried.follow(pairs, [&](std::size_t i) { return known[i].second; });
    return carried;
}

template <int Dim>
std::vector<std::int32_t> facets_that_come(std::span<const std::int32_t> new_facets, const NodalSurface<Dim>& before,
                                           const NodalSurface<Dim>& after, std::span<const std::int32_t> old_face_of) {
    std::vector<std::int32_t> coming;
    for (std::size_t face = 0; face < old_face_of.size(); ++face) {
        const std::int32_t old = old_face_of[face], first = after.facet_offsets()[face];
        for (std::int32_t facet = first; facet < after.facet_offsets()[face + 1]; ++facet)
            if (old == gone || std::ranges::binary_search(new_facets, before.facet_offsets()[old] + facet - first))
                coming.push_back(facet);
    }
    return coming;
}

#define ABUT_INSTANTIATE(Dim)                                                                                    \
    template PairStore carried_over(const PairStore&, const NodalSurface<Dim>&, const NodalSurface<Dim>&,        \
                                    std::span<const std::int32_t>);                                              \
    template std::vector<std::int32_t> facets_that_come(std::span<const std::int32_t>, const NodalSurface<Dim>&, \
                                                        const NodalSurface<Dim>&, std::span<const std::int32_t>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::contact
