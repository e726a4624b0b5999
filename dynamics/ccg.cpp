#include "abut/dynamics/ccg.hpp"

#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "abut/dynamics/lanes.hpp"
#include "abut/dynamics/parallel.hpp"
#include "abut/dynamics/sweep_schedule.hpp"

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

/// Where a face is and how its jump is penalised.
template <int Dim>
struct FacePlace {
    std::array<double, Dim> centroid;  // x_f
    double jump_stiffness = 0.0;       // k_f = |f| eta / h_f
};

template <int Dim>
struct CellGeometry {
    double inverse_measure;  // 1/|c|
    double lambda;
    double mu;
    std::array<double, Dim> centroid;  // x_c
};

/// Elements of a region that are worth a task of their own.
inline constexpr std::ptrdiff_t region_grain = 256;

/// A face as one of its cells has it.
class Slot {
public:
    Slot(std::int32_t face, bool outward, std::int32_t neighbour) : face_(outward ? face : ~face), neighbour_(neighbour) {}
    [[nodiscard]] std::int32_t face() const { return face_ < 0 ? ~face_ : face_; }
    [[nodiscard]] bool outward() const { return face_ >= 0; }  // the normal of the face points out of the cell
    [[nodiscard]] double sign() const { return outward() ? 1.0 : -1.0; }
    [[nodiscard]] std::int32_t neighbour() const { return neighbour_; }  // cell on the other side; the cell itself on the boundary

private:
    std::int32_t face_;
    std::int32_t neighbour_;
};

/// Cells a chunk: its work arrays fit the second-level cache several times.
inline constexpr std::int32_t chunk_size = 512;

}  // namespace

/// The arrays that the sweeps run over, in the order in which they run.
template <int Dim>
struct Ccg<Dim>::Impl {
    // Faces. A boundary face has its one cell on both sides, no stiffness and an empty stencil: the sweeps need no branch.
    std::vector<std::array<std::int32_t, 2>> sides;
    std::vector<FaceStencil<Dim>> stencils;
    std::vector<std::array<double, Dim>> area_vectors;    // |f| n_f, out of the first side
    std::vector<FacePlace<Dim>> face_places;
    // Slots: the faces of the cells, cell by cell.
    std::vector<std::int32_t> slot_offsets;      // (n_cells + 1)
    std::vector<Slot> slots;
    // Cells.
    std::vector<CellGeometry<Dim>> cell_geometry;
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
    // Work arrays of registers.
    std::vector<double> u;           // displacement, by cell
    std::vector<double> relative;    // u_f - u_c of the first side, by face
    std::vector<double> g;           // displacement gradient, by cell
    std::vector<double> jump_force;  // k_f [u]_f, by face
    std::vector<double> s;           // S_c: the stress with the stabilisation, by cell
    std::vector<double> direct;      // part of dV/du_c that the jumps give directly, by cell
    std::vector<double> y;           // face forces, by face
    std::vector<double> face_correction;  // delta_f, by boundary face; zero but during a sweep
    std::vector<double> face_pair_force;
    // Where a chunk begins among the cells, faces, boundary faces and boundary_cells; one more at the end.
    struct Chunk {
        std::int32_t cell, face, boundary, boundary_cell;
    };
    std::vector<Chunk> chunks;
    SweepSchedule<6> schedule;

    Impl(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials, const BoundaryConditions<Dim>& boundary_conditions);
    void set_faces(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials);
    void set_cells(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials);
    void set_boundary(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials);
    void set_motion_bound(const mesh::Mesh<Dim>& mesh);
    void set_chunks();

    // The operator, one face or cell at a time ------------------------------------------------------------------------

    [[nodiscard]] std::ptrdiff_t n_cells() const { return static_cast<std::ptrdiff_t>(cell_geometry.size()); }
    [[nodiscard]] std::ptrdiff_t n_faces() const { return static_cast<std::ptrdiff_t>(sides.size()); }

    [[nodiscard]] Lanes<Dim> displacement(std::ptrdiff_t c) const { return load<Dim>(u, c); }

