#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/dynamics/ranks.hpp"

namespace abut::solid {

/// How far the bodies of a mesh have turned: the angle of the rotation in the polar decomposition of I + G, G the gradient
/// of the affine field that is nearest to the displacements of a body, weighted by mass.
template <int Dim>
class BodyRotation {
public:
    /// Cells of body b are [begin[b], begin[b + 1]) of those of all ranks; `rest` and `masses` are those of the cells
    /// here. All must outlive it. A call of all ranks.
    BodyRotation(std::span<const Vector<Dim>> rest, std::span<const double> masses, std::span<const std::int32_t> begin,
                 const dynamics::Ranks& ranks);

    /// Angle per body (n_bodies) [rad], 0 to pi, for the displacements u of the cells here [m]. A call of all ranks.
    [[nodiscard]] std::vector<double> angles(std::span<const Vector<Dim>> u) const;

private:
    struct Body {
        Vector<Dim> centre;   // of mass
        Matrix<Dim> inverse;  // of sum m (x - centre) (x - centre)^T
    };
    template <class Value, class Term>
    [[nodiscard]] Value sum_of(std::size_t body, const Value& zero, const Term& term) const;

    std::span<const Vector<Dim>> rest_;
    std::span<const double> masses_;
    std::span<const std::int32_t> begin_;
    const dynamics::Ranks& ranks_;
    std::vector<Body> bodies_;
};

}  // namespace abut::solid
