#pragma once
// Private to the sources of this layer.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/solid/body/bodies.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {

/// Boundary faces of a group, shared out to ranks: own ones are those of own cells and of own rigid bodies. They have the
/// numbers that one rank gives them, in the order of BoundaryGroup::faces of the whole mesh.
template <int Dim>
class GroupFaces {
public:
    /// `part` must outlive it. A call of all ranks.
    GroupFaces(const Bodies<Dim>& bodies, const RankPart<Dim>& part, const std::string& group);

    [[nodiscard]] std::span<const std::int32_t> own() const { return own_; }          ///< faces of the mesh here, increasing
    [[nodiscard]] std::span<const std::int32_t> numbers() const { return numbers_; }  ///< of own ones, increasing
    [[nodiscard]] std::size_t n_all() const { return gathered_.size(); }              ///< of all ranks

    /// Values of all faces by number (n_all, width), from those of own ones (n_own, width). A call of all ranks.
    [[nodiscard]] std::vector<double> gather(std::span<const double> of_own, std::size_t width = 1) const;
    [[nodiscard]] std::vector<Vector<Dim>> gather(std::span<const Vector<Dim>> of_own) const;
    /// Values of own faces, from those by number.
    [[nodiscard]] std::vector<Vector<Dim>> own_of(std::span<const Vector<Dim>> of_all) const {
        return chosen(of_all, numbers_);
    }
    /// Values of all faces of the group here, copies included, from those by number.
    [[nodiscard]] std::vector<Vector<Dim>> here_of(std::span<const Vector<Dim>> of_all) const {
        return chosen(of_all, numbers_here_);
    }
    /// start + term(i) of all own faces of all ranks, one after the other by number. A call of all ranks.
    template <class Term>
    [[nodiscard]] double fold(double start, const Term& term) const {
        if (part_->is_whole()) {
            for (std::size_t i = 0; i < own_.size(); ++i) start += term(i);
            return start;
        }
        std::vector<double> terms;
        for (std::size_t i = 0; i < own_.size(); ++i) terms.push_back(term(i));
        return part_->ranks().fold(start, std::vector<std::int64_t>(numbers_.begin(), numbers_.end()), terms);
    }

private:
    /// Body, cell among those of the body that all ranks have, position in the cell: rises with the number of a face.
    using Key = std::array<double, 3>;
    [[nodiscard]] static std::vector<Vector<Dim>> chosen(std::span<const Vector<Dim>> of_all,
                                                         std::span<const std::int32_t> numbers);
    void number_faces(std::span<const Key> here, std::span<const Key> own);

    const RankPart<Dim>* part_;
    std::vector<std::int32_t> own_, numbers_, numbers_here_;
    std::vector<std::int32_t> gathered_;  // numbers, as `gather` of the ranks brings their faces
};

}  // namespace abut::solid
