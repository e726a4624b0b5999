#include "studies/nodal/case_files.hpp"

#include "abut/run/report/energy_picture.hpp"
#include "abut/run/scene.hpp"

namespace abut::studies::nodal {
namespace {

/// Mean over the corners of each cell [m/s].
template <int Dim>
std::vector<Vector<Dim>> cell_velocities(const dynamics::RunView<Dim>& run, const P1Bodies<Dim>& bodies) {
    std::vector<Vector<Dim>> velocity;
    for (std::int32_t cell = 0; cell < bodies.mesh().n_cells(); ++cell) {
        Vector<Dim> sum = Vector<Dim>::Zero();
        for (const std::int32_t node : bodies.mesh().cell_vertices[cell]) sum += run.momentum(node) / bodies.masses()[node];
        velocity.push_back(sum / (Dim + 1));
    }
    return velocity;
}

}  // namespace

template <int Dim>
CaseFiles<Dim>::CaseFiles(const std::filesystem::path& folder, const Case<Dim>& one, std::int64_t steps)
    : folder_(folder), title_(one.name), frames_(one.run.frames), steps_(steps) {
    std::filesystem::create_directories(folder);
    if (frames_ > 0) series_.emplace(folder, "bodies", one.scene.mesh);
}

template <int Dim>
void CaseFiles<Dim>::look(const dynamics::RunView<Dim>& run, P1Bodies<Dim>& bodies) {
    if (!series_ || series_->n_frames() >= frames_) return;
    const std::int64_t intervals = std::max(1, frames_ - 1);
    if (run.steps * intervals >= series_->n_frames() * steps_) write(run, bodies);
}

template <int Dim>
void CaseFiles<Dim>::write(const dynamics::RunView<Dim>& run, P1Bodies<Dim>& bodies) {
    const auto stress = bodies.stresses(run.q);
    const auto velocity = cell_velocities(run, bodies);
    const auto pressure = bodies.contact_pressure();
    mesh::Frame<Dim> frame{.time = run.time, .vertex_displacement = as_vectors<Dim>(run.q)};
    frame.cell_fields = {{"velocity [m/s]", velocity}, {"stress [Pa]", stress}};
    frame.boundary_fields = {{"contact pressure [Pa]", pressure}};
    series_->write(frame);
}

template <int Dim>
void CaseFiles<Dim>::finish(const dynamics::Ledger<Dim>& ledger, const Figures& figures) const {
    apps::Table energies{.columns = dynamics::ledger_columns<Dim>(), .rows = {}};
    for (const auto& entry : ledger.entries()) energies.rows.push_back(dynamics::ledger_values(entry));
    apps::write_csv(folder_ / "energy.csv", energies);
    if (!energies.rows.empty()) run::write_energy_picture<Dim>(folder_, title_, ledger.entries(), figures.scale);
}

template class CaseFiles<2>;
template class CaseFiles<3>;

}  // namespace abut::studies::nodal
