#include "abut/solid/contact_patches.hpp"

#include <algorithm>

#include "abut/base/disjoint_sets.hpp"
#include "abut/base/sort_unique.hpp"

namespace abut::solid {
namespace {

constexpr double smallest_part = 1e-6;  // of a unit vector in a prescribed direction

/// Cells by their position in an increasing list, joined to patches.
template <int Dim>
class PatchFinder {
public:
    PatchFinder(const Ccg<Dim>& ccg, std::span<const TouchingFaces<Dim>> touching)
        : ccg_(ccg), touching_(touching), cells_(cells_of_faces()), sets_(cells_.size()), patch_of_root_(cells_.size(), -1) {
        for (const auto& [face_1, face_2, at, normal] : touching_) {
            join_cells_of(face_1);
            join_cells_of(face_2);
            if (face_1 != no_face && face_2 != no_face) sets_.join(position(face_1), position(face_2));
        }
    }

    std::vector<dynamics::ContactPatch<Dim>> find() {
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            dynamics::ContactPatch<Dim>& patch = patch_of(static_cast<std::int32_t>(i));
            patch.points.push_back(cells_[i]);
            for (const BoundaryFace face : ccg_.prescribed_faces_of(cells_[i])) append_holds(patch, face);
        }
        for (const auto& [face_1, face_2, at, normal] : touching_)
            if (face_1 == no_face || face_2 == no_face)
                patch_of(position(std::max(face_1, face_2))).holds.push_back({at, normal});
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

    std::vector<std::int32_t> cells_of_faces() const {
        std::vector<std::int32_t> cells;
        for (const auto& [face_1, face_2, at, normal] : touching_)
            for (const BoundaryFace face : {face_1, face_2}) {
                if (face == no_face) continue;
                const auto of_face = ccg_.cells_of(face);
                cells.insert(cells.end(), of_face.begin(), of_face.end());
            }
        sort_unique(cells);
        return cells;
    }

    std::int32_t position_of(std::int32_t cell) const {
        return static_cast<std::int32_t>(std::ranges::lower_bound(cells_, cell) - cells_.begin());
    }
    std::int32_t position(BoundaryFace face) const { return position_of(ccg_.cells_of(face).front()); }

    void join_cells_of(BoundaryFace face) {
        if (face == no_face) return;
        for (const std::int32_t cell : ccg_.cells_of(face)) sets_.join(position(face), position_of(cell));
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
    std::span<const TouchingFaces<Dim>> touching_;
    std::vector<std::int32_t> cells_;
    DisjointSets sets_;
    std::vector<std::int32_t> patch_of_root_;
    std::vector<dynamics::ContactPatch<Dim>> patches_;
};

}  // namespace

template <int Dim>
std::vector<dynamics::ContactPatch<Dim>> contact_patches(const Ccg<Dim>& ccg, std::span<const TouchingFaces<Dim>> touching) {
    return PatchFinder<Dim>(ccg, touching).find();
}

template std::vector<dynamics::ContactPatch<2>> contact_patches<2>(const Ccg<2>&, std::span<const TouchingFaces<2>>);
template std::vector<dynamics::ContactPatch<3>> contact_patches<3>(const Ccg<3>&, std::span<const TouchingFaces<3>>);

}  // namespace abut::solid
