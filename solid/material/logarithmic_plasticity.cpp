#include "abut/solid/material/logarithmic_plasticity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "abut/base/decompositions.hpp"
#include "abut/solid/material/rising_root.hpp"

namespace abut::solid {
namespace {

constexpr double two_thirds = 2.0 / 3.0;
const double alpha_of_flow = std::sqrt(two_thirds);
constexpr double near_stretches = 1e-4;  // of three axes: their mean stands for all in what is of second order

/// p from z: its lower triangle by columns, without the last one, since p has no trace.
template <int Dim>
Matrix<3> plastic_strain_of(std::span<const double> memory) {
    Matrix<3> plastic = Matrix<3>::Zero();
    std::size_t at = 0;
    for (int j = 0; j < Dim; ++j)
        for (int i = j; i < Dim && j < 2; ++i) plastic(i, j) = plastic(j, i) = memory[at++];
    plastic(2, 2) = -plastic(0, 0) - plastic(1, 1);
    return plastic;
}

template <int Dim>
void set_plastic_strain(const Matrix<3>& plastic, std::span<double> memory) {
    std::size_t at = 0;
    for (int j = 0; j < Dim; ++j)
        for (int i = j; i < Dim && j < 2; ++i) memory[at++] = plastic(i, j);
}

/// F^T F - I.
template <int Dim>
Matrix<Dim> right_stretched(const Matrix<Dim>& g) {
    return g + g.transpose() + g.transpose() * g;
}

Matrix<3> deviator(const Matrix<3>& tensor) { return tensor - tensor.trace() / 3.0 * Matrix<3>::Identity(); }

/// First divided difference of (ln c)/2 at c = 1 + s_1 and 1 + s_2.
double divided_difference(double s_1, double s_2) {
    const double apart = (s_1 - s_2) / (1.0 + s_2);
    return 0.5 * (apart == 0.0 ? 1.0 : std::log1p(apart) / apart) / (1.0 + s_2);
}

/// Second divided difference of the same.
double divided_difference(double s_1, double s_2, double s_3) {
    std::array<double, 3> s{s_1, s_2, s_3};
    std::ranges::sort(s);
    const double middle = 1.0 + (s_1 + s_2 + s_3) / 3.0;
    if (s[2] - s[0] <= near_stretches * middle) return -0.25 / (middle * middle);
    return (divided_difference(s[2], s[1]) - divided_difference(s[1], s[0])) / (s[2] - s[0]);
}

}  // namespace

template <int Dim>
struct LogarithmicPlasticity<Dim>::Strain {
    Matrix<Dim> axes;                  // of F^T F
    Vector<Dim> stretch;               // its eigenvalues less 1
    Matrix<3> of = Matrix<3>::Zero();  // E; in 2D 0 out of the plane
    bool is_sound;                     // det F > 0

    /// dE/d(F^T F) applied to a symmetric tensor: it maps changes of F^T F to those of E, and stress in E to that in F^T F.
    [[nodiscard]] Matrix<Dim> mapped(const Matrix<Dim>& tensor) const {
        Matrix<Dim> in_axes = axes.transpose() * tensor * axes;
        for (int j = 0; j < Dim; ++j)
            for (int i = 0; i < Dim; ++i) in_axes(i, j) *= divided_difference(stretch[i], stretch[j]);
        return axes * in_axes * axes.transpose();
    }
    /// By how much `mapped` of a tensor changes as F^T F does, while the tensor stays.
    [[nodiscard]] Matrix<Dim> changed_map(const Matrix<Dim>& tensor, const Matrix<Dim>& change) const {
        const Matrix<Dim> t = axes.transpose() * tensor * axes, c = axes.transpose() * change * axes;
        Matrix<Dim> sum = Matrix<Dim>::Zero();
        for (int k = 0; k < Dim; ++k)
            for (int j = 0; j < Dim; ++j)
                for (int i = 0; i < Dim; ++i)
                    sum(j, k) += divided_difference(stretch[i], stretch[j], stretch[k]) * c(j, i) * t(i, k);
        return axes * (sum + sum.transpose()) * axes.transpose();
    }
};

/// Size |change of p| and direction of the flow of a step; 0 without flow.
template <int Dim>
struct LogarithmicPlasticity<Dim>::Flow {
    double size = 0.0, trial = 0.0, slope = 0.0;  // and |xi| before, and the slope of the radius in it
    Matrix<3> along = Matrix<3>::Zero();
};

template <int Dim>
std::vector<double> LogarithmicPlasticity<Dim>::initial_memory() const {
    return std::vector<double>(Dim == 2 ? 4 : 6, 0.0);
}

template <int Dim>
auto LogarithmicPlasticity<Dim>::strain_of(const Matrix<Dim>& g) -> Strain {
    const SymmetricEigen<Dim> eigen = symmetric_eigen(right_stretched<Dim>(g));
    Strain strain{
        .axes = eigen.vectors, .stretch = eigen.values, .is_sound = (Matrix<Dim>::Identity() + g).determinant() > 0.0};
    Vector<Dim> logarithms;
    for (int k = 0; k < Dim; ++k) logarithms[k] = 0.5 * std::log1p(eigen.values[k]);
    strain.of = in_3d<Dim>(eigen.vectors * logarithms.asDiagonal() * eigen.vectors.transpose());
    return strain;
}

template <int Dim>
auto LogarithmicPlasticity<Dim>::flow(const Strain& strain, const Matrix<3>& plastic, const FlowStress& stress) const
    -> Flow {
    const double answer = 2.0 * material_.mu() + two_thirds * material_.flow.kinematic_hardening;
    const Matrix<3> driving = 2.0 * material_.mu() * deviator(strain.of) - answer * plastic;
    Flow flow{.trial = driving.norm()};
    if (!strain.is_sound || !(flow.trial > alpha_of_flow * stress.at_start())) return flow;
    const auto excess = [&](double size) {
        const auto [at, slope] = stress.at(alpha_of_flow * size);
        return std::pair{answer * size + alpha_of_flow * at - flow.trial, answer + two_thirds * slope};
    };
    flow.size = rising_root(excess, 0.0, flow.trial / answer);
    flow.slope = two_thirds * stress.at(alpha_of_flow * flow.size).slope;
    flow.along = driving / flow.trial;
    return flow;
}

/// dW/dE.
template <int Dim>
Matrix<3> LogarithmicPlasticity<Dim>::stress_of(const Strain& strain, const Matrix<3>& plastic) const {
    return material_.lambda() * strain.of.trace() * Matrix<3>::Identity() + 2.0 * material_.mu() * (strain.of - plastic);
}

/// W and P = 2 F (dW/dE : dE/d(F^T F)).
template <int Dim>
Response<Dim> LogarithmicPlasticity<Dim>::response(const Matrix<Dim>& g, const Strain& strain,
                                                   const Matrix<3>& plastic) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!strain.is_sound) return {infinity, Matrix<Dim>::Constant(infinity)};
    const double trace = strain.of.trace();
    const double energy = 0.5 * material_.lambda() * trace * trace + material_.mu() * (strain.of - plastic).squaredNorm() +
                          material_.flow.kinematic_hardening / 3.0 * plastic.squaredNorm();
    const Matrix<Dim> stress = stress_of(strain, plastic).template topLeftCorner<Dim, Dim>();
    return {energy, 2.0 * (Matrix<Dim>::Identity() + g) * strain.mapped(stress)};
}

