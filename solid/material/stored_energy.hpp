#pragma once
#include <cstddef>
#include <span>

#include "abut/base/vector.hpp"

namespace abut::solid {

/// Response of a material to a displacement gradient.
template <int Dim>
struct Response {
    double energy;       ///< W, per volume at rest [J/m^3]
    Matrix<Dim> stress;  ///< P = dW/dF, the first stress tensor of Piola and Kirchhoff [Pa]
};

/// An elastic material by its stored energy W(F) per volume at rest, F = I + G: what cells of Kinematics::finite are
/// made of whose material is not St. Venant and Kirchhoff's. W does not know how the cell is turned: W(Q F) = W(F) for
/// rotations Q, and vanishes at G = 0 together with its stress. In 2D it is that of plane strain.
///
/// One object serves all cells of a body, from several threads at once.
template <int Dim>
class StoredEnergy {
public:
    StoredEnergy() = default;
    StoredEnergy(const StoredEnergy&) = delete;
    StoredEnergy& operator=(const StoredEnergy&) = delete;
    virtual ~StoredEnergy() = default;

    /// W and dW/dF. Where det F is not positive W is infinite or not a number, and the stress counts for nothing.
    [[nodiscard]] virtual Response<Dim> at(const Matrix<Dim>& g) const = 0;
    /// dP for a change dF at G [Pa]; by central differences unless it is overridden. Free faces of cells ask for it.
    [[nodiscard]] virtual Matrix<Dim> stress_change(const Matrix<Dim>& g, const Matrix<Dim>& change) const;
    /// Sets `results` to `stress_change` of each of several changes.
    virtual void stress_changes(const Matrix<Dim>& g, std::span<const Matrix<Dim>> changes,
                                std::span<Matrix<Dim>> results) const {
        for (std::size_t i = 0; i < changes.size(); ++i) results[i] = stress_change(g, changes[i]);
    }
};

}  // namespace abut::solid
