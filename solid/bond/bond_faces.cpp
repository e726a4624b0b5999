#include "abut/solid/bond/bond_faces.hpp"

#include <algorithm>
#include <utility>

#include "abut/base/sort_unique.hpp"

namespace abut::solid {

template <int Dim>
BondFaces<Dim>::BondFaces(const mesh::Mesh<Dim>& mesh, const RankPart<Dim>& part, std::span<const BondPlace<Dim>> places,
                          std::span<const std::size_t> of_places) {
    for (const std::size_t place : of_places)
        numbers_.insert(numbers_.end(), places[place].numbers.begin(), places[place].numbers.end());
    sort_unique(numbers_);
    is_own_.resize(numbers_.size(), 0);
    std::vector<std::size_t> own;
    const std::vector<BoundaryFace> by_number = part.faces_by_number(mesh);
    for (std::size_t face = 0; face < numbers_.size(); ++face) {
        const BoundaryFace here = by_number[numbers_[face]];
        faces_.push_back(here);
        if (here == no_face) continue;
        here_.push_back(face);
        faces_here_.push_back(here);
        if (!std::ranges::binary_search(part.own_faces(), here)) continue;
        is_own_[face] = 1;
        own.push_back(face);
        own_faces_.push_back(here);
    }
    items_ = RankItems(part.ranks(), std::move(own));
}

template <int Dim>
std::size_t BondFaces<Dim>::position_of(const BondPlace<Dim>& place, std::size_t side) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(numbers_, place.numbers[side]) - numbers_.begin());
}

template class BondFaces<2>;
template class BondFaces<3>;

}  // namespace abut::solid