template <int Dim>
Response<Dim> LogarithmicPlasticity<Dim>::at(const Matrix<Dim>& g, std::span<const double> memory) const {
    return response(g, strain_of(g), plastic_strain_of<Dim>(memory));
}

template <int Dim>
Advance<Dim> LogarithmicPlasticity<Dim>::advance(const Matrix<Dim>& g, double dt, std::span<double> memory) const {
    const Strain strain = strain_of(g);
    const FlowStress stress(material_.flow, memory.back(), dt);
    const Matrix<3> before = plastic_strain_of<Dim>(memory);
    const Flow flow = this->flow(strain, before, stress);
    if (!(flow.size > 0.0)) return {response(g, strain, before), false};
    set_plastic_strain<Dim>(before + flow.size * flow.along, memory);
    memory.back() += alpha_of_flow * flow.size;
    Advance<Dim> advance{response(g, strain, plastic_strain_of<Dim>(memory)), true};
    advance.response.energy += stress.work(alpha_of_flow * flow.size);
    return advance;
}

template <int Dim>
bool LogarithmicPlasticity<Dim>::stress_changes(const Matrix<Dim>& g, std::span<const double> memory,
                                                std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results) const {
    change_stress(g, strain_of(g), plastic_strain_of<Dim>(memory), Flow{}, changes, results);
    return true;
}

/// The tangent that is consistent with the radial return.
template <int Dim>
bool LogarithmicPlasticity<Dim>::advanced_changes(const Matrix<Dim>& g, double dt, std::span<const double> memory,
                                                  std::span<const Matrix<Dim>> changes,
                                                  std::span<Matrix<Dim>> results) const {
    const Strain strain = strain_of(g);
    const FlowStress stress(material_.flow, memory.back(), dt);
    const Matrix<3> before = plastic_strain_of<Dim>(memory);
    const Flow flow = this->flow(strain, before, stress);
    change_stress(g, strain, before + flow.size * flow.along, flow, changes, results);
    return true;
}

template <int Dim>
void LogarithmicPlasticity<Dim>::change_stress(const Matrix<Dim>& g, const Strain& strain, const Matrix<3>& plastic,
                                               const Flow& flow, std::span<const Matrix<Dim>> changes,
                                               std::span<Matrix<Dim>> results) const {
    const Matrix<Dim> f = Matrix<Dim>::Identity() + g;
    const double mu = material_.mu();
    const double answer = 2.0 * mu + two_thirds * material_.flow.kinematic_hardening + flow.slope;
    const Matrix<Dim> stress = stress_of(strain, plastic).template topLeftCorner<Dim, Dim>(), mapped = strain.mapped(stress);
    for (std::size_t n = 0; n < changes.size(); ++n) {
        const Matrix<Dim> half = f.transpose() * changes[n], change = half + half.transpose();
        const Matrix<3> strained = in_3d<Dim>(strain.mapped(change));
        Matrix<3> stressed = material_.lambda() * strained.trace() * Matrix<3>::Identity() + 2.0 * mu * strained;
        if (flow.size > 0.0) {
            const double along = flow.along.cwiseProduct(strained).sum();
            stressed -= 4.0 * mu * mu *
                        (flow.size / flow.trial * (deviator(strained) - along * flow.along) + along / answer * flow.along);
        }
        results[n] =
            2.0 * changes[n] * mapped +
            2.0 * f * (strain.mapped(stressed.template topLeftCorner<Dim, Dim>()) + strain.changed_map(stress, change));
    }
}

template <int Dim>
std::optional<double> LogarithmicPlasticity<Dim>::out_of_plane_stress(const Matrix<Dim>& g,
                                                                      std::span<const double> memory) const {
    if constexpr (Dim == 3) return std::nullopt;
    return stress_of(strain_of(g), plastic_strain_of<Dim>(memory))(2, 2) / (Matrix<Dim>::Identity() + g).determinant();
}

template class LogarithmicPlasticity<2>;
template class LogarithmicPlasticity<3>;

}  // namespace abut::solid
