#include "abut/solid/load/frame_loads.hpp"

#include <algorithm>

#include "abut/base/sort_unique.hpp"

namespace abut::solid {

template <int Dim>
FrameLoads<Dim>::FrameLoads(const Bodies<Dim>& bodies, const BodyFrames<Dim>& frames, const RankPart<Dim>& part)
    : bodies_(bodies), frames_(frames), part_(part), faces_(frames.n_bodies()), loads_(frames.n_bodies()) {
    const mesh::Mesh<Dim>& mesh = bodies.deformable();
    const auto& conditions = bodies.options().boundary.traction;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        if (bodies.traction_hold(i) != TractionHold::frames) continue;
        any_ = true;
        for (const std::int32_t face : mesh.group(conditions[i].group).faces) {
            const auto at = std::ranges::lower_bound(mesh.boundary_faces, face);
            const auto b = static_cast<BoundaryFace>(at - mesh.boundary_faces.begin());
            faces_[static_cast<std::size_t>(mesh.cell_body[mesh.face_cells[face][0]])].push_back(b);
        }
    }
    for (auto& faces : faces_) sort_unique(faces);
}

template <int Dim>
void FrameLoads<Dim>::take(const BoundaryLoad<Dim>& load) {
    const mesh::Mesh<Dim>& mesh = bodies_.deformable();
    for (std::size_t body = 0; body < loads_.size(); ++body) {
        const std::vector<BoundaryFace>& faces = faces_[body];
        const auto sum = [&](const auto& component_of) {
            return part_.fold_faces(0.0, [&](BoundaryFace b) {
                if (!std::ranges::binary_search(faces, b)) return 0.0;
                const auto i = static_cast<std::size_t>(b);
                const Vector<Dim> arm = mesh.face_centroid[mesh_face(mesh, b)] - frames_.rest_centre(body);
                return component_of(load.traction[i], moment<Dim>(arm, load.traction[i]));
            });
        };
        if (!part_.any(!faces.empty())) continue;
        Load& of_body = loads_[body];
        for (int k = 0; k < Dim; ++k)
            of_body.force[k] = sum([&](const Vector<Dim>& force, const AxialVector<Dim>&) { return force[k]; });
        for (int k = 0; k < of_body.moment.size(); ++k)
            of_body.moment[k] = sum([&](const Vector<Dim>&, const AxialVector<Dim>& moment) { return moment[k]; });
    }
}

template <int Dim>
auto FrameLoads<Dim>::turned(std::size_t body) const -> Load {
    const Matrix<Dim>& turn = frames_.step(body).mean_turn();
    Load load = loads_[body];
    load.force = turn * load.force;
    if constexpr (Dim == 3) load.moment = turn * load.moment;
    return load;
}

template <int Dim>
std::span<const BodyPush<Dim>> FrameLoads<Dim>::pushes(std::span<const BodyPush<Dim>> others) {
    if (!any_) return others;
    pushes_.assign(others.begin(), others.end());
    pushes_.resize(loads_.size());
    for (std::size_t body = 0; body < loads_.size(); ++body) {
        const Load load = turned(body);
        pushes_[body].gradient -= load.force;
        pushes_[body].moment -= 0.5 * hat<Dim>(load.moment);  // whose axial vector is that moment
    }
    return pushes_;
}

template <int Dim>
void FrameLoads<Dim>::follow() {
    work_ = 0.0;
    for (std::size_t body = 0; any_ && body < loads_.size(); ++body) {
        const Load load = turned(body);
        work_ += load.force.dot(frames_.end()[body].centre - frames_.start()[body].centre) +
                 load.moment.dot(frames_.step(body).turned());
    }
}

template class FrameLoads<2>;
template class FrameLoads<3>;

}  // namespace abut::solid
