#include "abut/dynamics/ccg.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "abut/dynamics/lanes.hpp"
#include "abut/dynamics/parallel.hpp"

namespace abut::dynamics {
namespace {

/// For each index in [0, n): the (row, place) pairs in which it occurs, rows increasing. The transpose of compressed rows.
struct Occurrences {
    std::vector<std::int32_t> offsets;
    std::vector<std::int32_t> rows;
    std::vector<std::int32_t> places;

    template <class IndexAt>  // index_at(row, place) for place in [begin(row), begin(row + 1))
    static Occurrences of(std::int32_t n, std::int32_t n_rows, std::span<const std::int32_t> begin, const IndexAt& index_at) {
        Occurrences found;
        found.offsets.assign(static_cast<std::size_t>(n) + 1, 0);
        const auto for_each = [&](auto&& visit) {
            for (std::int32_t row = 0; row < n_rows; ++row)
                for (std::int32_t place = begin[row]; place < begin[row + 1]; ++place)
                    if (const std::int32_t i = index_at(row, place); i >= 0) visit(i, row, place);
        };
        for_each([&](std::int32_t i, std::int32_t, std::int32_t) { ++found.offsets[i + 1]; });
        std::partial_sum(found.offsets.begin(), found.offsets.end(), found.offsets.begin());
        found.rows.resize(static_cast<std::size_t>(found.offsets.back()));
        found.places.resize(found.rows.size());
        std::vector<std::int32_t> next(found.offsets.begin(), found.offsets.end() - 1);
        for_each([&](std::int32_t i, std::int32_t row, std::int32_t place) {
            found.rows[next[i]] = row;
            found.places[next[i]++] = place;
        });
        return found;
    }
};

void sort_unique(std::vector<std::int32_t>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// The largest absolute row sum: bounds the operator in the largest-component norm.
template <int Dim>
double row_sum_norm(const Matrix<Dim>& m) {
    return m.cwiseAbs().rowwise().sum().maxCoeff();
}

}  // namespace

/// The arrays that the sweeps run over, in the order in which they run.
template <int Dim>
struct Ccg<Dim>::Impl {
    // faces; a boundary face has its one cell on both sides, no stiffness and an empty stencil, so that the sweeps need no branch
    std::vector<std::array<std::int32_t, 2>> sides;
    std::vector<FaceStencil<Dim>> stencils;
    std::vector<double> jump_stiffness;          // k_f = |f| eta / h_f
    std::vector<Lanes<Dim>> area_vector;         // |f| n_f, out of sides[0]
    std::vector<Lanes<Dim>> face_centroid;
    // cells
    std::vector<std::int32_t> cell_face_offsets;
    std::vector<std::int32_t> cell_faces;
    std::vector<double> measure;
    std::vector<double> lambda;
    std::vector<double> mu;
    std::vector<Lanes<Dim>> cell_centroid;
    Occurrences of_cell;                         // interior stencils that use a cell
    std::vector<double> of_cell_weight;
    // boundary faces
    std::vector<std::int32_t> boundary_faces;
    std::vector<std::int32_t> boundary_place;    // of a face, -1 inside
    BoundaryReconstruction<Dim> boundary;
    std::vector<LaneTensor<Dim>> boundary_weight;            // as boundary.weights
    std::vector<std::int32_t> boundary_cells;                // cells that some boundary face depends on
    Occurrences of_boundary_cell;                            // rows of `boundary` by place in boundary_cells
    std::vector<LaneTensor<Dim>> of_boundary_cell_weight;    // transposed
    std::vector<std::int32_t> boundary_cell_place;           // of a cell, -1 elsewhere
    std::vector<std::array<std::int32_t, 2>> body_boundary_cells;  // ranges of boundary_cells, one a body
    std::vector<double> body_amplification;                  // largest sum of |weights| of a boundary face
    BoundaryConditions<Dim> conditions;
    FaceConditions<Dim> face_conditions;
    std::vector<Vector<Dim>> boundary_centroid;
    std::vector<double> boundary_measure;
    std::vector<double> boundary_stiffness;
    StencilReport report;
    bool varies = false;
    // work: one value a face or a cell
    std::vector<Lanes<Dim>> u;             // displacement
    std::vector<Lanes<Dim>> relative;      // u_f - u_c of the first side
    std::vector<LaneTensor<Dim>> g;        // displacement gradient
    std::vector<Lanes<Dim>> jump_force;    // k [u]_f
    std::vector<LaneTensor<Dim>> s;        // sigma + stabilisation
    std::vector<Lanes<Dim>> direct;        // part of dV/du_c that the jumps give directly
    std::vector<Lanes<Dim>> y;             // face forces

    Impl(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials, const BoundaryConditions<Dim>& boundary_conditions);
    void set_faces(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials);
    void set_cells(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials);
    void set_boundary(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials);
    void set_motion_bound(const mesh::Mesh<Dim>& mesh);

