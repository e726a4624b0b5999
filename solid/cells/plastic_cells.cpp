#include "abut/solid/cells/plastic_cells.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "abut/base/eigen.hpp"
#include "abut/base/parallel.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/material/rising_root.hpp"
#include "abut/solid/operator/free_strains.hpp"

namespace abut::solid {
namespace {

constexpr double no_direction = 1e-12;  // of a projector: rounding
constexpr double no_answer = 1e-12;     // the same of dev C_e dev, over 2 mu
constexpr int most_doublings = 60;
constexpr double return_rounding =
    1e-9;  // more than what sums of very many steps make of a driving force, over the yield radius
constexpr double two_thirds = 2.0 / 3.0, third = 1.0 / 3.0;
constexpr double per_sqrt2 = 1.0 / std::numbers::sqrt2;
const double slope_of_alpha = std::sqrt(two_thirds);  // in |p|

/// The sides of the shear components, in their order.
template <int Dim>
constexpr std::array<std::pair<int, int>, Dim == 2 ? 1 : 3> shears = [] {
    if constexpr (Dim == 2)
        return std::array{std::pair{0, 1}};
    else
        return std::array{std::pair{1, 2}, std::pair{0, 2}, std::pair{0, 1}};
}();

/// Less its mean of the normal components, which are the first three.
template <class Strain>
[[gnu::always_inline]] inline Strain deviator_of(Strain strain) {
    const double mean = strain.template head<3>().sum() * third;
    for (int i = 0; i < 3; ++i) strain[i] -= mean;
    return strain;
}

}  // namespace

template <int Dim>
auto PlasticCells<Dim>::packed(const Matrix<Dim>& tensor) -> Strain {
    Strain strain = Strain::Zero();
    for (int i = 0; i < Dim; ++i) strain[i] = tensor(i, i);
    for (std::size_t k = 0; k < shears<Dim>.size(); ++k) {
        const auto [i, j] = shears<Dim>[k];
        strain[3 + static_cast<int>(k)] = (tensor(i, j) + tensor(j, i)) * per_sqrt2;
    }
    return strain;
}

template <int Dim>
Matrix<Dim> PlasticCells<Dim>::unpacked(const Strain& strain) {
    Matrix<Dim> tensor = Matrix<Dim>::Zero();
    for (int i = 0; i < Dim; ++i) tensor(i, i) = strain[i];
    for (std::size_t k = 0; k < shears<Dim>.size(); ++k) {
        const auto [i, j] = shears<Dim>[k];
        tensor(i, j) = tensor(j, i) = strain[3 + static_cast<int>(k)] * per_sqrt2;
    }
    return tensor;
}

/// C_e = C - C B (B^T C B)^-1 B^T C with the strains of balancing combinations of free faces in the columns of B.
template <int Dim>
auto PlasticCells<Dim>::response_of(const Material& material, std::span<const FreeFaceOfCell<Dim>> free) -> Response {
    Response response;
    Stiffness& stiffness = response.stiffness;
    stiffness = 2.0 * material.mu() * Stiffness::Identity();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) stiffness(i, j) += material.lambda();
    if (!free.empty()) {
        Eigen::MatrixXd strains(n_strains, std::ssize(free) * Dim);
        for (std::size_t i = 0; i < free.size(); ++i)
            for (int j = 0; j < Dim; ++j)
                strains.col(static_cast<Eigen::Index>(i) * Dim + j) =
                    as_eigen(packed(free[i].free_part.col(j) * free[i].normal.transpose()));
        strains *= balancing_combinations<Dim>(free).of_faces;
        const Eigen::MatrixXd stresses = as_eigen(stiffness) * strains;
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(strains.transpose() * stresses);
        for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) {
            const Eigen::VectorXd relaxed = stresses * solver.eigenvectors().col(i);
            stiffness -= Stiffness(relaxed * relaxed.transpose() / solver.eigenvalues()[i]);
        }
    }
    Stiffness of_deviators;
    for (int j = 0; j < n_strains; ++j) of_deviators.col(j) = deviator_of(Strain(stiffness * deviator_of(Strain::Unit(j))));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n_strains, n_strains>> solver(
        as_eigen(0.5 * (of_deviators + of_deviators.transpose())));
    response.axes = solver.eigenvectors();
    response.values = solver.eigenvalues();
    for (int i = 0; i < n_strains; ++i)
        if (response.values[i] <= no_answer * 2.0 * material.mu()) response.values[i] = 0.0;
    return response;
}

