#pragma once
// Private to the sources of this layer.
#include <Eigen/Core>
#include <span>
#include <vector>

#include "abut/solid/operator/directed_cells.hpp"

namespace abut::solid {

/// Stress that pushes on its free faces add to that of a cell [Pa].
template <int Dim>
struct StressOfPushes {
    Matrix<Dim> in_space;
    double out_of_plane = 0.0;  ///< in 2D
};

/// Stress of a gradient of displacements. `directed`: what the material has beside lambda and mu [Pa]; may be null.
template <int Dim>
[[nodiscard]] StressOfPushes<Dim> stress_of_gradient(const Matrix<Dim>& g, double lambda, double mu,
                                                     const DirectedStiffness<Dim>* directed);

/// How the free faces of a cell answer to tractions on them, by the moduli of its material at rest. Displacements û are
/// those that balance the tractions (balancing_combinations), and strain the cell by the gradient sum z (x) n of
/// z = |f|/|c| û. docs/method.md, Space.
template <int Dim>
class FreeFaceAnswers {
public:
    /// `normals`: of unit length, out of the cell. `directed`: as in `stress_of_gradient`.
    FreeFaceAnswers(std::vector<Vector<Dim>> normals, double lambda, double mu, const DirectedStiffness<Dim>* directed);

    /// Stress that the cell has under these tractions, one per face.
    [[nodiscard]] StressOfPushes<Dim> stress(std::span<const Vector<Dim>> tractions) const;
    /// Pressure on a face alone over its z along the normal [Pa].
    [[nodiscard]] double modulus(std::size_t face) const;

private:
    std::vector<Vector<Dim>> normals_;
    double lambda_, mu_;
    const DirectedStiffness<Dim>* directed_;
    Eigen::MatrixXd compliance_;  // z of all faces by all tractions, (n Dim, n Dim) [1/Pa]
};

}  // namespace abut::solid
