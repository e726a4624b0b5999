#pragma once
// Private to the sources of this layer.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/solid/material/material.hpp"
#include "abut/solid/material/orthotropic.hpp"

namespace abut::solid {

/// Refuses laws that contradict themselves or their material, as H~ would not show it: the closed trapezoid keeps H~
/// exact for any stress. They are tried at one state and along one direction.
template <int Dim>
class LawCheck {
public:
    /// Messages begin with `who`.
    LawCheck(const Material& material, std::string who) : material_(material), who_(std::move(who)) {
        for (int j = 0; j < Dim; ++j)
            for (int i = 0; i < Dim; ++i) {
                state_(i, j) = 0.05 * std::sin(1.0 + i + 3.0 * j);
                along_(i, j) = std::cos(2.0 * i - j);
            }
        turn_(0, 0) = turn_(1, 1) = 0.8;
        turn_(1, 0) = 0.6;
        turn_(0, 1) = -0.6;
    }

    /// Throws BadInput.
    void require(const StoredEnergy<Dim>& law) const {
        const Matrix<Dim> zero = Matrix<Dim>::Zero();
        require(std::abs(law.at(zero).energy) + law.at(zero).stress.norm(), "has energy or stress at rest");
        require_slope([&](const Matrix<Dim>& g) { return law.at(g); }, "has a stress that is not the slope of its energy");
        require_same_when_turned(law, "has an energy that knows how it is turned");
        const Matrix<Dim> hooke = material_.mu() * (along_ + along_.transpose()) +
                                  material_.lambda() * along_.trace() * Matrix<Dim>::Identity() +
                                  DirectedStiffness<Dim>(material_).stress(along_);
        require((law.stress_change(zero, along_) - hooke).norm(), "has other moduli at small strains than its material");
    }
    /// Throws BadInput.
    void require(const InelasticLaw<Dim>& law) const {
        const std::vector<double> initial = law.initial_memory();
        require(FrozenLaw<Dim>(law, initial));
        const auto advance = [&](const Matrix<Dim>& g, std::vector<double>& memory) {
            memory = initial;
            return law.advance(g, step_length, memory).response;
        };
        std::vector<double> memory;
        require_slope([&](const Matrix<Dim>& g) { return advance(g, memory); },
                      "has a stress at the end of a step that is not the slope of what the step stores and dissipates");
        const Matrix<Dim> stress = advance(state_, memory).stress;
        const FrozenLaw<Dim> afterwards(law, memory);
        require((afterwards.at(state_).stress - stress).norm(),
                "has another stress after a step than at its end, while nothing moves");
        require_same_when_turned(afterwards, "has an energy that knows, after a step, how it is turned");
    }

private:
    static constexpr double step = 1e-5, allowed = 1e-6;  // of F; over mu
    static constexpr double step_length = 1.0;            // [s]: a law that knows no rates has the same answer for any

    void require(double off, const char* what) const {
        if (!(off / material_.mu() <= allowed))
            throw BadInput(who_ + what + ": it is off by " + number(off / material_.mu()) + " of the shear modulus, " +
                               number(allowed) + " is allowed. Correct its stored energy or the constants of its material.",
                           {.value = off / material_.mu(), .allowed = allowed});
    }
    template <class ResponseAt>
    void require_slope(const ResponseAt& at, const char* what) const {
        const double slope = (at(state_ + step * along_).energy - at(state_ - step * along_).energy) / (2.0 * step);
        require(std::abs(at(state_).stress.cwiseProduct(along_).sum() - slope), what);
    }
    void require_same_when_turned(const StoredEnergy<Dim>& law, const char* what) const {
        const Matrix<Dim> unit = Matrix<Dim>::Identity();
        require(std::abs(law.at(turn_ * (unit + state_) - unit).energy - law.at(state_).energy), what);
    }

    const Material& material_;
    std::string who_;
    Matrix<Dim> state_, along_;
    Matrix<Dim> turn_ = Matrix<Dim>::Identity();
};

}  // namespace abut::solid