template <int Dim>
PlasticCells<Dim>::PlasticCells(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials,
                                std::span<const Kinematics> kinematics, const FaceConditions<Dim>& conditions,
                                FreeFaceRule rule, FreeFaces free_faces, const CcgArrays<Dim>& arrays)
    : materials_(materials.begin(), materials.end()) {
    const auto flows = [&](std::size_t body) {
        return materials_[body].law == MaterialLaw::j2 && !properties_of(kinematics, body).finite_strains;
    };
    for (std::size_t body = 0; body < materials_.size(); ++body) {
        any_ = any_ || flows(body);
        responses_.push_back(response_of(materials_[body], {}));
    }
    if (!any_) return;
    index_.assign(static_cast<std::size_t>(mesh.n_cells()), -1);
    std::vector<std::vector<FreeFaceOfCell<Dim>>> free(index_.size());
    for (const BoundaryFace b : boundary_faces(mesh)) {
        if (rule != FreeFaceRule::local_equilibrium) break;
        if (conditions.joined[b]) continue;
        const Matrix<Dim> free_part = Matrix<Dim>::Identity() - conditions.prescribed[b];
        if (!free_part.isZero(no_direction))
            free[cell_of(mesh, b)].push_back({mesh.face_normal[mesh_face(mesh, b)], free_part});
    }
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[c]);
        if (!flows(body)) continue;
        auto number = static_cast<std::int32_t>(body);
        if (const auto& of_cell = free[static_cast<std::size_t>(c)]; !of_cell.empty()) {
            number = static_cast<std::int32_t>(responses_.size());
            responses_.push_back(response_of(materials_[body], of_cell));
        }
        index_[static_cast<std::size_t>(c)] = static_cast<std::int32_t>(cells_.size());
        cells_.push_back({.material = &materials_[body], .response = number, .measure = mesh.cell_measure[c]});
        surfaces_.push_back({.poisson = materials_[body].poisson});
        set_surface(surfaces_.size() - 1);
        if (rule != FreeFaceRule::local_equilibrium) continue;
        const std::vector<Shift> shifts = shifts_of(arrays, c, conditions);
        set_tilt(arrays, c, shifts);
        if (free_faces != FreeFaces::stay_alone) make_push(c, shifts);
    }
    driving_.assign(cells_.size(), unknown());
    next_driving_ = driving_;
    flows_.assign(cells_.size(), 0);
    loss_.assign(cells_.size(), 0.0);
}

/// Free faces balance C : G with what they bear, of which C : p n is a part.
template <int Dim>
auto PlasticCells<Dim>::shifts_of(const CcgArrays<Dim>& arrays, std::int32_t cell,
                                  const FaceConditions<Dim>& conditions) const -> std::vector<Shift> {
    std::vector<Shift> shifts;
    const BoundaryReconstruction<Dim>& boundary = arrays.boundary;
    for (const HalfFace& half_face : arrays.half_faces_of(cell)) {
        const BoundaryFace b = arrays.boundary_index[half_face.face];
        if (b == no_face || conditions.prescribed[b].isIdentity(0.0)) continue;
        Shift& shift = shifts.emplace_back(Shift{b, SmallMatrix<Dim, n_strains>::Zero()});
        for (int k = 0; k < n_strains; ++k) {
            const Matrix<Dim> stress = unpacked(Strain(response_inside(at(cell)).stiffness.col(k)));
            Vector<Dim> moved = Vector<Dim>::Zero();
            for (std::int32_t i = boundary.load_offsets[number_of(b)]; i < boundary.load_offsets[number_of(b) + 1]; ++i)
                moved += boundary.from_traction[i] * (stress * arrays.normal_of(boundary.load_faces[i]));
            shift.moved.col(k) = moved;
        }
    }
    return shifts;
}

