#include "abut/solid/corner_surface.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"

namespace abut::solid {

template <int Dim>
CornerSurface<Dim>::CornerSurface(const Bodies<Dim>& bodies, Ccg<Dim>& ccg, const BodyFrames<Dim>& frames,
                                  const Obstacles<Dim>& obstacles)
    : bodies_(bodies),
      mesh_(bodies.deformable()),
      ccg_(ccg),
      frames_(frames),
      obstacles_(obstacles),
      places_(bodies.rigid().size()),
      u_(static_cast<std::size_t>(bodies.n_cells())) {
    faces_.stiffness.assign(static_cast<std::size_t>(mesh_.n_bodies()) + bodies.rigid().size(), 0.0);
    append_deformable();
    append_rigid();
    for (double& of_body : faces_.stiffness)
        if (of_body == 0.0) of_body = 1.0;  // all faces are prescribed: nothing touches it
    append_obstacles();
}

template <int Dim>
void CornerSurface<Dim>::append_face(const mesh::Mesh<Dim>& mesh, std::int32_t face, std::int32_t body, double stiffness) {
    std::vector<std::int32_t> corners;
    for (const std::int32_t v : mesh.face_vertices[face]) {
        corners.push_back(static_cast<std::int32_t>(rest_.size()));
        rest_.push_back(mesh.vertices[v]);
        face_of_.push_back(static_cast<std::int32_t>(faces_.body.size()));
    }
    faces_.append_face(corners, cell_depth(mesh, face), body);
    corner_offsets_.push_back(static_cast<std::int32_t>(rest_.size()));
    stiffness_.push_back(stiffness);
    double& of_body = faces_.stiffness[static_cast<std::size_t>(body)];
    of_body = std::max(of_body, stiffness);
}

template <int Dim>
void CornerSurface<Dim>::append_deformable() {
    const auto prescribed = ccg_.prescribed();
    std::vector<BoundaryFace> in_mesh;  // of the boundary faces of bodies that deform
    for (const BoundaryFace b : boundary_faces(bodies_.mesh()))
        if (!bodies_.is_rigid(bodies_.mesh().cell_body[cell_of(bodies_.mesh(), b)])) in_mesh.push_back(b);
    for (const BoundaryFace b : ccg_.boundary_faces()) {
        if (!prescribed[b].isZero(0.0)) {
            ++faces_left_out_;
            continue;
        }
        const std::int32_t face = mesh_face(mesh_, b);
        double& amplification = amplification_.emplace_back(0.0);
        for (const std::int32_t v : mesh_.face_vertices[face])
            amplification = std::max(
                amplification, ccg_.corner_amplification(b, Vector<Dim>(mesh_.vertices[v] - mesh_.face_centroid[face])));
        append_face(mesh_, face, static_cast<std::int32_t>(body_of(b)), ccg_.normal_stiffness(b));
        boundary_.push_back(b);
        mesh_boundary_.push_back(in_mesh[static_cast<std::size_t>(b)]);
    }
}

template <int Dim>
void CornerSurface<Dim>::append_rigid() {
    const mesh::Mesh<Dim>& mesh = bodies_.mesh();
    const RigidBodies<Dim>& rigid = bodies_.rigid();
    for (std::size_t i = 0; i < rigid.size(); ++i) {
        rigid_points_.emplace_back(RigidBodies<Dim>::points_per_body);
        std::iota(rigid_points_.back().begin(), rigid_points_.back().end(), rigid.first_point(i));
        for (const BoundaryFace b : boundary_faces(mesh)) {
            const std::int32_t cell = cell_of(mesh, b), face = mesh_face(mesh, b);
            if (mesh.cell_body[cell] != rigid.mesh_body(i)) continue;
            append_face(mesh, face, mesh_.n_bodies() + static_cast<std::int32_t>(i),
                        bodies_.rigid_skin(i) * mesh.face_measure[face] / mesh.cell_measure[cell]);
            rigid_of_.push_back(i);
            mesh_boundary_.push_back(b);
        }
    }
}

template <int Dim>
void CornerSurface<Dim>::append_obstacles() {
    for (std::size_t i = 0; i < obstacles_.size(); ++i) {
        faces_.append_obstacle(obstacles_[i], rest_);
        obstacle_of_.resize(rest_.size() - face_of_.size(), i);
    }
    stiffness_.resize(faces_.body.size(), std::numeric_limits<double>::infinity());
}

template <int Dim>
contact::NodalSurface<Dim> CornerSurface<Dim>::for_contact() const {
    contact::NodalFaces<Dim> view = faces_.view();
    view.face_stiffness = stiffness_;
    return contact::NodalSurface<Dim>(rest_, view);
}

template <int Dim>
std::span<const std::int32_t> CornerSurface<Dim>::points_of(contact::SurfaceFace face) const {
    const auto i = static_cast<std::size_t>(face);
    if (is_obstacle(i)) return {};
    if (is_deformable(i)) return ccg_.cells_of(boundary_[i]);
    return rigid_points_[rigid_of(i)];
}

template <int Dim>
Vector<Dim> CornerSurface<Dim>::middle(contact::SurfaceFace face, const Points& x) const {
    const auto i = static_cast<std::size_t>(face);
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (std::int32_t n = corner_offsets_[i]; n < corner_offsets_[i + 1]; ++n) sum += x[n];
    return sum / (corner_offsets_[i + 1] - corner_offsets_[i]);
}

template <int Dim>
double CornerSurface<Dim>::amplification(const Listed& listed) const {
    double largest = 0.0;
    for (const std::int32_t face : listed.faces) largest = std::max(largest, amplification_[static_cast<std::size_t>(face)]);
    return largest;
}

// Where they are -----------------------------------------------------------------------------------------------------

template <int Dim>
typename CornerSurface<Dim>::Listed CornerSurface<Dim>::list(std::span<const std::int32_t> nodes) const {
    Listed listed;
    for (const std::int32_t node : nodes)
        if (is_of_obstacle(node))
            listed.obstacles.push_back(node);
        else if (is_deformable(face_of(node)))
            listed.faces.push_back(face_of_[node]);
        else
            listed.rigid.push_back(node);
    sort_unique(listed.faces);
    for (const std::int32_t face : listed.faces) {
        listed.boundary.push_back(boundary_[face]);
        for (std::int32_t n = corner_offsets_[face]; n < corner_offsets_[face + 1]; ++n) listed.nodes.push_back(n);
    }
    listed.nodes.insert(listed.nodes.end(), listed.rigid.begin(), listed.rigid.end());
    listed.nodes.insert(listed.nodes.end(), listed.obstacles.begin(), listed.obstacles.end());
    listed.region = ccg_.region_of_tilted_faces(listed.boundary);
    return listed;
}

template <int Dim>
typename CornerSurface<Dim>::Listed CornerSurface<Dim>::list_all() const {
    std::vector<std::int32_t> nodes(rest_.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    return list(nodes);
}

template <int Dim>
void CornerSurface<Dim>::place(const Listed& listed, std::span<const Vector<Dim>> q, std::span<const BodyFrame<Dim>> frames,
                               const BoundaryLoad<Dim>& load, double time, Points& x) {
    displacement_.resize(listed.faces.size());
    tilt_.resize(listed.faces.size());
    frames_.displacement(listed.region.input_cells, q, frames, u_);
    ccg_.evaluate_tilted_faces(listed.region, u_, load, displacement_, tilt_);
    parallel_each(
        std::ssize(listed.faces),
        [&](std::ptrdiff_t i) {
            const BoundaryFace b = listed.boundary[i];
            const std::size_t body = body_of(b);
            const Vector<Dim> arm = displacement_[i] - frames_.rest_centre(body);
            for (std::int32_t n = corner_offsets_[listed.faces[i]]; n < corner_offsets_[listed.faces[i] + 1]; ++n)
                x[n] = frames[body](rest_[n] + arm + tilt_[i] * (rest_[n] - ccg_.centroid(b)));
        },
        256);
    place_rigid(q);
    for (const std::int32_t n : listed.rigid) {
        const std::size_t body = rigid_of(face_of(n));
        x[n] = places_[body](rest_[n] - bodies_.rigid().rest_centre(body));
    }
    std::size_t obstacle = obstacles_.size();  // none yet
    contact::Placement<Dim> placement;
    for (const std::int32_t n : listed.obstacles) {
        if (const std::size_t of_node = obstacle_of(n); of_node != obstacle) {
            obstacle = of_node;
            placement = obstacles_.placement(obstacle, time);
        }
        x[n] = placement(rest_[n]);
    }
}

template <int Dim>
void CornerSurface<Dim>::place_rigid(std::span<const Vector<Dim>> q) {
    for (std::size_t i = 0; i < places_.size(); ++i) places_[i] = bodies_.rigid().place(i, q);
}

template class CornerSurface<2>;
template class CornerSurface<3>;

}  // namespace abut::solid
