#include "abut/solid/contact_patches.hpp"

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
    PatchFinder(const Ccg<Dim>& ccg, std::span<const TouchingPoints<Dim>> touching)
        : ccg_(ccg), touching_(touching), points_(all_points()), sets_(points_.size()), patch_of_root_(points_.size(), -1) {
        for (const TouchingPoints<Dim>& pair : touching_) {
            const std::int32_t first = any_position(pair);
            for (const auto& side : {pair.points_1, pair.points_2})
                for (const std::int32_t point : side) sets_.join(first, position_of(point));
        }
    }

    std::vector<dynamics::ContactPatch<Dim>> find() {
        for (std::size_t i = 0; i < points_.size(); ++i) {
            dynamics::ContactPatch<Dim>& patch = patch_of(static_cast<std::int32_t>(i));
            patch.points.push_back(points_[i]);
            if (points_[i] >= ccg_.n_cells()) continue;
            for (const BoundaryFace face : ccg_.prescribed_faces_of(points_[i])) append_holds(patch, face);
        }
        for (const TouchingPoints<Dim>& pair : touching_)
            if (pair.points_1.empty() || pair.points_2.empty())
                patch_of(any_position(pair)).holds.push_back({pair.position, pair.normal});
        return std::move(patches_);
    }

private:
    /// The columns of a projector span the directions that it keeps.
    void append_holds(dynamics::ContactPatch<Dim>& patch, BoundaryFace face) const {
        const Matrix<Dim>& projector = ccg_.prescribed()[face];
        for (int i = 0; i < Dim; ++i)
            if (const Vector<Dim> kept = projector.col(i); kept.norm() > smallest_part)
                patch.holds.push_back({ccg_.centroid(face), kept.normalized()});
    }

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

    const Ccg<Dim>& ccg_;
    std::span<const TouchingPoints<Dim>> touching_;
    std::vector<std::int32_t> points_;
    DisjointSets sets_;
    std::vector<std::int32_t> patch_of_root_;
    std::vector<dynamics::ContactPatch<Dim>> patches_;
};

}  // namespace

template <int Dim>
std::vector<dynamics::ContactPatch<Dim>> contact_patches(const Ccg<Dim>& ccg,
                                                         std::span<const TouchingPoints<Dim>> touching) {
    return PatchFinder<Dim>(ccg, touching).find();
}

template std::vector<dynamics::ContactPatch<2>> contact_patches<2>(const Ccg<2>&, std::span<const TouchingPoints<2>>);
template std::vector<dynamics::ContactPatch<3>> contact_patches<3>(const Ccg<3>&, std::span<const TouchingPoints<3>>);

}  // namespace abut::solid