    [[nodiscard]] Lanes<Dim> reconstruct(std::ptrdiff_t f) const {
        const Lanes<Dim> origin = displacement(sides[f][0]);
        Lanes<Dim> sum;
        for (int j = 0; j <= Dim; ++j) sum += stencils[f].weights[j] * (displacement(stencils[f].cells[j]) - origin);
        return sum;
    }

    [[nodiscard]] Lanes<Dim> reconstruct_boundary(std::ptrdiff_t b, const BoundaryLoad<Dim>& boundary_load) const {
        const Lanes<Dim> origin = displacement(sides[boundary_faces[b]][0]);
        Lanes<Dim> sum;
        for (std::int32_t i = boundary.offsets[b]; i < boundary.offsets[b + 1]; ++i)
            sum += boundary_weight[i] * (displacement(boundary.cells[i]) - origin);
        sum += load<Dim>(face_correction, b);
        if (boundary_load.displacement.empty()) return sum;
        return sum + load<Dim>(Vector<Dim>(boundary_load.displacement[b] - boundary.deficit[b] * unload<Dim>(origin)));
    }

    [[nodiscard]] LaneTensor<Dim> gradient(std::ptrdiff_t c) const {
        LaneTensor<Dim> sum{};
        const Lanes<Dim> u_c = displacement(c);
        for (std::int32_t i = slot_offsets[c]; i < slot_offsets[c + 1]; ++i) {
            const Slot& slot = slots[i];
            // relative[f] is seen from the first side of f; the difference is exactly zero when that is c.
            const std::int32_t first = slot.outward() ? static_cast<std::int32_t>(c) : slot.neighbour();
            const Lanes<Dim> seen_from_c = load<Dim>(relative, slot.face()) + (displacement(first) - u_c);
            sum.add_outer(slot.sign() * seen_from_c, area_vectors[slot.face()]);
        }
        for (Lanes<Dim>& column : sum.col) column = cell_geometry[c].inverse_measure * column;
        return sum;
    }

    /// x_f - x_c
    [[nodiscard]] std::array<double, Dim> arm(const FacePlace<Dim>& face, std::ptrdiff_t c) const {
        std::array<double, Dim> difference;
        for (int j = 0; j < Dim; ++j) difference[j] = face.centroid[j] - cell_geometry[c].centroid[j];
        return difference;
    }

    /// k_f [u]_f, [u]_f = I_1(x_f) - I_2(x_f)
    [[nodiscard]] Lanes<Dim> jump(std::ptrdiff_t f) const {
        const auto [a, b] = sides[f];
        const FacePlace<Dim>& face = face_places[f];
        const Lanes<Dim> in_a = load_tensor<Dim>(g, a).times(arm(face, a));
        const Lanes<Dim> in_b = load_tensor<Dim>(g, b).times(arm(face, b));
        return face.jump_stiffness * ((displacement(a) - displacement(b)) + (in_a - in_b));
    }

    [[nodiscard]] LaneTensor<Dim> elastic_stress(std::ptrdiff_t c, const LaneTensor<Dim>& g_c) const {
        const LaneTensor<Dim> transposed = g_c.transposed();
        double trace = 0.0;
        for (int j = 0; j < Dim; ++j) trace += g_c.col[j][j];
        LaneTensor<Dim> sigma;
        for (int j = 0; j < Dim; ++j) {
            sigma.col[j] = cell_geometry[c].mu * (g_c.col[j] + transposed.col[j]);
            sigma.col[j].r[j] += cell_geometry[c].lambda * trace;
        }
        return sigma;
    }

    /// S_c = sigma_c + (1/|c|) sum of k [u] (x) (x_f - x_c), and the sum of k [u].
    void stress(std::ptrdiff_t c) {
        LaneTensor<Dim> sum{};
        Lanes<Dim> on_cell;
        for (std::int32_t i = slot_offsets[c]; i < slot_offsets[c + 1]; ++i) {
            const std::int32_t f = slots[i].face();
            const Lanes<Dim> force = slots[i].sign() * load<Dim>(jump_force, f);
            sum.add_outer(force, arm(face_places[f], c));
            on_cell += force;
        }
        const LaneTensor<Dim> sigma = elastic_stress(c, load_tensor<Dim>(g, c));
        for (int j = 0; j < Dim; ++j) sum.col[j] = sigma.col[j] + cell_geometry[c].inverse_measure * sum.col[j];
        store_tensor(sum, s, c);
        store(on_cell, direct, c);
    }

