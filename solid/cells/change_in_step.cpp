#include "abut/solid/cells/change_in_step.hpp"

#include <algorithm>
#include <atomic>

#include "abut/base/parallel.hpp"

namespace abut::solid {

template <int Dim, class Real>
ChangeInStep<Dim, Real>::ChangeInStep(const CcgArrays<Dim>& arrays, const CcgCoefficients<Dim, Real>& coefficients,
                                      const SweepElements<Lanes<Dim, Real>>& element, const Readers& readers)
    : arrays_(arrays), coefficients_(coefficients), element_(element), readers_(readers) {
    constexpr std::size_t width = lane_width<Dim>;
    const std::size_t n_cells = arrays.cells.size();
    if (readers.finite || readers.damped || readers.metal) u_.resize(width * n_cells);
    if (readers.finite) relative_.resize(width * arrays.faces.size());
    if (readers.shows_gradients || readers.metal) gradient_.resize(width * Dim * n_cells);
    if (!readers.metal) return;
    asks_.assign(n_cells, 0);
    is_made_ = asks_;
    last_u_.resize(width * n_cells);
}

template <int Dim, class Real>
void ChangeInStep<Dim, Real>::begin(const StepEnds<Dim>& ends) {
    of_finite_ = readers_.finite && !ends.start.empty();
    of_linear_ = (readers_.damped || readers_.metal) && !ends.start.empty();
    if (!of_finite_ && !of_linear_) return;
    take_loads(ends);
    std::atomic<bool> same = readers_.metal && follows_last_load(ends) && load_.empty();
    parallel_each(arrays_.n_cells(), [&](std::ptrdiff_t c) {
        store(load_packed<Dim>(ends.end[c]) - load_packed<Dim>(ends.start[c]), u_, c);
        if (!readers_.metal) return;
        if (unload(load_packed<Dim>(last_u_, c)) != ends.start[c]) same.store(false, std::memory_order_relaxed);
        store(load_packed<Dim>(ends.end[c]), last_u_, c);
    });
    follows_ = same;
}

template <int Dim, class Real>
void ChangeInStep<Dim, Real>::take_loads(const StepEnds<Dim>& ends) {
    load_.clear();
    if (of_linear_ && ends.start_load && ends.end_load)
        for (std::size_t b = 0; b < ends.end_load->displacement.size(); ++b)
            load_.push_back(ends.end_load->displacement[b] - ends.start_load->displacement[b]);
    if (of_linear_ && readers_.damped) add_corrections(ends.change);
    if (std::ranges::all_of(load_, [](const Vector<Dim>& change) { return change.isZero(0.0); })) load_.clear();
}

/// Bonded faces move their cells beside what prescribed displacements do.
template <int Dim, class Real>
void ChangeInStep<Dim, Real>::add_corrections(const FaceCorrections<Dim>& change) {
    if (!change.faces.empty()) load_.resize(arrays_.boundary_faces.size(), Vector<Dim>::Zero());
    for (std::size_t i = 0; i < change.faces.size(); ++i) {
        const Vector<Dim>& of_face = change.displacement[i];
        load_[static_cast<std::size_t>(change.faces[i])] += of_face;
        arrays_.boundary.for_each_answer(change.faces[i], [&](BoundaryFace face, const Matrix<Dim>& answer) {
            load_[static_cast<std::size_t>(face)] += answer * of_face;
        });
    }
}

/// Whether prescribed displacements begin where those of the last step ended.
template <int Dim, class Real>
bool ChangeInStep<Dim, Real>::follows_last_load(const StepEnds<Dim>& ends) {
    static const BoundaryLoad<Dim> none;
    const bool same = last_ended_ && last_load_ == (ends.start_load ? *ends.start_load : none).displacement;
    last_ended_ = false;
    last_load_ = (ends.end_load ? *ends.end_load : none).displacement;
    return same;
}

/// Change of û_f less u_c, prescribed displacements fixed.
template <int Dim, class Real>
Lanes<Dim, Real> ChangeInStep<Dim, Real>::of_cells_behind(BoundaryFace face) const {
    const BoundaryReconstruction<Dim>& boundary = arrays_.boundary;
    const Lanes<Dim, Real> origin = of_cell(arrays_.cell_of(face));
    const std::int32_t b = number_of(face);
    Lanes<Dim, Real> sum;
    for (std::int32_t i = boundary.offsets[b]; i < boundary.offsets[b + 1]; ++i)
        sum += coefficients_.boundary_weights[i] * (of_cell(boundary.cells[i]) - origin);
    return sum - load_packed<Dim>(Vector<Dim>(boundary.deficit[b] * unload<Dim>(origin)));
}

template <int Dim, class Real>
Lanes<Dim, Real> ChangeInStep<Dim, Real>::of_face(BoundaryFace b) const {
    const Lanes<Dim, Real> of_cells = of_cells_behind(b);
    return load_.empty() ? of_cells : of_cells + load_packed<Dim>(load_[static_cast<std::size_t>(number_of(b))]);
}

template <int Dim, class Real>
Matrix<Dim> ChangeInStep<Dim, Real>::made_gradient(std::int32_t c) const {
    const auto relative = [&](std::int32_t f) {
        const BoundaryFace b = arrays_.boundary_index[f];
        return b == no_face ? reconstructed(f) : of_face(b);
    };
    return unload(element_.gradient_of(u_.data(), c, relative));
}

template <int Dim, class Real>
void ChangeInStep<Dim, Real>::prepare_gradient(std::int32_t c, bool is_needed) {
    const auto i = static_cast<std::size_t>(c);
    is_made_[i] = is_needed || asks_[i] != 0 ? 1 : 0;
    asks_[i] = 0;
    if (is_made_[i] != 0) store_tensor(load_packed<Dim>(made_gradient(c)), gradient_, c);
}

template <int Dim, class Real>
Matrix<Dim> ChangeInStep<Dim, Real>::gradient(std::int32_t c) const {
    return is_made_[static_cast<std::size_t>(c)] != 0 ? unload(load_tensor<Dim>(gradient_, c)) : made_gradient(c);
}

template <int Dim, class Real>
void ChangeInStep<Dim, Real>::set_gradient_of_finite(std::int32_t c) {
    LaneTensor<Dim, Real> change{};
    if (of_finite_)
        change = element_.gradient_of(u_.data(), c, [&](std::int32_t f) { return load_packed<Dim>(relative_, f); });
    store_tensor(change, gradient_, c);
}

template class ChangeInStep<2, double>;
template class ChangeInStep<3, double>;
#define ABUT_INSTANTIATE(Dim)                                                                                  \
    template ChangeInStep<Dim, float>::ChangeInStep(const CcgArrays<Dim>&, const CcgCoefficients<Dim, float>&, \
                                                    const SweepElements<Lanes<Dim, float>>&, const Readers&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
