#include "abut/solid/load/held_places.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "abut/base/decompositions.hpp"
#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::solid {
namespace {

constexpr double least_width = 1e-3;      // of a cloud of points: its least second moment over the largest
constexpr std::size_t first_choice = 32;  // cells that are sorted by distance at first
constexpr double as_far = 1.0 + 1e-9;     // distances within this differ by rounding

}  // namespace

template <>
Vector<2> area_vector<2>(std::span<const Vector<2>> corners) {
    const Vector<2> along = corners[1] - corners[0];
    return {along[1], -along[0]};
}

template <>
Vector<3> area_vector<3>(std::span<const Vector<3>> corners) {
    Vector<3> sum = Vector<3>::Zero();
    for (std::size_t i = 2; i < corners.size(); ++i)
        sum += 0.5 * moment<3>(Vector<3>(corners[i - 1] - corners[0]), Vector<3>(corners[i] - corners[0]));
    return sum;
}

/// Mass, centre and second moments of some points.
template <int Dim>
struct HeldPlaces<Dim>::Cloud {
    Cloud(const Points& points, std::span<const std::size_t> chosen) {
        const Vector<Dim> origin = points.rest[chosen.front()];
        for (const std::size_t i : chosen) {
            mass += points.mass[i];
            centre += points.mass[i] * (points.rest[i] - origin);
        }
        centre = origin + centre / mass;
        for (const std::size_t i : chosen) {
            const Vector<Dim> arm = points.rest[i] - centre;
            second_moment += points.mass[i] * arm * arm.transpose();
        }
    }
    [[nodiscard]] bool is_wide() const {
        const Vector<Dim> moments = symmetric_eigenvalues(second_moment);
        return moments[0] > least_width * moments[Dim - 1];
    }

    double mass = 0.0;
    Vector<Dim> centre = Vector<Dim>::Zero();
    Matrix<Dim> second_moment = Matrix<Dim>::Zero();
};

/// Weights that add up to 1, and with which the place moves exactly with affine motions of the points.
template <int Dim>
HeldPlace<Dim> HeldPlaces<Dim>::held_by(const Points& points, std::span<const std::size_t> chosen,
                                        const Vector<Dim>& position) const {
    const Cloud cloud(points, chosen);
    HeldPlace<Dim> place{.points = {}, .weights = {}, .rest = position};
    const Vector<Dim> slope = cloud.second_moment.inverse() * (position - cloud.centre);
    for (const std::size_t i : chosen) {
        place.points.push_back(points.number[i]);
        place.weights.push_back(points.mass[i] * (1.0 / cloud.mass + slope.dot(points.rest[i] - cloud.centre)));
    }
    return place;
}

/// The cells that are near enough, and as many of the next ones as it takes to span all directions. Of cells that are
/// as far as each other all are taken or none: rounding must not choose between them.
template <int Dim>
std::vector<std::size_t> HeldPlaces<Dim>::cells_around(const Points& points, const Anchor<Dim>& anchor) const {
    std::vector<double> distance;
    for (const Vector<Dim>& rest : points.rest) distance.push_back((rest - anchor.position).norm());
    const auto nearer = [&](std::size_t i, std::size_t j) { return std::pair(distance[i], i) < std::pair(distance[j], j); };
    std::vector<std::size_t> cells(distance.size());
    std::iota(cells.begin(), cells.end(), std::size_t{0});
    const auto n_near = static_cast<std::size_t>(
        std::ranges::count_if(distance, [&](double of_cell) { return of_cell <= as_far * anchor.radius; }));
    std::size_t sorted = 0;
    for (std::size_t n = std::max<std::size_t>(n_near, Dim + 1); n <= cells.size(); ++n) {
        if (n >= sorted && sorted < cells.size()) {
            sorted = std::min(cells.size(), std::max(first_choice, 2 * n));
            std::ranges::partial_sort(cells, cells.begin() + static_cast<std::ptrdiff_t>(sorted), nearer);
        }
        if (n < cells.size() && distance[cells[n]] <= as_far * distance[cells[n - 1]]) continue;
        const std::span<const std::size_t> nearest = std::span(cells).first(n);
        if (!Cloud(points, nearest).is_wide()) continue;
        cells.resize(n);
        std::ranges::sort(cells);
        return cells;
    }
    throw BadInput(bodies_.mesh().name + ": the centres of the cells of body '" + bodies_.mesh().body_names[anchor.body] +
                   "' lie nearly in a plane or on a line, so that nothing can be held beside it. Refine its mesh, or choose "
                   "Kinematics::rigid.");
}

