#include "abut/solid/material/j2_plasticity.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "abut/base/decompositions.hpp"
#include "abut/solid/material/rising_root.hpp"

namespace abut::solid {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double same_stretch = 1e-9;  // of two axes: the slope of what is between them is taken
const double alpha_per_flow = std::sqrt(2.0 / 3.0);

/// C_p^-1 - I from z: its lower triangle by columns.
template <int Dim>
Matrix<Dim> plastic_part(std::span<const double> memory) {
    Matrix<Dim> part;
    std::size_t at = 0;
    for (int j = 0; j < Dim; ++j)
        for (int i = j; i < Dim; ++i) part(i, j) = part(j, i) = memory[at++];
    return part;
}

template <int Dim>
void set_plastic_part(const Matrix<Dim>& part, std::span<double> memory) {
    std::size_t at = 0;
    for (int j = 0; j < Dim; ++j)
        for (int i = j; i < Dim; ++i) memory[at++] = 0.5 * (part(i, j) + part(j, i));
}

template <int Dim>
constexpr std::size_t n_plastic = Dim*(Dim + 1) / 2;  // and, in the plane, the part out of it

/// b_e - I where nothing has flowed: G + G^T + G G^T.
template <int Dim>
Matrix<Dim> left_stretched(const Matrix<Dim>& g) {
    return g + g.transpose() + g * g.transpose();
}

}  // namespace

/// Principal logarithmic elastic strains, and where they point; the third out of the plane in 2D.
template <int Dim>
struct J2Plasticity<Dim>::Elastic {
    Matrix<Dim> directions;
    Vector<Dim> stretch;  // eigenvalues of b_e - I
    Vector<3> strain;
    bool is_sound;  // det F > 0
};

template <int Dim>
std::vector<double> J2Plasticity<Dim>::initial_memory() const {
    return std::vector<double>(n_plastic<Dim> + (Dim == 2 ? 2 : 1), 0.0);
}

template <int Dim>
auto J2Plasticity<Dim>::elastic_part(const Matrix<Dim>& g, std::span<const double> memory) const -> Elastic {
    const Matrix<Dim> f = Matrix<Dim>::Identity() + g;
    const Matrix<Dim> part = plastic_part<Dim>(memory);
    const Matrix<Dim> left = left_stretched<Dim>(g) + f * part * f.transpose();
    const SymmetricEigen<Dim> eigen = symmetric_eigen(Matrix<Dim>(0.5 * (left + left.transpose())));
    Elastic elastic{eigen.vectors, eigen.values, Vector<3>::Zero(), f.determinant() > 0.0};
    for (int k = 0; k < Dim; ++k) elastic.strain[k] = 0.5 * std::log1p(eigen.values[k]);
    if constexpr (Dim == 2) elastic.strain[2] = 0.5 * std::log1p(memory[n_plastic<2>]);
    return elastic;
}

/// W and P = tau F^-T.
template <int Dim>
Response<Dim> J2Plasticity<Dim>::response(const Matrix<Dim>& g, const Elastic& elastic) const {
    if (!elastic.is_sound) return {infinity, Matrix<Dim>::Constant(infinity)};
    const double lambda = material_.lambda(), mu = material_.mu(), trace = elastic.strain.sum();
    Matrix<Dim> tau = Matrix<Dim>::Zero();
    for (int k = 0; k < Dim; ++k)
        tau += (lambda * trace + 2.0 * mu * elastic.strain[k]) * elastic.directions.col(k) *
               elastic.directions.col(k).transpose();
    const Matrix<Dim> inverse = (Matrix<Dim>::Identity() + g).inverse();
    return {0.5 * lambda * trace * trace + mu * elastic.strain.squaredNorm(), tau * inverse.transpose()};
}

template <int Dim>
Response<Dim> J2Plasticity<Dim>::at(const Matrix<Dim>& g, std::span<const double> memory) const {
    return response(g, elastic_part(g, memory));
}

/// Delta gamma of a trial deviator of this size [Pa].
template <int Dim>
double J2Plasticity<Dim>::flow(double size, const FlowStress& stress) const {
    const double mu = material_.mu();
    const auto excess = [&](double flow) {
        const auto [at, slope] = stress.at(alpha_per_flow * flow);
        return std::pair{2.0 * mu * flow + alpha_per_flow * at - size, 2.0 * mu + 2.0 / 3.0 * slope};
    };
    return rising_root(excess, 0.0, size / (2.0 * mu));
}

template <int Dim>
Advance<Dim> J2Plasticity<Dim>::advance(const Matrix<Dim>& g, double dt, std::span<double> memory) const {
    Elastic elastic = elastic_part(g, memory);
    const Vector<3> deviator = elastic.strain - Vector<3>::Constant(elastic.strain.mean());
    const double mu = material_.mu(), size = 2.0 * mu * deviator.norm();
    const FlowStress stress(material_.flow, memory.back(), dt);
    if (!elastic.is_sound || !(size > alpha_per_flow * stress.at_start())) return {response(g, elastic), false};

    const double flowed = flow(size, stress);
    elastic.strain -= flowed / deviator.norm() * deviator;
    Matrix<Dim> left = Matrix<Dim>::Zero();  // b_e - I
    for (int k = 0; k < Dim; ++k)
        left += std::expm1(2.0 * elastic.strain[k]) * elastic.directions.col(k) * elastic.directions.col(k).transpose();
    const Matrix<Dim> inverse = (Matrix<Dim>::Identity() + g).inverse();
    set_plastic_part<Dim>(inverse * (left - left_stretched<Dim>(g)) * inverse.transpose(), memory);
    if constexpr (Dim == 2) memory[n_plastic<2>] = std::expm1(2.0 * elastic.strain[2]);
    memory.back() += alpha_per_flow * flowed;
    Advance<Dim> advance{response(g, elastic), true};
    advance.response.energy += stress.work(alpha_per_flow * flowed);
    return advance;
}

