#include "abut/solid/ccg/sweeps.hpp"

#include <tuple>
#include <utility>

#include "abut/base/parallel.hpp"
#include "abut/solid/ccg/sweep_elements.hpp"

namespace abut::solid {
namespace {

/// Elements of a region that are worth a task of their own.
inline constexpr std::ptrdiff_t region_grain = 256;

template <class Id, class Body>
void for_all(const std::vector<Id>& list, const Body& body) {
    parallel_each(
        static_cast<std::ptrdiff_t>(list.size()), [&](std::ptrdiff_t i) { body(list[i]); }, region_grain);
}

}  // namespace

// One element --------------------------------------------------------------------------------------------------------

// Displacements enter by their differences to that of a cell nearby: a translation of the body costs no accuracy.

template <int Dim>
Lanes<Dim> CcgSweeps<Dim>::reconstructed_boundary(BoundaryFace face, const BoundaryLoad<Dim>& boundary_load) const {
    const BoundaryReconstruction<Dim>& boundary = arrays_.boundary;
    const Lanes<Dim> origin = displacement(arrays_.cell_of(face));
    const std::int32_t b = number_of(face);
    Lanes<Dim> sum;
    for (std::int32_t i = boundary.offsets[b]; i < boundary.offsets[b + 1]; ++i)
        sum += arrays_.boundary_weights[i] * (displacement(boundary.cells[i]) - origin);
    sum += load_packed<Dim>(correction_, b);
    if (boundary_load.displacement.empty()) return sum;
    return sum + load_packed<Dim>(Vector<Dim>(boundary_load.displacement[b] - boundary.deficit[b] * unload<Dim>(origin)));
}

template <int Dim>
[[gnu::always_inline]] inline Lanes<Dim> CcgSweeps<Dim>::interior_gradient(std::ptrdiff_t f) const {
    const auto [a, b] = arrays_.face_cells[f];
    LaneTensor<Dim> difference = load_tensor<Dim>(s_, a);
    const LaneTensor<Dim> other = load_tensor<Dim>(s_, b);
    for (int j = 0; j < Dim; ++j) difference.col[j] -= other.col[j];
    return difference.times(arrays_.faces[f].area_vector);
}

template <int Dim>
Lanes<Dim> CcgSweeps<Dim>::boundary_gradient(BoundaryFace face, const BoundaryLoad<Dim>& boundary_load) const {
    const std::int32_t f = arrays_.face_of(face), b = number_of(face);
    const Lanes<Dim> gradient = load_tensor<Dim>(s_, arrays_.face_cells[f][0]).times(arrays_.faces[f].area_vector) +
                                load_packed<Dim>(pair_gradient_, b);
    return boundary_load.traction.empty() ? gradient : gradient - load_packed<Dim>(boundary_load.traction[b]);
}

template <int Dim>
[[gnu::always_inline]] inline Lanes<Dim> CcgSweeps<Dim>::cell_gradient(std::ptrdiff_t c) const {
    const auto& [offsets, rows, weights] = arrays_.of_cell;
    Lanes<Dim> sum = load_packed<Dim>(direct_, c);
    for (std::int32_t i = offsets[c]; i < offsets[c + 1]; ++i) sum += weights[i] * load_packed<Dim>(y_, rows[i]);
    return sum;
}

template <int Dim>
Lanes<Dim> CcgSweeps<Dim>::boundary_cell_gradient(std::ptrdiff_t position) const {
    const auto& [offsets, rows, weights] = arrays_.of_boundary_cell;
    Lanes<Dim> sum;
    for (std::int32_t i = offsets[position]; i < offsets[position + 1]; ++i)
        sum += weights[i] * load_packed<Dim>(y_, arrays_.face_of(rows[i]));
    return sum;
}

/// 1/2 |c| eps:C:eps, and 1/2 k |[u]|^2 of the faces whose first side the cell is.
template <int Dim>
double CcgSweeps<Dim>::energy(std::ptrdiff_t c) const {
    const CellGeometry<Dim>& cell = arrays_.cells[c];
    const LaneTensor<Dim> g = load_tensor<Dim>(g_, c);
    const bool finite = finite_.contains(c);
    const LaneTensor<Dim> strain = finite ? green_strain(g) : g;
    const LaneTensor<Dim> sigma = finite ? finite_stress(c, strain) : elastic_stress(cell, g);
    double density = 0.0;
    for (int j = 0; j < Dim; ++j) density += dot(sigma.col[j], strain.col[j]);
    double twice = density / cell.inverse_measure;
    for (std::int32_t i = arrays_.half_face_offsets[c]; i < arrays_.half_face_offsets[c + 1]; ++i) {
        const HalfFace& half_face = arrays_.half_faces[i];
        if (half_face.first != c) continue;
        const Lanes<Dim> jump = load_packed<Dim>(trace_, i) - load_packed<Dim>(trace_, half_face.twin);
        twice += arrays_.faces[half_face.face].jump_stiffness * dot(jump, jump);
    }
    return 0.5 * twice;
}

template <int Dim>
Matrix<Dim> CcgSweeps<Dim>::stress(std::int32_t c) const {
    const LaneTensor<Dim> g = load_tensor<Dim>(g_, c);
    if (finite_.contains(c)) return cauchy_stress(c);
    return unload(elastic_stress(arrays_.cells[c], g));
}

// One chunk ----------------------------------------------------------------------------------------------------------

template <int Dim>
void CcgSweeps<Dim>::load_displacement(std::span<const Vector<Dim>> u) {
    parallel_each(arrays_.n_cells(), [&](std::ptrdiff_t c) { store(load_packed<Dim>(u[c]), u_, c); });
}

template <int Dim>
void CcgSweeps<Dim>::reconstruct_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load) {
    for (std::int32_t f = chunks_[k].face; f < chunks_[k + 1].face; ++f) store(reconstructed(u_, f), relative_, f);
    for (const BoundaryFace b : boundary_of_chunk(k))
        store(reconstructed_boundary(b, boundary_load), relative_, arrays_.face_of(b));
    if (!has_change_ || !chunks_[k].has_finite) return;
    for (std::int32_t f = chunks_[k].face; f < chunks_[k + 1].face; ++f)
        store(reconstructed(u_change_, f), relative_change_, f);
    for (const BoundaryFace b : boundary_of_chunk(k)) store(boundary_change(b), relative_change_, arrays_.face_of(b));
}

