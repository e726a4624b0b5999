#include "abut/run/snapshots.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "abut/run/cell_velocity.hpp"
#include "abut/run/failure.hpp"
#include "abut/run/frames.hpp"
#include "abut/run/scene.hpp"

namespace abut::run {
namespace {

using Position = Snapshot::Position;

constexpr std::int64_t looks_per_run = 60;
constexpr double strain_of_rounding = 1e-9;  // far above it
constexpr double worth_another = 1.05;       // times the force of the snapshot before

template <int Dim>
Position in_space(const Vector<Dim>& x) {
    Position result{};
    for (int i = 0; i < Dim; ++i) result[static_cast<std::size_t>(i)] = x[i];
    return result;
}

/// Adds polygons, and numbers the vertices that they use.
template <int Dim>
class PolygonMaker {
public:
    PolygonMaker(const mesh::Mesh<Dim>& mesh, BodyPolygons& polygons)
        : polygons_(polygons), number_(mesh.vertices.size(), -1) {
        if constexpr (Dim == 2)
            for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
                add(mesh.cell_vertices[cell], cell);
                for (const std::int32_t face : mesh.cell_faces[cell]) polygons_.is_rim.push_back(mesh.is_boundary(face));
            }
        else
            for (const std::int32_t face : mesh.boundary_faces)
                add(mesh.face_vertices[face], mesh.face_cells[static_cast<std::size_t>(face)][0]);
    }

private:
    void add(std::span<const std::int32_t> vertices, std::int32_t cell) {
        for (const std::int32_t vertex : vertices) {
            std::int32_t& number = number_[static_cast<std::size_t>(vertex)];
            if (number < 0) {
                number = static_cast<std::int32_t>(polygons_.vertex.size());
                polygons_.vertex.push_back(vertex);
            }
            polygons_.corners.push_back(number);
        }
        polygons_.offsets.push_back(polygons_.corners.size());
        polygons_.cell.push_back(cell);
    }

    BodyPolygons& polygons_;
    std::vector<std::int32_t> number_;  // of the vertices of the mesh
};

template <int Dim>
contact::Placement<Dim> placement_of(const contact::RigidObstacle<Dim>& obstacle, double time) {
    if (obstacle.placement) return obstacle.placement(time);
    contact::Placement<Dim> placement;
    if (obstacle.path) placement.offset = obstacle.path(time);
    return placement;
}

template <int Dim>
std::vector<std::vector<Position>> faces_of_obstacles(const std::vector<contact::RigidObstacle<Dim>>& obstacles,
                                                      double time) {
    std::vector<std::vector<Position>> faces;
    for (const auto& obstacle : obstacles) {
        const contact::Placement<Dim> placement = placement_of(obstacle, time);
        for (const auto& corners : obstacle.faces) {
            auto& face = faces.emplace_back();
            for (const Vector<Dim>& corner : corners) face.push_back(in_space<Dim>(placement(corner)));
        }
    }
    return faces;
}

template <int Dim>
double normal_impulse(const solid::Solid<Dim>& solid) {
    double sum = 0.0;
    for (const solid::BodyImpulse<Dim>& pair : solid.contact_impulses()) sum += pair.normal_impulse;
    return sum;
}

std::span<const double> numbers(const std::vector<Position>& positions) {
    return positions.empty() ? std::span<const double>() : std::span(positions.front().data(), 3 * positions.size());
}

std::vector<Position> positions(const std::vector<double>& numbers) {
    std::vector<Position> result(numbers.size() / 3);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    return result;
}

void put(StateWriter& state, const std::optional<Snapshot>& snapshot) {
    state.put(static_cast<std::uint8_t>(snapshot.has_value()));
    if (!snapshot) return;
    state.put(snapshot->what);
    state.put(snapshot->time);
    state.put(snapshot->force);
    state.put_all(numbers(snapshot->position));
    state.put_all(std::span<const double>(snapshot->value));
    state.put(static_cast<std::uint64_t>(snapshot->obstacles.size()));
    for (const auto& face : snapshot->obstacles) state.put_all(numbers(face));
}

std::optional<Snapshot> get_snapshot(StateReader& state) {
    if (state.get<std::uint8_t>() == 0) return {};
    Snapshot snapshot{.what = state.get_text(), .time = state.get<double>(), .force = state.get<double>()};
    snapshot.position = positions(state.get_all<double>());
    snapshot.value = state.get_all<double>();
    for (auto n = state.get<std::uint64_t>(); n > 0; --n) snapshot.obstacles.push_back(positions(state.get_all<double>()));
    return snapshot;
}

}  // namespace

