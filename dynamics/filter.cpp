#include "abut/dynamics/filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "abut/base/dense_decompositions.hpp"
#include "abut/base/eigen.hpp"
#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::dynamics {
namespace {

constexpr double not_held = 1e-10;  // eigenvalue of a rigid motion over the largest, for the holds to allow it
// Of its own size: a vector that is in the span of others up to this is theirs. Up to this much of v . e H~ may change.
constexpr double dependent = 1e-14;

/// Vectors of a patch, in coordinates where M is the unit matrix, orthonormal to each other.
class OrthonormalVectors {
public:
    OrthonormalVectors(Eigen::Index size, Eigen::Index at_most) : vectors_(size, at_most) {}

    /// `size`: of what the vector is made of, before anything cancels.
    void add(Eigen::VectorXd vector, double size) {
        remove_from(vector);
        if (const double norm = vector.norm(); norm > dependent * size) vectors_.col(n_++) = vector / norm;
    }
    /// Twice: what rounding leaves of the first time would be of the size of the result.
    void remove_from(Eigen::VectorXd& vector) const {
        const auto present = vectors_.leftCols(n_);
        for (int time = 0; time < 2; ++time) vector -= present * (present.transpose() * vector).eval();
    }

private:
    Eigen::MatrixXd vectors_;
    Eigen::Index n_ = 0;
};

/// The rigid motions of a patch that nothing holds: Dim translations, and rotations about the centre of mass, in units of
/// the radius of gyration.
template <int Dim>
class FreeRigidMotions {
public:
    static constexpr int n_motions = Dim + n_rotations<Dim>;
    using Motion = SmallMatrix<n_motions, 1>;
    using Basis = Eigen::Matrix<double, n_motions, Eigen::Dynamic, 0, n_motions, n_motions>;

    FreeRigidMotions(std::span<const double> mass, std::vector<Vector<Dim>> position, std::span<const Hold<Dim>> holds)
        : arm_(std::move(position)) {
        double total = 0.0, inertia = 0.0;
        Vector<Dim> centre = Vector<Dim>::Zero();
        for (std::size_t i = 0; i < mass.size(); ++i) {
            total += mass[i];
            centre += mass[i] * arm_[i];
        }
        centre /= total;
        for (std::size_t i = 0; i < mass.size(); ++i) inertia += mass[i] * (arm_[i] - centre).squaredNorm();
        const double radius = inertia > 0.0 ? std::sqrt(inertia / total) : 1.0;
        for (Vector<Dim>& arm : arm_) arm = (arm - centre) / radius;
        free_ = null_space(holds, centre, radius);
        size_ = std::sqrt(total);
    }

    /// Their momenta, M^1/2 times the velocities.
    void append_to(OrthonormalVectors& vectors, std::span<const double> root_mass) const {
        for (const Motion motion : free_.colwise()) {
            Eigen::VectorXd momentum(Dim * static_cast<Eigen::Index>(arm_.size()));
            for (std::size_t i = 0; i < arm_.size(); ++i)
                momentum.segment<Dim>(Dim * static_cast<Eigen::Index>(i)) =
                    as_eigen(root_mass[i] * velocity_at(arm_[i], motion));
            vectors.add(std::move(momentum), size_);
        }
    }

private:
    using Square = SmallMatrix<n_motions, n_motions>;

    static Vector<Dim> velocity_at(const Vector<Dim>& arm, const Motion& motion) {
        return motion.template head<Dim>() + turning_velocity<Dim>(motion.template tail<n_rotations<Dim>>(), arm);
    }
    /// Motions that the holds leave; a hold takes (direction, arm × direction) from each motion.
    static Basis null_space(std::span<const Hold<Dim>> holds, const Vector<Dim>& centre, double radius) {
        if (holds.empty()) return Basis::Identity(n_motions, n_motions);
        Square held = Square::Zero();
        for (const Hold<Dim>& hold : holds) {
            const AxialVector<Dim> turning = moment<Dim>((hold.position - centre) / radius, hold.direction);
            Motion row;
            std::ranges::copy(turning, std::ranges::copy(hold.direction, row.begin()).out);
            held += row * row.transpose();
        }
        const auto eigen = symmetric_eigen(Eigen::MatrixXd(as_eigen(held)));
        const double limit = not_held * eigen.values[n_motions - 1];
        const auto n_free = std::ranges::count_if(eigen.values, [&](double value) { return value <= limit; });
        return eigen.vectors.leftCols(n_free);
    }