    // The operator, one face or cell at a time ------------------------------------------------------------------------

    [[nodiscard]] Lanes<Dim> reconstruct(std::ptrdiff_t f) const {
        const Lanes<Dim> origin = u[sides[f][0]];
        Lanes<Dim> sum;
        for (int j = 0; j <= Dim; ++j) sum += stencils[f].weights[j] * (u[stencils[f].cells[j]] - origin);
        return sum;
    }

    [[nodiscard]] Lanes<Dim> reconstruct_boundary(std::ptrdiff_t b, const BoundaryLoad<Dim>& load) const {
        const Lanes<Dim> origin = u[sides[boundary_faces[b]][0]];
        Lanes<Dim> sum;
        for (std::int32_t i = boundary.offsets[b]; i < boundary.offsets[b + 1]; ++i)
            sum += boundary_weight[i] * (u[boundary.cells[i]] - origin);
        if (load.displacement.empty()) return sum;
        return sum + abut::dynamics::load<Dim>(Vector<Dim>(load.displacement[b] - boundary.deficit[b] * unload<Dim>(origin)));
    }

    [[nodiscard]] LaneTensor<Dim> gradient(std::ptrdiff_t c) const {
        LaneTensor<Dim> sum{};
        for (std::int32_t i = cell_face_offsets[c]; i < cell_face_offsets[c + 1]; ++i) {
            const std::int32_t f = cell_faces[i];
            const std::int32_t first = sides[f][0];
            if (first == c)
                sum.add_outer(relative[f], area_vector[f]);
            else
                sum.add_outer(relative[f] + (u[first] - u[c]), -area_vector[f]);
        }
        const double scale = 1.0 / measure[c];
        for (Lanes<Dim>& column : sum.col) column = scale * column;
        return sum;
    }

    [[nodiscard]] Lanes<Dim> jump(std::ptrdiff_t f) const {
        const auto [a, b] = sides[f];
        const Lanes<Dim> in_a = g[a] * (face_centroid[f] - cell_centroid[a]);
        const Lanes<Dim> in_b = g[b] * (face_centroid[f] - cell_centroid[b]);
        return (u[a] - u[b]) + (in_a - in_b);
    }

    [[nodiscard]] LaneTensor<Dim> elastic_stress(std::ptrdiff_t c) const {
        const LaneTensor<Dim>& gradient_c = g[c];
        double trace = 0.0;
        for (int j = 0; j < Dim; ++j) trace += gradient_c.col[j][j];
        LaneTensor<Dim> sigma;
        for (int j = 0; j < Dim; ++j) {
            Lanes<Dim> transposed;
            for (int i = 0; i < Dim; ++i) transposed.r[i] = gradient_c.col[i][j];
            sigma.col[j] = mu[c] * (gradient_c.col[j] + transposed);
            sigma.col[j].r[j] += lambda[c] * trace;
        }
        return sigma;
    }

    void stress(std::ptrdiff_t c) {
        LaneTensor<Dim> stabilisation{};
        Lanes<Dim> on_cell;
        for (std::int32_t i = cell_face_offsets[c]; i < cell_face_offsets[c + 1]; ++i) {
            const std::int32_t f = cell_faces[i];
            const Lanes<Dim> force = sides[f][0] == c ? jump_force[f] : -jump_force[f];
            stabilisation.add_outer(force, face_centroid[f] - cell_centroid[c]);
            on_cell += force;
        }
        const double scale = 1.0 / measure[c];
        const LaneTensor<Dim> sigma = elastic_stress(c);
        for (int j = 0; j < Dim; ++j) s[c].col[j] = sigma.col[j] + scale * stabilisation.col[j];
        direct[c] = on_cell;
    }

    [[nodiscard]] Lanes<Dim> face_force(std::ptrdiff_t f) const {
        const auto [a, b] = sides[f];
        LaneTensor<Dim> difference;
        for (int j = 0; j < Dim; ++j) difference.col[j] = s[a].col[j] - s[b].col[j];
        return difference * area_vector[f];
    }

    [[nodiscard]] Lanes<Dim> boundary_face_force(std::ptrdiff_t b, const BoundaryLoad<Dim>& load) const {
        const std::int32_t f = boundary_faces[b];
        const Lanes<Dim> force = s[sides[f][0]] * area_vector[f];
        return load.traction.empty() ? force : force - abut::dynamics::load<Dim>(load.traction[b]);
    }

    /// dV/du_c = jumps + R^T y.
    [[nodiscard]] Lanes<Dim> cell_gradient(std::ptrdiff_t c) const {
        Lanes<Dim> sum = direct[c];
        for (std::int32_t i = of_cell.offsets[c]; i < of_cell.offsets[c + 1]; ++i) sum += of_cell_weight[i] * y[of_cell.rows[i]];
        return sum;
    }

