#pragma once
// Private to the layer.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/run/values/forward.hpp"
#include "abut/solid/material/material.hpp"

namespace abut::run {

/// Share of the energy in play that FineMotion::energy may have [-]. docs/results.md, The verdict.
inline constexpr double large_fine_share = 0.1;

/// Motion that changes from cell to cell, of which neither H~ nor H - H~ tells. Each cell is compared with its neighbours on
/// both sides, as in rows of bricks, or with all of them where it has none and lies inside of its body.
///
/// Bodies of which too little is known have no fine motion: those of fewer than six cells across, whose first modes are
/// among the upper half of all, and those of which less than a quarter of the mass has such neighbours. Five bricks in a
/// row have 0.11 of their first bending mode in fine motion, six 0.055.
template <int Dim>
class FineMotion {
public:
    /// Lists the neighbours of the cells of a mesh, once for all looks; keeps no reference.
    explicit FineMotion(const mesh::Mesh<Dim>& mesh);

    /// Kinetic energy of that motion [J]: of half the difference between the velocity of a cell and the mean of its
    /// neighbours. A wave has sin^4(kh/2) of its energy in it: a quarter or more in the upper half of the modes. A linear
    /// field has none where cells are equally spaced, else a part of the order of the square of (change of size)/(size of
    /// the body).
    ///
    /// Cells that have such neighbours stand for the whole body, by up to four times their own energy: no body has more
    /// fine motion than kinetic energy. Velocities of the cells (n_cells) [m/s] are those of the step to come, in which
    /// modes that change sign from step to step are whole. The mesh is that of the lists, with a material per body.
    [[nodiscard]] double energy(const mesh::Mesh<Dim>& mesh, std::span<const solid::Material> materials,
                                std::span<const Vector<Dim>> velocity) const;

private:
    [[nodiscard]] Vector<Dim> mean_around(std::size_t cell, std::span<const Vector<Dim>> field) const;

    std::vector<std::size_t> first_;    // of each cell, in around_
    std::vector<std::int32_t> around_;  // cells that each one is compared with; none in bodies of few cells
    std::vector<char> is_told_;         // by body
};

}  // namespace abut::run