    std::vector<Vector<Dim>> arm_;  // from the centre of mass, over the radius of gyration
    Basis free_;
    double size_;  // of a motion of unit velocity
};

}  // namespace

void detail::check_kappa(double kappa) {
    if (!(kappa >= 0.0 && kappa <= 1.0))
        throw BadInput("filter: kappa is " + number(kappa) +
                           "; 0 to 1 is allowed. Give the part of the mode that is taken out at each step.",
                       {.value = kappa, .allowed = kappa < 0.0 ? 0.0 : 1.0});
}

template <int Dim>
std::vector<Vector<Dim>> detail::parasitic_part(const ContactPatch<Dim>& patch, std::span<const std::int32_t> numbers,
                                                std::span<const PatchPoint<Dim>> points, double kappa) {
    const std::size_t n = patch.points.size();
    std::vector<double> mass(n), root_mass(n);
    std::vector<Vector<Dim>> position(n);
    Eigen::VectorXd e(Dim * static_cast<Eigen::Index>(n)), v(e.size());  // M^-1/2 times momenta
    for (std::size_t k = 0; k < n; ++k) {
        const auto at = std::ranges::lower_bound(numbers, patch.points[k]) - numbers.begin();
        const PatchPoint<Dim>& point = points[static_cast<std::size_t>(at)];
        const auto own = Eigen::seqN(Dim * static_cast<Eigen::Index>(k), Eigen::fix<Dim>);
        mass[k] = point.mass;
        root_mass[k] = std::sqrt(mass[k]);
        position[k] = point.position;
        v(own) = as_eigen(point.momentum / root_mass[k]);
        e(own) = as_eigen(point.parasitic / root_mass[k]);
    }
    OrthonormalVectors kept(e.size(), FreeRigidMotions<Dim>::n_motions + 1);
    FreeRigidMotions<Dim>(mass, std::move(position), patch.holds).append_to(kept, root_mass);
    const double speed = v.norm();
    kept.add(std::move(v), speed);
    kept.remove_from(e);
    std::vector<Vector<Dim>> part(n);
    for (std::size_t k = 0; k < n; ++k)
        part[k] = (kappa * root_mass[k]) * Vector<Dim>(e.segment<Dim>(Dim * static_cast<Eigen::Index>(k)));
    return part;
}

template <int Dim>
void detail::gather_points(const Ranks& ranks, std::span<const std::size_t> own, std::span<PatchPoint<Dim>> points) {
    if (ranks.is_one()) return;
    constexpr std::size_t n_values = 2 + 3 * Dim;  // place among the points, mass, vectors
    std::vector<double> values;
    for (const std::size_t i : own) {
        const PatchPoint<Dim>& point = points[i];
        values.insert(values.end(), {static_cast<double>(i), point.mass});
        for (const Vector<Dim>* vector : {&point.position, &point.momentum, &point.parasitic})
            values.insert(values.end(), vector->begin(), vector->end());
    }
    values = ranks.gather(values);
    for (auto value = values.begin(); value != values.end(); value += n_values) {
        PatchPoint<Dim>& point = points[static_cast<std::size_t>(value[0])];
        point.mass = value[1];
        auto from = value + 2;
        for (Vector<Dim>* vector : {&point.position, &point.momentum, &point.parasitic})
            for (double& component : *vector) component = *from++;
    }
}

#define ABUT_INSTANTIATE(Dim)                                                                                         \
    template std::vector<Vector<Dim>> detail::parasitic_part(const ContactPatch<Dim>&, std::span<const std::int32_t>, \
                                                             std::span<const PatchPoint<Dim>>, double);               \
    template void detail::gather_points(const Ranks&, std::span<const std::size_t>, std::span<PatchPoint<Dim>>);
ABUT_INSTANTIATE(1)
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::dynamics