    [[nodiscard]] Lanes<Dim> boundary_cell_gradient(std::ptrdiff_t place) const {
        Lanes<Dim> sum;
        for (std::int32_t i = of_boundary_cell.offsets[place]; i < of_boundary_cell.offsets[place + 1]; ++i)
            sum += of_boundary_cell_weight[i] * y[boundary_faces[of_boundary_cell.rows[i]]];
        return sum;
    }

    // Whole sweeps ----------------------------------------------------------------------------------------------------

    void load_displacement(std::span<const Vector<Dim>> displacement) {
        parallel_each(static_cast<std::ptrdiff_t>(u.size()), [&](std::ptrdiff_t c) { u[c] = load<Dim>(displacement[c]); });
    }

    void add_corrections(const FaceCorrections<Dim>& corrections) {
        for (std::size_t i = 0; i < corrections.faces.size(); ++i)
            relative[boundary_faces[corrections.faces[i]]] += load<Dim>(corrections.displacement[i]);
    }

    void add_pair_forces(const FaceCorrections<Dim>& corrections) {
        if (corrections.force.empty()) return;
        for (std::size_t i = 0; i < corrections.faces.size(); ++i)
            y[boundary_faces[corrections.faces[i]]] += load<Dim>(corrections.force[i]);
    }

    void sweep_to_jumps(std::span<const Vector<Dim>> displacement, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections) {
        load_displacement(displacement);
        parallel_each(static_cast<std::ptrdiff_t>(sides.size()), [&](std::ptrdiff_t f) { relative[f] = reconstruct(f); });
        parallel_each(boundary.size(), [&](std::ptrdiff_t b) { relative[boundary_faces[b]] = reconstruct_boundary(b, load); });
        add_corrections(corrections);
        parallel_each(static_cast<std::ptrdiff_t>(measure.size()), [&](std::ptrdiff_t c) { g[c] = gradient(c); });
        parallel_each(static_cast<std::ptrdiff_t>(sides.size()), [&](std::ptrdiff_t f) { jump_force[f] = jump_stiffness[f] * jump(f); });
    }

    void sweep_to_forces(const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections) {
        parallel_each(static_cast<std::ptrdiff_t>(measure.size()), [&](std::ptrdiff_t c) { stress(c); });
        parallel_each(static_cast<std::ptrdiff_t>(sides.size()), [&](std::ptrdiff_t f) { y[f] = face_force(f); });
        parallel_each(boundary.size(), [&](std::ptrdiff_t b) { y[boundary_faces[b]] = boundary_face_force(b, load); });
        add_pair_forces(corrections);
    }

    void sweep_to_cells(std::span<Vector<Dim>> result) {
        parallel_each(static_cast<std::ptrdiff_t>(measure.size()), [&](std::ptrdiff_t c) { result[c] = unload<Dim>(cell_gradient(c)); });
        parallel_each(static_cast<std::ptrdiff_t>(boundary_cells.size()),
                      [&](std::ptrdiff_t place) { result[boundary_cells[place]] += unload<Dim>(boundary_cell_gradient(place)); });
    }

    // The same on a region --------------------------------------------------------------------------------------------

    void evaluate_to_stress(const Region<Dim>& region, std::span<const Vector<Dim>> displacement, const BoundaryLoad<Dim>& load,
                            const FaceCorrections<Dim>& corrections) {
        for (const std::int32_t c : region.loaded_cells) u[c] = abut::dynamics::load<Dim>(displacement[c]);
        for (const std::int32_t f : region.reconstructed) relative[f] = reconstruct(f);
        for (const std::int32_t b : region.reconstructed_boundary) relative[boundary_faces[b]] = reconstruct_boundary(b, load);
        add_corrections(corrections);
        for (const std::int32_t c : region.gradient_cells) g[c] = gradient(c);
        for (const std::int32_t f : region.jump_faces) jump_force[f] = jump_stiffness[f] * jump(f);
        for (const std::int32_t c : region.stress_cells) stress(c);
    }

    void complete(Region<Dim>& region) const;

    // How face forces answer to face displacements --------------------------------------------------------------------

    /// Places in the boundary of all boundary faces that share an energy term with b, itself included, increasing.
    [[nodiscard]] std::vector<std::int32_t> coupled_faces(std::int32_t b) const;
    /// d[u]_f / dw_b for an interior face f of the cell of boundary face b: this number times the identity.
    [[nodiscard]] double jump_answer(std::int32_t f, std::int32_t b) const;
    [[nodiscard]] Matrix<Dim> coupling_block(std::int32_t b, std::int32_t other) const;

