#include "abut/solid/load/loads.hpp"

#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/solid/part/state_of_vectors.hpp"

namespace abut::solid {
namespace {

template <int Dim>
std::vector<Vector<Dim>> body_forces(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options,
                                     std::span<const double> masses) {
    std::vector<Vector<Dim>> forces;
    if (options.acceleration.empty() && !options.body_load) return forces;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        Vector<Dim> force = Vector<Dim>::Zero();
        if (!options.acceleration.empty()) force += masses[c] * options.acceleration[mesh.cell_body[c]];
        if (options.body_load) force += mesh.cell_measure[c] * options.body_load(mesh.cell_centroid[c]);
        if (!force.allFinite())
            throw BadInput(mesh.name + ": the force on cell " + std::to_string(mesh.cell_label[c]) +
                               " is not finite. Correct SolidOptions::body_load.",
                           {.cell = c});
        forces.push_back(force);
    }
    return forces;
}

}  // namespace

template <int Dim>
Loads<Dim>::Loads(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, std::span<const double> masses,
                  const Ccg<Dim>& ccg, const RankPart<Dim>& part)
    : mesh_(mesh),
      ccg_(ccg),
      part_(part),
      has_conditions_(!options.boundary.dirichlet.empty() || !options.boundary.traction.empty() ||
                      !options.temperature_rise.empty()),
      has_body_force_(!options.acceleration.empty() || options.body_load),
      body_force_(body_forces(mesh, options, masses)),
      start_(ccg.load_at(0.0, 0.0)),
      end_(start_) {}

template <int Dim>
BoundaryLoad<Dim> Loads<Dim>::mean() const {
    BoundaryLoad<Dim> mean = end_;
    for (std::size_t b = 0; b < mean.displacement.size(); ++b)
        mean.displacement[b] = 0.5 * (start_.displacement[b] + end_.displacement[b]);
    return mean;
}

template <int Dim>
bool Loads<Dim>::begin_step(double time, double dt, bool apart, const std::function<double()>& potential,
                            const std::function<void(Jump)>& follow_jump, const std::function<void(Jump, double)>& book) {
    auto [changed, next] =
        dynamics::agreed(part_.ranks(), [&] { return std::pair(ccg_.load_at(time, time), ccg_.load_at(time + dt, time)); });
    is_half_done_ = true;
    start_ = end_;
    traction_time_ = time;
    const bool pulls = part_.any(changed.traction != end_.traction),
               heats = part_.any(changed.temperature != end_.temperature);
    if (pulls || heats) {
        double before = potential();
        const auto jump = [&](BoundaryLoad<Dim> to, Jump what) {
            end_ = std::move(to);
            follow_jump(what);
            const double after = potential();
            book(what, after - before);
            before = after;
            start_ = end_;
        };
        if (pulls && heats && apart) jump(with_old_tractions(changed), Jump::temperatures);
        jump(std::move(changed), pulls ? Jump::tractions : Jump::temperatures);
    }
    end_ = std::move(next);
    return pulls || heats;
}

/// What faces give way by is linear in the tractions, and heat moves them beside that.
template <int Dim>
BoundaryLoad<Dim> Loads<Dim>::with_old_tractions(const BoundaryLoad<Dim>& changed) const {
    const BoundaryReconstruction<Dim>& boundary = ccg_.boundary();
    BoundaryLoad<Dim> load = changed;
    load.traction = end_.traction;
    for (const BoundaryFace b : ccg_.boundary_faces())
        for (std::int32_t i = boundary.load_offsets[number_of(b)]; i < boundary.load_offsets[number_of(b) + 1]; ++i) {
            const BoundaryFace face = boundary.load_faces[i];
            const auto f = static_cast<std::size_t>(number_of(face));
            load.displacement[static_cast<std::size_t>(number_of(b))] += boundary.from_traction[i] *
                                                                         (end_.traction[f] - changed.traction[f]) /
                                                                         mesh_.face_measure[mesh_face(mesh_, face)];
        }
    return load;
}