template <int Dim>
HeldPlace<Dim> HeldPlaces<Dim>::of(const Anchor<Dim>& anchor) {
    if (anchor.body == ground) return {.points = {}, .weights = {}, .rest = anchor.position};
    if (anchor.body < 0 || anchor.body >= bodies_.mesh().n_bodies() || !anchor.position.allFinite() ||
        !(anchor.radius >= 0.0))
        throw BadInput(bodies_.mesh().name + ": a spring is anchored to body " + std::to_string(anchor.body) +
                       " with a radius of " + number(anchor.radius) + " m; bodies are counted from 0 to " +
                       std::to_string(bodies_.mesh().n_bodies() - 1) +
                       " (solid::ground: none), a radius is >= 0, and a position is finite.");
    const Points& points = points_of(anchor.body);
    if (!bodies_.is_rigid(anchor.body)) return held_by(points, cells_around(points, anchor), anchor.position);
    std::vector<std::size_t> all(points.number.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return held_by(points, all, anchor.position);
}

template <int Dim>
auto HeldPlaces<Dim>::points_of(std::int32_t body) -> const Points& {
    const auto found = points_.find(body);
    return found != points_.end() ? found->second : points_.emplace(body, gathered_points_of(body)).first->second;
}

template <int Dim>
auto HeldPlaces<Dim>::gathered_points_of(std::int32_t body) const -> Points {
    const auto [begin, end] = bodies_.points_of(body);
    const std::int32_t deformable = bodies_.deformable_body(body);
    Points points;
    if (deformable < 0) {
        const std::int32_t others = part_.n_all_cells() - bodies_.n_cells();  // from here to all points
        for (std::int32_t i = begin; i < end; ++i) {
            points.number.push_back(i + others);
            points.rest.push_back(bodies_.rest()[i]);
            points.mass.push_back(bodies_.masses()[i]);
        }
        return points;
    }
    std::vector<double> numbers, rest, masses;
    for (const std::int32_t c : part_.own_cells_of(static_cast<std::size_t>(deformable))) {
        numbers.push_back(part_.cell_numbers()[c]);
        rest.insert(rest.end(), bodies_.rest()[c].begin(), bodies_.rest()[c].end());
        masses.push_back(bodies_.masses()[c]);
    }
    numbers = part_.ranks().gather(numbers);
    rest = part_.ranks().gather(rest);
    masses = part_.ranks().gather(masses);
    std::vector<std::size_t> order(numbers.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return numbers[i]; });
    for (const std::size_t i : order) {
        points.number.push_back(static_cast<std::int32_t>(numbers[i]));
        points.rest.push_back(as_vectors<Dim>(std::span<const double>(rest))[i]);
        points.mass.push_back(masses[i]);
    }
    return points;
}

/// The place of a face of a body that deforms; `face` counts in the mesh of all bodies.
template <int Dim>
HeldPlace<Dim> HeldPlaces<Dim>::place_of(std::int32_t face) const {
    const mesh::Mesh<Dim>& mesh = bodies_.mesh();
    const auto in_mesh =
        static_cast<BoundaryFace>(std::ranges::lower_bound(mesh.boundary_faces, face) - mesh.boundary_faces.begin());
    const auto b = std::ranges::lower_bound(boundary_in_mesh_, in_mesh) - boundary_in_mesh_.begin();
    const BoundaryReconstruction<Dim>& boundary = ccg_.boundary();
    HeldPlace<Dim> place{.points = {}, .weights = {}, .rest = mesh.face_centroid[static_cast<std::size_t>(face)]};
    for (std::int32_t i = boundary.offsets[static_cast<std::size_t>(b)];
         i < boundary.offsets[static_cast<std::size_t>(b) + 1]; ++i) {
        place.points.push_back(static_cast<std::int32_t>(part_.cell_numbers()[boundary.cells[i]]));
        place.weights.push_back(boundary.weights[i](0, 0));
    }
    return place;
}