    [[nodiscard]] double free_motion_bound(std::span<const Vector<Dim>> from, std::span<const Vector<Dim>> to) const;
    [[nodiscard]] double largest_motion(std::span<const Vector<Dim>> u_from, const BoundaryLoad<Dim>& load_from,
                                        std::span<const Vector<Dim>> u_to, const BoundaryLoad<Dim>& load_to) const;
    [[nodiscard]] std::span<const std::int32_t> faces_of(std::int32_t c) const {
        return {cell_faces.data() + cell_face_offsets[c], static_cast<std::size_t>(cell_face_offsets[c + 1] - cell_face_offsets[c])};
    }
};

template <int Dim>
Ccg<Dim>::Impl::Impl(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials, const BoundaryConditions<Dim>& boundary_conditions)
    : conditions(boundary_conditions), face_conditions(sort_to_faces(mesh, boundary_conditions)) {
    set_faces(mesh, materials);
    set_cells(mesh, materials);
    set_boundary(mesh, materials);
    set_motion_bound(mesh);
    for (const auto& condition : conditions.dirichlet) varies = varies || condition.history;
    for (const auto& condition : conditions.traction) varies = varies || condition.history;
    u.resize(measure.size());
    g.resize(measure.size());
    s.resize(measure.size());
    direct.resize(measure.size());
    relative.resize(sides.size());
    jump_force.resize(sides.size());
    y.resize(sides.size());
}

template <int Dim>
void Ccg<Dim>::Impl::set_faces(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials) {
    const auto n_faces = static_cast<std::size_t>(mesh.n_faces());
    sides = mesh.face_cells;
    stencils.resize(n_faces);
    jump_stiffness.assign(n_faces, 0.0);
    boundary_place.assign(n_faces, -1);
    std::vector<std::int32_t> interior;
    for (std::int32_t f = 0; f < mesh.n_faces(); ++f) {
        area_vector.push_back(load<Dim>(Vector<Dim>(mesh.face_measure[f] * mesh.face_normal[f])));
        face_centroid.push_back(load<Dim>(mesh.face_centroid[f]));
        if (mesh.is_boundary(f)) {
            boundary_place[f] = static_cast<std::int32_t>(boundary_faces.size());
            boundary_faces.push_back(f);
            sides[f][1] = sides[f][0];
            stencils[f].cells.fill(sides[f][0]);
            stencils[f].weights.fill(0.0);
            continue;
        }
        interior.push_back(f);
        // |f| eta / h_f with h_f = |f|^(1/(d-1))
        const double eta = materials[mesh.cell_body[sides[f][0]]].stabilisation();
        jump_stiffness[f] = Dim == 2 ? eta : eta * std::sqrt(mesh.face_measure[f]);
    }
    const auto selected = select_stencils<Dim>(mesh, interior, report);
    for (std::size_t i = 0; i < interior.size(); ++i) stencils[interior[i]] = selected[i];
}

template <int Dim>
void Ccg<Dim>::Impl::set_cells(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials) {
    cell_face_offsets = mesh.cell_faces.offsets;
    cell_faces = mesh.cell_faces.values;
    measure = mesh.cell_measure;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        lambda.push_back(materials[mesh.cell_body[c]].lambda());
        mu.push_back(materials[mesh.cell_body[c]].mu());
        cell_centroid.push_back(load<Dim>(mesh.cell_centroid[c]));
    }
    std::vector<std::int32_t> begin(static_cast<std::size_t>(mesh.n_faces()) + 1);
    for (std::size_t f = 0; f < begin.size(); ++f) begin[f] = static_cast<std::int32_t>(f) * (Dim + 1);
    of_cell = Occurrences::of(mesh.n_cells(), mesh.n_faces(), begin, [&](std::int32_t f, std::int32_t place) {
        return boundary_place[f] >= 0 ? -1 : stencils[f].cells[place - begin[f]];
    });
    for (std::size_t i = 0; i < of_cell.rows.size(); ++i)
        of_cell_weight.push_back(stencils[of_cell.rows[i]].weights[of_cell.places[i] - begin[of_cell.rows[i]]]);
    of_cell.places.clear();
}

template <int Dim>
void Ccg<Dim>::Impl::set_boundary(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials) {
    boundary = dynamics::reconstruct_boundary<Dim>(mesh, stencils, materials, face_conditions, conditions.neumann);
    for (const Matrix<Dim>& weight : boundary.weights) boundary_weight.push_back(load<Dim>(weight));
    boundary_cells = boundary.cells;
    sort_unique(boundary_cells);
    boundary_cell_place.assign(measure.size(), -1);
    for (std::size_t i = 0; i < boundary_cells.size(); ++i) boundary_cell_place[boundary_cells[i]] = static_cast<std::int32_t>(i);
    of_boundary_cell = Occurrences::of(static_cast<std::int32_t>(boundary_cells.size()), boundary.size(), boundary.offsets,
                                       [&](std::int32_t, std::int32_t place) { return boundary_cell_place[boundary.cells[place]]; });
    for (const std::int32_t place : of_boundary_cell.places)
        of_boundary_cell_weight.push_back(load<Dim>(Matrix<Dim>(boundary.weights[place].transpose())));
    of_boundary_cell.places.clear();
    for (const std::int32_t f : boundary_faces) {
        const std::int32_t c = mesh.face_cells[f][0];
        boundary_centroid.push_back(mesh.face_centroid[f]);
        boundary_measure.push_back(mesh.face_measure[f]);
        boundary_stiffness.push_back(materials[mesh.cell_body[c]].wave_modulus() * mesh.face_measure[f] / mesh.cell_measure[c]);
    }
}

template <int Dim>
void Ccg<Dim>::Impl::set_motion_bound(const mesh::Mesh<Dim>& mesh) {
    body_amplification.assign(static_cast<std::size_t>(mesh.n_bodies()), 0.0);
    for (std::int32_t b = 0; b < boundary.size(); ++b) {
        double sum = 0.0;
        for (std::int32_t i = boundary.offsets[b]; i < boundary.offsets[b + 1]; ++i) sum += row_sum_norm<Dim>(boundary.weights[i]);
        double& largest = body_amplification[mesh.cell_body[mesh.face_cells[boundary_faces[b]][0]]];
        largest = std::max(largest, sum);
    }
    std::int32_t begin = 0;
    for (std::int32_t body = 0; body < mesh.n_bodies(); ++body) {
        auto end = begin;
        while (end < static_cast<std::int32_t>(boundary_cells.size()) && mesh.cell_body[boundary_cells[end]] == body) ++end;
        body_boundary_cells.push_back({begin, end});
        begin = end;
    }
}

/// From the cells whose stress is wanted back to everything it depends on.
template <int Dim>
void Ccg<Dim>::Impl::complete(Region<Dim>& region) const {
    const auto faces_of = [&](const std::vector<std::int32_t>& cells) {
        std::vector<std::int32_t> faces;
        for (const std::int32_t c : cells)
            faces.insert(faces.end(), cell_faces.begin() + cell_face_offsets[c], cell_faces.begin() + cell_face_offsets[c + 1]);
        sort_unique(faces);
        return faces;
    };
    sort_unique(region.stress_cells);
    region.jump_faces = faces_of(region.stress_cells);
    region.gradient_cells = region.stress_cells;
    for (const std::int32_t f : region.jump_faces) region.gradient_cells.insert(region.gradient_cells.end(), sides[f].begin(), sides[f].end());
    sort_unique(region.gradient_cells);
    region.loaded_cells = region.gradient_cells;
    for (const std::int32_t f : faces_of(region.gradient_cells)) {
        region.loaded_cells.insert(region.loaded_cells.end(), sides[f].begin(), sides[f].end());
        if (const std::int32_t b = boundary_place[f]; b >= 0) {
            region.reconstructed_boundary.push_back(b);
            region.loaded_cells.insert(region.loaded_cells.end(), boundary.cells.begin() + boundary.offsets[b],
                                       boundary.cells.begin() + boundary.offsets[b + 1]);
        } else {
            region.reconstructed.push_back(f);
            region.loaded_cells.insert(region.loaded_cells.end(), stencils[f].cells.begin(), stencils[f].cells.end());
        }
    }
    sort_unique(region.loaded_cells);
}

template <int Dim>
std::vector<std::int32_t> Ccg<Dim>::Impl::coupled_faces(std::int32_t b) const {
    const std::int32_t cell = sides[boundary_faces[b]][0];
    std::vector<std::int32_t> coupled;
    for (const std::int32_t f : faces_of(cell))
        for (const std::int32_t c : sides[f])
            for (const std::int32_t other : faces_of(c))
                if (boundary_place[other] >= 0) coupled.push_back(boundary_place[other]);
    sort_unique(coupled);
    return coupled;
}

template <int Dim>
double Ccg<Dim>::Impl::jump_answer(std::int32_t f, std::int32_t b) const {
    const std::int32_t cell = sides[boundary_faces[b]][0];
    const double sign = sides[f][0] == cell ? 1.0 : -1.0;
    return sign * dot(area_vector[boundary_faces[b]], face_centroid[f] - cell_centroid[cell]) / measure[cell];
}

template <int Dim>
Matrix<Dim> Ccg<Dim>::Impl::coupling_block(std::int32_t b, std::int32_t other) const {
    const std::int32_t cell = sides[boundary_faces[b]][0];
    const std::int32_t other_cell = sides[boundary_faces[other]][0];
    Matrix<Dim> block = Matrix<Dim>::Zero();
    if (cell == other_cell) {
        const Vector<Dim> a_f = unload<Dim>(area_vector[boundary_faces[b]]);
        const Vector<Dim> a_g = unload<Dim>(area_vector[boundary_faces[other]]);
        block = (lambda[cell] * a_f * a_g.transpose() + mu[cell] * (a_f.dot(a_g) * Matrix<Dim>::Identity() + a_g * a_f.transpose())) / measure[cell];
    }
    for (const std::int32_t f : faces_of(cell))
        if (sides[f][0] == other_cell || sides[f][1] == other_cell)
            block += jump_stiffness[f] * jump_answer(f, b) * jump_answer(f, other) * Matrix<Dim>::Identity();
    return block;
}

/// û_f moves as sum_j W_j du_j, and the weights of a row sum to the identity: with the motion m of one cell of the body
/// taken out, |dû_f - m| <= sum |W_j| max |du_j - m|.
template <int Dim>
double Ccg<Dim>::Impl::free_motion_bound(std::span<const Vector<Dim>> from, std::span<const Vector<Dim>> to) const {
    double bound = 0.0;
    for (std::size_t body = 0; body < body_boundary_cells.size(); ++body) {
        const auto [begin, end] = body_boundary_cells[body];
        if (begin == end) continue;
        const Vector<Dim> common = to[boundary_cells[begin]] - from[boundary_cells[begin]];
        double deviation = 0.0;
        for (std::int32_t i = begin; i < end; ++i) {
            const std::int32_t c = boundary_cells[i];
            deviation = std::max(deviation, (to[c] - from[c] - common).cwiseAbs().maxCoeff());
        }
        bound = std::max(bound, common.norm() + std::sqrt(static_cast<double>(Dim)) * body_amplification[body] * deviation);
    }
    return bound;
}

template <int Dim>
double Ccg<Dim>::Impl::largest_motion(std::span<const Vector<Dim>> u_from, const BoundaryLoad<Dim>& load_from,
                                      std::span<const Vector<Dim>> u_to, const BoundaryLoad<Dim>& load_to) const {
    double largest = 0.0;
    for (std::int32_t b = 0; b < boundary.size(); ++b) {
        Vector<Dim> motion = Vector<Dim>::Zero();
        if (!load_to.displacement.empty()) motion = load_to.displacement[b] - load_from.displacement[b];
        for (std::int32_t i = boundary.offsets[b]; i < boundary.offsets[b + 1]; ++i)
            motion += boundary.weights[i] * (u_to[boundary.cells[i]] - u_from[boundary.cells[i]]);
        largest = std::max(largest, motion.norm());
    }
    return largest;
}

template <int Dim>
Ccg<Dim>::Ccg(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials, const BoundaryConditions<Dim>& conditions)
    : impl_(std::make_unique<Impl>(mesh, materials, conditions)) {}

template <int Dim>
Ccg<Dim>::~Ccg() = default;
template <int Dim>
Ccg<Dim>::Ccg(Ccg&&) noexcept = default;
template <int Dim>
Ccg<Dim>& Ccg<Dim>::operator=(Ccg&&) noexcept = default;

template <int Dim>
std::int32_t Ccg<Dim>::n_cells() const {
    return static_cast<std::int32_t>(impl_->measure.size());
}

template <int Dim>
std::int32_t Ccg<Dim>::n_boundary() const {
    return impl_->boundary.size();
}

template <int Dim>
bool Ccg<Dim>::load_varies() const {
    return impl_->varies;
}

template <int Dim>
BoundaryLoad<Dim> Ccg<Dim>::load_at(double displacement_time, double traction_time) const {
    const Impl& m = *impl_;
    BoundaryLoad<Dim> load;
    if (m.conditions.dirichlet.empty() && m.conditions.traction.empty()) return load;
    const auto n = static_cast<std::size_t>(m.boundary.size());
    std::vector<Vector<Dim>> prescribed(n, Vector<Dim>::Zero());
    std::vector<Vector<Dim>> traction(n, Vector<Dim>::Zero());
    const auto value_at = [&](const auto& condition, double time, std::int32_t b) {
        return condition.history ? condition.history(time, m.boundary_centroid[b]) : condition.value;
    };
    for (std::size_t i = 0; i < m.conditions.dirichlet.size(); ++i)
        for (const auto& [b, projector] : m.face_conditions.dirichlet[i]) prescribed[b] += projector * value_at(m.conditions.dirichlet[i], displacement_time, b);
    for (std::size_t i = 0; i < m.conditions.traction.size(); ++i)
        for (const std::int32_t b : m.face_conditions.traction[i]) traction[b] += value_at(m.conditions.traction[i], traction_time, b);

    load.displacement.assign(n, Vector<Dim>::Zero());
    load.traction.assign(n, Vector<Dim>::Zero());
    for (std::size_t b = 0; b < n; ++b) {
        load.traction[b] = m.boundary_measure[b] * traction[b];
        for (std::int32_t i = m.boundary.load_offsets[b]; i < m.boundary.load_offsets[b + 1]; ++i)
            load.displacement[b] += m.boundary.from_displacement[i] * prescribed[m.boundary.load_faces[i]] +
                                    m.boundary.from_traction[i] * traction[m.boundary.load_faces[i]];
    }
    return load;
}

template <int Dim>
BoundaryLoad<Dim> Ccg<Dim>::load_free() const {
    if (impl_->conditions.dirichlet.empty() && impl_->conditions.traction.empty()) return {};
    const std::vector<Vector<Dim>> zero(static_cast<std::size_t>(impl_->boundary.size()), Vector<Dim>::Zero());
    return {zero, zero};
}

template <int Dim>
std::span<const Matrix<Dim>> Ccg<Dim>::prescribed() const {
    return impl_->face_conditions.prescribed;
}

template <int Dim>
bool Ccg<Dim>::has_prescribed_face(std::int32_t cell) const {
    return std::ranges::any_of(impl_->faces_of(cell), [&](std::int32_t f) {
        const std::int32_t b = impl_->boundary_place[f];
        return b >= 0 && !impl_->face_conditions.prescribed[b].isZero(0.0);
    });
}

template <int Dim>
void Ccg<Dim>::boundary_displacement(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, std::span<Vector<Dim>> displacement) {
    Impl& m = *impl_;
    m.load_displacement(u);
    parallel_each(m.boundary.size(), [&](std::ptrdiff_t b) {
        displacement[b] = u[m.sides[m.boundary_faces[b]][0]] + unload<Dim>(m.reconstruct_boundary(b, load));
    });
}

template <int Dim>
void Ccg<Dim>::gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                        std::span<Vector<Dim>> result) {
    impl_->sweep_to_jumps(u, load, corrections);
    impl_->sweep_to_forces(load, corrections);
    impl_->sweep_to_cells(result);
}

