#include "studies/nodal/impact_files.hpp"

#include "abut/run/energy_picture.hpp"
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
ImpactFiles<Dim>::ImpactFiles(const ImpactOptions& options, const Impact<Dim>& impact, std::int64_t steps)
    : options_(options), title_(impact.name), steps_(steps) {
    energies_.columns = dynamics::ledger_columns<Dim>();
    if constexpr (Dim == 2)
        energies_.columns.emplace_back("pseudo_angular_momentum");
    else
        for (const char* axis : {"x", "y", "z"}) energies_.columns.push_back(std::string("pseudo_angular_momentum_") + axis);
    std::filesystem::create_directories(options.out);
    if (options.frames > 0) series_.emplace(options.out, "bodies", impact.scene.mesh);
}

template <int Dim>
void ImpactFiles<Dim>::record(const dynamics::LedgerEntry<Dim>& entry, const AxialVector<Dim>& turning_momentum) {
    std::vector<double> row = dynamics::ledger_values(entry);
    row.insert(row.end(), turning_momentum.data(), turning_momentum.data() + turning_momentum.size());
    energies_.rows.push_back(std::move(row));
    entries_.push_back(entry);
}

template <int Dim>
void ImpactFiles<Dim>::look(const dynamics::RunView<Dim>& run, P1Bodies<Dim>& bodies) {
    if (!series_ || series_->n_frames() >= options_.frames) return;
    const std::int64_t intervals = std::max(1, options_.frames - 1);
    if (run.steps * intervals >= series_->n_frames() * steps_) write(run, bodies);
}

template <int Dim>
void ImpactFiles<Dim>::write(const dynamics::RunView<Dim>& run, P1Bodies<Dim>& bodies) {
    const auto stress = bodies.stresses(run.q);
    const auto velocity = cell_velocities(run, bodies);
    const auto pressure = bodies.contact_pressure();
    mesh::Frame<Dim> frame{.time = run.time, .vertex_displacement = as_vectors<Dim>(run.q)};
    frame.cell_fields = {{"velocity [m/s]", velocity}, {"stress [Pa]", stress}};
    frame.boundary_fields = {{"contact pressure [Pa]", pressure}};
    series_->write(frame);
}

template <int Dim>
void ImpactFiles<Dim>::finish(const ImpactFigures& figures) const {
    apps::write_csv(options_.out / "energy.csv", energies_);
    if (entries_.empty()) return;
    run::write_energy_picture<Dim>(options_.out, title_, entries_, {"E0", figures.largest_energy});
}

template class ImpactFiles<2>;
template class ImpactFiles<3>;

}  // namespace abut::studies::nodal
