#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "abut/solid/boundary/bond_places.hpp"
#include "abut/solid/part/rank_items.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {

/// The faces of some places of bonds, increasing by their numbers. All ranks know all of them; each evaluates those of
/// its own cells, and brings that to all.
template <int Dim>
class BondFaces {
public:
    /// `part` must outlive it; `of_places`: positions in `places`. A call of all ranks.
    BondFaces(const mesh::Mesh<Dim>& mesh, const RankPart<Dim>& part, std::span<const BondPlace<Dim>> places,
              std::span<const std::size_t> of_places);

    [[nodiscard]] std::size_t size() const { return numbers_.size(); }
    /// Position of the face on one side of a place.
    [[nodiscard]] std::size_t position_of(const BondPlace<Dim>& place, std::size_t side) const;
    /// In the bodies that deform; `no_face`: it is on other ranks alone.
    [[nodiscard]] BoundaryFace operator[](std::size_t face) const { return faces_[face]; }

    [[nodiscard]] std::span<const std::size_t> own() const { return items_.own(); }
    [[nodiscard]] std::span<const BoundaryFace> own_faces() const { return own_faces_; }
    /// Own ones and copies.
    [[nodiscard]] std::span<const std::size_t> here() const { return here_; }
    [[nodiscard]] std::span<const BoundaryFace> faces_here() const { return faces_here_; }
    [[nodiscard]] bool is_own(std::size_t face) const { return is_own_[face] != 0; }

    /// Brings values of all faces.
    [[nodiscard]] const RankItems& items() const { return items_; }
    /// value(face) of all faces, each from its owner. A call of all ranks.
    template <class Value>
    [[nodiscard]] std::vector<double> of_owners(std::size_t width, const Value& value) const {
        std::vector<double> values(width * size());
        for (const std::size_t face : own()) {
            const auto of_face = value(face);
            std::copy_n(of_face.begin(), width, values.begin() + static_cast<std::ptrdiff_t>(width * face));
        }
        items_.bring({{values, width}});
        return values;
    }

private:
    std::vector<std::size_t> numbers_;
    std::vector<BoundaryFace> faces_, own_faces_, faces_here_;
    std::vector<std::size_t> here_;
    std::vector<char> is_own_;
    RankItems items_;
};

}  // namespace abut::solid