template <int Dim>
Vector<Dim> Ccg<Dim>::boundary_force(std::int32_t boundary_face) const {
    return unload<Dim>(impl_->y[impl_->boundary_faces[boundary_face]]);
}

template <int Dim>
double Ccg<Dim>::potential(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections) {
    Impl& m = *impl_;
    m.sweep_to_jumps(u, load, corrections);
    const double elastic = ordered_sum(static_cast<std::ptrdiff_t>(m.measure.size()), 0.0, [&](std::ptrdiff_t c) {
        const LaneTensor<Dim> sigma = m.elastic_stress(c);
        double density = 0.0;
        for (int j = 0; j < Dim; ++j) density += dot(sigma.col[j], m.g[c].col[j]);
        return m.measure[c] * density;
    });
    const double stabilisation = ordered_sum(static_cast<std::ptrdiff_t>(m.sides.size()), 0.0, [&](std::ptrdiff_t f) {
        return m.jump_stiffness[f] > 0.0 ? dot(m.jump_force[f], m.jump_force[f]) / m.jump_stiffness[f] : 0.0;
    });
    double work = 0.0;
    for (std::size_t b = 0; b < load.traction.size(); ++b) {
        const std::int32_t f = m.boundary_faces[b];
        work += load.traction[b].dot(unload<Dim>(m.relative[f] + m.u[m.sides[f][0]]));
    }
    return 0.5 * (elastic + stabilisation) - work;
}

