#pragma once
// Private to the sources of this layer.
#include <array>

#include "abut/solid/cells/finite_cell.hpp"

namespace abut::solid {

/// Gradients F of a cell whose free faces have several normals, at an edge or a corner of its body, on a straight step: from
/// those that the affine faces give, F = I + G, to those with the free faces where they bear nothing,
///
///     F_cond = F t (x) t + r (e_2 (x) n_2 + e_3 (x) n_3) at an edge along t in space,    r (e_1 (x) n_1 + ...) at a corner
///
/// The e_k are orthonormal, at an edge normal to F t, and turn as the affine faces do: sums of e_k (x) F n_k are symmetric.
/// r = s (l/s)^(-nu), s being the stretch that heat asks for and l that along the edge, 1 out of the plane; at a corner in
/// space r = s. To first order this is the minimum of the energy for every isotropic material, and to all orders for
/// incompressible ones. docs/method.md, Bodies that bend.
///
/// The counterpart of CondensedStep: gradients of energy are pulled back such that the work along the step is the change of
/// what depends on F_cond, and that what has no moment in F_cond has none in F.
template <int Dim>
class EdgeStep {
public:
    /// From G - change/2 to G + change/2. `swelling`: s at both ends [-].
    EdgeStep(const FreeCell<Dim>& free, double poisson, const std::array<double, 2>& swelling, const Matrix<Dim>& g,
             const Matrix<Dim>& change);
    /// F_cond - I, the mean of both ends.
    [[nodiscard]] const Matrix<Dim>& mean() const { return mean_; }
    /// The change of F_cond. Where s changes, a part of it does not come from F.
    [[nodiscard]] const Matrix<Dim>& change() const { return change_; }
    /// dV/dF from dV/dF_cond [the same unit].
    [[nodiscard]] Matrix<Dim> pull_back(const Matrix<Dim>& gradient) const;

private:
    static constexpr int n_axial = Dim * (Dim - 1) / 2;
    using Angles = SmallMatrix<n_axial, 1>;

    void set_turning(const Matrix<Dim>& turned_0, const Matrix<Dim>& turned_1, const Matrix<Dim>& change_of_f);

    Matrix<Dim> axes_;       // FreeCell::axes
    int first_;              // column of the first normal: 1 at an edge, 0 at a corner
    Matrix<Dim> f_;          // mean of F on the axes
    Matrix<Dim> turned_;     // mean of e_k
    Matrix<Dim> condensed_;  // mean of F_cond on the axes
    Matrix<Dim> mean_, change_;
    Angles omega_;                             // of the step
    SmallMatrix<n_axial, n_axial> to_angles_;  // -L^-T
    Matrix<Dim> arms_;                         // what a change of r moves, by its axis
    double stretch_slope_ = 0.0;               // of r in |F t|^2
};

/// F_cond - I in one state. `swelling`: s [-].
template <int Dim>
[[nodiscard]] Matrix<Dim> edge_gradient(const FreeCell<Dim>& free, double poisson, double swelling, const Matrix<Dim>& g);

}  // namespace abut::solid
