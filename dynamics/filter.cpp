#include "abut/dynamics/filter.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::dynamics {
namespace {

inline constexpr double motionless = 1e-12;  // v . M v' below this times v . M v: no direction to keep, nothing is done

/// Points on one line have no inertia about it, a single point none at all: there they cannot spin.
Matrix<3> pseudo_inverse(const Matrix<3>& inertia) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(inertia);
    const double cut = 1e-12 * eigen.eigenvalues().maxCoeff();
    const Eigen::Vector3d inverse =
        eigen.eigenvalues().unaryExpr([&](double value) { return value > cut ? 1.0 / value : 0.0; });
    return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

/// Rigid-body parts of velocity fields over a set of weighted points.
template <int Dim>
class RigidMotion {
public:
    RigidMotion(std::span<const double> mass, std::span<const Vector<Dim>> position)
        : mass_(mass), lever_arm_(position.begin(), position.end()) {
        Vector<Dim> centre = Vector<Dim>::Zero();
        for (std::size_t i = 0; i < mass.size(); ++i) {
            total_ += mass[i];
            centre += mass[i] * position[i];
        }
        centre /= total_;
        for (Vector<Dim>& lever_arm : lever_arm_) lever_arm -= centre;
        if constexpr (Dim == 3) {
            Matrix<3> inertia = Matrix<3>::Zero();
            for (std::size_t i = 0; i < lever_arm_.size(); ++i)
                inertia += mass[i] *
                           (lever_arm_[i].squaredNorm() * Matrix<3>::Identity() - lever_arm_[i] * lever_arm_[i].transpose());
            inverse_inertia_ = pseudo_inverse(inertia);
        } else {
            for (std::size_t i = 0; i < lever_arm_.size(); ++i) inertia_ += mass[i] * lever_arm_[i].squaredNorm();
        }
    }

    void remove_from(std::span<Vector<Dim>> velocity) const {
        Vector<Dim> mean = Vector<Dim>::Zero();
        for (std::size_t i = 0; i < velocity.size(); ++i) mean += mass_[i] * velocity[i];
        mean /= total_;
        for (Vector<Dim>& v : velocity) v -= mean;
        if constexpr (Dim == 3) {
            Vector<3> momentum = Vector<3>::Zero();
            for (std::size_t i = 0; i < velocity.size(); ++i) momentum += mass_[i] * lever_arm_[i].cross(velocity[i]);
            const Vector<3> spin = inverse_inertia_ * momentum;
            for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] -= spin.cross(lever_arm_[i]);
        } else {
            double momentum = 0.0;
            for (std::size_t i = 0; i < velocity.size(); ++i)
                momentum += mass_[i] * (lever_arm_[i][0] * velocity[i][1] - lever_arm_[i][1] * velocity[i][0]);
            const double spin = inertia_ > 0.0 ? momentum / inertia_ : 0.0;
            for (std::size_t i = 0; i < velocity.size(); ++i)
                velocity[i] -= spin * Vector<2>(-lever_arm_[i][1], lever_arm_[i][0]);
        }
    }

private:
    std::span<const double> mass_;
    std::vector<Vector<Dim>> lever_arm_;
    double total_ = 0.0;
    double inertia_ = 0.0;
    Matrix<3> inverse_inertia_ = Matrix<3>::Zero();
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
void detail::filter_patch(const ContactPatch& patch, const PatchState<Dim>& state, double kappa) {
    const std::size_t n = patch.points.size();
    std::vector<double> mass(n);
    std::vector<Vector<Dim>> position(n), e(n), v(n);  // e as a velocity M^-1 e
    for (std::size_t k = 0; k < n; ++k) {
        const std::int32_t i = patch.points[k];
        const auto at = std::lower_bound(state.points.begin(), state.points.end(), i) - state.points.begin();
        mass[k] = state.mass[i];
        position[k] = state.rest_position[i] + state.q[i];
        v[k] = state.p_before[i] / mass[k];
        e[k] = (state.p_after[i] - state.p_before[i] - state.dt * state.force[at]) / mass[k];
    }
    std::vector<Vector<Dim>> v_free = v;  // v'
    if (!patch.held) {
        const RigidMotion<Dim> rigid(mass, position);
        rigid.remove_from(e);
        rigid.remove_from(v_free);
    }
    const double along = mass_product<Dim>(mass, v, v_free);
    if (!(along >= motionless * mass_product<Dim>(mass, v, v) && along > 0.0)) return;
    const double alpha = mass_product<Dim>(mass, v, e) / along;
    for (std::size_t k = 0; k < n; ++k) state.p_after[patch.points[k]] -= (kappa * mass[k]) * (e[k] - alpha * v_free[k]);
}

template void detail::filter_patch<2>(const ContactPatch&, const PatchState<2>&, double);
template void detail::filter_patch<3>(const ContactPatch&, const PatchState<3>&, double);

}  // namespace abut::dynamics
