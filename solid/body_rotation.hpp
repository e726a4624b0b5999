#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::solid {

/// How far the bodies of a mesh have turned: the angle of the rotation in the polar decomposition of I + G, G the gradient
/// of the affine field that is nearest to the displacements of a body, weighted by mass.
template <int Dim>
class BodyRotation {
public:
    /// `masses` are those of the cells. The mesh and the masses must outlive it.
    BodyRotation(const mesh::Mesh<Dim>& mesh, std::span<const double> masses);

    /// Of each body (n_bodies) [rad], 0 to pi, for the displacements u of the cells (n_cells) [m].
    [[nodiscard]] std::vector<double> angles(std::span<const Vector<Dim>> u) const;

private:
    struct Body {
        std::int32_t begin, end;  // its cells
        Vector<Dim> centre;       // of mass
        Matrix<Dim> inverse;      // of sum m (x - centre) (x - centre)^T
    };

    const mesh::Mesh<Dim>& mesh_;
    std::span<const double> masses_;
    std::vector<Body> bodies_;
};

}  // namespace abut::solid
