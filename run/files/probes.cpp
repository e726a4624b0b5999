#include "abut/run/files/probes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/run/files/frames.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/sight.hpp"

namespace abut::run {
namespace {

constexpr double gone = std::numeric_limits<double>::quiet_NaN();  // of a place whose cell has left

constexpr double allowed_distance = 0.5;  // of a place from its cell, over the size of that
constexpr double at_border = 1e-9;        // likewise: it is in the cell

/// In the order of the columns.
template <int Dim>
std::vector<double> components(const Matrix<Dim>& stress, double out_of_plane_stress) {
    if constexpr (Dim == 2)
        return {stress(0, 0), stress(1, 1), out_of_plane_stress, stress(0, 1)};
    else
        return {stress(0, 0), stress(1, 1), stress(2, 2), stress(1, 2), stress(0, 2), stress(0, 1)};
}

/// Distance of a point beyond the face of a convex cell that it is farthest from, < 0 inside [m].
template <int Dim>
double distance_beside(const mesh::Mesh<Dim>& mesh, std::int32_t cell, const Vector<Dim>& position) {
    double farthest = -std::numeric_limits<double>::infinity();
    for (const std::int32_t face : mesh.cell_faces[cell]) {
        const double outward = mesh.face_cells[face][0] == cell ? 1.0 : -1.0;
        farthest = std::max(farthest, outward * mesh.face_normal[face].dot(position - mesh.face_centroid[face]));
    }
    return farthest;
}

/// Forces on a body along the normals of its faces, by friction, and its velocity past what it touches.
template <int Dim>
std::array<Vector<Dim>, 3> contact_of(std::int32_t body, const std::vector<ForceRow<Dim>>& rows) {
    Vector<Dim> normal = Vector<Dim>::Zero(), friction = Vector<Dim>::Zero(), slip = Vector<Dim>::Zero();
    double rubbing_force = 0.0;
    for (const ForceRow<Dim>& row : rows) {
        if (row.body_1 == row.body_2 || (row.body_1 != body && row.body_2 != body)) continue;
        const double sign = row.body_2 == body ? 1.0 : -1.0;
        normal += sign * (row.force - row.friction);
        friction += sign * row.friction;
        slip += (sign * row.rubbing_force) * row.slip_velocity;
        rubbing_force += row.rubbing_force;
    }
    if (rubbing_force > 0.0) slip /= rubbing_force;
    return {normal, friction, slip};
}

}  // namespace

template <int Dim>
std::int32_t cell_at(const mesh::Mesh<Dim>& mesh, std::int32_t body, const Vector<Dim>& position) {
    std::int32_t nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        if (mesh.cell_body[cell] != body) continue;
        const double size = std::pow(mesh.cell_measure[cell], 1.0 / Dim);
        // A place can be beyond no face by much and still be far along it.
        const double beside =
            std::max(distance_beside(mesh, cell, position), (position - mesh.cell_centroid[cell]).norm() - 3.0 * size);
        if (beside <= at_border * size) return cell;  // the first of those that share the place: rounding does not choose
        if (beside < least) std::tie(least, nearest) = std::pair(beside, cell);
    }
    if (nearest >= 0) {
        const double allowed = allowed_distance * std::pow(mesh.cell_measure[nearest], 1.0 / Dim);
        if (least <= allowed) return nearest;
        throw BadInput(fmt::format("the place is {:.4g} m beside body '{}', {:.4g} m is allowed. Give one inside of it, at "
                                   "rest.",
                                   least, mesh.body_names[static_cast<std::size_t>(body)], allowed),
                       {.cell = nearest, .value = least, .allowed = allowed});
    }
    throw BadInput(fmt::format("body {} is none of {} bodies, counted from 0.", body, mesh.n_bodies()));
}

template <int Dim>
typename Probes<Dim>::Watched Probes<Dim>::watched(const mesh::Mesh<Dim>& mesh, const Probe<Dim>& probe) {
    if (probe.position) {
        if (probe.contact)
            throw BadInput("'contact' is of a body as a whole, and 'point' is given, too. Leave one of them out.");
        const std::int32_t cell = cell_at(mesh, probe.body, *probe.position);
        return {.cells = {cell}, .weights = {1.0}, .arms = {*probe.position - mesh.cell_centroid[cell]}};
    }
    Watched watched;
    if (probe.contact) watched.contact_of = probe.body;
    double measure = 0.0;
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        if (mesh.cell_body[cell] != probe.body) continue;
        watched.cells.push_back(cell);
        watched.weights.push_back(mesh.cell_measure[cell]);
        watched.arms.push_back(Vector<Dim>::Zero());
        measure += mesh.cell_measure[cell];
    }
    if (watched.cells.empty())
        throw BadInput(fmt::format("body {} is none of {} bodies, counted from 0.", probe.body, mesh.n_bodies()));
    for (double& weight : watched.weights) weight /= measure;
    return watched;
}