    /// 1/2 |c| eps:C:eps
    [[nodiscard]] double elastic_energy(std::ptrdiff_t c) const {
        const LaneTensor<Dim> g_c = load_tensor<Dim>(g, c);
        const LaneTensor<Dim> sigma = elastic_stress(c, g_c);
        double density = 0.0;
        for (int j = 0; j < Dim; ++j) density += dot(sigma.col[j], g_c.col[j]);
        return 0.5 * density / cell_geometry[c].inverse_measure;
    }

    /// 1/2 k_f |[u]_f|^2
    [[nodiscard]] double jump_energy(std::ptrdiff_t f) const {
        const Lanes<Dim> force = load<Dim>(jump_force, f);
        const double stiffness = face_places[f].jump_stiffness;
        return stiffness > 0.0 ? 0.5 * dot(force, force) / stiffness : 0.0;
    }

    [[nodiscard]] Lanes<Dim> face_force(std::ptrdiff_t f) const {
        const auto [a, b] = sides[f];
        LaneTensor<Dim> difference = load_tensor<Dim>(s, a);
        const LaneTensor<Dim> other = load_tensor<Dim>(s, b);
        for (int j = 0; j < Dim; ++j) difference.col[j] -= other.col[j];
        return difference.times(area_vectors[f]);
    }

    [[nodiscard]] Lanes<Dim> boundary_face_force(std::ptrdiff_t b, const BoundaryLoad<Dim>& boundary_load) const {
        const std::int32_t f = boundary_faces[b];
        const Lanes<Dim> force = load_tensor<Dim>(s, sides[f][0]).times(area_vectors[f]) + load<Dim>(face_pair_force, b);
        return boundary_load.traction.empty() ? force : force - load<Dim>(boundary_load.traction[b]);
    }

    /// dV/du_c = jumps + R^T y.
    [[nodiscard]] Lanes<Dim> cell_gradient(std::ptrdiff_t c) const {
        Lanes<Dim> sum = load<Dim>(direct, c);
        for (std::int32_t i = of_cell.offsets[c]; i < of_cell.offsets[c + 1]; ++i) sum += of_cell_weight[i] * load<Dim>(y, of_cell.rows[i]);
        return sum;
    }

    [[nodiscard]] Lanes<Dim> boundary_cell_gradient(std::ptrdiff_t place) const {
        Lanes<Dim> sum;
        for (std::int32_t i = of_boundary_cell.offsets[place]; i < of_boundary_cell.offsets[place + 1]; ++i)
            sum += of_boundary_cell_weight[i] * load<Dim>(y, boundary_faces[of_boundary_cell.rows[i]]);
        return sum;
    }

    // Whole sweeps ----------------------------------------------------------------------------------------------------

    void load_displacement(std::span<const Vector<Dim>> from) {
        parallel_each(n_cells(), [&](std::ptrdiff_t c) { store(load<Dim>(from[c]), u, c); });
    }

    /// The sweeps see the corrections face by face; zero everywhere else.
    class PlacedCorrections {
    public:
        PlacedCorrections(Impl& impl, const FaceCorrections<Dim>& corrections) : impl_(impl), corrections_(corrections) {
            for (std::size_t i = 0; i < corrections.faces.size(); ++i) {
                store(load<Dim>(corrections.displacement[i]), impl.face_correction, corrections.faces[i]);
                if (!corrections.force.empty()) store(load<Dim>(corrections.force[i]), impl.face_pair_force, corrections.faces[i]);
            }
        }
        ~PlacedCorrections() {
            for (const std::int32_t b : corrections_.faces) {
                store(Lanes<Dim>{}, impl_.face_correction, b);
                store(Lanes<Dim>{}, impl_.face_pair_force, b);
            }
        }
        PlacedCorrections(const PlacedCorrections&) = delete;
        PlacedCorrections& operator=(const PlacedCorrections&) = delete;

    private:
        Impl& impl_;
        const FaceCorrections<Dim>& corrections_;
    };

