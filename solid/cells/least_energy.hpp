#pragma once
// Private to the sources of this layer.
#include <array>

#include "abut/solid/cells/finite_cell.hpp"
#include "abut/solid/material/stored_energy.hpp"
#include "abut/solid/material/thermal_stretch.hpp"

namespace abut::solid {

/// A cell of any stored energy with free faces: F with these faces where the energy is least, in one state, by Newton's
/// method. They change F along their normals alone. The counterpart of CondensedStep, which knows this in closed form
/// for one material.
template <int Dim>
class LeastEnergy {
public:
    LeastEnergy() = default;
    /// `g`: F - I with affine faces, `shape`: what the search begins with. `law` must outlive it.
    LeastEnergy(const FreeCell<Dim>& free, const StoredEnergy<Dim>& law, const Matrix<Dim>& g, const Matrix<Dim>& shape);
    /// `shape` as the linear material has it.
    [[nodiscard]] static Matrix<Dim> linear_shape(const FreeCell<Dim>& free, double contraction, const Matrix<Dim>& g);
    /// `shape` of a cell that is warm.
    [[nodiscard]] static Matrix<Dim> warm_shape(const FreeCell<Dim>& free, double contraction, const Matrix<Dim>& g,
                                                const ThermalStretch& stretch);

    /// F - I at the minimum.
    [[nodiscard]] const Matrix<Dim>& gradient() const { return gradient_; }
    /// F at the minimum from the axes of the cell to axes that go with the tangents of F: how the free faces stand,
    /// however the cell is turned.
    [[nodiscard]] Matrix<Dim> shape() const { return frame_.transpose() * (axes_ + gradient_ * axes_); }
    /// W and dW/dF of the minimum as a function of F: the stress on free faces is 0. Not numbers where there is no minimum.
    [[nodiscard]] const Response<Dim>& response() const { return response_; }
    /// dV/dF of a cell with one normal, from dV/dF at the minimum.
    [[nodiscard]] Matrix<Dim> pull_back(const Matrix<Dim>& gradient) const;

private:
    void set_one_normal(const Matrix<Dim>& g, const Matrix<Dim>& shape);
    void set_edge(const Matrix<Dim>& shape);
    template <int n>
    void minimise(std::array<Matrix<Dim>, n> directions);

    const StoredEnergy<Dim>* law_ = nullptr;
    Matrix<Dim> axes_ = Matrix<Dim>::Identity();
    Matrix<Dim> frame_ = Matrix<Dim>::Identity();  // of what the tangents have become
    Matrix<Dim> gradient_ = Matrix<Dim>::Zero();
    Matrix<Dim> inverse_ = Matrix<Dim>::Identity();  // of d(P n)/d(F n)
    Response<Dim> response_{0.0, Matrix<Dim>::Zero()};
};

}  // namespace abut::solid