template <int Dim>
void PlasticCells<Dim>::set_tilt(const CcgArrays<Dim>& arrays, std::int32_t cell, std::span<const Shift> shifts) {
    if (shifts.empty()) return;
    Tilt tilt = Tilt::Zero();
    for (const Shift& shift : shifts)
        for (int k = 0; k < n_strains; ++k) {
            const Vector<Dim> area(arrays.faces[arrays.face_of(shift.face)].area_vector.data());
            const Matrix<Dim> of_gradient = arrays.cells[cell].inverse_measure * shift.moved.col(k) * area.transpose();
            tilt.col(k) += SmallMatrix<Dim * Dim, 1>(of_gradient.data());
        }
    at(cell).tilt = static_cast<std::int32_t>(tilts_.size());
    tilts_.push_back(tilt);
}

template <int Dim>
void PlasticCells<Dim>::make_push(std::int32_t cell, std::span<const Shift> shifts) {
    if (shifts.empty()) return;
    surfaces_[number(cell)].push = static_cast<std::int32_t>(pushes_.size());
    const auto first = static_cast<std::int32_t>(shifts_.size());
    shifts_.insert(shifts_.end(), shifts.begin(), shifts.end());
    pushes_.push_back(
        {.number = number(cell), .first_shift = first, .end_shift = static_cast<std::int32_t>(shifts_.size())});
}

template <int Dim>
void PlasticCells<Dim>::make_deviator(Strain& strain) {
    strain = deviator_of(strain);
}

template <int Dim>
Vector<Dim> PlasticCells<Dim>::moved(std::ptrdiff_t cell, BoundaryFace face) const {
    const Push& push = pushes_[static_cast<std::size_t>(surfaces_[number(cell)].push)];
    for (std::int32_t i = push.first_shift; i < push.end_shift; ++i)
        if (const Shift& shift = shifts_[static_cast<std::size_t>(i)]; shift.face == face)
            return shift.moved * at(cell).memory.plastic;
    return Vector<Dim>::Zero();
}

template <int Dim>
auto PlasticCells<Dim>::memory_of(const Cell& cell, const Strain& plastic, double equivalent) const -> Memory {
    // C is 2 mu for a deviator
    const Strain stress =
        is_inside(cell) ? Strain(2.0 * cell.material->mu() * plastic) : Strain(response(cell).stiffness * plastic);
    return {plastic, equivalent, unpacked(stress)};
}

template <int Dim>
auto PlasticCells<Dim>::shift_of(const Cell& cell, const Memory& memory) const -> Strain {
    const double back = two_thirds * cell.material->flow.kinematic_hardening;
    if (is_inside(cell)) return (2.0 * cell.material->mu() + back) * memory.plastic;
    return deviator_of(Strain(response(cell).stiffness * memory.plastic)) + back * memory.plastic;
}

template <int Dim>
void PlasticCells<Dim>::set_surface(std::size_t number) {
    const Cell& cell = cells_[number];
    Surface& surface = surfaces_[number];
    surface.shift = shift_of(cell, cell.memory);
    surface.radius = slope_of_alpha * cell.material->flow.stress(cell.memory.equivalent);
    surface.has_flowed = cell.memory.equivalent > 0.0;
}

/// Push of contact in the step.
template <int Dim>
auto PlasticCells<Dim>::push_on(std::size_t number) const -> Strain {
    const std::int32_t push = surfaces_[number].push;
    return push < 0 ? Strain::Zero() : pushes_[static_cast<std::size_t>(push)].stress;
}

/// Deviator of C : eps.
template <int Dim>
auto PlasticCells<Dim>::elastic_deviator(const Surface& surface, const Matrix<Dim>& elastic) -> Strain {
    Strain stress = packed(elastic);
    if constexpr (Dim == 2) stress[2] = surface.poisson * elastic.trace();
    return deviator_of(stress);
}