    enum Stage { reconstruction, gradients, jumps, stresses, face_forces, cell_gradients, n_stages };

    void reconstruct_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load) {
        for (std::int32_t f = chunks[k].face; f < chunks[k + 1].face; ++f) store(reconstruct(f), relative, f);
        for (std::int32_t b = chunks[k].boundary; b < chunks[k + 1].boundary; ++b)
            store(reconstruct_boundary(b, boundary_load), relative, boundary_faces[b]);
    }

    void gradients_of_chunk(std::int32_t k) {
        for (std::int32_t c = chunks[k].cell; c < chunks[k + 1].cell; ++c) store_tensor(gradient(c), g, c);
    }

    void jumps_of_chunk(std::int32_t k) {
        for (std::int32_t f = chunks[k].face; f < chunks[k + 1].face; ++f) store(jump(f), jump_force, f);
    }

    void stresses_of_chunk(std::int32_t k) {
        for (std::int32_t c = chunks[k].cell; c < chunks[k + 1].cell; ++c) stress(c);
    }

    void face_forces_of_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load) {
        for (std::int32_t f = chunks[k].face; f < chunks[k + 1].face; ++f) store(face_force(f), y, f);
        for (std::int32_t b = chunks[k].boundary; b < chunks[k + 1].boundary; ++b)
            store(boundary_face_force(b, boundary_load), y, boundary_faces[b]);
    }

    void cell_gradients_of_chunk(std::int32_t k, std::span<Vector<Dim>> result) {
        for (std::int32_t c = chunks[k].cell; c < chunks[k + 1].cell; ++c) result[c] = unload<Dim>(cell_gradient(c));
        for (std::int32_t place = chunks[k].boundary_cell; place < chunks[k + 1].boundary_cell; ++place)
            result[boundary_cells[place]] += unload<Dim>(boundary_cell_gradient(place));
    }

    void sweep(std::span<const Vector<Dim>> from, const BoundaryLoad<Dim>& boundary_load, const FaceCorrections<Dim>& corrections,
               std::span<Vector<Dim>> result) {
        const PlacedCorrections placed(*this, corrections);
        load_displacement(from);
        schedule.run([&](int stage, std::int32_t chunk) {
            switch (stage) {
                case reconstruction: return reconstruct_chunk(chunk, boundary_load);
                case gradients: return gradients_of_chunk(chunk);
                case jumps: return jumps_of_chunk(chunk);
                case stresses: return stresses_of_chunk(chunk);
                case face_forces: return face_forces_of_chunk(chunk, boundary_load);
                default: return cell_gradients_of_chunk(chunk, result);
            }
        });
    }

    void sweep_to_jumps(std::span<const Vector<Dim>> from, const BoundaryLoad<Dim>& boundary_load, const FaceCorrections<Dim>& corrections) {
        const PlacedCorrections placed(*this, corrections);
        load_displacement(from);
        const auto n_chunks = static_cast<std::int32_t>(chunks.size()) - 1;
        const auto for_each_chunk = [&](auto&& task) { oneapi::tbb::parallel_for(std::int32_t{0}, n_chunks, task); };
        for_each_chunk([&](std::int32_t k) { reconstruct_chunk(k, boundary_load); });
        for_each_chunk([&](std::int32_t k) { gradients_of_chunk(k); });
        for_each_chunk([&](std::int32_t k) { jumps_of_chunk(k); });
    }

    // The same on a region --------------------------------------------------------------------------------------------

    void evaluate_to_stress(const Region<Dim>& region, std::span<const Vector<Dim>> from, const BoundaryLoad<Dim>& boundary_load) {
        const auto for_all = [](const std::vector<std::int32_t>& list, const auto& body) {
            parallel_each(static_cast<std::ptrdiff_t>(list.size()), [&](std::ptrdiff_t i) { body(list[i]); }, region_grain);
        };
        for_all(region.loaded_cells, [&](std::int32_t c) { store(load<Dim>(from[c]), u, c); });
        for_all(region.reconstructed, [&](std::int32_t f) { store(reconstruct(f), relative, f); });
        for_all(region.reconstructed_boundary, [&](std::int32_t b) { store(reconstruct_boundary(b, boundary_load), relative, boundary_faces[b]); });
        for_all(region.gradient_cells, [&](std::int32_t c) { store_tensor(gradient(c), g, c); });
        for_all(region.jump_faces, [&](std::int32_t f) { store(jump(f), jump_force, f); });
        for_all(region.stress_cells, [&](std::int32_t c) { stress(c); });
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
    [[nodiscard]] std::vector<std::int32_t> faces_of(std::int32_t c) const {
        std::vector<std::int32_t> faces;
        for (std::int32_t i = slot_offsets[c]; i < slot_offsets[c + 1]; ++i) faces.push_back(slots[i].face());
        return faces;
    }
    [[nodiscard]] Vector<Dim> area_vector(std::int32_t f) const { return Eigen::Map<const Vector<Dim>>(area_vectors[f].data()); }
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
    u.resize(lane_width<Dim> * cell_geometry.size());
    relative.resize(lane_width<Dim> * sides.size());
    g.resize(lane_width<Dim> * Dim * cell_geometry.size());
    jump_force.resize(lane_width<Dim> * sides.size());
    s.resize(lane_width<Dim> * Dim * cell_geometry.size());
    direct.resize(lane_width<Dim> * cell_geometry.size());
    y.resize(lane_width<Dim> * sides.size());
    face_correction.resize(lane_width<Dim> * boundary_faces.size());
    face_pair_force.resize(lane_width<Dim> * boundary_faces.size());
    set_chunks();
}

