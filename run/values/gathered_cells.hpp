#pragma once
// Private to the layer.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/boundary/boundary_face.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/solid.hpp"

namespace abut::run {

/// Brings values of the cells of a solid together on rank 0, in the order of the whole mesh. On one rank the whole is here.
/// All functions are calls of all ranks; what they return is empty on ranks other than 0.
template <int Dim>
class GatheredCells {
public:
    /// Both must outlive it. On ranks other than 0 `whole`, the mesh of all cells, is not looked at.
    GatheredCells(const solid::Solid<Dim>& solid, const mesh::Mesh<Dim>& whole);

    /// of(cell) of each cell of the whole (n_cells), from that of the own cells by their numbers in the mesh of the solid;
    /// `T` is a double, a vector or a matrix.
    template <class T, class Of>
    [[nodiscard]] std::vector<T> cells(const Of& of) const {
        if (solid_.ranks().is_one()) {
            std::vector<T> all;
            all.reserve(whole_.cell_measure.size());
            for (std::int32_t c = 0; c < whole_.n_cells(); ++c) all.push_back(of(c));
            return all;
        }
        constexpr std::size_t width = sizeof(T) / sizeof(double);
        std::vector<double> own(width * own_.position.size());
        for (std::size_t i = 0; i < own_.position.size(); ++i) {
            const T value = of(own_.position[i]);
            std::memcpy(&own[width * i], &value, sizeof(T));
        }
        const std::vector<double> all = first_gets(own);
        std::vector<T> ordered(all.size() / width);
        for (std::size_t i = 0; i < ordered.size(); ++i)
            std::memcpy(static_cast<void*>(&ordered[static_cast<std::size_t>(numbers_[i])]), &all[width * i], sizeof(T));
        return ordered;
    }
    /// Values by boundary face of the whole, from those by boundary face of the mesh of the solid; none where no rank has
    /// any.
    [[nodiscard]] std::vector<double> boundary(std::span<const double> of_part) const;
    /// Boundary faces in the whole, from a list that has on each rank the faces of its own cells, and `no_face` or copies
    /// elsewhere.
    [[nodiscard]] std::vector<solid::BoundaryFace> faces(std::span<const solid::BoundaryFace> here) const;

private:
    [[nodiscard]] std::vector<double> first_gets(std::span<const double> own) const;

    const solid::Solid<Dim>& solid_;
    const mesh::Mesh<Dim>& whole_;
    solid::OwnCells own_;                // of several ranks
    std::vector<std::int32_t> numbers_;  // of cells in the whole, as they come
};

}  // namespace abut::run
