#include "abut/solid/ccg/sweeps.hpp"

#include <tuple>
#include <utility>

#include "abut/base/parallel.hpp"
#include "abut/solid/cells/simplex_elements.hpp"

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
                                const FiniteCells<Dim>& finite) requires std::is_same_v<Real, float>
    : state_(arrays, coefficients, finite, {}) {
    set_chunks();
}

template <int Dim, class Real>
CcgSweeps<Dim, Real>::CcgSweeps(const CcgArrays<Dim>& arrays, const FiniteCells<Dim>& finite, ViscousCells<Dim>& viscous,
                                PlasticCells<Dim>& plastic, CappedJumps<Dim>& capped,
                                const ThermalCells<Dim>& thermal) requires std::is_same_v<Real, double>
    : state_(arrays, arrays, finite,
             {.finite = finite.any() && !finite.takes_ends(),
              .damped = viscous.any(),
              .metal = plastic.any(),
              .shows_gradients = finite.any()}),
      finite_(state_, viscous, capped),
      materials_(state_, viscous, plastic, capped, thermal) {
    set_chunks();
}

template <int Dim, class Real>
PlacedCorrections<Dim, Real> CcgSweeps<Dim, Real>::placed(const FaceCorrections<Dim>& corrections) {
    return {state_.arrays, state_.finite, state_.element.units, state_.element.tables, state_.moments, corrections};
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                    const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    run_sweeps([&](std::ptrdiff_t c) { store(load_packed<Dim>(u[c]), state_.work.u, c); }, load, corrections, result);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::mean_gradient(const StepEnds<Dim>& ends, const BoundaryLoad<Dim>& load,
                                         const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    if constexpr (is_double) take_ends(ends);
    const auto load_midpoint = [&](std::ptrdiff_t c) {
        store(0.5 * (load_packed<Dim>(ends.start[c]) + load_packed<Dim>(ends.end[c])), state_.work.u, c);
    };
    run_sweeps(load_midpoint, load, corrections, result);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::gradient_of_packed(LargeArray<double>& u, const BoundaryLoad<Dim>& load,
                                              const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result,
                                              const StepEnds<Dim>& ends) {
    std::swap(state_.work.u, u);
    state_.element.tables.u = Table<double>(state_.work.u);
    if constexpr (is_double) take_ends(ends);
    run_sweeps([](std::ptrdiff_t) {}, load, corrections, result);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::gradient_and_energies(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                                 const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result,
                                                 std::span<double> energies) {
    run_sweeps([&](std::ptrdiff_t c) { store(load_packed<Dim>(u[c]), state_.work.u, c); }, load, corrections, result,
               energies);
}

/// load_cell(c) sets u_c. Energies are taken where they are wanted: before contact is in the stresses of their cells.
template <int Dim, class Real>
template <class LoadCell>
void CcgSweeps<Dim, Real>::run_sweeps(const LoadCell& load_cell, const BoundaryLoad<Dim>& load,
                                      const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result,
                                      std::span<double> energies) {
    const auto placed_corrections = placed(corrections);
    state_.set_load(load);
    schedule_.run([&](int stage, std::int32_t chunk) {
        switch (stage) {
            case loading:
                return in_pool_of_chunk(chunk, [&](auto& pool) { pool.load(wanted_.loaded[chunk], load_cell); });
            case reconstruction:
                return reconstruct_chunk(chunk);
            case displacement_gradients:
                return displacement_gradients_of_chunk(chunk);
            case stresses:
                if constexpr (is_double)
                    if (!energies.empty()) energies_of_chunk(chunk, energies);
                return stresses_of_chunk(chunk);
            case face_gradients:
                return face_gradients_of_chunk(chunk);
            default:
                return cell_gradients_of_chunk(chunk, result);
        }
    });
    state_.change.leave();
    if constexpr (is_double) finite_.leave();
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::cell_energies(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                         const FaceCorrections<Dim>& corrections, std::span<double> result) {
    const auto placed_corrections = placed(corrections);
    state_.set_load(load);
    parallel_each(state_.arrays.n_cells(), [&](std::ptrdiff_t c) { store(load_packed<Dim>(u[c]), state_.work.u, c); });
    const auto n_chunks = static_cast<std::int32_t>(chunks_.size()) - 1;
    parallel_tasks(n_chunks, [&](std::int32_t k) { reconstruct_chunk(k); });
    parallel_tasks(n_chunks, [&](std::int32_t k) { displacement_gradients_of_chunk(k); });
    parallel_tasks(n_chunks, [&](std::int32_t k) { energies_of_chunk(k, result); });
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::boundary_displacement(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                                 std::span<Vector<Dim>> displacement) {
    state_.set_load(load);
    LargeArray<double> packed(state_.work.u.size());  // that of the state is of the last gradient
    parallel_each(state_.arrays.n_cells(), [&](std::ptrdiff_t c) { store(load_packed<Dim>(u[c]), packed, c); });
    parallel_each(state_.arrays.n_boundary(), [&](std::ptrdiff_t b) {
        const auto face = static_cast<BoundaryFace>(b);
        displacement[b] = u[state_.arrays.cell_of(face)] + unload<Dim>(any_boundary_displacement(packed.data(), face));
    });
}

// Both ends of a step ------------------------------------------------------------------------------------------------

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::take_ends(const StepEnds<Dim>& ends) {
    state_.dt = ends.dt;
    state_.change.begin(ends);
    if (!state_.finite.takes_ends() || ends.start.empty()) return;
    static const BoundaryLoad<Dim> none;
    begin_step(ends.start, ends.start_load ? *ends.start_load : none, ends.dt);
    finite_.fill_end(ends.end, ends.end_load ? *ends.end_load : none);
}

/// Takes the start from where the last step ended, if that is here; what materials remember goes on wherever the step
/// begins.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::begin_step(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, double dt) {
    state_.dt = dt;  // contact asks where faces end before the step is made
    const auto each_chunk = [&](const auto& task) {
        parallel_tasks(static_cast<std::int32_t>(chunks_.size()) - 1, [&](std::int32_t k) {
            if (chunks_[k].kind == Kind::finite) task(k);
        });
    };
    const auto each_loaded = [&](const auto& task) { each_chunk([&](std::int32_t k) { task(wanted_.loaded[k]); }); };
    if (!finite_.begin_step(each_loaded, u, load)) return;
    state_.set_load(load);
    each_loaded([&](std::span<const Run> cells) { finite_.set_start(cells, u); });
    each_chunk([&](std::int32_t k) { reconstruct_chunk(k); });
    each_chunk([&](std::int32_t k) { displacement_gradients_of_chunk(k); });
    each_chunk([&](std::int32_t k) { stresses_of_chunk(k); });
    finite_.keep_start(load);
}

// A part of the mesh -------------------------------------------------------------------------------------------------

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::evaluate_to_displacement_gradients(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                                              const BoundaryLoad<Dim>& boundary_load) {
    state_.set_load(boundary_load);
    for_all(region.input_cells, [&](std::int32_t c) { store(load_packed<Dim>(u[c]), state_.work.u, c); });
    for_all(region.reconstructed,
            [&](std::int32_t f) { store(state_.element.reconstructed(state_.work.u.data(), f), state_.work.of_face, f); });
    for_all(region.reconstructed_boundary, [&](BoundaryFace b) {
        store(state_.element.reconstructed_row(state_.work.u.data(), b), state_.work.of_face, state_.arrays.face_of(b));
    });
    for_all(region.displacement_gradient_cells,
            [&](std::int32_t c) { in_pool(*this, kind_of(c), [c](auto& pool) { pool.set_gradient(c); }); });
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::evaluate_tilted_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                                 const BoundaryLoad<Dim>& boundary_load, std::span<Vector<Dim>> displacement,
                                                 std::span<Matrix<Dim>> gradient, StepState state) {
    const StepStage stage = finite_.stage();
    if (state == StepState::end) finite_.try_end();
    evaluate_to_displacement_gradients(region, u, boundary_load);
    finite_.return_to(stage);
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
        gradient[i] = unload<Dim>(state_.element.boundary_gradient(region.faces[i]));
        state_.arrays.boundary.for_each_answer(region.faces[i], [&](BoundaryFace face, const Matrix<Dim>& answer) {
            gradient[i] += answer.transpose() * unload<Dim>(state_.element.boundary_gradient(face));
        });
    }
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::evaluate_cells(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                          const BoundaryLoad<Dim>& boundary_load, const FaceCorrections<Dim>& corrections,
                                          std::span<Vector<Dim>> result) {
    const auto placed_corrections = placed(corrections);
    state_.set_load(boundary_load);
    for_all(region.input_cells, [&](std::int32_t c) { store(load_packed<Dim>(u[c]), state_.work.u, c); });
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
            each(region.reconstructed, &Offsets::reconstructed, [&](std::int32_t f) {
                store(state_.element.reconstructed(state_.work.u.data(), f), state_.work.of_face, f);
            });
            return each(region.reconstructed_boundary, &Offsets::reconstructed_boundary, [&](BoundaryFace b) {
                store(state_.element.reconstructed_row(state_.work.u.data(), b), state_.work.of_face,
                      state_.arrays.face_of(b));
            });
        case displacement_gradients:
            return each(region.displacement_gradient_cells, &Offsets::displacement_gradient_cell, [&](std::int32_t c) {
                in_pool(*this, kind_of(c), [c](auto& pool) { pool.set_gradient(c); });
                set_any_traces(c);
            });
        case stresses:
            return each(region.stress_cells, &Offsets::stress_cell, [&](std::int32_t c) {
                set_any_stress(c);
                answer_to_corrections(c);
            });
        case face_gradients:
            each(region.energy_gradient_faces, &Offsets::energy_gradient_face,
                 [&](std::int32_t f) { state_.element.set_any_face_gradient(f); });
            return each(region.faces, &Offsets::face, [&](BoundaryFace b) {
                store(state_.element.boundary_gradient(b), state_.work.boundary_y, number_of(b));
            });
        default:
            for (std::int32_t i = region.chunks[k].cell; i < region.chunks[k + 1].cell; ++i) {
                const std::int32_t c = region.cells[i];
                Lanes<Dim> sum = state_.element.cell_gradient(c);
                if (const std::int32_t position = state_.arrays.boundary_cell_position[c]; position >= 0)
                    sum += state_.element.boundary_cell_gradient(position);
                result[i] = unload<Dim>(sum);
            }
    }
}

template class CcgSweeps<2>;
template class CcgSweeps<3>;

// In single precision there are whole steps alone.
#define ABUT_INSTANTIATE(Dim)                                                                                    \
    template CcgSweeps<Dim, float>::CcgSweeps(const CcgArrays<Dim>&, const CcgCoefficients<Dim, float>&,         \
                                              const FiniteCells<Dim>&);                                          \
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