template <int Dim>
void CcgSweeps<Dim>::displacement_gradients_of_chunk(std::int32_t k) {
    const std::int32_t begin = chunks_[k].cell, end = chunks_[k + 1].cell;
    if (chunks_[k].has_finite)
        for (std::int32_t c = begin; c < end; ++c) set_any_displacement_gradient(c);
    else
        for (std::int32_t c = begin; c < end; ++c) set_displacement_gradient(c);
}

template <int Dim>
void CcgSweeps<Dim>::stresses_of_chunk(std::int32_t k) {
    const std::int32_t begin = chunks_[k].cell, end = chunks_[k + 1].cell;
    if (chunks_[k].has_finite)
        for (std::int32_t c = begin; c < end; ++c) set_any_stress(c);
    else
        for (std::int32_t c = begin; c < end; ++c) set_stress(c);
    add_moments(begin, end);
}

template <int Dim>
void CcgSweeps<Dim>::face_gradients_of_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load) {
    for (std::int32_t f = chunks_[k].face; f < chunks_[k + 1].face; ++f) store(interior_gradient(f), y_, f);
    for (const BoundaryFace b : boundary_of_chunk(k)) store(boundary_gradient(b, boundary_load), y_, arrays_.face_of(b));
}

template <int Dim>
void CcgSweeps<Dim>::cell_gradients_of_chunk(std::int32_t k, std::span<Vector<Dim>> result) const {
    for (std::int32_t c = chunks_[k].cell; c < chunks_[k + 1].cell; ++c) result[c] = unload<Dim>(cell_gradient(c));
    for (std::int32_t position = chunks_[k].boundary_cell; position < chunks_[k + 1].boundary_cell; ++position)
        result[arrays_.boundary_cells[position]] += unload<Dim>(boundary_cell_gradient(position));
}

// Whole meshes -------------------------------------------------------------------------------------------------------

