#include "abut/solid/point_loads.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/dynamics/point_system.hpp"

namespace abut::solid {
namespace {

constexpr double least_width = 1e-3;  // of a cloud of points: its least second moment over the largest

/// The discrete gradient of k/2 (|r| - L)^2: along the mean of r, so that it has no moment about the mean positions.
template <int Dim>
Vector<Dim> mean_tension(const Spring<Dim>& law, const Vector<Dim>& r_0, const Vector<Dim>& r_1) {
    const double mean_length = 0.5 * (r_0.norm() + r_1.norm());
    const double share = law.length > 0.0 && mean_length > 0.0 ? 1.0 - law.length / mean_length : 1.0;
    return 0.5 * law.stiffness * share * (r_0 + r_1);
}

/// Of a dashpot at this rate: along the spring, or in all directions where it has no length.
template <int Dim>
Vector<Dim> damping_tension(const Spring<Dim>& law, const Vector<Dim>& r, const Vector<Dim>& rate) {
    if (law.length == 0.0) return law.damping * rate;
    const Vector<Dim> along = r.normalized();
    return law.damping * along.dot(rate) * along;
}

}  // namespace

template <int Dim>
PointLoads<Dim>::PointLoads(const Bodies<Dim>& bodies) : bodies_(bodies), options_(bodies.options()) {
    hold_springs();
    hold_tractions();
    check_moments();
    for (const BodyMoment<Dim>& law : options_.moments) moments_.push_back({law});
}

/// Mass, centre and second moments of some points.
template <int Dim>
struct PointLoads<Dim>::Cloud {
    Cloud(const Bodies<Dim>& bodies, std::span<const std::int32_t> points) {
        const Vector<Dim> origin = bodies.rest()[points.front()];
        for (const std::int32_t i : points) {
            mass += bodies.masses()[i];
            centre += bodies.masses()[i] * (bodies.rest()[i] - origin);
        }
        centre = origin + centre / mass;
        for (const std::int32_t i : points) {
            const Vector<Dim> arm = bodies.rest()[i] - centre;
            second_moment += bodies.masses()[i] * arm * arm.transpose();
        }
    }
    [[nodiscard]] bool is_wide() const {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>> eigen(
            Eigen::Matrix<double, Dim, Dim>(second_moment), Eigen::EigenvaluesOnly);
        return eigen.eigenvalues()[0] > least_width * eigen.eigenvalues()[Dim - 1];
    }

