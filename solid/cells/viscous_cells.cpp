#include "abut/solid/cells/viscous_cells.hpp"

#include <algorithm>
#include <cmath>

namespace abut::solid {
namespace {

/// That have equal measures: Dim!
template <int Dim>
constexpr double simplices_in_a_cube = Dim == 2 ? 2.0 : 6.0;

/// C : strain, without stress on free faces.
template <int Dim>
Matrix<Dim> stress_of_rate(const Material& material, const FreeCell<Dim>* free, const Matrix<Dim>& strain) {
    if (free) return condensed_stress(*free, material.lambda(), material.mu(), strain);
    return 2.0 * material.mu() * strain + material.lambda() * strain.trace() * Matrix<Dim>::Identity();
}

/// A, by which the rate of volume over the volume is A : dE/dt. Where faces are free it is that of the directions along
/// them, with what these make of the others.
template <int Dim>
Matrix<Dim> volume_of_strain(const Material& material, const FreeCell<Dim>* free, const Matrix<Dim>& f) {
    const Matrix<Dim> metric = f.transpose() * f;
    if (!free) return metric.inverse();
    if (free->n_tangents == 0) return Matrix<Dim>::Zero();
    if (free->n_tangents == 1) {
        const double left =
            free->has_one_normal() ? 2.0 * material.mu() / material.wave_modulus() : 1.0 - 2.0 * material.poisson;
        const Vector<Dim> along = free->axes.col(0);
        return left / along.dot(metric * along) * along * along.transpose();
    }
    const SmallMatrix<Dim, Dim - 1> tangents = free->axes.template leftCols<Dim - 1>();
    const SmallMatrix<Dim - 1, Dim - 1> in_plane = tangents.transpose() * metric * tangents;
    return 2.0 * material.mu() / material.wave_modulus() * tangents * in_plane.inverse() * tangents.transpose();
}

/// Adds what a force c (now + before)/2 does in a step whose rate is `now`: `work`. Of it dt/4 c (now + before)^2 is
/// dissipated, and the rest is lagged: it is the change of dt/4 c rate^2.
void add_lagged(dynamics::Losses& loss, double work, double dissipated) {
    loss.by_damping += dissipated;
    loss.lagged += work - dissipated;
}

}  // namespace

template <int Dim>
ViscousCells<Dim>::ViscousCells(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials)
    : materials_(materials.begin(), materials.end()), directed_(mesh, materials) {
    any_ = std::ranges::any_of(materials_, &Damping::any, &Material::damping);
    if (!any_) return;
    index_.assign(static_cast<std::size_t>(mesh.n_cells()), -1);
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const Material& material = materials_[static_cast<std::size_t>(mesh.cell_body[c])];
        if (!material.damping.any()) continue;
        index_[static_cast<std::size_t>(c)] = static_cast<std::int32_t>(cells_.size());
        const double measure = mesh.cell_measure[c];
        const bool is_simplex = mesh.cell_faces[c].size() == Dim + 1;
        const double size = std::pow((is_simplex ? simplices_in_a_cube<Dim> : 1.0) * measure, 1.0 / Dim);
        cells_.push_back({.material = &material, .measure = measure, .size = size});
    }
}

