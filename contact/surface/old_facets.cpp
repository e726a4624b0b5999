#include "abut/contact/surface/old_facets.hpp"

#include <string>

#include "abut/base/error.hpp"

namespace abut::contact {
namespace {

constexpr std::int32_t was_not_there = -1;

[[noreturn]] void refuse(std::size_t face, const std::string& what) {
    throw BadInput("nodal contact: new face " + std::to_string(face) + " " + what,
                   {.face_1 = static_cast<std::int64_t>(face)});
}

}  // namespace

template <int Dim>
std::vector<std::int32_t> old_facets(const NodalSurface<Dim>& before, const NodalSurface<Dim>& after,
                                     std::span<const std::int32_t> old_face_of) {
    if (old_face_of.size() != static_cast<std::size_t>(after.n_faces()))
        throw BadInput("nodal contact: old numbers of " + std::to_string(old_face_of.size()) +
                       " faces are given, the new surface has " + std::to_string(after.n_faces()) +
                       " faces; give one each, -1 for a face that was not there.");
    std::vector<std::int32_t> old_of_new(static_cast<std::size_t>(after.facets().size()), was_not_there);
    std::vector<char> is_taken(static_cast<std::size_t>(before.n_faces()), 0);
    for (std::size_t face = 0; face < old_face_of.size(); ++face) {
        const std::int32_t old = old_face_of[face];
        if (old == was_not_there) continue;
        if (old < 0 || old >= before.n_faces())
            refuse(face, "is said to have been face " + std::to_string(old) + ", but there were " +
                             std::to_string(before.n_faces()) + " faces. Give -1 for a face that was not there.");
        const std::int32_t old_first = before.facet_offsets()[old], n = before.facet_offsets()[old + 1] - old_first;
        const std::int32_t first = after.facet_offsets()[face];
        if (after.facet_offsets()[face + 1] - first != n)
            refuse(face, "has not as many corners as old face " + std::to_string(old) + " had. Give -1 for another face.");
        if (is_taken[old]) refuse(face, "is old face " + std::to_string(old) + ", which another one is, too.");
        is_taken[old] = 1;
        for (std::int32_t i = 0; i < n; ++i) old_of_new[first + i] = old_first + i;
    }
    return old_of_new;
}

template std::vector<std::int32_t> old_facets(const NodalSurface<2>&, const NodalSurface<2>&, std::span<const std::int32_t>);
template std::vector<std::int32_t> old_facets(const NodalSurface<3>&, const NodalSurface<3>&, std::span<const std::int32_t>);

}  // namespace abut::contact