template <int Dim>
void PlasticCells<Dim>::end_elastic(std::size_t number) {
    flows_[number] = 0;
    loss_[number] = 0.0;
    if (surfaces_[number].push >= 0) pushes_[static_cast<std::size_t>(surfaces_[number].push)].work = 0.0;
}

/// The driving force at the end is twice that in the middle less that at the start.
template <int Dim>
bool PlasticCells<Dim>::stays_elastic(std::ptrdiff_t cell, const Matrix<Dim>& mean) {
    const std::size_t n = number(cell);
    const Surface& surface = surfaces_[n];
    const Strain end = 2.0 * (elastic_deviator(surface, mean) - surface.shift) - driving_[n];
    const double largest = (1.0 - return_rounding) * surface.radius;
    const double square = surface.push < 0 ? end.squaredNorm() : (end + push_on(n)).squaredNorm();
    if (!(square <= largest * largest)) return false;  // or not a number
    next_driving_[n] = end;
    end_elastic(n);
    return true;
}

/// How far a cell without free faces flows: its direction is that of the trial state.
template <int Dim>
double PlasticCells<Dim>::flow_inside(const Cell& cell, const FlowStress& stress, double trial) const {
    const double answer = 2.0 * cell.material->mu() + two_thirds * cell.material->flow.kinematic_hardening;
    const auto excess = [&](double g) {
        const auto [at, slope] = stress.at(slope_of_alpha * g);
        return std::pair{slope_of_alpha * at + g * answer - trial, two_thirds * slope + answer};
    };
    return rising_root(excess, 0.0, trial / answer);
}

/// How far a cell flows (|change of p|) from the trial state xi = dev C_e : (eps - p) - 2/3 H p, and `normal`, its
/// direction at the end: the root of sum of y^2/(rho + g b)^2 = 1 over the axes, with y = xi along one, b its answer
/// and rho the radius at the end.
template <int Dim>
double PlasticCells<Dim>::flow(std::size_t number, const FlowStress& stress, const Strain& trial, Strain& normal) const {
    const Cell& cell = cells_[number];
    const double size = trial.norm();
    if (size <= surfaces_[number].radius) return 0.0;
    const Response& of = response(cell);
    // Contact gives way as the face flows, and knows by how much: what it pushes with is no dead load. Flow that goes
    // as far as where faces are held never goes too far; what is left beyond the surface flows in the next steps.
    if (is_inside(cell) || !push_on(number).isZero(0.0)) {
        normal = trial / size;
        return flow_inside(cell, stress, size);
    }
    const Strain y = of.axes.transpose() * trial;
    const Strain b = of.values + two_thirds * cell.material->flow.kinematic_hardening * Strain::Ones();
    // Of the sum S the root of S^-1/2 = 1, which is nearly a line in g.
    const auto excess = [&](double g) {
        const auto [at, slope] = stress.at(slope_of_alpha * g);
        const double rho = slope_of_alpha * at, rise = two_thirds * slope;
        double sum = 0.0, change = 0.0;
        for (int k = 0; k < n_strains; ++k) {
            const double over = y[k] / (rho + g * b[k]);
            sum += over * over;
            change -= 2.0 * over * over * (rise + b[k]) / (rho + g * b[k]);
        }
        return std::pair{1.0 / std::sqrt(sum) - 1.0, -0.5 * change / (sum * std::sqrt(sum))};
    };
    double high = size / (2.0 * cell.material->mu());
    for (int i = 0; excess(high).first < 0.0; high *= 2.0)
        if (++i == most_doublings) return 0.0;  // what a load on a face fixes does not answer to flow
    const double g = rising_root(excess, 0.0, high);
    const double rho = slope_of_alpha * stress.at(slope_of_alpha * g).stress;
    Strain end;
    for (int k = 0; k < n_strains; ++k) end[k] = y[k] / (rho + g * b[k]);
    normal = of.axes * end;
    return g;
}

