#include "abut/solid/ccg/sweeps.hpp"

#include <tuple>
#include <utility>

#include "abut/base/parallel.hpp"
#include "abut/solid/ccg/simplex_elements.hpp"

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

// Whole meshes -------------------------------------------------------------------------------------------------------

template <int Dim, class Real>
CcgSweeps<Dim, Real>::CcgSweeps(const CcgArrays<Dim>& arrays, const CcgCoefficients<Dim, Real>& coefficients,
                                const FiniteCells<Dim>& finite, ViscousCells<Dim>* viscous, PlasticCells<Dim>* plastic,
                                CappedJumps<Dim>* capped, const ThermalCells<Dim>* thermal)
    : arrays_(arrays),
      coefficients_(coefficients),
      finite_(finite),
      kept_(arrays, finite),
      viscous_(viscous && viscous->any() ? viscous : nullptr),
      plastic_(plastic && plastic->any() ? plastic : nullptr),
      capped_(capped && capped->any() ? capped : nullptr),
      thermal_(thermal) {
    constexpr std::size_t width = lane_width<Dim>;
    u_.resize(width * arrays.cells.size());
    of_face_.resize(width * arrays.faces.size());
    if (!arrays.simplices.all()) {
        g_.resize(width * Dim * arrays.cells.size());
        trace_.resize(width * arrays.half_faces.size());
    }
    s_.resize(width * Dim * arrays.cells.size());
    deviation_.resize(width * arrays.cells.size());
    direct_.resize(width * arrays.cells.size());
    boundary_y_.resize(width * arrays.boundary_faces.size());
    affine_y_.resize(width * arrays.affine.faces.size());
    correction_.resize(width * arrays.boundary_faces.size());
    pair_gradient_.resize(width * arrays.boundary_faces.size());
    free_.resize(finite.free().size());
    if (finite.any() || plastic_) g_change_.resize(s_.size());
    if (plastic_) {
        wants_change_.assign(arrays.cells.size(), 0);
        has_change_made_ = wants_change_;
    }
    flows_.resize(finite.n_inelastic());
    const bool has_gradients = finite.any() && !finite.takes_ends();
    if (has_gradients || viscous_ || plastic_) u_change_.resize(u_.size());
    if (plastic_) u_end_.resize(u_.size());
    if (has_gradients) relative_change_.resize(of_face_.size());
    element_ = {tables_of(arrays, coefficients), coefficients.units};
    SweepTables<Dim, Real>& tables = element_.tables;
    tables.u = Table<double>(u_);
    tables.of_face = Table<Real>(of_face_);
    tables.g = Table<Real>(g_);
    tables.trace = Table<Real>(trace_);
    tables.s = Table<Real>(s_);
    tables.deviation = Table<Real>(deviation_);
    tables.direct = Table<Real>(direct_);
    tables.boundary_y = Table<Real>(boundary_y_);
    tables.affine_y = Table<Real>(affine_y_);
    tables.correction = Table<Real>(correction_);
    tables.pair_gradient = Table<Real>(pair_gradient_);
    set_chunks();
}