template <int Dim>
void Snapshots<Dim>::begin(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    is_rigid_.clear();
    for (std::size_t body = 0; body < scene.mesh.body_names.size(); ++body)
        is_rigid_.push_back(kinematics_of(scene, result, body) == solid::Kinematics::rigid);
    all_rigid_ = std::ranges::all_of(is_rigid_, [](char is_rigid) { return is_rigid != 0; });
    polygons_ = {.in_space = Dim == 3,
                 .value_name = all_rigid_ ? "speed" : "von Mises stress",
                 .value_unit = all_rigid_ ? "m/s" : "Pa"};
    if (!all_rigid_) {
        polygons_.least_end = std::numeric_limits<double>::infinity();
        for (std::size_t body = 0; body < is_rigid_.size(); ++body)
            if (is_rigid_[body] == 0)
                polygons_.least_end = std::min(polygons_.least_end, strain_of_rounding * scene.solid.materials[body].young);
    }
    PolygonMaker<Dim>(scene.mesh, polygons_);
    const std::int64_t interval = result.options.interval;
    every_ = interval * std::max<std::int64_t>(1, result.steps / (interval * looks_per_run));
}

template <int Dim>
void Snapshots<Dim>::record(const dynamics::LedgerEntry<Dim>& entry) {
    in_contact_ = entry.active_pairs > 0;
}

template <int Dim>
bool Snapshots<Dim>::wants_look(std::int64_t step) const {
    return step == 0 || (in_contact_ && step % every_ == 0);
}

template <int Dim>
void Snapshots<Dim>::look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    if (!wants_look(run.steps)) return;
    const double impulse = normal_impulse(solid);
    const double force = run.time > last_time_ ? (impulse - last_impulse_) / (run.time - last_time_) : 0.0;
    last_impulse_ = impulse;
    last_time_ = run.time;
    const bool is_start = run.steps == 0;
    if (!is_start && !(force > (largest_ ? worth_another * largest_->force : 0.0))) return;
    static_cast<void>(solid.potential(run.q));  // leaves the stresses of this state behind
    std::optional<Snapshot>& kept = is_start ? start_ : largest_;
    kept = taken(is_start ? "At the start" : "Near the largest contact force", run, solid);
    kept->force = force;
}

template <int Dim>
void Snapshots<Dim>::end(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    end_ = taken("At the end", run, solid);
}

template <int Dim>
void Snapshots<Dim>::fail(const Failure& failure, solid::Solid<Dim>& solid) {
    static_cast<void>(solid.potential(failure.sound.q));
    end_ = taken("The last sound state", dynamics::RunView<Dim>(failure.sound), solid);
}

template <int Dim>
Snapshot Snapshots<Dim>::taken(std::string what, const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) const {
    Snapshot snapshot{.what = std::move(what), .time = run.time};
    const std::vector<Vector<Dim>> displacement = solid.vertex_displacement(run.q);
    for (const std::int32_t vertex : polygons_.vertex) {
        const auto v = static_cast<std::size_t>(vertex);
        snapshot.position.push_back(in_space<Dim>(solid.mesh().vertices[v] + displacement[v]));
    }
    snapshot.value = values(run, solid);
    snapshot.obstacles = faces_of_obstacles<Dim>(solid.options().obstacles, run.time);
    return snapshot;
}

template <int Dim>
std::vector<double> Snapshots<Dim>::values(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) const {
    const std::vector<Vector<Dim>> velocity = all_rigid_ ? cell_velocity(run, solid) : std::vector<Vector<Dim>>();
    std::vector<double> result;
    for (const std::int32_t cell : polygons_.cell) {
        const auto body = static_cast<std::size_t>(solid.mesh().cell_body[static_cast<std::size_t>(cell)]);
        if (all_rigid_)
            result.push_back(velocity[static_cast<std::size_t>(cell)].norm());
        else if (is_rigid_[body] != 0)
            result.push_back(std::numeric_limits<double>::quiet_NaN());
        else
            result.push_back(von_mises<Dim>(solid.stress(cell), solid.options().materials[body].poisson));
    }
    return result;
}

template <int Dim>
void Snapshots<Dim>::save(StateWriter& state) const {
    state.put(last_impulse_);
    state.put(last_time_);
    put(state, start_);
    put(state, largest_);
}

template <int Dim>
void Snapshots<Dim>::resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) {
    begin(scene, result);
    last_impulse_ = state.get<double>();
    last_time_ = state.get<double>();
    start_ = get_snapshot(state);
    largest_ = get_snapshot(state);
}

template <int Dim>
BodyPictures Snapshots<Dim>::pictures() const {
    BodyPictures pictures{.polygons = polygons_, .snapshots = {}};
    for (const std::optional<Snapshot>* snapshot : {&start_, &largest_, &end_})
        if (*snapshot) pictures.snapshots.push_back(**snapshot);
    return pictures;
}

template class Snapshots<2>;
template class Snapshots<3>;

}  // namespace abut::run
