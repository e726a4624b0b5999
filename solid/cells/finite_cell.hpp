#pragma once
// Private to the sources of this layer.
#include <cstdint>

#include "abut/base/vector.hpp"
#include "abut/solid/operator/arrays.hpp"
#include "abut/solid/operator/lanes.hpp"

namespace abut::solid {

/// (G + G^T + G^T G)/2: the Green strain of F = I + G, exact for small G, too.
template <int Dim>
[[nodiscard]] inline LaneTensor<Dim> green_strain(const LaneTensor<Dim>& g) {
    const LaneTensor<Dim> transposed = g.transposed();
    LaneTensor<Dim> strain;
    for (int j = 0; j < Dim; ++j) {
        strain.col[j] = g.col[j] + transposed.col[j];
        for (int i = 0; i < Dim; ++i) strain.col[j].r[i] += dot(g.col[i], g.col[j]);
        strain.col[j] = 0.5 * strain.col[j];
    }
    return strain;
}

/// The mean of the Green strains at G - dG/2 and G + dG/2.
template <int Dim>
[[nodiscard]] inline LaneTensor<Dim> mean_green_strain(const LaneTensor<Dim>& g, const LaneTensor<Dim>& change) {
    LaneTensor<Dim> strain = green_strain(g);
    for (int j = 0; j < Dim; ++j)
        for (int i = 0; i < Dim; ++i) strain.col[j].r[i] += 0.125 * dot(change.col[i], change.col[j]);
    return strain;
}

/// lambda tr E + 2 mu E.
template <int Dim>
[[nodiscard]] inline LaneTensor<Dim> svk_stress(const CellGeometry<Dim>& cell, const LaneTensor<Dim>& strain) {
    double trace = 0.0;
    for (int j = 0; j < Dim; ++j) trace += strain.col[j][j];
    LaneTensor<Dim> stress;
    for (int j = 0; j < Dim; ++j) {
        stress.col[j] = (2.0 * cell.mu) * strain.col[j];
        stress.col[j].r[j] += cell.lambda * trace;
    }
    return stress;
}

/// A cell of a body of Kinematics::finite that has free faces. These are where the energy of the cell is least: they
/// change F along their normals only, and the minimum is a function of F on the directions tangent to all of them.
/// docs/method.md, Bodies that bend.
template <int Dim>
struct FreeCell {
    std::int32_t cell;
    /// Dim - 1 where all free faces have one normal, fewer at edges and corners. Normals less than 28 degrees apart are
    /// one: their mean
    int n_tangents;
    Matrix<Dim> axes;  ///< orthonormal and right-handed, tangents first
    /// M^-1 on what the normals span, M = sum |f|/|c| n n^T over the free faces; 0 beside it [m]. Where F is changed by X
    /// such a face moves by X M^-1 n: of all motions that change F so, that of the least sum |f| |û|^2
    Matrix<Dim> to_faces;

    [[nodiscard]] bool has_one_normal() const { return n_tangents == Dim - 1; }
    [[nodiscard]] Vector<Dim> normal() const { return axes.col(Dim - 1); }
};

/// nu' = lambda/(lambda + 2 mu): how a plane contracts across a stretch in it [-].
[[nodiscard]] inline double contraction(double lambda, double mu) { return lambda / (lambda + 2.0 * mu); }

/// nu [-].
[[nodiscard]] inline double poisson_ratio(double lambda, double mu) { return 0.5 * lambda / (lambda + mu); }

/// S of the condensed energy 1/2 S : E, which depends on E on the tangents alone; S n = 0 on each free face.
template <int Dim>
[[nodiscard]] Matrix<Dim> condensed_stress(const FreeCell<Dim>& free, double lambda, double mu, const Matrix<Dim>& strain);

/// How much a cell is deformed.
struct CellStretch {
    double determinant;  ///< det F [-]; 0 where a free face has no stretch across left
    double strain;       ///< |E|, Frobenius [-]
};

/// Stretch of a cell whose faces are where they are put.
template <int Dim>
[[nodiscard]] CellStretch cell_stretch(const Matrix<Dim>& displacement_gradient);

/// r^2, the squared stretch along the normal that the free face of a cell with one normal takes [-]. Not positive:
/// there is no minimum, the tangents are stretched too far.
template <int Dim>
[[nodiscard]] double normal_stretch_squared(const FreeCell<Dim>& free, double contraction,
                                            const Matrix<Dim>& displacement_gradient);

/// Stretch of a cell with one normal, under F_cond. Below r^2 = 0.05 the free face counts as lost.
template <int Dim>
[[nodiscard]] CellStretch condensed_stretch(const FreeCell<Dim>& free, double contraction,
                                            const Matrix<Dim>& displacement_gradient);

/// Gradients F of a cell with one normal on a straight step: from those that the affine faces give, F = I + G, to those with
/// the free faces at the minimum, F_cond, which has F on the tangents y_k = F t_k and
///
///     F_cond n = r e,  e normal to all y_k,  r^2 = 1 + nu' (Dim - 1 - sum y_k.y_k)
///
/// and back for gradients of energy: the work along the step is exactly the change of what depends on F_cond at both ends,
/// and what has no moment in F_cond has none in F. With the same F at both ends it is the plain derivative.
template <int Dim>
class CondensedStep {
public:
    CondensedStep() = default;
    /// From G - change/2 to G + change/2.
    CondensedStep(const FreeCell<Dim>& free, double contraction, const Matrix<Dim>& g, const Matrix<Dim>& change);

    /// F_cond - I, the mean of both ends.
    [[nodiscard]] const Matrix<Dim>& mean() const { return mean_; }
    /// dV/dF from dV/dF_cond [the same unit].
    [[nodiscard]] Matrix<Dim> pull_back(const Matrix<Dim>& gradient) const;

private:
    void set_plane(double contraction, const Matrix<Dim>& y_0, const Matrix<Dim>& y_1);
    void set_space(double contraction, const Matrix<Dim>& y_0, const Matrix<Dim>& y_1);

    Matrix<Dim> axes_ = Matrix<Dim>::Identity();
    Matrix<Dim> mean_ = Matrix<Dim>::Zero();
    Matrix<Dim> y_ = Matrix<Dim>::Identity();  // means of y_k
    Vector<Dim> z_ = Vector<Dim>::Zero();      // mean of F_cond n
    // In the plane: z = ratio R90 y
    double ratio_ = 1.0;
    double ratio_slope_ = 0.0;                  // of it in y.y/2
    Vector<Dim> change_ = Vector<Dim>::Zero();  // of y
    // In space: z = stretch e_3
    double contraction_over_stretch_ = 0.0;
    Matrix<Dim> frame_ = Matrix<Dim>::Identity();    // means of e_k
    Vector<Dim> stretch_arm_ = Vector<Dim>::Zero();  // what p is multiplied by for the change of r
    Matrix<Dim> to_angles_ = Matrix<Dim>::Zero();    // -L^-T
};

}  // namespace abut::solid
