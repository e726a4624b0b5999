#include "abut/dynamics/filter.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::dynamics {
namespace {

constexpr double motionless = 1e-12;  // v . M v' below this times v . M v: no direction to keep, nothing is done

constexpr double not_held = 1e-10;    // eigenvalue of a rigid motion over the largest, for the holds to allow it
constexpr double no_inertia = 1e-12;  // the same of a rotation: points on one line have none about it

/// The rigid motions of a patch that nothing holds, and the parts of velocity fields along these. A rigid motion has Dim
/// components of translation and one (2D) or three of rotation about the centre of mass, times the radius of gyration.
template <int Dim>
class FreeRigidMotions {
public:
    FreeRigidMotions(std::span<const double> mass, std::span<const Vector<Dim>> rest_position,
                     std::span<const Vector<Dim>> position, std::span<const Hold<Dim>> holds)
        : mass_(mass), arm_(position.begin(), position.end()) {
        double total = 0.0, inertia = 0.0;
        Vector<Dim> centre = Vector<Dim>::Zero(), centre_at_rest = Vector<Dim>::Zero();
        for (std::size_t i = 0; i < mass.size(); ++i) {
            total += mass[i];
            centre += mass[i] * position[i];
            centre_at_rest += mass[i] * rest_position[i];
        }
        centre /= total;
        centre_at_rest /= total;
        for (Vector<Dim>& arm : arm_) arm -= centre;
        for (std::size_t i = 0; i < mass.size(); ++i) inertia += mass[i] * arm_[i].squaredNorm();
        const double radius = inertia > 0.0 ? std::sqrt(inertia / total) : 1.0;
        for (Vector<Dim>& arm : arm_) arm /= radius;

        Square held = Square::Zero();
        for (const Hold<Dim>& hold : holds) {
            const Motion row = moment((hold.position - centre_at_rest) / radius, hold.direction);
            held += row * row.transpose();
        }
        Square gram = Square::Zero();
        for (std::size_t i = 0; i < mass.size(); ++i)
            for (int d = 0; d < Dim; ++d) {
                const Motion row = moment(arm_[i], Vector<Dim>::Unit(d));
                gram += mass[i] * (row * row.transpose());
            }
        projection_ = inverse_on(null_space(held), gram);
    }

    void remove_from(std::span<Vector<Dim>> velocity) const {
        Motion momentum = Motion::Zero();
        for (std::size_t i = 0; i < velocity.size(); ++i) momentum += mass_[i] * moment(arm_[i], velocity[i]);
        const Motion motion = projection_ * momentum;
        for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] -= velocity_at(arm_[i], motion);
    }

private:
    static constexpr int n_motions = Dim == 2 ? 3 : 6;
    using Motion = Eigen::Matrix<double, n_motions, 1>;
    using Square = Eigen::Matrix<double, n_motions, n_motions>;
    using Basis = Eigen::Matrix<double, n_motions, Eigen::Dynamic, 0, n_motions, n_motions>;

    /// (v, arm x v): the product of a rigid motion with it is v . (velocity of the motion at the arm).
    static Motion moment(const Vector<Dim>& arm, const Vector<Dim>& v) {
        Motion result;
        result.template head<Dim>() = v;
        if constexpr (Dim == 2)
            result[2] = arm[0] * v[1] - arm[1] * v[0];
        else
            result.template tail<3>() = arm.cross(v);
        return result;
    }
    static Vector<Dim> velocity_at(const Vector<Dim>& arm, const Motion& motion) {
        if constexpr (Dim == 2)
            return Vector<2>(motion[0] - motion[2] * arm[1], motion[1] + motion[2] * arm[0]);
        else
            return motion.template head<3>() + Vector<3>(motion.template tail<3>()).cross(arm);
    }

    static Basis null_space(const Square& held) {
        if (held.isZero(0.0)) return Square::Identity();
        const Eigen::SelfAdjointEigenSolver<Square> eigen(held);  // eigenvalues increase
        const double limit = not_held * eigen.eigenvalues()[n_motions - 1];
        const auto n_free = std::ranges::count_if(eigen.eigenvalues(), [&](double value) { return value <= limit; });
        return eigen.eigenvectors().leftCols(n_free);
    }

    /// B (B^T gram B)^+ B^T.
    static Square inverse_on(const Basis& basis, const Square& gram) {
        if (basis.cols() == 0) return Square::Zero();
        const Basis gram_basis = gram * basis;
        const Eigen::MatrixXd small = basis.transpose() * gram_basis;
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(small);
        const double cut = no_inertia * eigen.eigenvalues().maxCoeff();
        const Eigen::VectorXd inverse =
            eigen.eigenvalues().unaryExpr([&](double value) { return value > cut ? 1.0 / value : 0.0; });
        const Eigen::MatrixXd vectors = basis * eigen.eigenvectors();
        return vectors * inverse.asDiagonal() * vectors.transpose();
    }

    std::span<const double> mass_;
    std::vector<Vector<Dim>> arm_;  // from the centre of mass, over the radius of gyration
    Square projection_;             // from momentum to the rigid motion that carries it
};

template <int Dim>
double mass_product(std::span<const double> mass, std::span<const Vector<Dim>> a, std::span<const Vector<Dim>> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < mass.size(); ++i) sum += mass[i] * a[i].dot(b[i]);
    return sum;
}

}  // namespace

void detail::check_kappa(double kappa) {
    if (!(kappa >= 0.0 && kappa <= 1.0))
        throw BadInput("filter: kappa is " + number(kappa) +
                           "; 0 to 1 is allowed. Give the part of the mode that is taken out at each step.",
                       {.value = kappa, .allowed = kappa < 0.0 ? 0.0 : 1.0});
}

template <int Dim>
void detail::filter_patch(const ContactPatch<Dim>& patch, const PatchState<Dim>& state, double kappa) {
    const std::size_t n = patch.points.size();
    std::vector<double> mass(n);
    std::vector<Vector<Dim>> rest_position(n), position(n), e(n), v(n);  // e as a velocity M^-1 e
    for (std::size_t k = 0; k < n; ++k) {
        const std::int32_t i = patch.points[k];
        const auto at = std::lower_bound(state.points.begin(), state.points.end(), i) - state.points.begin();
        mass[k] = state.mass[i];
        rest_position[k] = state.rest_position[i];
        position[k] = rest_position[k] + state.q[i];
        v[k] = state.p_before[i] / mass[k];
        e[k] = (state.p_after[i] - state.p_before[i] - state.dt * state.force[at]) / mass[k];
    }
    std::vector<Vector<Dim>> v_free = v;  // v'
    const FreeRigidMotions<Dim> rigid(mass, rest_position, position, patch.holds);
    rigid.remove_from(e);
    rigid.remove_from(v_free);
    const double along = mass_product<Dim>(mass, v, v_free);
    if (!(along >= motionless * mass_product<Dim>(mass, v, v) && along > 0.0)) return;
    const double alpha = mass_product<Dim>(mass, v, e) / along;
    for (std::size_t k = 0; k < n; ++k) state.p_after[patch.points[k]] -= (kappa * mass[k]) * (e[k] - alpha * v_free[k]);
}

template void detail::filter_patch<2>(const ContactPatch<2>&, const PatchState<2>&, double);
template void detail::filter_patch<3>(const ContactPatch<3>&, const PatchState<3>&, double);

}  // namespace abut::dynamics