template <int Dim>
Matrix<Dim> ViscousCells<Dim>::stress(std::ptrdiff_t cell, const Matrix<Dim>& g, const Matrix<Dim>& change, double dt,
                                      const FreeCell<Dim>* free) {
    Cell& of = at(cell);
    const Material& material = *of.material;
    of.of_stress = {};
    const Matrix<Dim> f = Matrix<Dim>::Identity() + g;
    Matrix<Dim> result = Matrix<Dim>::Zero();
    const Matrix<Dim> product = f.transpose() * change;
    of.now.strain = (0.5 / dt) * (product + product.transpose());
    if (material.damping.stiffness > 0.0) {
        const Matrix<Dim> before = of.before.deforms_known ? of.before.strain : of.now.strain;
        const Matrix<Dim> mean = 0.5 * (of.now.strain + before);
        Matrix<Dim> of_mean = material.damping.stiffness * stress_of_rate<Dim>(material, free, mean);
        if (directed_.contains(cell)) of_mean += material.damping.stiffness * directed_[cell].stress(mean);
        const double measure = dt * of.measure;
        const double lost = measure * of_mean.cwiseProduct(mean).sum();  // dt/4 c (now + before)^2
        const double work = measure * of_mean.cwiseProduct(of.now.strain).sum();
        const double first = of.before.deforms_known ? 1.0 : 0.75;  // the lag begins with the first step
        add_lagged(of.of_stress, work, first * lost);
        result += f * of_mean;
    }
    if (material.damping.linear_viscosity > 0.0 || material.damping.quadratic_viscosity > 0.0) {
        const Matrix<Dim> of_strain = volume_of_strain<Dim>(material, free, f);
        const double volume = f.determinant();
        of.now.volume = of_strain.cwiseProduct(of.now.strain).sum();
        const double before = of.before.deforms_known ? of.before.volume : of.now.volume;
        const double rate = 0.5 * (of.now.volume + before);
        const double speed = std::sqrt(material.wave_modulus() / material.density);
        const double squeeze = rate < 0.0 ? -rate : 0.0;
        double pressure = material.density * of.size *
                          (material.damping.linear_viscosity * speed +
                           material.damping.quadratic_viscosity * material.damping.quadratic_viscosity * of.size * squeeze) *
                          rate;
        if (pressure * of.now.volume < 0.0) pressure = 0.0;  // it never does work
        of.of_stress.by_viscosity += dt * of.measure * volume * pressure * of.now.volume;
        result += volume * pressure * f * of_strain;
    }
    of.now.deforms_known = true;
    return result;
}

template <int Dim>
Vector<Dim> ViscousCells<Dim>::drag(std::ptrdiff_t cell, double mass, const Vector<Dim>& motion, double dt) {
    Cell& of = at(cell);
    of.of_drag = {};
    if (!(of.material->damping.mass > 0.0)) return Vector<Dim>::Zero();
    if (of.drag_step != dt) {
        of.drag_step = dt;
        of.drag_rate = -std::expm1(-of.material->damping.mass * dt) / dt;
    }
    const double damping = of.drag_rate * mass;
    of.now.velocity = motion / dt;
    of.now.moves_known = true;
    const Vector<Dim> before = of.before.moves_known ? of.before.velocity : of.now.velocity;
    const Vector<Dim> mean = 0.5 * (of.now.velocity + before);
    const double first = of.before.moves_known ? 1.0 : 0.75;
    add_lagged(of.of_drag, damping * mean.dot(motion), first * dt * damping * mean.squaredNorm());
    return -damping * mean;
}

template <int Dim>
double ViscousCells<Dim>::damping_ratio(double omega) const {
    double largest = 0.0;
    for (const Cell& cell : cells_) largest = std::max(largest, cell.material->damping_ratio(omega, cell.size));
    return largest;
}

template <int Dim>
dynamics::Losses ViscousCells<Dim>::loss(std::ptrdiff_t cell) const {
    if (!contains(cell)) return {};
    const Cell& of = at(cell);
    dynamics::Losses loss = of.of_stress;
    loss += of.of_drag;
    return loss;
}

template <int Dim>
void ViscousCells<Dim>::bring_to_rest() {
    for (Cell& cell : cells_) {
        cell.before = {};
        cell.before.deforms_known = cell.before.moves_known = true;
    }
}

template <int Dim>
void ViscousCells<Dim>::end_step() {
    for (Cell& cell : cells_) cell.before = cell.now;
}

template <int Dim>
void ViscousCells<Dim>::put_memory(std::ptrdiff_t cell, std::vector<double>& values) const {
    if (!contains(cell)) return;
    const Rates& rates = at(cell).before;
    values.insert(values.end(), rates.strain.data(), rates.strain.data() + Dim * Dim);
    values.insert(values.end(), rates.velocity.data(), rates.velocity.data() + Dim);
    for (const double value : {rates.volume, rates.deforms_known ? 1.0 : 0.0, rates.moves_known ? 1.0 : 0.0})
        values.push_back(value);
}

template <int Dim>
void ViscousCells<Dim>::set_memory(std::ptrdiff_t cell, std::span<const double> values) {
    Rates& rates = at(cell).before;
    rates.strain = Matrix<Dim>(values.data());
    rates.velocity = Vector<Dim>(values.data() + Dim * Dim);
    const std::span<const double> rest = values.subspan(Dim * Dim + Dim);
    rates.volume = rest[0];
    rates.deforms_known = rest[1] != 0.0;
    rates.moves_known = rest[2] != 0.0;
    at(cell).now = rates;
}

template class ViscousCells<2>;
template class ViscousCells<3>;

}  // namespace abut::solid