template <int Dim, class Real>
PlacedCorrections<Dim, Real> CcgSweeps<Dim, Real>::placed(const FaceCorrections<Dim>& corrections) {
    return {arrays_, finite_, element_.units, element_.tables, moments_, corrections};
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_load(const BoundaryLoad<Dim>& load) {
    element_.tables.load_displacement = plain<double>(load.displacement);
    element_.tables.traction = plain<double>(load.traction);
    temperature_ = load.temperature;
    if (finite_.any_warm()) finite_.set_temperature(temperature_);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                    const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    run_sweeps([&](std::ptrdiff_t c) { store(load_packed<Dim>(u[c]), u_, c); }, load, corrections, result);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::mean_gradient(const StepEnds<Dim>& ends, const BoundaryLoad<Dim>& load,
                                         const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    if constexpr (takes_finite) take_ends(ends);
    const auto load_midpoint = [&](std::ptrdiff_t c) {
        store(0.5 * (load_packed<Dim>(ends.start[c]) + load_packed<Dim>(ends.end[c])), u_, c);
    };
    run_sweeps(load_midpoint, load, corrections, result);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::gradient_of_packed(LargeArray<double>& u, const BoundaryLoad<Dim>& load,
                                              const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result,
                                              const StepEnds<Dim>& ends) {
    std::swap(u_, u);
    element_.tables.u = Table<double>(u_);
    if constexpr (takes_finite) take_ends(ends);
    run_sweeps([](std::ptrdiff_t) {}, load, corrections, result);
}

/// load_cell(c) sets u_ of a cell.
template <int Dim, class Real>
template <class LoadCell>
void CcgSweeps<Dim, Real>::run_sweeps(const LoadCell& load_cell, const BoundaryLoad<Dim>& load,
                                      const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    const auto placed_corrections = placed(corrections);
    set_load(load);
    schedule_.run([&](int stage, std::int32_t chunk) {
        switch (stage) {
            case loading:
                if constexpr (takes_finite)
                    if (takes_end(chunk)) return load_end(chunk);
                return for_runs(wanted_.loaded[chunk], load_cell);
            case reconstruction:
                return reconstruct_chunk(chunk);
            case displacement_gradients:
                return displacement_gradients_of_chunk(chunk);
            case stresses:
                return stresses_of_chunk(chunk);
            case face_gradients:
                return face_gradients_of_chunk(chunk);
            default:
                return cell_gradients_of_chunk(chunk, result);
        }
    });
    has_change_ = steps_ = follows_ = false;
    keeps_ = nullptr;
    end_ = {};
    advances_ = false;
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::cell_energies(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                         const FaceCorrections<Dim>& corrections, std::span<double> result) {
    const auto placed_corrections = placed(corrections);
    set_load(load);
    load_displacement(u);
    const auto n_chunks = static_cast<std::int32_t>(chunks_.size()) - 1;
    parallel_tasks(n_chunks, [&](std::int32_t k) { reconstruct_chunk(k); });
    parallel_tasks(n_chunks, [&](std::int32_t k) { displacement_gradients_of_chunk(k); });
    parallel_tasks(n_chunks, [&](std::int32_t k) {
        for_runs(wanted_.cell_gradients[k], [&](std::int32_t c) { result[static_cast<std::size_t>(c)] = energy(c); });
    });
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::boundary_displacement(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                                 std::span<Vector<Dim>> displacement) {
    set_load(load);
    LargeArray<double> packed(u_.size());  // u_ is of the last gradient
    parallel_each(arrays_.n_cells(), [&](std::ptrdiff_t c) { store(load_packed<Dim>(u[c]), packed, c); });
    parallel_each(arrays_.n_boundary(), [&](std::ptrdiff_t b) {
        const auto face = static_cast<BoundaryFace>(b);
        displacement[b] = u[arrays_.cell_of(face)] + unload<Dim>(any_boundary_displacement(packed.data(), face));
    });
}

// A part of the mesh -------------------------------------------------------------------------------------------------

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::evaluate_to_displacement_gradients(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                                              const BoundaryLoad<Dim>& boundary_load) {
    set_load(boundary_load);
    for_all(region.input_cells, [&](std::int32_t c) { store(load_packed<Dim>(u[c]), u_, c); });
    for_all(region.reconstructed, [&](std::int32_t f) { store(element_.reconstructed(u_.data(), f), of_face_, f); });
    for_all(region.reconstructed_boundary,
            [&](BoundaryFace b) { store(element_.reconstructed_row(u_.data(), b), of_face_, arrays_.face_of(b)); });
    for_all(region.displacement_gradient_cells, [&](std::int32_t c) { set_any_displacement_gradient(c); });
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::evaluate_tilted_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                                 const BoundaryLoad<Dim>& boundary_load, std::span<Vector<Dim>> displacement,
                                                 std::span<Matrix<Dim>> gradient, StepState state) {
    const bool looked_at_end = looks_at_end_;
    if (state == StepState::end && finite_.any_inelastic()) looks_at_end_ = advances_ = true;
    evaluate_to_displacement_gradients(region, u, boundary_load);
    looks_at_end_ = looked_at_end;
    advances_ = false;
    parallel_each(
        std::ssize(region.faces),
        [&](std::ptrdiff_t i) { std::tie(displacement[i], gradient[i]) = tilted_face(region.faces[i]); }, region_grain);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::evaluate_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                          const BoundaryLoad<Dim>& boundary_load, std::span<Vector<Dim>> displacement,
                                          std::span<Vector<Dim>> gradient) {
    evaluate_to_displacement_gradients(region, u, boundary_load);
    for_all(region.displacement_gradient_cells, [&](std::int32_t c) { set_any_traces(c); });
    for_all(region.stress_cells, [&](std::int32_t c) { set_any_stress(c); });
    for (std::size_t i = 0; i < region.faces.size(); ++i) {
        displacement[i] = face_displacement(region.faces[i]);
        gradient[i] = unload<Dim>(element_.boundary_gradient(region.faces[i]));
        arrays_.boundary.for_each_answer(region.faces[i], [&](BoundaryFace face, const Matrix<Dim>& answer) {
            gradient[i] += answer.transpose() * unload<Dim>(element_.boundary_gradient(face));
        });
    }
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::evaluate_cells(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                          const BoundaryLoad<Dim>& boundary_load, const FaceCorrections<Dim>& corrections,
                                          std::span<Vector<Dim>> result) {
    const auto placed_corrections = placed(corrections);
    set_load(boundary_load);
    for_all(region.input_cells, [&](std::int32_t c) { store(load_packed<Dim>(u[c]), u_, c); });
    const auto task = [&](int stage, std::int32_t k) { run_task(region, stage, k, result); };
    if (region.chunks.size() == chunks_.size()) return schedule_.run(task);
    for (int stage = 0; stage < n_stages; ++stage) task(stage, 0);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::run_task(const Region<Dim>& region, int stage, std::int32_t k, std::span<Vector<Dim>> result) {
    using Offsets = typename Region<Dim>::Offsets;
    const auto each = [&](const auto& list, std::int32_t Offsets::*of, const auto& body) {
        for (std::int32_t i = region.chunks[k].*of; i < region.chunks[k + 1].*of; ++i) body(list[i]);
    };
    switch (stage) {
        case loading:  // is done
            return;
        case reconstruction:
            each(region.reconstructed, &Offsets::reconstructed,
                 [&](std::int32_t f) { store(element_.reconstructed(u_.data(), f), of_face_, f); });
            return each(region.reconstructed_boundary, &Offsets::reconstructed_boundary, [&](BoundaryFace b) {
                store(element_.reconstructed_row(u_.data(), b), of_face_, arrays_.face_of(b));
            });
        case displacement_gradients:
            return each(region.displacement_gradient_cells, &Offsets::displacement_gradient_cell, [&](std::int32_t c) {
                set_any_displacement_gradient(c);
                set_any_traces(c);
            });
        case stresses:
            return each(region.stress_cells, &Offsets::stress_cell, [&](std::int32_t c) {
                set_any_stress(c);
                answer_to_corrections(c);
            });
        case face_gradients:
            each(region.energy_gradient_faces, &Offsets::energy_gradient_face,
                 [&](std::int32_t f) { element_.set_any_face_gradient(f); });
            return each(region.faces, &Offsets::face,
                        [&](BoundaryFace b) { store(element_.boundary_gradient(b), boundary_y_, number_of(b)); });
        default:
            for (std::int32_t i = region.chunks[k].cell; i < region.chunks[k + 1].cell; ++i) {
                const std::int32_t c = region.cells[i];
                Lanes<Dim> sum = element_.cell_gradient(c);
                if (const std::int32_t position = arrays_.boundary_cell_position[c]; position >= 0)
                    sum += element_.boundary_cell_gradient(position);
                result[i] = unload<Dim>(sum);
            }
    }
}

template class CcgSweeps<2>;
template class CcgSweeps<3>;

// In single precision there are whole steps alone.
#define ABUT_INSTANTIATE(Dim)                                                                                    \
    template CcgSweeps<Dim, float>::CcgSweeps(const CcgArrays<Dim>&, const CcgCoefficients<Dim, float>&,         \
                                              const FiniteCells<Dim>&, ViscousCells<Dim>*, PlasticCells<Dim>*,   \
                                              CappedJumps<Dim>*, const ThermalCells<Dim>*);                      \
    template void CcgSweeps<Dim, float>::gradient(std::span<const Vector<Dim>>, const BoundaryLoad<Dim>&,        \
                                                  const FaceCorrections<Dim>&, std::span<Vector<Dim>>);          \
    template void CcgSweeps<Dim, float>::mean_gradient(const StepEnds<Dim>&, const BoundaryLoad<Dim>&,           \
                                                       const FaceCorrections<Dim>&, std::span<Vector<Dim>>);     \
    template void CcgSweeps<Dim, float>::gradient_of_packed(LargeArray<double>&, const BoundaryLoad<Dim>&,       \
                                                            const FaceCorrections<Dim>&, std::span<Vector<Dim>>, \
                                                            const StepEnds<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