/// The sweeps see the corrections face by face; zero everywhere else.
template <int Dim>
class CcgSweeps<Dim>::PlacedCorrections {
public:
    PlacedCorrections(CcgSweeps& sweeps, const FaceCorrections<Dim>& corrections)
        : sweeps_(sweeps), corrections_(corrections) {
        sweeps.moments_.assign(sweeps.arrays_, sweeps.finite_, corrections);
        for (std::size_t i = 0; i < corrections.faces.size(); ++i) {
            const std::int32_t b = number_of(corrections.faces[i]);
            if (!corrections.energy_gradient.empty())
                store(load_packed<Dim>(corrections.energy_gradient[i]), sweeps.pair_gradient_, b);
            if (corrections.displacement.empty()) continue;
            const Vector<Dim>& correction = corrections.displacement[i];
            store(load_packed<Dim>(sweeps.correction_, b) + load_packed<Dim>(correction), sweeps.correction_, b);
            sweeps.arrays_.boundary.for_each_answer(corrections.faces[i], [&](BoundaryFace face, const Matrix<Dim>& answer) {
                store(load_packed<Dim>(sweeps.correction_, number_of(face)) +
                          load_packed<Dim>(Vector<Dim>(answer * correction)),
                      sweeps.correction_, number_of(face));
            });
        }
    }
    ~PlacedCorrections() {
        sweeps_.moments_.clear();
        for (const BoundaryFace face : corrections_.faces) {
            store(Lanes<Dim>{}, sweeps_.correction_, number_of(face));
            store(Lanes<Dim>{}, sweeps_.pair_gradient_, number_of(face));
            sweeps_.arrays_.boundary.for_each_answer(face, [&](BoundaryFace answering, const Matrix<Dim>&) {
                store(Lanes<Dim>{}, sweeps_.correction_, number_of(answering));
            });
        }
    }
    PlacedCorrections(const PlacedCorrections&) = delete;
    PlacedCorrections& operator=(const PlacedCorrections&) = delete;

private:
    CcgSweeps& sweeps_;
    const FaceCorrections<Dim>& corrections_;
};

template <int Dim>
CcgSweeps<Dim>::CcgSweeps(const CcgArrays<Dim>& arrays, const FiniteCells<Dim>& finite) : arrays_(arrays), finite_(finite) {
    constexpr std::size_t width = lane_width<Dim>;
    u_.resize(width * arrays.cells.size());
    relative_.resize(width * arrays.faces.size());
    g_.resize(width * Dim * arrays.cells.size());
    trace_.resize(width * arrays.half_faces.size());
    s_.resize(width * Dim * arrays.cells.size());
    direct_.resize(width * arrays.cells.size());
    y_.resize(width * arrays.faces.size());
    correction_.resize(width * arrays.boundary_faces.size());
    pair_gradient_.resize(width * arrays.boundary_faces.size());
    if (finite.any()) {
        u_change_.resize(u_.size());
        relative_change_.resize(relative_.size());
        g_change_.resize(g_.size());
        condensed_.resize(finite.free().size());
    }
    set_chunks();
}

template <int Dim>
void CcgSweeps<Dim>::gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                              const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result,
                              const StepEnds<Dim>& ends) {
    load_displacement(u);
    load_change(ends);
    run_sweeps(load, corrections, result);
}

template <int Dim>
void CcgSweeps<Dim>::gradient_of_packed(std::vector<double>& u, const BoundaryLoad<Dim>& load,
                                        const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result,
                                        const StepEnds<Dim>& ends) {
    std::swap(u_, u);
    load_change(ends);
    run_sweeps(load, corrections, result);
}

template <int Dim>
void CcgSweeps<Dim>::run_sweeps(const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                                std::span<Vector<Dim>> result) {
    const PlacedCorrections placed(*this, corrections);
    schedule_.run([&](int stage, std::int32_t chunk) {
        switch (stage) {
            case reconstruction:
                return reconstruct_chunk(chunk, load);
            case displacement_gradients:
                return displacement_gradients_of_chunk(chunk);
            case stresses:
                return stresses_of_chunk(chunk);
            case face_gradients:
                return face_gradients_of_chunk(chunk, load);
            default:
                return cell_gradients_of_chunk(chunk, result);
        }
    });
    has_change_ = false;
}

template <int Dim>
double CcgSweeps<Dim>::stored_energy(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                     const FaceCorrections<Dim>& corrections) {
    const PlacedCorrections placed(*this, corrections);
    load_displacement(u);
    const auto n_chunks = static_cast<std::int32_t>(chunks_.size()) - 1;
    parallel_tasks(n_chunks, [&](std::int32_t k) { reconstruct_chunk(k, load); });
    parallel_tasks(n_chunks, [&](std::int32_t k) { displacement_gradients_of_chunk(k); });
    return ordered_sum(arrays_.n_cells(), 0.0, [&](std::ptrdiff_t c) { return energy(c); });
}

template <int Dim>
void CcgSweeps<Dim>::boundary_displacement(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                           std::span<Vector<Dim>> displacement) {
    load_displacement(u);
    parallel_each(arrays_.n_boundary(), [&](std::ptrdiff_t b) {
        const auto face = static_cast<BoundaryFace>(b);
        displacement[b] = u[arrays_.cell_of(face)] + unload<Dim>(reconstructed_boundary(face, load));
    });
}

// A part of the mesh -------------------------------------------------------------------------------------------------