/// Every rank has the faces of rigid bodies; those of others come from the ranks that own their cells.
template <int Dim>
auto HeldPlaces<Dim>::faces_of(const std::string& group) -> std::vector<Face> {
    const mesh::Mesh<Dim>& mesh = bodies_.mesh();
    std::vector<Face> faces;
    std::vector<double> mine;  // key, body, area, corners, points, centroid
    for (const std::int32_t in_mesh : mesh.group(group).faces) {
        const auto f = static_cast<std::size_t>(in_mesh);
        const std::int32_t cell = mesh.face_cells[f][0], body = mesh.cell_body[cell];
        Face face{in_mesh, body, 0, mesh.face_measure[f], mesh.face_centroid[f], mesh.face_normal[f], {}, {}};
        for (const std::int32_t vertex : mesh.face_vertices[in_mesh]) face.corners.push_back(mesh.vertices[vertex]);
        if (area_vector<Dim>(face.corners).dot(face.normal) < 0.0) std::ranges::reverse(face.corners);
        if (part_.is_whole() || bodies_.is_rigid(body)) {
            face.place = bodies_.is_rigid(body) ? of({.body = body, .position = face.centroid}) : place_of(in_mesh);
            faces.push_back(std::move(face));
            continue;
        }
        const std::int32_t deformable = bodies_.deformable_cell(cell).first;
        if (!std::ranges::binary_search(part_.own_cells(), deformable)) continue;
        const auto position = std::ranges::find(mesh.cell_faces[cell], in_mesh) - mesh.cell_faces[cell].begin();
        mine.insert(mine.end(),
                    {static_cast<double>(part_.key_of(deformable, position)), static_cast<double>(body), face.area});
        face.place = place_of(in_mesh);
        mine.insert(mine.end(), {static_cast<double>(face.corners.size()), static_cast<double>(face.place.points.size())});
        for (const Vector<Dim>* vector : {&face.centroid, &face.normal})
            mine.insert(mine.end(), vector->begin(), vector->end());
        for (const Vector<Dim>& corner : face.corners) mine.insert(mine.end(), corner.begin(), corner.end());
        mine.insert(mine.end(), face.place.points.begin(), face.place.points.end());
        mine.insert(mine.end(), face.place.weights.begin(), face.place.weights.end());
    }
    const std::vector<double> all = part_.ranks().gather(mine);
    for (auto next = all.begin(); next != all.end();) {
        Face face{static_cast<std::int64_t>(next[0]), static_cast<std::int32_t>(next[1]), 0, next[2], {}, {}, {}, {}};
        face.corners.resize(static_cast<std::size_t>(next[3]));
        face.place.points.resize(static_cast<std::size_t>(next[4]));
        face.place.weights.resize(face.place.points.size());
        next += 5;
        const auto take = [&](Vector<Dim>& vector) {
            std::copy_n(next, Dim, vector.begin());
            next += Dim;
        };
        take(face.centroid);
        take(face.normal);
        for (Vector<Dim>& corner : face.corners) take(corner);
        face.place.rest = face.centroid;
        for (std::int32_t& point : face.place.points) point = static_cast<std::int32_t>(*next++);
        for (double& weight : face.place.weights) weight = *next++;
        faces.push_back(std::move(face));
    }
    std::ranges::sort(faces, {}, [](const Face& face) { return std::pair(face.body, face.key); });
    for (std::size_t i = 0; i < faces.size(); ++i) faces[i].in_group = i;  // bodies come one after the other
    return faces;
}

template class HeldPlaces<2>;
template class HeldPlaces<3>;

}  // namespace abut::solid