template <int Dim>
Probes<Dim>::Probes(const Scene<Dim>& scene, const RunResult<Dim>& result)
    : forces_(scene, result),
      interval_(scene.outputs.interval > 0 ? scene.outputs.interval : result.options.interval),
      n_steps_(result.run.steps) {
    for (const Probe<Dim>& probe : scene.outputs.probes) {
        try {
            probes_.push_back(watched(scene.mesh, probe));
        } catch (const BadInput& error) {
            throw BadInput(fmt::format("probe '{}': {}", probe.name, error.what()));
        }
    }
    at_start_ = probes_;
}

template <int Dim>
void Probes<Dim>::take_cells(std::span<const std::int32_t> first_cells) {
    for (std::size_t p = 0; p < probes_.size(); ++p) {
        const Watched& all = at_start_[p];
        Watched& left = probes_[p];
        left = {.contact_of = all.contact_of};
        double sum = 0.0;
        for (std::size_t i = 0; i < all.cells.size(); ++i) {
            const auto now = std::ranges::lower_bound(first_cells, all.cells[i]);
            if (now == first_cells.end() || *now != all.cells[i]) continue;
            left.cells.push_back(static_cast<std::int32_t>(now - first_cells.begin()));
            left.weights.push_back(all.weights[i]);
            left.arms.push_back(all.arms[i]);
            sum += all.weights[i];
        }
        for (double& weight : left.weights) weight /= sum;
    }
}

template <int Dim>
std::vector<std::string> Probes<Dim>::columns(const Probe<Dim>& probe) {
    std::vector<std::string> columns;
    for (const char* vector : {"displacement", "velocity"})
        for (int i = 0; i < Dim; ++i) columns.push_back(fmt::format("{}_{}", vector, "xyz"[i]));
    for (const char* component : {"xx", "yy", "zz", "yz", "xz", "xy"})
        if (Dim == 3 || (std::string(component) != "yz" && std::string(component) != "xz"))
            columns.push_back(fmt::format("stress_{}", component));
    columns.push_back("von_mises");
    if (probe.contact)
        for (const char* vector : {"contact_normal", "friction", "slip_velocity"})
            for (int i = 0; i < Dim; ++i) columns.push_back(fmt::format("{}_{}", vector, "xyz"[i]));
    return columns;
}

template <int Dim>
bool Probes<Dim>::wants_look(std::int64_t step) const {
    return step % interval_ == 0 || step == n_steps_;
}

template <int Dim>
std::vector<std::vector<double>> Probes<Dim>::values(const Sight<Dim>& sight) {
    const std::vector<ForceRow<Dim>> forces = forces_.rows(sight.moment);
    std::vector<std::vector<double>> rows;
    for (const Watched& probe : probes_) {
        Vector<Dim> u = Vector<Dim>::Zero(), v = Vector<Dim>::Zero();
        Matrix<Dim> stress = Matrix<Dim>::Zero();
        double out_of_plane = 0.0;
        if (probe.cells.empty()) {
            u = v = Vector<Dim>::Constant(gone);
            stress = Matrix<Dim>::Constant(gone);
            out_of_plane = gone;
        }
        for (std::size_t i = 0; i < probe.cells.size(); ++i) {
            const auto cell = static_cast<std::size_t>(probe.cells[i]);
            const double weight = probe.weights[i];
            u += weight * (sight.displacement[cell] + sight.displacement_gradient[cell] * probe.arms[i]);
            v += weight * sight.velocity[cell];
            stress += weight * sight.stress[cell];
            out_of_plane += weight * sight.out_of_plane_stress[cell];
        }
        std::vector<double> values(u.begin(), u.end());
        values.insert(values.end(), v.begin(), v.end());
        for (const double value : components<Dim>(stress, out_of_plane)) values.push_back(value);
        values.push_back(von_mises<Dim>(stress, out_of_plane));
        if (probe.contact_of >= 0)
            for (const Vector<Dim>& vector : contact_of<Dim>(probe.contact_of, forces))
                values.insert(values.end(), vector.begin(), vector.end());
        rows.push_back(std::move(values));
    }
    return rows;
}

#define ABUT_INSTANTIATE(Dim)   \
    template class Probes<Dim>; \
    template std::int32_t cell_at<Dim>(const mesh::Mesh<Dim>&, std::int32_t, const Vector<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