template <int Dim>
void CcgSweeps<Dim>::evaluate_to_displacement_gradients(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                                        const BoundaryLoad<Dim>& boundary_load) {
    for_all(region.input_cells, [&](std::int32_t c) { store(load_packed<Dim>(u[c]), u_, c); });
    for_all(region.reconstructed, [&](std::int32_t f) { store(reconstructed(u_, f), relative_, f); });
    for_all(region.reconstructed_boundary,
            [&](BoundaryFace b) { store(reconstructed_boundary(b, boundary_load), relative_, arrays_.face_of(b)); });
    for_all(region.displacement_gradient_cells, [&](std::int32_t c) { set_any_displacement_gradient(c); });
}

template <int Dim>
void CcgSweeps<Dim>::evaluate_tilted_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                           const BoundaryLoad<Dim>& boundary_load, std::span<Vector<Dim>> displacement,
                                           std::span<Matrix<Dim>> gradient) {
    evaluate_to_displacement_gradients(region, u, boundary_load);
    for (std::size_t i = 0; i < region.faces.size(); ++i)
        std::tie(displacement[i], gradient[i]) = tilted_face(region.faces[i]);
}

template <int Dim>
void CcgSweeps<Dim>::evaluate_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                    const BoundaryLoad<Dim>& boundary_load, std::span<Vector<Dim>> displacement,
                                    std::span<Vector<Dim>> gradient) {
    evaluate_to_displacement_gradients(region, u, boundary_load);
    for_all(region.stress_cells, [&](std::int32_t c) { set_any_stress(c); });
    for (std::size_t i = 0; i < region.faces.size(); ++i) {
        displacement[i] = face_displacement(arrays_.face_of(region.faces[i]));
        gradient[i] = unload<Dim>(boundary_gradient(region.faces[i], boundary_load));
        arrays_.boundary.for_each_answer(region.faces[i], [&](BoundaryFace face, const Matrix<Dim>& answer) {
            gradient[i] += answer.transpose() * unload<Dim>(boundary_gradient(face, boundary_load));
        });
    }
}

template <int Dim>
void CcgSweeps<Dim>::evaluate_cells(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                    const BoundaryLoad<Dim>& boundary_load, const FaceCorrections<Dim>& corrections,
                                    std::span<Vector<Dim>> result) {
    const PlacedCorrections placed(*this, corrections);
    for_all(region.input_cells, [&](std::int32_t c) { store(load_packed<Dim>(u[c]), u_, c); });
    const auto task = [&](int stage, std::int32_t k) { run_task(region, stage, k, boundary_load, result); };
    if (region.chunks.size() == chunks_.size()) return schedule_.run(task);
    for (int stage = 0; stage < n_stages; ++stage) task(stage, 0);
}

template <int Dim>
void CcgSweeps<Dim>::run_task(const Region<Dim>& region, int stage, std::int32_t k, const BoundaryLoad<Dim>& boundary_load,
                              std::span<Vector<Dim>> result) {
    using Offsets = typename Region<Dim>::Offsets;
    const auto each = [&](const auto& list, std::int32_t Offsets::*of, const auto& body) {
        for (std::int32_t i = region.chunks[k].*of; i < region.chunks[k + 1].*of; ++i) body(list[i]);
    };
    switch (stage) {
        case reconstruction:
            each(region.reconstructed, &Offsets::reconstructed,
                 [&](std::int32_t f) { store(reconstructed(u_, f), relative_, f); });
            return each(region.reconstructed_boundary, &Offsets::reconstructed_boundary, [&](BoundaryFace b) {
                store(reconstructed_boundary(b, boundary_load), relative_, arrays_.face_of(b));
            });
        case displacement_gradients:
            return each(region.displacement_gradient_cells, &Offsets::displacement_gradient_cell,
                        [&](std::int32_t c) { set_any_displacement_gradient(c); });
        case stresses:
            return each(region.stress_cells, &Offsets::stress_cell, [&](std::int32_t c) {
                set_any_stress(c);
                add_moments(c, c + 1);
            });
        case face_gradients:
            each(region.energy_gradient_faces, &Offsets::energy_gradient_face,
                 [&](std::int32_t f) { store(interior_gradient(f), y_, f); });
            return each(region.faces, &Offsets::face,
                        [&](BoundaryFace b) { store(boundary_gradient(b, boundary_load), y_, arrays_.face_of(b)); });
        default:
            for (std::int32_t i = region.chunks[k].cell; i < region.chunks[k + 1].cell; ++i) {
                const std::int32_t c = region.cells[i];
                Lanes<Dim> sum = cell_gradient(c);
                if (const std::int32_t position = arrays_.boundary_cell_position[c]; position >= 0)
                    sum += boundary_cell_gradient(position);
                result[i] = unload<Dim>(sum);
            }
    }
}

template class CcgSweeps<2>;
template class CcgSweeps<3>;

}  // namespace abut::solid