template <int Dim>
void Loads<Dim>::add_work(double share, double& work) const {
    if (!vary()) return;
    work = part_.fold_faces(work, [&](BoundaryFace face) {
        const auto b = static_cast<std::size_t>(face);
        return share * ccg_.boundary_gradient(face).dot(end_.displacement[b] - start_.displacement[b]);
    });
}

template <int Dim>
double Loads<Dim>::body_work(std::span<const Vector<Dim>> u) const {
    if (!has_body_force_) return 0.0;
    return part_.sum_of_cells([&](std::ptrdiff_t c) { return body_force_[c].dot(u[c]); });
}

template <int Dim>
void Loads<Dim>::to_force(std::span<Vector<Dim>> gradient) const {
    const bool has_body_force = !body_force_.empty();
    parallel_each(static_cast<std::ptrdiff_t>(gradient.size()), [&](std::ptrdiff_t c) {
        gradient[c] = has_body_force ? Vector<Dim>(body_force_[c] - gradient[c]) : Vector<Dim>(-gradient[c]);
    });
}

template <int Dim>
void Loads<Dim>::add_impulse(std::span<const std::int32_t> cells, std::span<const Vector<Dim>> gradient, double dt,
                             std::span<Vector<Dim>> impulse) const {
    const bool has_body_force = !body_force_.empty();
    parallel_each(static_cast<std::ptrdiff_t>(cells.size()), [&](std::ptrdiff_t i) {
        const std::int32_t c = cells[i];
        if (has_body_force) impulse[c] += dt * body_force_[c];
        impulse[c] -= dt * gradient[i];
    });
}

template <int Dim>
void Loads<Dim>::save(StateWriter& state) const {
    if (!has_conditions_) {
        put_all<Dim>(state, end_.displacement);
        put_all<Dim>(state, end_.traction);
    } else {
        put_all<Dim>(state, part_.gather_faces(end_.displacement));
        put_all<Dim>(state, part_.gather_faces(end_.traction));
    }
    if (ccg_.is_warm()) state.put(traction_time_);
}

template <int Dim>
void Loads<Dim>::restore(StateReader& state) {
    if (!has_conditions_) {
        take_all<Dim>(state, end_.displacement);
        take_all<Dim>(state, end_.traction);
    } else {
        std::vector<Vector<Dim>> of_all(part_.n_all_faces());
        take_all<Dim>(state, of_all);
        end_.displacement = part_.faces_here(mesh_, of_all);
        take_all<Dim>(state, of_all);
        end_.traction = part_.faces_here(mesh_, of_all);
    }
    if (ccg_.is_warm()) {
        traction_time_ = state.get<double>();
        end_.temperature =
            dynamics::agreed(part_.ranks(), [&] { return ccg_.load_at(traction_time_, traction_time_).temperature; });
    }
    start_ = end_;
}

template <int Dim>
void Loads<Dim>::take_over(const Loads& before, std::span<const std::int32_t> old_boundary, double time) {
    if (ccg_.is_warm() != before.ccg_.is_warm())
        throw BadInput(mesh_.name +
                       ": bodies are warm before the change or after it, not both (temperature_rise). Keep it.");
    traction_time_ = before.traction_time_;
    end_ = ccg_.load_at(time, ccg_.is_warm() ? traction_time_ : time);
    const auto take = [&](const std::vector<Vector<Dim>>& old, std::vector<Vector<Dim>>& now) {
        if (old.empty()) return;
        for (std::size_t b = 0; b < now.size(); ++b)
            if (old_boundary[b] >= 0) now[b] = old[static_cast<std::size_t>(old_boundary[b])];
    };
    take(before.end_.displacement, end_.displacement);
    take(before.end_.traction, end_.traction);
    start_ = end_;
}

template class Loads<2>;
template class Loads<3>;

}  // namespace abut::solid