template <int Dim>
Region<Dim> Ccg<Dim>::region_of_faces(std::span<const std::int32_t> faces) const {
    Region<Dim> region;
    region.faces.assign(faces.begin(), faces.end());
    for (const std::int32_t b : faces) region.stress_cells.push_back(impl_->sides[impl_->boundary_faces[b]][0]);
    impl_->complete(region);
    return region;
}

template <int Dim>
Region<Dim> Ccg<Dim>::region_of_cells(std::span<const std::int32_t> cells) const {
    const Impl& m = *impl_;
    Region<Dim> region;
    region.cells.assign(cells.begin(), cells.end());
    for (const std::int32_t c : cells) {
        region.stress_cells.push_back(c);
        for (std::int32_t i = m.of_cell.offsets[c]; i < m.of_cell.offsets[c + 1]; ++i) region.force_faces.push_back(m.of_cell.rows[i]);
        if (const std::int32_t place = m.boundary_cell_place[c]; place >= 0)
            for (std::int32_t i = m.of_boundary_cell.offsets[place]; i < m.of_boundary_cell.offsets[place + 1]; ++i)
                region.faces.push_back(m.of_boundary_cell.rows[i]);
    }
    sort_unique(region.force_faces);
    sort_unique(region.faces);
    for (const std::int32_t f : region.force_faces) region.stress_cells.insert(region.stress_cells.end(), m.sides[f].begin(), m.sides[f].end());
    for (const std::int32_t b : region.faces) region.stress_cells.push_back(m.sides[m.boundary_faces[b]][0]);
    m.complete(region);
    return region;
}