/// d tau_i/d strain_j of principal values [Pa].
template <int Dim>
Matrix<3> J2Plasticity<Dim>::elastic_moduli() const {
    return Matrix<3>::Constant(material_.lambda()) + 2.0 * material_.mu() * Matrix<3>::Identity();
}

template <int Dim>
bool J2Plasticity<Dim>::stress_changes(const Matrix<Dim>& g, std::span<const double> memory,
                                       std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results) const {
    const Elastic elastic = elastic_part(g, memory);
    change_stress(g, memory, elastic, elastic.strain, elastic_moduli(), changes, results);
    return true;
}

/// The tangent that is consistent with the radial return.
template <int Dim>
bool J2Plasticity<Dim>::advanced_changes(const Matrix<Dim>& g, double dt, std::span<const double> memory,
                                         std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results) const {
    const Elastic elastic = elastic_part(g, memory);
    const Vector<3> deviator = elastic.strain - Vector<3>::Constant(elastic.strain.mean());
    const double mu = material_.mu(), size = 2.0 * mu * deviator.norm();
    const FlowStress stress(material_.flow, memory.back(), dt);
    Vector<3> strain = elastic.strain;
    Matrix<3> moduli = elastic_moduli();
    if (size > alpha_per_flow * stress.at_start()) {
        const double flowed = flow(size, stress);
        const double hardening = 2.0 / 3.0 * stress.at(alpha_per_flow * flowed).slope;
        const Vector<3> along = deviator.normalized();
        const Matrix<3> onto = along * along.transpose();
        const Matrix<3> deviatoric = Matrix<3>::Identity() - Matrix<3>::Constant(1.0 / 3.0);
        moduli -= 4.0 * mu * mu * (flowed / size * (deviatoric - onto) + onto / (2.0 * mu + hardening));
        strain -= flowed * along;
    }
    change_stress(g, memory, elastic, strain, moduli, changes, results);
    return true;
}

/// Changes of P = tau F^-T, tau being a function of b_e before the step has flowed, with its axes.
template <int Dim>
void J2Plasticity<Dim>::change_stress(const Matrix<Dim>& g, std::span<const double> memory, const Elastic& elastic,
                                      const Vector<3>& strain, const Matrix<3>& moduli, std::span<const Matrix<Dim>> changes,
                                      std::span<Matrix<Dim>> results) const {
    const Matrix<Dim> f = Matrix<Dim>::Identity() + g, to_stress = f.inverse().transpose();
    const Matrix<Dim> arm = (Matrix<Dim>::Identity() + plastic_part<Dim>(memory)) * f.transpose();
    const Vector<3> tau = material_.lambda() * strain.sum() * Vector<3>::Ones() + 2.0 * material_.mu() * strain;
    const Matrix<Dim>& axes = elastic.directions;
    const Matrix<Dim> stress = axes * tau.head<Dim>().asDiagonal() * axes.transpose() * to_stress;
    for (std::size_t n = 0; n < changes.size(); ++n) {
        const Matrix<Dim> half = changes[n] * arm;
        const Matrix<Dim> stretched = axes.transpose() * (half + half.transpose()) * axes;
        Vector<3> strained = Vector<3>::Zero();
        for (int k = 0; k < Dim; ++k) strained[k] = 0.5 * stretched(k, k) / (1.0 + elastic.stretch[k]);
        const Vector<3> along = moduli * strained;
        Matrix<Dim> change;
        for (int j = 0; j < Dim; ++j)
            for (int i = 0; i < Dim; ++i) {
                const double apart = elastic.stretch[i] - elastic.stretch[j];
                const double slope = std::abs(apart) > same_stretch
                                         ? (tau[i] - tau[j]) / apart
                                         : 0.5 * (moduli(i, i) - moduli(i, j)) / (1.0 + elastic.stretch[i]);
                change(i, j) = i == j ? along[i] : slope * stretched(i, j);
            }
        results[n] = axes * change * axes.transpose() * to_stress - stress * changes[n].transpose() * to_stress;
    }
}

template <int Dim>
std::optional<double> J2Plasticity<Dim>::out_of_plane_stress(const Matrix<Dim>& g, std::span<const double> memory) const {
    if constexpr (Dim == 3) return std::nullopt;
    const Vector<3> strain = elastic_part(g, memory).strain;
    const double tau = material_.lambda() * strain.sum() + 2.0 * material_.mu() * strain[2];
    return tau / (Matrix<Dim>::Identity() + g).determinant();
}

template class J2Plasticity<2>;
template class J2Plasticity<3>;

}  // namespace abut::solid
