#include "abut/run/files/picture_marks.hpp"

#include <algorithm>
#include <limits>

#include "abut/base/index.hpp"
#include "abut/run/body_names.hpp"
#include "abut/run/files/snapshot.hpp"
#include "abut/run/scene.hpp"

namespace abut::run {
namespace {

using Position = PictureMarks::Position;

constexpr std::size_t most_arrows = 12;  // of one condition
constexpr std::size_t most_in_all = 48;  // a pressure is a condition for each of its faces

Vector<3> as_vector(const Position& x) { return {x[0], x[1], x[2]}; }

/// Axes that go with a face: along its first edge, along its normal, and across both.
Matrix<3> axes_of(std::span<const Position> corners) {
    const Vector<3> along = (as_vector(corners[1]) - as_vector(corners[0])).normalized();
    const Vector<3> up = corners.size() > 2 ? Vector<3>(as_vector(corners[2]) - as_vector(corners[0])) : Vector<3>::UnitZ();
    const Vector<3> normal = along.cross(up).normalized();
    return Matrix<3>::from_columns(along, normal, along.cross(normal));
}

/// The end of a spring by the corners of the nearest cell of its body, weighted so that it moves with them where they
/// move affinely.
template <int Dim>
PictureMarks::SpringEnd end_of(const mesh::Mesh<Dim>& mesh, const solid::Anchor<Dim>& anchor,
                               const std::function<std::int32_t(std::int32_t)>& number) {
    PictureMarks::SpringEnd end;
    std::int32_t nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        const double distance = (mesh.cell_centroid[at(cell)] - anchor.position).squaredNorm();
        if (mesh.cell_body[at(cell)] != anchor.body || distance >= (1.0 - 1e-9) * least) continue;
        nearest = cell;
        least = distance;
    }
    if (nearest < 0) {
        end.fixed = in_space<Dim>(anchor.position);
        return end;
    }
    const auto vertices = mesh.cell_vertices[nearest];
    const double share = 1.0 / static_cast<double>(vertices.size());
    Vector<Dim> middle = Vector<Dim>::Zero();
    for (const std::int32_t vertex : vertices) middle += share * mesh.vertices[at(vertex)];
    Matrix<Dim> spread = Matrix<Dim>::Zero();
    for (const std::int32_t vertex : vertices) {
        const Vector<Dim> arm = mesh.vertices[at(vertex)] - middle;
        spread += arm * arm.transpose();
    }
    const Vector<Dim> slope = spread.inverse() * (anchor.position - middle);
    for (const std::int32_t vertex : vertices)
        end.held.emplace_back(number(vertex), share + slope.dot(mesh.vertices[at(vertex)] - middle));
    return end;
}

template <int Dim>
PictureMarks::LoadedFace loaded_face(const mesh::Mesh<Dim>& mesh, const solid::TractionCondition<Dim>& condition,
                                     std::int32_t face, const std::function<std::int32_t(std::int32_t)>& number) {
    PictureMarks::LoadedFace loaded;
    for (const std::int32_t vertex : mesh.face_vertices[face]) {
        loaded.corners.push_back(number(vertex));
        loaded.at_rest.push_back(in_space<Dim>(mesh.vertices[at(vertex)]));
    }
    loaded.normal = in_space<Dim>(mesh.face_normal[at(face)]);
    loaded.follows = condition.follows;
    if (condition.history)
        loaded.traction = [history = condition.history, x = mesh.face_centroid[at(face)]](double time) {
            return in_space<Dim>(history(time, x));
        };
    else
        loaded.traction = [value = in_space<Dim>(condition.value)](double) { return value; };
    return loaded;
}

/// At most so many, equally far apart.
template <class Item>
std::vector<Item> spread(std::vector<Item> all, std::size_t most) {
    const std::size_t every = (all.size() + most - 1) / most;
    std::vector<Item> kept;
    for (std::size_t k = every / 2; k < all.size(); k += every) kept.push_back(std::move(all[k]));
    return kept;
}

template <int Dim>
Position gravity_of_all(const std::vector<Vector<Dim>>& acceleration) {
    const bool is_same = !acceleration.empty() && std::ranges::all_of(acceleration, [&](const Vector<Dim>& of_body) {
        return of_body == acceleration.front();
    });
    return is_same ? in_space<Dim>(acceleration.front()) : Position{};
}

}  // namespace

template <int Dim>
PictureMarks marks_of(const Scene<Dim>& scene, const std::function<std::int32_t(std::int32_t)>& number) {
    PictureMarks marks;
    const auto& conditions = scene.solid.boundary;
    const solid::FaceConditions<Dim> sorted = solid::sort_to_faces<Dim>(scene.mesh, conditions);
    for (std::size_t i = 0; i < conditions.traction.size(); ++i) {
        if (conditions.traction[i].from_outside) continue;  // known to whoever sets it
        for (const solid::BoundaryFace face : spread(sorted.traction[i], most_arrows))
            marks.loaded.push_back(
                loaded_face<Dim>(scene.mesh, conditions.traction[i], solid::mesh_face(scene.mesh, face), number));
    }
    marks.loaded = spread(std::move(marks.loaded), most_in_all);
    for (const solid::Spring<Dim>& spring : scene.solid.springs)
        marks.springs.push_back(
            {end_of<Dim>(scene.mesh, spring.first, number), end_of<Dim>(scene.mesh, spring.second, number)});
    marks.gravity = gravity_of_all<Dim>(scene.solid.acceleration);
    for (std::size_t i = 0; i < scene.solid.obstacles.size(); ++i) {
        marks.obstacle_names.push_back(name_of_obstacle(scene, i));
        marks.obstacle.resize(marks.obstacle.size() + scene.solid.obstacles[i].faces.size(), static_cast<std::int32_t>(i));
    }
    return marks;
}

std::vector<PictureMarks::Load> loads_at(const PictureMarks& marks, double time, std::span<const Position> positions) {
    std::vector<PictureMarks::Load> loads;
    for (const PictureMarks::LoadedFace& face : marks.loaded) {
        std::vector<Position> corners;
        Vector<3> middle = Vector<3>::Zero();
        for (const std::int32_t corner : face.corners) {
            corners.push_back(positions[at(corner)]);
            middle += as_vector(corners.back()) / static_cast<double>(face.corners.size());
        }
        const Matrix<3> turn = axes_of(corners) * axes_of(face.at_rest).transpose();
        const Vector<3> given = as_vector(face.traction(time));
        const Vector<3> traction = face.follows ? Vector<3>(turn * given) : given;
        loads.push_back({in_space<3>(middle), in_space<3>(traction), in_space<3>(turn * as_vector(face.normal))});
    }
    return loads;
}

PictureMarks::Position place_of(const PictureMarks::SpringEnd& end, std::span<const Position> positions) {
    Position place = end.fixed;
    for (const auto& [corner, weight] : end.held)
        for (std::size_t i = 0; i < 3; ++i) place[i] += weight * positions[at(corner)][i];
    return place;
}

template PictureMarks marks_of<2>(const Scene<2>&, const std::function<std::int32_t(std::int32_t)>&);
template PictureMarks marks_of<3>(const Scene<3>&, const std::function<std::int32_t(std::int32_t)>&);

}  // namespace abut::run