template <int Dim>
void Ccg<Dim>::evaluate_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                              std::span<Vector<Dim>> displacement, std::span<Vector<Dim>> force) {
    Impl& m = *impl_;
    m.evaluate_to_stress(region, u, load, {});
    for (std::size_t i = 0; i < region.faces.size(); ++i) {
        const std::int32_t f = m.boundary_faces[region.faces[i]];
        displacement[i] = u[m.sides[f][0]] + unload<Dim>(m.relative[f]);
        force[i] = unload<Dim>(m.boundary_face_force(region.faces[i], load));
    }
}

template <int Dim>
void Ccg<Dim>::evaluate_cells(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                              const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    Impl& m = *impl_;
    m.evaluate_to_stress(region, u, load, corrections);
    for (const std::int32_t f : region.force_faces) m.y[f] = m.face_force(f);
    for (const std::int32_t b : region.faces) m.y[m.boundary_faces[b]] = m.boundary_face_force(b, load);
    m.add_pair_forces(corrections);
    for (std::size_t i = 0; i < region.cells.size(); ++i) {
        const std::int32_t c = region.cells[i];
        Lanes<Dim> sum = m.cell_gradient(c);
        if (const std::int32_t place = m.boundary_cell_place[c]; place >= 0) sum += m.boundary_cell_gradient(place);
        result[i] = unload<Dim>(sum);
    }
}

