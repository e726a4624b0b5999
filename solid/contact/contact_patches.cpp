#include "abut/solid/contact/contact_patches.hpp"

#include <algorithm>

#include "abut/base/disjoint_sets.hpp"
#include "abut/base/sort_unique.hpp"

namespace abut::solid {
namespace {

constexpr double smallest_part = 1e-6;  // of a unit vector in a prescribed direction

/// Points by their position in an increasing list, joined to patches.
template <int Dim>
class PatchFinder {
public:
    explicit PatchFinder(std::span<const TouchingPoints<Dim>> touching)
        : touching_(touching), points_(all_points()), sets_(points_.size()), patch_of_root_(points_.size(), -1) {
        for (const TouchingPoints<Dim>& pair : touching_) {
            const std::int32_t first = any_position(pair);
            for (const auto& side : {pair.points_1, pair.points_2})
                for (const std::int32_t point : side) sets_.join(first, position_of(point));
        }
    }

    template <class HoldsOf>
    std::vector<dynamics::ContactPatch<Dim>> find(const HoldsOf& holds_of_point) {
        for (std::size_t i = 0; i < points_.size(); ++i) {
            dynamics::ContactPatch<Dim>& patch = patch_of(static_cast<std::int32_t>(i));
            patch.points.push_back(points_[i]);
            const auto holds = holds_of_point(points_[i]);
            patch.holds.insert(patch.holds.end(), holds.begin(), holds.end());
        }
        for (const TouchingPoints<Dim>& pair : touching_)
            if (pair.points_1.empty() || pair.points_2.empty())
                patch_of(any_position(pair)).holds.push_back({pair.position, pair.normal});
        return std::move(patches_);
    }

private:
    std::vector<std::int32_t> all_points() const {
        std::vector<std::int32_t> points;
        for (const TouchingPoints<Dim>& pair : touching_)
            for (const auto& side : {pair.points_1, pair.points_2}) points.insert(points.end(), side.begin(), side.end());
        sort_unique(points);
        return points;
    }

    std::int32_t position_of(std::int32_t point) const {
        return static_cast<std::int32_t>(std::ranges::lower_bound(points_, point) - points_.begin());
    }
    std::int32_t any_position(const TouchingPoints<Dim>& pair) const {
        return position_of(pair.points_1.empty() ? pair.points_2.front() : pair.points_1.front());
    }

    dynamics::ContactPatch<Dim>& patch_of(std::int32_t position) {
        std::int32_t& patch = patch_of_root_[sets_.find(position)];
        if (patch < 0) {
            patch = static_cast<std::int32_t>(patches_.size());
            patches_.emplace_back();
        }
        return patches_[patch];
    }

    std::span<const TouchingPoints<Dim>> touching_;
    std::vector<std::int32_t> points_;
    DisjointSets sets_;
    std::vector<std::int32_t> patch_of_root_;
    std::vector<dynamics::ContactPatch<Dim>> patches_;
};

}  // namespace

/// The columns of a projector span the directions that it keeps.
template <int Dim>
std::vector<dynamics::Hold<Dim>> holds_of_cell(const Ccg<Dim>& ccg, std::int32_t cell) {
    std::vector<dynamics::Hold<Dim>> holds;
    for (const BoundaryFace face : ccg.prescribed_faces_of(cell))
        for (int j = 0; j < Dim; ++j) {
            const Vector<Dim> kept = ccg.prescribed()[face].col(j);
            if (kept.norm() > smallest_part) holds.push_back({ccg.centroid(face), kept.normalized()});
        }
    return holds;
}

template <int Dim>
std::vector<dynamics::ContactPatch<Dim>> contact_patches(
    std::span<const TouchingPoints<Dim>> touching,
    const std::function<std::vector<dynamics::Hold<Dim>>(std::int32_t point)>& holds_of_point) {
    return PatchFinder<Dim>(touching).find(holds_of_point);
}

#define ABUT_INSTANTIATE(Dim)                                                               \
    template std::vector<dynamics::Hold<Dim>> holds_of_cell(const Ccg<Dim>&, std::int32_t); \
    template std::vector<dynamics::ContactPatch<Dim>> contact_patches(                      \
        std::span<const TouchingPoints<Dim>>, const std::function<std::vector<dynamics::Hold<Dim>>(std::int32_t)>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
