#pragma once
// Private to the sources of this layer.
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/solid/material/material.hpp"

namespace abut::solid {

/// Refuses a stored energy that contradicts itself or its material, as H~ would not show it: the closed trapezoid keeps H~ exact for
/// any stress. Throws BadInput beginning with `who`.
template <int Dim>
void require_stored_energy(const StoredEnergy<Dim>& law, const Material& material, const std::string& who) {
    constexpr double step = 1e-5, allowed = 1e-6;  // of F; over mu
    const Matrix<Dim> zero = Matrix<Dim>::Zero(), unit = Matrix<Dim>::Identity();
    Matrix<Dim> g, d;
    for (int j = 0; j < Dim; ++j)
        for (int i = 0; i < Dim; ++i) {
            g(i, j) = 0.05 * std::sin(1.0 + i + 3.0 * j);
            d(i, j) = std::cos(2.0 * i - j);
        }
    Matrix<Dim> turn = unit;
    turn(0, 0) = turn(1, 1) = 0.8;
    turn(1, 0) = 0.6;
    turn(0, 1) = -0.6;
    const auto require = [&](double off, const char* what) {
        if (!(off / material.mu() <= allowed))
            throw BadInput(who + what + ": it is off by " + number(off / material.mu()) + " of the shear modulus, " +
                               number(allowed) + " is allowed. Correct its stored energy or the constants of its material.",
                           {.value = off / material.mu(), .allowed = allowed});
    };
    require(std::abs(law.at(zero).energy) + law.at(zero).stress.norm(), "has energy or stress at rest");
    const double slope = (law.at(g + step * d).energy - law.at(g - step * d).energy) / (2.0 * step);
    require(std::abs(law.at(g).stress.cwiseProduct(d).sum() - slope), "has a stress that is not the slope of its energy");
    require(std::abs(law.at(turn * (unit + g) - unit).energy - law.at(g).energy),
            "has an energy that knows how it is turned");
    const Matrix<Dim> hooke = material.mu() * (d + d.transpose()) + material.lambda() * d.trace() * unit;
    require((law.stress_change(zero, d) - hooke).norm(), "has other moduli at small strains than its material");
}

}  // namespace abut::solid