template <int Dim>
contact::FaceCoupling<Dim> Ccg<Dim>::coupling(std::span<const std::int32_t> faces) const {
    const Impl& m = *impl_;
    const auto place_of = [&](std::int32_t b) {
        const auto at = std::lower_bound(faces.begin(), faces.end(), b);
        return at != faces.end() && *at == b ? static_cast<std::int32_t>(at - faces.begin()) : -1;
    };
    contact::FaceCoupling<Dim> coupling;
    for (const std::int32_t b : faces) {
        std::vector<std::int32_t> coupled = m.coupled_faces(b);
        for (const std::int32_t other : coupled) {
            const std::int32_t place = place_of(other);
            if (place < 0) continue;
            coupling.columns.push_back(place);
            coupling.blocks.push_back(m.coupling_block(b, other));
        }
        coupling.offsets.push_back(static_cast<std::int32_t>(coupling.columns.size()));
    }
    return coupling;
}

template <int Dim>
double Ccg<Dim>::motion_bound(std::span<const Vector<Dim>> u_from, const BoundaryLoad<Dim>& load_from, std::span<const Vector<Dim>> u_to,
                              const BoundaryLoad<Dim>& load_to) const {
    return load_to.displacement.empty() ? impl_->free_motion_bound(u_from, u_to) : impl_->largest_motion(u_from, load_from, u_to, load_to);
}

template <int Dim>
double Ccg<Dim>::largest_motion(std::span<const Vector<Dim>> u_from, const BoundaryLoad<Dim>& load_from, std::span<const Vector<Dim>> u_to,
                                const BoundaryLoad<Dim>& load_to) const {
    return impl_->largest_motion(u_from, load_from, u_to, load_to);
}

template <int Dim>
Matrix<Dim> Ccg<Dim>::displacement_gradient(std::int32_t cell) const {
    Matrix<Dim> gradient;
    for (int j = 0; j < Dim; ++j) gradient.col(j) = unload<Dim>(impl_->g[cell].col[j]);
    return gradient;
}

template <int Dim>
Matrix<Dim> Ccg<Dim>::stress(std::int32_t cell) const {
    const LaneTensor<Dim> sigma = impl_->elastic_stress(cell);
    Matrix<Dim> stress;
    for (int j = 0; j < Dim; ++j) stress.col(j) = unload<Dim>(sigma.col[j]);
    return stress;
}

template <int Dim>
const StencilReport& Ccg<Dim>::stencil_report() const {
    return impl_->report;
}

template <int Dim>
const BoundaryReconstruction<Dim>& Ccg<Dim>::boundary() const {
    return impl_->boundary;
}

template <int Dim>
std::span<const FaceStencil<Dim>> Ccg<Dim>::stencils() const {
    return impl_->stencils;
}

template <int Dim>
double Ccg<Dim>::normal_stiffness(std::int32_t boundary_face) const {
    return impl_->boundary_stiffness[boundary_face];
}

template <int Dim>
std::span<const std::int32_t> Ccg<Dim>::cells_of(std::int32_t boundary_face) const {
    const auto& offsets = impl_->boundary.offsets;
    return {impl_->boundary.cells.data() + offsets[boundary_face], static_cast<std::size_t>(offsets[boundary_face + 1] - offsets[boundary_face])};
}

template class Ccg<2>;
template class Ccg<3>;

}  // namespace abut::dynamics
