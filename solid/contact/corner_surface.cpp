#include "abut/solid/contact/corner_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/solid/contact/solid_friction.hpp"

namespace abut::solid {

template <int Dim>
CornerSurface<Dim>::CornerSurface(const Bodies<Dim>& bodies, Ccg<Dim>& ccg, const BodyFrames<Dim>& frames,
                                  const Obstacles<Dim>& obstacles, const RankPart<Dim>& part)
    : bodies_(bodies),
      mesh_(bodies.deformable()),
      ccg_(ccg),
      frames_(frames),
      obstacles_(obstacles),
      part_(part),
      shared_(shared_faces(part, mesh_, ccg)),
      places_(bodies.rigid().size()),
      u_(static_cast<std::size_t>(bodies.n_cells())) {
    faces_.stiffness.assign(static_cast<std::size_t>(mesh_.n_bodies()) + bodies.rigid().size(), 0.0);
    append_deformable();
    append_rigid();
    for (double& of_body : faces_.stiffness)
        if (of_body == 0.0) of_body = 1.0;  // all faces are held
    append_obstacles();
}

template <int Dim>
void CornerSurface<Dim>::add_face(std::span<const Vector<Dim>> corners, double depth, std::int32_t body, double stiffness) {
    std::vector<std::int32_t> nodes;
    for (const Vector<Dim>& corner : corners) {
        nodes.push_back(static_cast<std::int32_t>(rest_.size()));
        rest_.push_back(corner);
        face_of_.push_back(static_cast<std::int32_t>(faces_.body.size()));
    }
    faces_.append_face(nodes, depth, body);
    corner_offsets_.push_back(static_cast<std::int32_t>(rest_.size()));
    stiffness_.push_back(stiffness);
    if (!std::isfinite(stiffness)) return;  // it alone is rigid, not its body
    double& of_body = faces_.stiffness[static_cast<std::size_t>(body)];
    of_body = std::max(of_body, stiffness);
}

template <int Dim>
void CornerSurface<Dim>::append_face(const mesh::Mesh<Dim>& mesh, std::int32_t face, double depth, std::int32_t body,
                                     double stiffness) {
    std::vector<Vector<Dim>> corners;
    for (const std::int32_t v : mesh.face_vertices[face]) corners.push_back(mesh.vertices[v]);
    add_face(corners, depth, body, stiffness);
}

template <int Dim>
void CornerSurface<Dim>::append_row(BoundaryFace b, std::size_t body) {
    const std::int32_t face = mesh_face(mesh_, b);
    std::vector<CornerWeights> corners;
    for (const std::int32_t v : mesh_.face_vertices[face])
        corners.push_back(ccg_.corner_weights(b, mesh_.vertices[v] - mesh_.face_centroid[face]));
    rows_.append_face(cell_of(mesh_, b), body, corners);
}

template <int Dim>
void CornerSurface<Dim>::append_deformable() {
    const std::vector<BoundaryFace> in_mesh = bodies_.boundary_in_mesh();
    for (std::size_t i = 0; i < shared_->size(); ++i) {
        const auto face = shared_->rest(i);
        add_face(face.corners, face.depth, face.body, face.stiffness);
        const BoundaryFace here = shared_->here()[i];
        boundary_.push_back(here);
        mesh_boundary_.push_back(here == no_face ? no_face : in_mesh[static_cast<std::size_t>(here)]);
        row_of_.push_back(shared_->is_own(i) ? static_cast<std::int32_t>(rows_.size()) : -1);
        if (!shared_->is_own(i)) continue;
        append_row(here, static_cast<std::size_t>(face.body));
    }
}

template <int Dim>
void CornerSurface<Dim>::append_rigid() {
    const mesh::Mesh<Dim>& mesh = bodies_.mesh();
    const RigidBodies<Dim>& rigid = bodies_.rigid();
    const std::int32_t others = part_.n_all_cells() - bodies_.n_cells();  // from here to all points
    for (std::size_t i = 0; i < rigid.size(); ++i) {
        rigid_points_.emplace_back(RigidBodies<Dim>::points_per_body);
        std::iota(rigid_points_.back().begin(), rigid_points_.back().end(), rigid.first_point(i) + others);
        for (const BoundaryFace b : boundary_faces(mesh)) {
            const std::int32_t cell = cell_of(mesh, b), face = mesh_face(mesh, b);
            if (mesh.cell_body[cell] != rigid.mesh_body(i)) continue;
            append_face(mesh, face, cell_depth(mesh, face), mesh_.n_bodies() + static_cast<std::int32_t>(i),
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
    if (!bodies_.deformable_options().has_friction()) return contact::NodalSurface<Dim>(rest_, view);
    const auto ratio_of = [&](std::int32_t body) {
        return static_cast<std::size_t>(body) < faces_.stiffness.size() - obstacles_.size()
                   ? bodies_.material_of_contact_body(body).shear_ratio()
                   : 1.0;  // of infinity
    };
    std::vector<double> of_bodies, of_faces;
    for (std::size_t body = 0; body < faces_.stiffness.size(); ++body)
        of_bodies.push_back(ratio_of(static_cast<std::int32_t>(body)) * faces_.stiffness[body]);
    for (std::size_t face = 0; face < stiffness_.size(); ++face)
        of_faces.push_back(ratio_of(faces_.body[face]) * stiffness_[face]);
    view.shear_stiffness = of_bodies;
    view.face_shear_stiffness = of_faces;
    return contact::NodalSurface<Dim>(rest_, view);
}

template <int Dim>
std::vector<std::int32_t> CornerSurface<Dim>::bodies_of_faces() const {
    std::vector<std::int32_t> bodies;
    for (const std::int32_t body : faces_.body) bodies.push_back(bodies_.mesh_body(body));
    return bodies;
}

template <int Dim>
std::vector<bool> CornerSurface<Dim>::faces_in_group(std::size_t group) const {
    return solid::faces_in_group(bodies_.mesh(), group, *shared_, mesh_boundary_, faces_.body.size());
}

template <int Dim>
std::span<const std::int32_t> CornerSurface<Dim>::points_of(contact::Face face) const {
    const auto i = static_cast<std::size_t>(face);
    if (is_obstacle(i) || std::isinf(stiffness_[i])) return {};
    if (!is_deformable(i)) return rigid_points_[rigid_of(i)];
    return shared_->cells_of(i);
}

template <int Dim>
std::vector<dynamics::Hold<Dim>> CornerSurface<Dim>::holds_of(std::int32_t point) const {
    return shared_->holds_of(point);
}

template <int Dim>
Vector<Dim> CornerSurface<Dim>::rest_centroid(contact::Face face) const {
    return shared_->centroid(static_cast<std::size_t>(face));
}

template <int Dim>
Vector<Dim> CornerSurface<Dim>::middle(contact::Face face, const Points& x) const {
    const auto i = static_cast<std::size_t>(face);
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (std::int32_t n = corner_offsets_[i]; n < corner_offsets_[i + 1]; ++n) sum += x[n];
    return sum / (corner_offsets_[i + 1] - corner_offsets_[i]);
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
    std::vector<BoundaryFace> own;
    for (const std::int32_t face : listed.faces) {
        for (std::int32_t n = corner_offsets_[face]; n < corner_offsets_[face + 1]; ++n) listed.nodes.push_back(n);
        const BoundaryFace b = boundary_[face];
        if (b == no_face) continue;
        listed.here.push_back(face);
        listed.boundary.push_back(b);
        if (!shared_->is_own(static_cast<std::size_t>(face))) continue;
        listed.own.push_back(face);
        own.push_back(b);
    }
    const std::vector<std::size_t> faces(listed.faces.begin(), listed.faces.end());
    for (const std::size_t i : shared_->as_brought(faces))
        for (std::int32_t n = corner_offsets_[faces[i]]; n < corner_offsets_[faces[i] + 1]; ++n)
            listed.gathered.push_back(n);
    listed.nodes.insert(listed.nodes.end(), listed.rigid.begin(), listed.rigid.end());
    listed.nodes.insert(listed.nodes.end(), listed.obstacles.begin(), listed.obstacles.end());
    listed.region = ccg_.region_of_tilted_faces(own);
    return listed;
}

template <int Dim>
typename CornerSurface<Dim>::Listed CornerSurface<Dim>::list_all() const {
    std::vector<std::int32_t> nodes(rest_.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    return list(nodes);
}

template <int Dim>
void CornerSurface<Dim>::place_deformable(std::span<const std::int32_t> faces, const Region<Dim>& region,
                                          std::span<const Vector<Dim>> q, std::span<const BodyFrame<Dim>> frames,
                                          const BoundaryLoad<Dim>& load, Points& x, StepState state) {
    displacement_.resize(faces.size());
    tilt_.resize(faces.size());
    if (frames_.any()) frames_.displacement(region.input_cells, q, frames, u_);
    const std::span<const Vector<Dim>> u = frames_.any() ? u_ : q.first(u_.size());
    ccg_.evaluate_tilted_faces(region, u, load, displacement_, tilt_, state);
    parallel_each(
        std::ssize(faces),
        [&](std::ptrdiff_t i) {
            const std::int32_t face = faces[i];
            const std::size_t body = body_of(static_cast<std::size_t>(face));
            const Vector<Dim> arm = displacement_[i] - frames_.rest_centre(body), centroid = ccg_.centroid(boundary_[face]);
            for (std::int32_t n = corner_offsets_[face]; n < corner_offsets_[face + 1]; ++n)
                x[n] = frames[body](rest_[n] + arm + free_part(boundary_[face], tilt_[i] * (rest_[n] - centroid)));
        },
        256);
}

template <int Dim>
void CornerSurface<Dim>::place_own(std::span<const std::int32_t> faces, std::span<const Vector<Dim>> q,
                                   std::span<const BodyFrame<Dim>> frames, const BoundaryLoad<Dim>& load, Points& x,
                                   StepState state) {
    std::vector<BoundaryFace> own;
    for (const std::int32_t face : faces) own.push_back(boundary_[face]);
    place_deformable(faces, ccg_.region_of_tilted_faces(own), q, frames, load, x, state);
}

template <int Dim>
void CornerSurface<Dim>::place(const Listed& listed, std::span<const Vector<Dim>> q, std::span<const BodyFrame<Dim>> frames,
                               const BoundaryLoad<Dim>& load, double time, Points& x, StepState state) {
    place_deformable(listed.own, listed.region, q, frames, load, x, state);
    gather_nodes(listed, x);
    place_rigid(q);
    place_given(listed, time, x);
}

template <int Dim>
void CornerSurface<Dim>::place_given(const Listed& listed, double time, Points& x) const {
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
void CornerSurface<Dim>::begin(CornerMotion<Dim>& motion, const Listed& listed, std::span<const Vector<Dim>> q,
                               std::span<const BodyFrame<Dim>> frames, const Points& x) const {
    std::vector<std::int32_t> rows;
    std::vector<double> radius;
    for (const std::int32_t face : listed.own) {
        rows.push_back(row_of_[static_cast<std::size_t>(face)]);
        const std::int32_t cell = rows_[rows.back()].cell;
        const Vector<Dim> point = bodies_.rest()[cell] + q[cell];
        double largest = 0.0;
        for (std::int32_t n = corner_offsets_[face]; n < corner_offsets_[face + 1]; ++n)
            largest = std::max(largest, (x[n] - point).norm());
        radius.push_back(largest);
    }
    motion.begin(std::move(rows), std::move(radius), q, frames);
}

template <int Dim>
double CornerSurface<Dim>::motion(std::int32_t face, const Points& from, const Points& to) const {
    double farthest = 0.0;
    for (std::int32_t n = corner_offsets_[face]; n < corner_offsets_[face + 1]; ++n)
        farthest = larger(farthest, (to[n] - from[n]).squaredNorm());
    return std::sqrt(farthest);
}

/// Brings the nodes of all listed faces from where they are placed.
template <int Dim>
void CornerSurface<Dim>::gather_nodes(const Listed& listed, Points& x) {
    if (listed.gathered.empty()) return;
    own_nodes_.clear();
    for (const std::int32_t face : listed.own)
        for (std::int32_t n = corner_offsets_[face]; n < corner_offsets_[face + 1]; ++n)
            own_nodes_.insert(own_nodes_.end(), x[n].begin(), x[n].end());
    const std::vector<double> all = part_.ranks().gather(own_nodes_);
    const auto positions = as_vectors<Dim>(std::span<const double>(all));
    for (std::size_t i = 0; i < positions.size(); ++i) x[listed.gathered[i]] = positions[i];
}

template <int Dim>
void CornerSurface<Dim>::place_rigid(std::span<const Vector<Dim>> q) {
    for (std::size_t i = 0; i < places_.size(); ++i) places_[i] = bodies_.rigid().place(i, q);
}

template class CornerSurface<2>;
template class CornerSurface<3>;

}  // namespace abut::solid
