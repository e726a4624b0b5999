// Elastic bodies that run into each other, in deal.II, with contact by Abut, in two and three dimensions.
//
// Q1 elements, matrix-free, total Lagrangian, lumped mass, no damping; linear elasticity and the material of St. Venant and
// Kirchhoff. Each runs with MEMM, which takes the mean force of a step, and with central differences:
//
//   discs      2D, plane strain: R = E = rho = 1, nu = 0.3, at +-0.05 along x, centres 0.8 apart along y; they slip off each
//              other. Other codes find for small strains that the left one leaves at (-0.0279, -0.0400)
//   cylinders  the same in 3D, length 0.5, ends free: (-0.0275, -0.0402)
//   bars       2D, finite strain: a bar that spins about its middle hits a square at rest with a corner, and both turn on
//
// impact <scene> [fine] [friction] [erode] [restart]: `fine` halves the cells of round bodies; with `friction`, a coefficient of
// 0.05, these slide all along, and friction takes what it takes from rigid discs; `erode` takes away the cells of the left body
// that are pressed hardest, with 1 % of all faces, while the bodies touch; `restart` goes on from a saved state in new objects 1 s
// later, and compares the bits of both ends. The exit status is 1 if a figure is off.
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/timer.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>
#include <deal.II/physics/elasticity/kinematics.h>

#include <abut/contact/nodal_contact.hpp>
#include <abut/contact/surface/nodal_faces.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace dealii;
using abut::contact::TakenForce;
using VectorType = LinearAlgebra::distributed::Vector<double>;
using Lanes = VectorizedArray<double>;

constexpr double lambda = 0.3 / (1.3 * 0.4), mu = 0.5 / 1.3, speed = 0.05;  // E = 1, nu = 0.3, rho = 1

