#include "abut/dynamics/parasitic_filter.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

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
        : mass_(mass), arm_(position.begin(), position.end()) {
        Vector<Dim> centre = Vector<Dim>::Zero();
        for (std::size_t i = 0; i < mass.size(); ++i) {
            total_ += mass[i];
            centre += mass[i] * position[i];
        }
        centre /= total_;
        for (Vector<Dim>& arm : arm_) arm -= centre;
        if constexpr (Dim == 3) {
            Matrix<3> inertia = Matrix<3>::Zero();
            for (std::size_t i = 0; i < arm_.size(); ++i)
                inertia += mass[i] * (arm_[i].squaredNorm() * Matrix<3>::Identity() - arm_[i] * arm_[i].transpose());
            inverse_inertia_ = pseudo_inverse(inertia);
        } else {
            for (std::size_t i = 0; i < arm_.size(); ++i) inertia_ += mass[i] * arm_[i].squaredNorm();
        }
    }

    void remove_from(std::span<Vector<Dim>> velocity) const {
        Vector<Dim> mean = Vector<Dim>::Zero();
        for (std::size_t i = 0; i < velocity.size(); ++i) mean += mass_[i] * velocity[i];
        mean /= total_;
        for (Vector<Dim>& v : velocity) v -= mean;
        if constexpr (Dim == 3) {
            Vector<3> momentum = Vector<3>::Zero();
            for (std::size_t i = 0; i < velocity.size(); ++i) momentum += mass_[i] * arm_[i].cross(velocity[i]);
            const Vector<3> spin = inverse_inertia_ * momentum;
            for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] -= spin.cross(arm_[i]);
        } else {
            double momentum = 0.0;
            for (std::size_t i = 0; i < velocity.size(); ++i)
                momentum += mass_[i] * (arm_[i][0] * velocity[i][1] - arm_[i][1] * velocity[i][0]);
            const double spin = inertia_ > 0.0 ? momentum / inertia_ : 0.0;
            for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] -= spin * Vector<2>(-arm_[i][1], arm_[i][0]);
        }
    }

private:
    std::span<const double> mass_;
    std::vector<Vector<Dim>> arm_;
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

template <int Dim>
void NeutralFilter<Dim>::operator()(std::span<const double> q, double dt, std::span<const double> p_before,
                                    std::span<double> p_after) {
    const std::vector<ContactPatch> patches = solid_.contact_patches();
    if (patches.empty()) return;
    cells_.clear();
    for (const ContactPatch& patch : patches) cells_.insert(cells_.end(), patch.cells.begin(), patch.cells.end());
    std::sort(cells_.begin(), cells_.end());
    force_.resize(cells_.size());
    solid_.end_force_on(cells_, q, force_);
    for (const ContactPatch& patch : patches)
        filter(patch, as_vectors<Dim>(q), dt, as_vectors<Dim>(p_before), as_vectors<Dim>(p_after), force_);
}

template <int Dim>
void NeutralFilter<Dim>::filter(const ContactPatch& patch, std::span<const Vector<Dim>> q, double dt,
                                std::span<const Vector<Dim>> p_before, std::span<Vector<Dim>> p_after,
                                std::span<const Vector<Dim>> force) {
    const std::size_t n = patch.cells.size();
    std::vector<double> mass(n);
    std::vector<Vector<Dim>> position(n);
    e_.resize(n);
    v_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const std::int32_t c = patch.cells[i];
        const auto at = std::lower_bound(cells_.begin(), cells_.end(), c) - cells_.begin();
        mass[i] = solid_.cell_mass()[c];
        position[i] = solid_.mesh().cell_centroid[c] + q[c];
        v_[i] = p_before[c] / mass[i];
        e_[i] = (p_after[c] - p_before[c] - dt * force[at]) / mass[i];
    }
    const std::vector<Vector<Dim>> v = v_;
    if (!patch.held) {
        const RigidMotion<Dim> rigid(mass, position);
        rigid.remove_from(e_);
        rigid.remove_from(v_);
    }
    const double along = mass_product<Dim>(mass, v, v_);
    if (!(along >= motionless * mass_product<Dim>(mass, v, v) && along > 0.0)) return;
    const double alpha = mass_product<Dim>(mass, v, e_) / along;
    for (std::size_t i = 0; i < n; ++i) p_after[patch.cells[i]] -= (kappa_ * mass[i]) * (e_[i] - alpha * v_[i]);
}

template class NeutralFilter<2>;
template class NeutralFilter<3>;

}  // namespace abut::dynamics