/// Chunks of cells with the faces they are the first side of, and which of them read each other's results.
template <int Dim>
void Ccg<Dim>::Impl::set_chunks() {
    const auto cells = static_cast<std::int32_t>(n_cells());
    const std::int32_t n_chunks = std::max(1, (cells + chunk_size - 1) / chunk_size);
    const auto place = [](const auto& sorted, std::int32_t value) {
        return static_cast<std::int32_t>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
    };
    for (std::int32_t k = 0; k <= n_chunks; ++k) {
        const std::int32_t cell = std::min(k * chunk_size, cells);
        const auto face = static_cast<std::int32_t>(
            std::partition_point(sides.begin(), sides.end(), [&](const auto& side) { return side[0] < cell; }) - sides.begin());
        chunks.push_back({cell, face, place(boundary_faces, face), place(boundary_cells, cell)});
    }

    std::array<std::vector<std::vector<std::int32_t>>, n_stages - 1> needs;
    for (auto& stage : needs) stage.resize(static_cast<std::size_t>(n_chunks));
    const auto chunk_of = [](std::int32_t cell) { return cell / chunk_size; };
    const auto owner = [&](std::int32_t face) { return chunk_of(sides[face][0]); };
    for (std::int32_t c = 0; c < cells; ++c) {
        const auto need = [&](Stage stage, std::int32_t chunk) {
            auto& row = needs[stage - 1][chunk_of(c)];
            if (row.empty() || row.back() != chunk) row.push_back(chunk);
        };
        for (std::int32_t i = slot_offsets[c]; i < slot_offsets[c + 1]; ++i) {
            need(gradients, owner(slots[i].face()));
            need(stresses, owner(slots[i].face()));
        }
        for (std::int32_t i = of_cell.offsets[c]; i < of_cell.offsets[c + 1]; ++i) need(cell_gradients, owner(of_cell.rows[i]));
        need(cell_gradients, chunk_of(c));
        if (const std::int32_t b = boundary_cell_place[c]; b >= 0)
            for (std::int32_t i = of_boundary_cell.offsets[b]; i < of_boundary_cell.offsets[b + 1]; ++i)
                need(cell_gradients, owner(boundary_faces[of_boundary_cell.rows[i]]));
    }
    for (const auto& [a, b] : sides) {
        for (const Stage stage : {jumps, face_forces}) {
            auto& row = needs[stage - 1][chunk_of(a)];
            for (const std::int32_t chunk : {chunk_of(a), chunk_of(b)})
                if (row.empty() || row.back() != chunk) row.push_back(chunk);
        }
    }
    for (auto& stage : needs)
        for (auto& row : stage) sort_unique(row);
    schedule = SweepSchedule<n_stages>(n_chunks, needs);
}