    double mass = 0.0;
    Vector<Dim> centre = Vector<Dim>::Zero();
    Matrix<Dim> second_moment = Matrix<Dim>::Zero();
};

/// Weights that add up to 1, and with which the place moves exactly with affine motions of the points.
template <int Dim>
HeldPlace<Dim> PointLoads<Dim>::held_by(std::vector<std::int32_t> points, const Vector<Dim>& position) const {
    const Cloud cloud(bodies_, points);
    HeldPlace<Dim> place{.points = std::move(points), .weights = {}, .rest = position};
    const Vector<Dim> slope = cloud.second_moment.inverse() * (position - cloud.centre);
    for (const std::int32_t i : place.points)
        place.weights.push_back(bodies_.masses()[i] * (1.0 / cloud.mass + slope.dot(bodies_.rest()[i] - cloud.centre)));
    return place;
}

/// The cells that are near enough, and as many of the next ones as it takes to span all directions.
template <int Dim>
std::vector<std::int32_t> PointLoads<Dim>::cells_around(const Anchor<Dim>& anchor) const {
    const auto [begin, end] = bodies_.points_of(anchor.body);
    std::vector<std::int32_t> cells(static_cast<std::size_t>(end - begin));
    std::iota(cells.begin(), cells.end(), begin);
    const auto distance = [&](std::int32_t i) { return (bodies_.rest()[i] - anchor.position).norm(); };
    std::ranges::stable_sort(cells, {}, distance);
    const auto near = std::ranges::partition_point(cells, [&](std::int32_t i) { return distance(i) <= anchor.radius; });
    const std::span<const std::int32_t> all(cells);
    for (std::size_t n = std::max<std::size_t>(static_cast<std::size_t>(near - cells.begin()), Dim + 1); n <= all.size();
         ++n)
        if (Cloud(bodies_, all.first(n)).is_wide()) {
            cells.resize(n);
            std::ranges::sort(cells);
            return cells;
        }
    throw BadInput(bodies_.mesh().name + ": the centres of the cells of body '" + bodies_.mesh().body_names[anchor.body] +
                   "' lie nearly in a plane or on a line, so that nothing can be held beside it. Refine its mesh, or choose "
                   "Kinematics::rigid.");
}

template <int Dim>
HeldPlace<Dim> PointLoads<Dim>::place_of(const Anchor<Dim>& anchor) const {
    if (anchor.body == ground) return {.points = {}, .weights = {}, .rest = anchor.position};
    if (anchor.body < 0 || anchor.body >= bodies_.mesh().n_bodies() || !anchor.position.allFinite() ||
        !(anchor.radius >= 0.0))
        throw BadInput(bodies_.mesh().name + ": a spring is anchored to body " + std::to_string(anchor.body) +
                       " with a radius of " + number(anchor.radius) + " m; bodies are counted from 0 to " +
                       std::to_string(bodies_.mesh().n_bodies() - 1) +
                       " (solid::ground: none), a radius is >= 0, and a position is finite.");
    if (!bodies_.is_rigid(anchor.body)) return held_by(cells_around(anchor), anchor.position);
    const auto [begin, end] = bodies_.points_of(anchor.body);
    std::vector<std::int32_t> points(static_cast<std::size_t>(end - begin));
    std::iota(points.begin(), points.end(), begin);
    return held_by(std::move(points), anchor.position);
}

template <int Dim>
void PointLoads<Dim>::hold_springs() {
    for (const Spring<Dim>& law : options_.springs) {
        for (const double value : {law.stiffness, law.length, law.damping})
            if (!(value >= 0.0) || !std::isfinite(value))
                throw BadInput(bodies_.mesh().name + ": a spring has the value " + number(value) +
                                   "; stiffness, length and damping must be finite and >= 0. Correct SolidOptions::springs.",
                               {.value = value, .allowed = 0.0});
        springs_.push_back({place_of(law.first), place_of(law.second), law});
    }
}

template <int Dim>
void PointLoads<Dim>::hold_tractions() {
    const mesh::Mesh<Dim>& mesh = bodies_.mesh();
    for (std::size_t i = 0; i < options_.boundary.traction.size(); ++i) {
        const TractionCondition<Dim>& condition = options_.boundary.traction[i];
        const std::vector<std::int32_t>& faces = mesh.group(condition.group).faces;
        outside_.emplace_back(condition.from_outside ? faces.size() : 0, condition.value);
        for (std::size_t k = 0; k < faces.size(); ++k) {
            const std::int32_t body = mesh.cell_body[mesh.face_cells[faces[k]][0]];
            if (!bodies_.turns(body)) continue;
            Anchor<Dim> anchor{.body = body, .position = mesh.face_centroid[faces[k]]};
            tractions_.push_back({place_of(anchor), mesh.face_measure[faces[k]], body, i, k});
        }
    }
}

template <int Dim>
std::vector<HeldPlace<Dim>> PointLoads<Dim>::traction_places(std::size_t condition) const {
    std::vector<HeldPlace<Dim>> places;
    for (const HeldTraction& traction : tractions_)
        if (traction.condition == condition) places.push_back(traction.place);
    return places;
}

template <int Dim>
void PointLoads<Dim>::check_moments() const {
    for (const BodyMoment<Dim>& moment : options_.moments)
        if (moment.body < 0 || moment.body >= bodies_.mesh().n_bodies() || !moment.moment.allFinite() ||
            !(moment.damping >= 0.0))
            throw BadInput(bodies_.mesh().name + ": a moment on body " + std::to_string(moment.body) +
                           " with a damping of " + number(moment.damping) + " N m s; bodies are counted from 0 to " +
                           std::to_string(bodies_.mesh().n_bodies() - 1) +
                           ", moments are finite, and damping is >= 0. Correct SolidOptions::moments.");
}

template <int Dim>
bool PointLoads<Dim>::do_work() const {
    return !moments_.empty() || !tractions_.empty() ||
           std::ranges::any_of(springs_, [](const HeldSpring& spring) { return spring.law.damping > 0.0; });
}

template <int Dim>
double PointLoads<Dim>::energy(std::span<const Vector<Dim>> q) const {
    double energy = 0.0;
    for (const HeldSpring& spring : springs_) {
        const double stretch = (spring.second.at(q) - spring.first.at(q)).norm() - spring.law.length;
        energy += 0.5 * spring.law.stiffness * stretch * stretch;
    }
    return energy;
}

template <int Dim>
void PointLoads<Dim>::add(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time, double dt,
                          contact::TakenForce take, const TurnOf& turn_of, std::span<Vector<Dim>> force, double& work) {
    add_springs(q_0, q_1, dt, take, force, work);
    work += add_tractions(q_0, q_1, time, turn_of, force);
    for (HeldMoment& moment : moments_) {
        const Middle middle = middle_of(moment.law.body, q_0, q_1);
        const AxialVector<Dim> spin = spin_of<Dim>(middle.second_moment, middle.angular) / dt;
        const bool takes_last = take == contact::TakenForce::mean && moment.spin;
        work += add_moment(moment.law, takes_last ? *moment.spin : spin, middle, q_0, q_1, force);
        moment.spin = spin;
    }
}

template <int Dim>
void PointLoads<Dim>::add_at(std::span<const Vector<Dim>> q, double time, const TurnOf& turn_of,
                             std::span<Vector<Dim>> force) const {
    for (const HeldSpring& spring : springs_) {
        const Vector<Dim> r = spring.second.at(q) - spring.first.at(q);
        push(spring,
             mean_tension(spring.law, r, r) + damping_tension(spring.law, r, spring.rate.value_or(Vector<Dim>::Zero())),
             force);
    }
    add_tractions(q, q, time, turn_of, force);
    for (const HeldMoment& moment : moments_)
        add_moment(moment.law, moment.spin.value_or(AxialVector<Dim>::Zero()), middle_of(moment.law.body, q, q), q, q,
                   force);
}

template <int Dim>
void PointLoads<Dim>::push(const HeldSpring& spring, const Vector<Dim>& tension, std::span<Vector<Dim>> force) const {
    spring.first.push(tension, force);
    spring.second.push(-tension, force);
}

template <int Dim>
void PointLoads<Dim>::add_springs(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double dt,
                                  contact::TakenForce take, std::span<Vector<Dim>> force, double& work) {
    for (HeldSpring& spring : springs_) {
        const Vector<Dim> r_0 = spring.second.at(q_0) - spring.first.at(q_0);
        const Vector<Dim> r_1 = spring.second.at(q_1) - spring.first.at(q_1);
        const bool mean = take == contact::TakenForce::mean;
        const Vector<Dim> rate = (r_1 - r_0) / dt;
        const Vector<Dim> damping =
            damping_tension<Dim>(spring.law, 0.5 * (r_0 + r_1), mean && spring.rate ? *spring.rate : rate);
        push(spring, mean_tension(spring.law, mean ? r_0 : r_1, r_1) + damping, force);
        work -= damping.dot(r_1 - r_0);
        spring.rate = rate;
    }
}

template <int Dim>
Vector<Dim> PointLoads<Dim>::value_of(const HeldTraction& traction, double time) const {
    const TractionCondition<Dim>& condition = options_.boundary.traction[traction.condition];
    if (condition.from_outside) return outside_[traction.condition][traction.face];
    const Vector<Dim> value = condition.history ? condition.history(time, traction.place.rest) : condition.value;
    if (!value.allFinite())
        throw BadInput("traction on '" + condition.group + "': its value at t = " + number(time) +
                       " s is not finite. Correct its value or history.");
    return value;
}

/// Of bodies that turn; those of the others are part of the loads of their cells. Constant within a step, as it begins. Their
/// work [J].
template <int Dim>
double PointLoads<Dim>::add_tractions(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time,
                                      const TurnOf& turn_of, std::span<Vector<Dim>> force) const {
    double work = 0.0;
    for (const HeldTraction& traction : tractions_) {
        Vector<Dim> push = traction.area * value_of(traction, time);
        if (options_.boundary.traction[traction.condition].follows) push = turn_of(traction.body) * push;
        traction.place.push(push, force);
        work += push.dot(traction.place.at(q_1) - traction.place.at(q_0));
    }
    return work;
}

template <int Dim>
typename PointLoads<Dim>::Middle PointLoads<Dim>::middle_of(std::int32_t body, std::span<const Vector<Dim>> q_0,
                                                            std::span<const Vector<Dim>> q_1) const {
    const auto [begin, end] = bodies_.points_of(body);
    const auto at = [&](std::int32_t i) -> Vector<Dim> { return bodies_.rest()[i] + 0.5 * (q_0[i] + q_1[i]); };
    Middle middle{Vector<Dim>::Zero(), Matrix<Dim>::Zero(), AxialVector<Dim>::Zero()};
    double mass = 0.0;
    for (std::int32_t i = begin; i < end; ++i) {
        mass += bodies_.masses()[i];
        middle.centre += bodies_.masses()[i] * at(i);
    }
    middle.centre /= mass;
    for (std::int32_t i = begin; i < end; ++i) {
        const Vector<Dim> arm = at(i) - middle.centre;
        middle.second_moment += bodies_.masses()[i] * arm * arm.transpose();
        middle.angular += bodies_.masses()[i] * moment<Dim>(arm, Vector<Dim>(q_1[i] - q_0[i]));
    }
    return middle;
}

/// Forces m alpha × x' that have this moment, x' being arms about the centre in the middle of the step. Their work [J].
template <int Dim>
double PointLoads<Dim>::add_moment(const BodyMoment<Dim>& law, const AxialVector<Dim>& spin, const Middle& middle,
                                   std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                                   std::span<Vector<Dim>> force) const {
    const Matrix<Dim> turning =
        hat<Dim>(spin_of<Dim>(middle.second_moment, AxialVector<Dim>(law.moment - law.damping * spin)));
    const auto [begin, end] = bodies_.points_of(law.body);
    double work = 0.0;
    for (std::int32_t i = begin; i < end; ++i) {
        const Vector<Dim> arm = bodies_.rest()[i] + 0.5 * (q_0[i] + q_1[i]) - middle.centre;
        const Vector<Dim> of_point = bodies_.masses()[i] * (turning * arm);
        force[i] += of_point;
        work += of_point.dot(q_1[i] - q_0[i]);
    }
    return work;
}

template <int Dim>
void PointLoads<Dim>::add_stiffness(std::span<const Vector<Dim>> q, std::span<Vector<Dim>> product) const {
    for (const HeldSpring& spring : springs_) {
        Vector<Dim> stretch = Vector<Dim>::Zero();
        for (std::size_t i = 0; i < spring.second.points.size(); ++i)
            stretch += spring.second.weights[i] * q[spring.second.points[i]];
        for (std::size_t i = 0; i < spring.first.points.size(); ++i)
            stretch -= spring.first.weights[i] * q[spring.first.points[i]];
        spring.first.push(-spring.law.stiffness * stretch, product);
        spring.second.push(spring.law.stiffness * stretch, product);
    }
}

template class PointLoads<2>;
template class PointLoads<3>;

}  // namespace abut::solid