// Corners of the faces of a cell as Abut asks for them: outside on the right (2D), counter-clockwise from outside (3D).
constexpr unsigned corners_2d[4][2] = {{2, 0}, {1, 3}, {0, 1}, {3, 2}};
constexpr unsigned corners_3d[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

std::span<const double> values(const VectorType& u) { return {u.begin(), u.locally_owned_size()}; }

template <int dim>
Tensor<1, dim> at_node(const VectorType& u, unsigned node) {
    Tensor<1, dim> value;
    for (unsigned d = 0; d < dim; ++d) value[d] = u.local_element(dim * node + d);
    return value;
}

enum class Strain { small, finite };  // linear elasticity, or Green's strain: St. Venant and Kirchhoff

struct State {  // all that a run goes on from
    VectorType x, v_before, v_after;  // x^n, v^{n-1/2}, v^{n+1/2}
    std::vector<bool> eroded;  // of each cell
    double potential = 0.0;    // V(x^n), with what faces hold that stick
    double taken = 0.0;        // by friction until now
    double dt;
    std::vector<std::byte> contact;
};

template <int dim>
class Bodies {
public:
    Bodies(const Triangulation<dim>& mesh, Strain strain, double friction, const State* saved = nullptr)
        : strain_(strain), dofs_(mesh) {
        dofs_.distribute_dofs(FESystem<dim>(FE_Q<dim>(1), dim));  // numbers the components of a node one after the other
        typename MatrixFree<dim>::AdditionalData serial;
        serial.tasks_parallel_scheme = MatrixFree<dim>::AdditionalData::none;
        serial.mapping_update_flags = update_gradients | update_JxW_values;
        matrix_free_.reinit(MappingQ1<dim>(), dofs_, AffineConstraints<double>(), QGauss<1>(2), serial);
        for (VectorType* u : {&rest_, &mass, &now.x, &now.v_before, &now.v_after}) matrix_free_.initialize_dof_vector(*u);
        body.resize(mass.size() / dim);
        for (const auto& cell : dofs_.active_cell_iterators())
            for (const unsigned i : cell->vertex_indices())
                for (unsigned d = 0; d < dim; ++d) {
                    AssertThrow(cell->vertex_dof_index(i, d) == dim * node(cell, i) + d, ExcInternalError());
                    rest_[cell->vertex_dof_index(i, d)] = cell->vertex(i)[d];
                    body[node(cell, i)] = cell->material_id();
                }
        FEEvaluation<dim, 1, 2, dim> element(matrix_free_);
        for (unsigned batch = 0; batch < matrix_free_.n_cell_batches(); ++batch) {
            element.reinit(batch);
            for (const unsigned q : element.quadrature_point_indices()) {
                Tensor<1, dim, Lanes> one;
                for (unsigned d = 0; d < dim; ++d) one[d] = 1.0;
                element.submit_value(one, q);
            }
            element.integrate_scatter(EvaluationFlags::values, mass);
        }
        now.x = rest_;
        now.eroded.assign(mesh.n_active_cells(), false);
        if (saved) now = *saved;
        set_intact();

        std::vector<double> depth[2];  // of the faces of each body
        for (const auto& cell : dofs_.active_cell_iterators())
            for (const unsigned f : cell->face_indices())
                if (is_skin(cell, f)) depth[cell->material_id()].push_back(half_height(cell, f));
        for (const auto& d : depth) {
            stiffness_.push_back(abut::contact::skin_stiffness(lambda + 2.0 * mu, d));
            shear_stiffness_.push_back(abut::contact::skin_stiffness(mu, d));
        }
        abut::contact::NodalOptions options;
        if (friction > 0.0) options.friction.laws = {{.coefficient = friction}};
        contact = std::make_unique<abut::contact::NodalContact<dim>>(skin(), options);
        if (saved) contact->restore(saved->contact);

        std::vector<double> node_mass;
        for (unsigned i = 0; i < body.size(); ++i) node_mass.push_back(mass[dim * i]);
        if (!saved) now.dt = contact->stable_step(node_mass, highest_frequency()).dt;
    }

    State state() const {
        State saved = now;
        saved.contact = contact->state();
        return saved;
    }

    void step(TakenForce take) {
        VectorType x = now.x, force = now.x;
        x.add(now.dt, now.v_after);
        force = 0.0;
        const auto& step = contact->step(now.dt, values(now.x), values(x), take);
        step.add_force_to(std::span(force.begin(), force.locally_owned_size()));
        now.taken += step.report.friction.dissipated;
        now.potential = step.energy + step.report.friction.energy + add_elastic_force(take == TakenForce::mean ? now.x : x, x, force);
        for (unsigned i = 0; i < force.size(); ++i) force[i] /= mass[i];
        VectorType v = take == TakenForce::mean ? now.v_before : now.v_after;
        v.add(take == TakenForce::mean ? 2.0 * now.dt : now.dt, force);
        now.v_before.swap(now.v_after);
        now.v_after.swap(v);
        now.x.swap(x);
    }

    /// Takes away the cells behind the faces of the left body that contact presses hardest, a share of all faces; their mass
    /// stays with their nodes. Returns the energy that goes with them.
    double erode(double share) {
        const std::vector<unsigned> old_faces = faces_;
        std::vector<std::pair<double, unsigned>> pressed;  // minus the force, and the face
        for (const auto& pair : contact->last().pairs)
            pressed.emplace_back(-pair.normal_force, faces_[static_cast<unsigned>(pair.face_1)]);
        std::sort(pressed.begin(), pressed.end());
        std::set<unsigned> gone;
        for (const auto& [force, face] : pressed)
            if (gone.size() < share * old_faces.size()) gone.insert(face);
        for (const unsigned face : gone) now.eroded[face / GeometryInfo<dim>::faces_per_cell] = true;
        faces_eroded = gone.size();
        faces_before = old_faces.size();
        set_intact();
        auto surface = skin();
        std::vector<std::int32_t> old_of;
        for (const unsigned face : faces_) {
            const auto old = std::lower_bound(old_faces.begin(), old_faces.end(), face);
            old_of.push_back(old != old_faces.end() && *old == face ? old - old_faces.begin() : -1);
        }
        contact->surface_replaced(std::move(surface), old_of);
        const double before = now.potential;
        VectorType unused = mass;
        now.potential = contact->evaluate(values(now.x)).energy + add_elastic_force(now.x, now.x, unused);
        return before - now.potential;
    }

    double product(const VectorType& u, const VectorType& v) const {  // u . M v
        VectorType scaled = mass;
        scaled.scale(u);
        return scaled * v;
    }
    double pseudo_energy() const { return 0.5 * product(now.v_before, now.v_after) + now.potential; }  // H~
    double energy_excess() const {                                                                     // H - H~
        VectorType jump = now.v_after;
        jump -= now.v_before;
        return 0.125 * product(jump, jump);
    }
    Tensor<1, dim> momentum(unsigned of_body) const {
        Tensor<1, dim> sum;
        for (unsigned i = 0; i < body.size(); ++i)
            if (body[i] == of_body) sum += mass[dim * i] * at_node<dim>(now.v_after, i);
        return sum;
    }
    double mass_of(unsigned of_body) const {
        double sum = 0.0;
        for (unsigned i = 0; i < body.size(); ++i) sum += body[i] == of_body ? mass[dim * i] : 0.0;
        return sum;
    }
    /// What the scheme keeps: J~ of MEMM, sum x^n x p^{n+1/2} of central differences; as a skew tensor.
    Tensor<2, dim> angular_momentum(TakenForce take) const {
        Tensor<2, dim> sum;
        for (unsigned i = 0; i < body.size(); ++i) {
            const auto x = at_node<dim>(now.x, i), v_0 = at_node<dim>(now.v_before, i), v_1 = at_node<dim>(now.v_after, i);
            sum += mass[dim * i] * (take == TakenForce::mean
                                        ? outer_product(x, 0.5 * (v_0 + v_1)) - 0.25 * now.dt * outer_product(v_0, v_1)
                                        : outer_product(x, v_1));
        }
        return sum - transpose(sum);
    }
    /// Angle about z by which a body has turned, in (-pi, pi].
    double angle(unsigned of_body) const {
        Tensor<2, dim> sum;
        Tensor<1, dim> mean;
        const double whole = mass_of(of_body);
        for (unsigned i = 0; i < body.size(); ++i)
            if (body[i] == of_body) mean += mass[dim * i] / whole * at_node<dim>(rest_, i);
        for (unsigned i = 0; i < body.size(); ++i)
            if (body[i] == of_body)
                sum += mass[dim * i] * outer_product(at_node<dim>(now.x, i), at_node<dim>(rest_, i) - mean);
        return std::atan2(sum[1][0] - sum[0][1], sum[0][0] + sum[1][1]);
    }

    VectorType mass;                    // one value for each component of a node
    std::vector<unsigned> body;  // of each node
    State now;
    std::size_t faces_eroded = 0, faces_before = 0;
    std::unique_ptr<abut::contact::NodalContact<dim>> contact;

private:
    using Cell = typename DoFHandler<dim>::active_cell_iterator;
    static std::int32_t node(const Cell& cell, unsigned vertex) { return cell->vertex_dof_index(vertex, 0) / dim; }
    /// Not the ends of cylinders: nothing can touch them.
    static bool is_skin(const Cell& cell, unsigned face) {
        return cell->face(face)->at_boundary() && cell->face(face)->boundary_id() == 0;
    }
    bool is_bare(const Cell& cell, unsigned face) const {
        return !cell->face(face)->at_boundary() && now.eroded[cell->neighbor(face)->active_cell_index()];
    }
    static double half_height(const Cell& cell, unsigned face) {
        const unsigned opposite = GeometryInfo<dim>::opposite_face[face];
        return 0.5 * cell->face(face)->center().distance(cell->face(opposite)->center());
    }

    /// Adds F_mid S_mean from x_0 to x_1 to the force, F(x_1) where both are the same; returns the strain energy at x_1.
    double add_elastic_force(const VectorType& x_0, const VectorType& x_1, VectorType& force) const {
        using Sym = SymmetricTensor<2, dim, Lanes>;
        const Sym unit = unit_symmetric_tensor<dim, Lanes>();
        const auto strain = [&](const Tensor<2, dim, Lanes>& F) -> Sym {
            return strain_ == Strain::finite ? Physics::Elasticity::Kinematics::E(F) : Sym(symmetrize(F) - unit);
        };
        FEEvaluation<dim, 1, 2, dim> start(matrix_free_), end(matrix_free_);
        double energy = 0.0;
        for (unsigned batch = 0; batch < matrix_free_.n_cell_batches(); ++batch) {
            start.reinit(batch);
            end.reinit(batch);
            start.gather_evaluate(x_0, EvaluationFlags::gradients);
            end.gather_evaluate(x_1, EvaluationFlags::gradients);
            const Lanes intact = end.read_cell_data(intact_);
            Lanes energies = 0.0;
            for (const unsigned q : end.quadrature_point_indices()) {
                const Tensor<2, dim, Lanes> F_0 = start.get_gradient(q), F_1 = end.get_gradient(q);
                const auto E_0 = strain(F_0), E_1 = strain(F_1);
                const Sym S_0 = Lanes(lambda) * trace(E_0) * unit + Lanes(2.0 * mu) * E_0;
                const Sym S_1 = Lanes(lambda) * trace(E_1) * unit + Lanes(2.0 * mu) * E_1;
                const auto F_mid = strain_ == Strain::finite ? 0.5 * (F_0 + F_1) : Tensor<2, dim, Lanes>(unit);
                energies += 0.5 * intact * (S_1 * E_1) * end.JxW(q);
                end.submit_gradient(-0.5 * intact * F_mid * Tensor<2, dim, Lanes>(S_0 + S_1), q);
            }
            end.integrate_scatter(EvaluationFlags::gradients, force);
            for (unsigned lane = 0; lane < matrix_free_.n_active_entries_per_cell_batch(batch); ++lane)
                energy += energies[lane];
        }
        return energy;
    }

    /// Of the bodies at rest without contact, by power iteration; K y is a difference of forces.
    double highest_frequency() const {
        VectorType y = mass, force = mass;
        for (unsigned i = 0; i < y.size(); ++i) y[i] = std::sin(1.0 + i * i);
        double omega_squared = 0.0;
        for (int iteration = 0; iteration < 100; ++iteration) {
            y *= 1e-6 / y.linfty_norm();
            VectorType x = rest_;
            x += y;
            force = 0.0;
            add_elastic_force(x, x, force);
            omega_squared = -(force * y) / product(y, y);
            for (unsigned i = 0; i < y.size(); ++i) y[i] = -force[i] / mass[i];
        }
        return std::sqrt(omega_squared);
    }

    void set_intact() {
        intact_.resize(matrix_free_.n_cell_batches(), Lanes(1.0));
        for (unsigned batch = 0; batch < intact_.size(); ++batch)
            for (unsigned lane = 0; lane < matrix_free_.n_active_entries_per_cell_batch(batch); ++lane)
                if (now.eroded[matrix_free_.get_cell_iterator(batch, lane)->active_cell_index()]) intact_[batch][lane] = 0.0;
    }

    /// The faces of intact cells at the boundary, or where a neighbour has eroded.
    abut::contact::NodalSurface<dim> skin() {
        abut::contact::NodalFaceArrays<dim> arrays;
        arrays.stiffness = stiffness_;
        faces_.clear();
        for (const auto& cell : dofs_.active_cell_iterators())
            for (const unsigned f : cell->face_indices()) {
                if (now.eroded[cell->active_cell_index()]) continue;
                if (!is_skin(cell, f) && !is_bare(cell, f)) continue;
                std::vector<std::int32_t> corners;
                for (unsigned i = 0; i < GeometryInfo<dim>::vertices_per_face; ++i)
                    if constexpr (dim == 2) corners.push_back(node(cell, corners_2d[f][i]));
                    else corners.push_back(node(cell, corners_3d[f][i]));
                arrays.append_face(corners, half_height(cell, f), cell->material_id());
                faces_.push_back(cell->active_cell_index() * GeometryInfo<dim>::faces_per_cell + f);
            }
        abut::contact::NodalFaces<dim> faces = arrays.view();
        faces.shear_stiffness = shear_stiffness_;  // friction alone reads it
        abut::contact::NodalSurface<dim> surface(values(rest_), faces);
        AssertThrow(surface.inward_bodies().empty(), ExcMessage("faces look inwards"));
        return surface;
    }

    Strain strain_;
    VectorType rest_;
    DoFHandler<dim> dofs_;
    MatrixFree<dim> matrix_free_;
    AlignedVector<Lanes> intact_;    // 0 where a cell has eroded, else 1
    std::vector<unsigned> faces_;    // of contact, as faces_per_cell * cell + face: increasing
    std::vector<double> stiffness_, shear_stiffness_;  // of contact, of each body
};

struct Scene {
    Triangulation<2> mesh;       // material 0: left body, 1: right body
    bool left_spins = false;     // about the origin, and the right body rests
    double impact = 2.5;         // a time when the bodies touch [s]
    double end = 15.0;           // [s]
    Tensor<1, 2> expected = {};  // velocity of the left body at the end, of linear elasticity
};

struct Options {
    bool erode, restart;
    double friction;
};

/// What friction takes from rigid discs, over their kinetic energy: they meet with the normal impulse of discs without friction,
/// and each kg m/s along their faces slows sliding by 3/m on each disc.
double taken_from_rigid_discs(double friction, const Tensor<1, 2>& without) {
    const double impulse = std::hypot(without[0] - speed, without[1]);  // over m
    const double sliding = 2.0 * speed * std::abs(without[1]) / impulse;
    return friction * impulse * (sliding - 3.0 * friction * impulse) / (speed * speed);
}

template <int dim>
void set_velocity(Bodies<dim>& bodies, const Scene& scene) {
    for (unsigned i = 0; i < bodies.body.size(); ++i) {
        const auto x = at_node<dim>(bodies.now.x, i);
        Tensor<1, dim> v;
        if (!scene.left_spins) v[0] = bodies.body[i] == 0 ? speed : -speed;
        else if (bodies.body[i] == 0) v[0] = speed * x[1], v[1] = -speed * x[0];
        for (unsigned d = 0; d < dim; ++d) bodies.now.v_before[dim * i + d] = bodies.now.v_after[dim * i + d] = v[d];
    }
}

/// Whether all figures are as they ought to be.
template <int dim>
bool run(const Triangulation<dim>& mesh, const Scene& scene, Options options, Strain strain, TakenForce take) {
    const Timer timer;
    Bodies<dim> bodies(mesh, strain, options.friction);
    set_velocity(bodies, scene);
    const auto step_at = [&](double time) { return static_cast<unsigned>(time / bodies.now.dt); };
    const double H_0 = bodies.pseudo_energy();  // all of it kinetic
    const Tensor<1, dim> P_0 = bodies.momentum(0) + bodies.momentum(1);
    const Tensor<2, dim> J_0 = bodies.angular_momentum(take);
    const double P_scale = std::sqrt(2.0 * H_0 * (bodies.mass_of(0) + bodies.mass_of(1)));  // and of J, with R = 1

    double lost = 0.0, drift = 0.0, H_drift = 0.0, excess = 0.0, P_drift = 0.0, J_drift = 0.0, turned[2] = {0.0, 0.0};
    std::size_t pairs_at_restart = 0;
    State saved;
    for (unsigned n = 0; n < step_at(scene.end); ++n) {
        bodies.step(take);
        if (options.erode && n == step_at(scene.impact)) lost = bodies.erode(0.01);
        if (options.restart && n == step_at(scene.impact + 1.0))
            saved = bodies.state(), pairs_at_restart = bodies.contact->last().pairs.size();
        const double gain = bodies.pseudo_energy() + lost + bodies.now.taken - H_0;
        drift = std::max(drift, std::abs(gain));
        H_drift = std::max(H_drift, std::abs(gain + bodies.energy_excess()));
        excess = std::max(excess, bodies.energy_excess());
        P_drift = std::max(P_drift, (bodies.momentum(0) + bodies.momentum(1) - P_0).norm());
        J_drift = std::max(J_drift, (bodies.angular_momentum(take) - J_0).norm());
        for (unsigned b = 0; b < 2; ++b) turned[b] += std::remainder(bodies.angle(b) - turned[b], 2.0 * numbers::PI);
    }
    const auto& report = bodies.contact->report();
    const Tensor<1, dim> v = bodies.momentum(0) / bodies.mass_of(0);
    const double off = std::hypot(v[0] - scene.expected[0], v[1] - scene.expected[1]) / scene.expected.norm();
    std::printf("%s strain, %s: %u steps of %.4f, %.1f s\n", strain == Strain::small ? "small" : "finite",
                take == TakenForce::mean ? "MEMM" : "central differences", step_at(scene.end), bodies.now.dt,
                timer.wall_time());
    std::printf("    left body (%.4f, %.4f), bodies turned by %.3f and %.3f\n", v[0], v[1], turned[0], turned[1]);
    std::printf("    drift of H~ %.1e, H %.1e, momentum %.1e, angular momentum %.1e; max H - H~ %.1e\n", drift / H_0,
                H_drift / H_0, P_drift / P_scale, J_drift / P_scale, excess / H_0);
    std::printf("    pairs up to %ld, |g|/D up to %.2f, corrections up to %.0e, missed contacts %ld\n",
                long(report.active_pairs_max), report.compression_max, report.correction_max, long(report.missed_contacts));

    bool holds = P_drift < 1e-12 * P_scale && report.missed_contacts == 0 && report.active_pairs_max > 0;
    if (strain == Strain::finite) holds = holds && J_drift < 1e-12 * P_scale;
    holds = holds && H_drift < 0.01 * H_0 && (take == TakenForce::end || drift < 1e-12 * H_0);
    if (scene.left_spins) holds = holds && std::abs(turned[0]) > 1.0 && std::abs(turned[1]) > 1.0;
    if (options.erode) {
        std::printf("    %zu of %zu faces eroded, and %.1e of the energy\n", bodies.faces_eroded, bodies.faces_before,
                    lost / H_0);
        holds = holds && bodies.faces_eroded > 0 && lost > 0.0;
    } else if (options.friction > 0.0) {
        const double taken = bodies.now.taken / H_0, of_rigid = taken_from_rigid_discs(options.friction, scene.expected);
        std::printf("    friction took %.4f of the energy, %.4f of rigid discs\n", taken, of_rigid);
        holds = holds && std::abs(taken - of_rigid) < 0.05 * of_rigid;
    } else if (strain == Strain::small) {
        std::printf("    off by %.2f %% of its speed\n", 100.0 * off);
        holds = holds && off < 0.01;
    }
    if (options.restart) {
        Bodies<dim> again(mesh, strain, options.friction, &saved);
        for (unsigned n = step_at(scene.impact + 1.0) + 1; n < step_at(scene.end); ++n) again.step(take);
        const auto same = [](const VectorType& u, const VectorType& v) { return std::ranges::equal(values(u), values(v)); };
        const bool equal = same(again.now.x, bodies.now.x) && same(again.now.v_after, bodies.now.v_after);
        std::printf("    restart with %zu pairs pressed: %s bits\n", pairs_at_restart, equal ? "same" : "OTHER");
        holds = holds && equal && pairs_at_restart > 0;
    }
    if (!holds) std::printf("    OFF\n");
    return holds;
}

template <int dim>
bool run_all(const Triangulation<dim>& mesh, const Scene& scene, Options options) {
    bool all = true;
    for (const Strain strain : {Strain::small, Strain::finite})
        for (const TakenForce take : {TakenForce::mean, TakenForce::end})
            if (strain == Strain::finite || !scene.left_spins) all = run(mesh, scene, options, strain, take) && all;
    return all;
}

/// Appends a body as it is after refinement, without levels or manifold.
void add_body(Triangulation<2>& mesh, const Triangulation<2>& refined, const Tensor<1, 2>& shift) {
    Triangulation<2> body, first;
    GridGenerator::flatten_triangulation(refined, body);
    GridTools::shift(shift, body);
    const bool is_first = mesh.n_levels() == 0;
    for (const auto& cell : body.active_cell_iterators()) cell->set_material_id(is_first ? 0 : 1);
    if (is_first) return mesh.copy_triangulation(body);
    first.copy_triangulation(mesh);
    GridGenerator::merge_triangulations(first, body, mesh);
}

Scene round_bodies(unsigned refinements, const Tensor<1, 2>& expected) {
    Scene scene;
    scene.expected = expected;
    Triangulation<2> disc;
    GridGenerator::hyper_ball_balanced(disc);
    disc.refine_global(refinements);
    add_body(scene.mesh, disc, {});
    add_body(scene.mesh, disc, Point<2>(std::sqrt(2.02 * 2.02 - 0.8 * 0.8), 0.8));
    return scene;
}

Scene bar_and_square() {
    Scene scene;
    scene.left_spins = true;
    scene.impact = 40.5, scene.end = 100.0;
    Triangulation<2> bar, square;
    GridGenerator::subdivided_hyper_rectangle(bar, {32, 8}, Point<2>(-1.0, -0.25), Point<2>(1.0, 0.25));
    GridGenerator::subdivided_hyper_rectangle(square, {17, 17}, Point<2>(0.6, 0.6), Point<2>(1.6, 1.6));
    add_body(scene.mesh, bar, {});
    add_body(scene.mesh, square, {});
    return scene;
}

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    const auto given = [&](const char* word) { return std::ranges::count(words, word) > 0; };
    const Options options{given("erode"), given("restart"), given("friction") ? 0.05 : 0.0};
    if (given("discs")) {
        const Scene scene = round_bodies(given("fine") ? 4 : 3, Point<2>(-0.0279, -0.0400));
        return run_all(scene.mesh, scene, options) ? 0 : 1;
    }
    if (given("cylinders")) {
        const Scene scene = round_bodies(given("fine") ? 3 : 2, Point<2>(-0.0275, -0.0402));
        Triangulation<3> mesh;
        GridGenerator::extrude_triangulation(scene.mesh, given("fine") ? 7 : 4, 0.5, mesh);
        return run_all(mesh, scene, options) ? 0 : 1;
    }
    if (given("bars")) {
        const Scene scene = bar_and_square();
        return run_all(scene.mesh, scene, options) ? 0 : 1;
    }
    std::fprintf(stderr, "usage: impact discs|cylinders|bars [fine] [friction] [erode] [restart]\n");
    return 2;
}
