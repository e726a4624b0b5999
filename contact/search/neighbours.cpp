#include "abut/contact/search/neighbours.hpp"

#include <algorithm>
#include <numeric>

#include "abut/base/sort_unique.hpp"
#include "abut/geometry/merged_vertices.hpp"

namespace abut::contact {

template <int Dim>
Neighbours::Neighbours(const SurfaceView<Dim>& surface, int rings)
    : rings_(rings), face_offsets_(surface.face_offsets.begin(), surface.face_offsets.end()) {
    const std::vector<std::int32_t> merged_vertex = geometry::merged_vertices<Dim>(surface.vertices);
    corners_.reserve(surface.face_vertices.size());
    for (const std::int32_t v : surface.face_vertices) corners_.push_back(merged_vertex[static_cast<std::size_t>(v)]);
    corner_offsets_.assign(surface.vertices.size() + 1, 0);
    for (const std::int32_t corner : corners_) ++corner_offsets_[static_cast<std::size_t>(corner) + 1];
    std::partial_sum(corner_offsets_.begin(), corner_offsets_.end(), corner_offsets_.begin());
    faces_.resize(corners_.size());
    std::vector<std::int32_t> next(corner_offsets_.begin(), corner_offsets_.end() - 1);
    for (std::int32_t face = 0; face < surface.size(); ++face)
        for (const std::int32_t corner : corners_of(face)) faces_[next[corner]++] = face;
}

std::span<const std::int32_t> Neighbours::corners_of(std::int32_t face) const {
    return {corners_.data() + face_offsets_[face], corners_.data() + face_offsets_[face + 1]};
}

std::span<const std::int32_t> Neighbours::faces_at(std::int32_t corner) const {
    return {faces_.data() + corner_offsets_[corner], faces_.data() + corner_offsets_[corner + 1]};
}

bool Neighbours::share_a_corner(std::int32_t face_1, std::int32_t face_2) const {
    const auto corners_1 = corners_of(face_1), corners_2 = corners_of(face_2);
    return std::ranges::find_first_of(corners_1, corners_2) != corners_1.end();
}

bool Neighbours::operator()(std::int32_t face_1, std::int32_t face_2) const {
    if (share_a_corner(face_1, face_2)) return true;
    std::vector<std::int32_t> reached{face_1}, next;
    for (int ring = 1; ring < rings_; ++ring) {
        next.clear();
        for (const std::int32_t face : reached)
            for (const std::int32_t corner : corners_of(face)) {
                const auto faces = faces_at(corner);
                next.insert(next.end(), faces.begin(), faces.end());
            }
        sort_unique(next);
        reached.swap(next);
        if (std::ranges::any_of(reached, [&](std::int32_t face) { return share_a_corner(face, face_2); })) return true;
    }
    return false;
}

template Neighbours::Neighbours(const SurfaceView<2>&, int);
template Neighbours::Neighbours(const SurfaceView<3>&, int);

}  // namespace abut::contact