template <int Dim>
void Ccg<Dim>::Impl::set_faces(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials) {
    const auto n_faces = static_cast<std::size_t>(mesh.n_faces());
    sides = mesh.face_cells;
    stencils.resize(n_faces);
    area_vectors.resize(n_faces);
    face_places.resize(n_faces);
    boundary_place.assign(n_faces, -1);
    std::vector<std::int32_t> interior;
    for (std::int32_t f = 0; f < mesh.n_faces(); ++f) {
        for (int j = 0; j < Dim; ++j) {
            area_vectors[f][j] = mesh.face_measure[f] * mesh.face_normal[f][j];
            face_places[f].centroid[j] = mesh.face_centroid[f][j];
        }
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
        face_places[f].jump_stiffness = Dim == 2 ? eta : eta * std::sqrt(mesh.face_measure[f]);
    }
    const auto selected = select_stencils<Dim>(mesh, interior, report);
    for (std::size_t i = 0; i < interior.size(); ++i) stencils[interior[i]] = selected[i];
}

template <int Dim>
void Ccg<Dim>::Impl::set_cells(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials) {
    slot_offsets = mesh.cell_faces.offsets;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const Material& material = materials[mesh.cell_body[c]];
        CellGeometry<Dim>& geometry = cell_geometry.emplace_back();
        geometry.inverse_measure = 1.0 / mesh.cell_measure[c];
        geometry.lambda = material.lambda();
        geometry.mu = material.mu();
        for (int j = 0; j < Dim; ++j) geometry.centroid[j] = mesh.cell_centroid[c][j];
        for (const std::int32_t f : mesh.cell_faces[c]) {
            const bool outward = sides[f][0] == c;
            slots.emplace_back(f, outward, sides[f][outward ? 1 : 0]);
        }
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
    boundary_cell_place.assign(cell_geometry.size(), -1);
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
    const auto all_faces_of = [&](const std::vector<std::int32_t>& cells) {
        std::vector<std::int32_t> faces;
        for (const std::int32_t c : cells)
            for (std::int32_t i = slot_offsets[c]; i < slot_offsets[c + 1]; ++i) faces.push_back(slots[i].face());
        sort_unique(faces);
        return faces;
    };
    sort_unique(region.stress_cells);
    region.jump_faces = all_faces_of(region.stress_cells);
    region.gradient_cells = region.stress_cells;
    for (const std::int32_t f : region.jump_faces) region.gradient_cells.insert(region.gradient_cells.end(), sides[f].begin(), sides[f].end());
    sort_unique(region.gradient_cells);
    region.loaded_cells = region.gradient_cells;
    for (const std::int32_t f : all_faces_of(region.gradient_cells)) {
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
    const Vector<Dim> from_cell = Eigen::Map<const Vector<Dim>>(face_places[f].centroid.data()) -
                                  Eigen::Map<const Vector<Dim>>(cell_geometry[cell].centroid.data());
    return sign * cell_geometry[cell].inverse_measure * area_vector(boundary_faces[b]).dot(from_cell);
}

template <int Dim>
Matrix<Dim> Ccg<Dim>::Impl::coupling_block(std::int32_t b, std::int32_t other) const {
    const std::int32_t cell = sides[boundary_faces[b]][0];
    const std::int32_t other_cell = sides[boundary_faces[other]][0];
    Matrix<Dim> block = Matrix<Dim>::Zero();
    if (cell == other_cell) {
        const Vector<Dim> a_f = area_vector(boundary_faces[b]);
        const Vector<Dim> a_g = area_vector(boundary_faces[other]);
        const auto& [inverse_measure, lambda, mu, centroid] = cell_geometry[cell];
        block = inverse_measure * (lambda * a_f * a_g.transpose() + mu * (a_f.dot(a_g) * Matrix<Dim>::Identity() + a_g * a_f.transpose()));
    }
    for (const std::int32_t f : faces_of(cell))
        if (sides[f][0] == other_cell || sides[f][1] == other_cell)
            block += face_places[f].jump_stiffness * jump_answer(f, b) * jump_answer(f, other) * Matrix<Dim>::Identity();
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
    const auto motion_of = [&](std::int32_t b) {
        Lanes<Dim> motion;
        if (!load_to.displacement.empty()) motion = load<Dim>(Vector<Dim>(load_to.displacement[b] - load_from.displacement[b]));
        for (std::int32_t i = boundary.offsets[b]; i < boundary.offsets[b + 1]; ++i)
            motion += boundary_weight[i] * (load<Dim>(u_to[boundary.cells[i]]) - load<Dim>(u_from[boundary.cells[i]]));
        return dot(motion, motion);
    };
    const double largest = oneapi::tbb::parallel_reduce(
        oneapi::tbb::blocked_range<std::int32_t>(0, boundary.size(), parallel_grain), 0.0,
        [&](const oneapi::tbb::blocked_range<std::int32_t>& range, double so_far) {
            for (std::int32_t b = range.begin(); b < range.end(); ++b) so_far = std::max(so_far, motion_of(b));
            return so_far;
        },
        [](double a, double b) { return std::max(a, b); });
    return std::sqrt(largest);
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
    return static_cast<std::int32_t>(impl_->n_cells());
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
void Ccg<Dim>::boundary_displacement(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& boundary_load, std::span<Vector<Dim>> displacement) {
    Impl& m = *impl_;
    m.load_displacement(u);
    parallel_each(m.boundary.size(), [&](std::ptrdiff_t b) {
        displacement[b] = u[m.sides[m.boundary_faces[b]][0]] + unload<Dim>(m.reconstruct_boundary(b, boundary_load));
    });
}

template <int Dim>
void Ccg<Dim>::gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& boundary_load, const FaceCorrections<Dim>& corrections,
                        std::span<Vector<Dim>> result) {
    impl_->sweep(u, boundary_load, corrections, result);
}

template <int Dim>
Vector<Dim> Ccg<Dim>::boundary_force(std::int32_t boundary_face) const {
    return unload<Dim>(load<Dim>(impl_->y, impl_->boundary_faces[boundary_face]));
}

template <int Dim>
double Ccg<Dim>::potential(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& boundary_load, const FaceCorrections<Dim>& corrections) {
    Impl& m = *impl_;
    m.sweep_to_jumps(u, boundary_load, corrections);
    const double elastic = ordered_sum(m.n_cells(), 0.0, [&](std::ptrdiff_t c) { return m.elastic_energy(c); });
    const double jumps = ordered_sum(m.n_faces(), 0.0, [&](std::ptrdiff_t f) { return m.jump_energy(f); });
    double work = 0.0;
    for (std::size_t b = 0; b < boundary_load.traction.size(); ++b) {
        const std::int32_t f = m.boundary_faces[b];
        work += boundary_load.traction[b].dot(unload<Dim>(load<Dim>(m.relative, f) + m.displacement(m.sides[f][0])));
    }
    return elastic + jumps - work;
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
void Ccg<Dim>::evaluate_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& boundary_load,
                              std::span<Vector<Dim>> displacement, std::span<Vector<Dim>> force) {
    Impl& m = *impl_;
    m.evaluate_to_stress(region, u, boundary_load);
    for (std::size_t i = 0; i < region.faces.size(); ++i) {
        const std::int32_t f = m.boundary_faces[region.faces[i]];
        displacement[i] = u[m.sides[f][0]] + unload<Dim>(load<Dim>(m.relative, f));
        force[i] = unload<Dim>(m.boundary_face_force(region.faces[i], boundary_load));
    }
}

template <int Dim>
void Ccg<Dim>::evaluate_cells(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& boundary_load,
                              const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    Impl& m = *impl_;
    const typename Impl::PlacedCorrections placed(m, corrections);
    m.evaluate_to_stress(region, u, boundary_load);
    for (const std::int32_t f : region.force_faces) store(m.face_force(f), m.y, f);
    for (const std::int32_t b : region.faces) store(m.boundary_face_force(b, boundary_load), m.y, m.boundary_faces[b]);
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
    return unload(load_tensor<Dim>(impl_->g, cell));
}

template <int Dim>
Matrix<Dim> Ccg<Dim>::stress(std::int32_t cell) const {
    return unload(impl_->elastic_stress(cell, load_tensor<Dim>(impl_->g, cell)));
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