/// By how much xi at the end is beyond the surface where a cell flows as if its faces were held.
template <int Dim>
auto PlasticCells<Dim>::beyond_surface(const Cell& cell, const Strain& normal, double g) const -> Strain {
    const auto deviator = [&](const Response& of) { return deviator_of(Strain(of.stiffness * normal)); };
    return g * (deviator(response_inside(cell)) - deviator(response(cell)));
}

template <int Dim>
void PlasticCells<Dim>::advance(std::ptrdiff_t cell, const Matrix<Dim>& mean, const Matrix<Dim>& change, double dt) {
    const std::size_t n = number(cell);
    const Surface& surface = surfaces_[n];
    Cell& of = cells_[n];
    end_elastic(n);
    const Strain middle = elastic_deviator(surface, mean), half = of.material->mu() * deviator_of(packed(change));
    const Strain push = push_on(n);
    next_driving_[n] = middle + half - surface.shift;
    Strain normal;
    const FlowStress stress(of.material->flow, of.memory.equivalent, dt);
    const double g = flow(n, stress, next_driving_[n] + push, normal);
    if (!(g > 0.0)) return;
    const double radius = slope_of_alpha * stress.at(slope_of_alpha * g).stress;
    const double beyond = push.isZero(0.0) ? 0.0 : normal.dot(beyond_surface(of, normal, g));
    const double loss = 0.5 * of.measure * g * (normal.dot(middle - half - surface.shift + push) + radius + beyond);
    // Else it waits: a stress beyond the surface is one of a rate.
    if (loss < 0.0 && of.material->flow.knows_rates()) return;
    flows_[n] = 1;
    any_flowed_.store(true, std::memory_order_relaxed);
    loss_[n] = loss;
    if (surface.push >= 0) pushes_[static_cast<std::size_t>(surface.push)].work = of.measure * g * normal.dot(push);
    of.next = memory_of(of, of.memory.plastic + g * normal, of.memory.equivalent + slope_of_alpha * g);
    next_driving_[n] = middle + half - shift_of(of, of.next);
}

template <int Dim>
double PlasticCells<Dim>::energy(std::ptrdiff_t cell, const Matrix<Dim>& g) const {
    const Cell& of = at(cell);
    const Strain& plastic = of.memory.plastic;
    return plastic.dot(response(of).stiffness * (0.5 * plastic) - response_inside(of).stiffness * packed(g)) +
           of.material->flow.kinematic_hardening / 3.0 * plastic.squaredNorm();
}

template <int Dim>
double PlasticCells<Dim>::out_of_plane_stress(std::ptrdiff_t cell, const Matrix<Dim>& g) const {
    const Cell& of = at(cell);
    return of.material->lambda() * g.trace() - (response(of).stiffness * of.memory.plastic)[2];
}

template <int Dim>
void PlasticCells<Dim>::end_step() {
    std::swap(driving_, next_driving_);
    if (!any_flowed_.exchange(false)) return;
    parallel_each(static_cast<std::ptrdiff_t>(cells_.size()), [&](std::ptrdiff_t i) {
        const auto n = static_cast<std::size_t>(i);
        if (flows_[n] == 0) return;
        cells_[n].memory = cells_[n].next;
        set_surface(n);
        flows_[n] = 0;
    });
}

template <int Dim>
void PlasticCells<Dim>::put_memory(std::ptrdiff_t cell, std::vector<double>& values) const {
    if (!contains(cell)) return;
    const Memory& memory = at(cell).memory;
    values.insert(values.end(), memory.plastic.data(), memory.plastic.data() + n_strains);
    values.push_back(memory.equivalent);
}

template <int Dim>
void PlasticCells<Dim>::set_memory(std::ptrdiff_t cell, std::span<const double> values) {
    const std::size_t n = number(cell);
    cells_[n].memory = memory_of(cells_[n], Strain(values.data()), values[n_strains]);
    set_surface(n);
    flows_[n] = 0;
    driving_[n] = unknown();
}

template class PlasticCells<2>;
template class PlasticCells<3>;

}  // namespace abut::solid
