#include "abut/contact/law/face_law.hpp"

#include <utility>

#include "abut/base/ids.hpp"
#include "abut/contact/host_checks.hpp"
#include "abut/contact/law/engine_law.hpp"
#include "abut/contact/law/finite_forces.hpp"

namespace abut::contact {

static_assert(EngineLaw<FaceLaw<2>> && EngineLaw<FaceLaw<3>>);

template <int Dim>
FaceLaw<Dim>::FaceLaw(const SurfaceView<Dim>& surface, const ContactOptions& options, Sharing* sharing)
    : surface_(surface),
      area_(options.area),
      weighting_(options.weighting),
      pieces_(options, sharing),
      law_(options, sharing),
      friction_(options.friction) {}

// The list -----------------------------------------------------------------------------------------------------------

template <int Dim>
void FaceLaw<Dim>::list(std::span<const FacetPair> pairs, std::span<const FacetPair>, State, double) {
    list_remembered(pairs);
    list_.list_faces(faces_);
}

/// Faces are not numbered.
template <int Dim>
void FaceLaw<Dim>::list_remembered(std::span<const FacetPair> pairs) {
    list_.clear();
    for (const auto& [face_1, face_2] : pairs) {
        const std::int32_t first = number_of(face_1), second = number_of(face_2);
        list_.append(surface_, first, second, weighting_,
                     friction_.any() ? friction_.law_between(Face{first}, Face{second}) : -1);
    }
}

template <int Dim>
bool FaceLaw<Dim>::is_pressed_in(std::size_t p, State u) const {
    const ContactPair<Dim>& pair = list_.pairs()[p];
    return is_pressed_in(pair, u[pair.face_1], u[pair.face_2]);
}

template <int Dim>
bool FaceLaw<Dim>::is_pressed_in(const ContactPair<Dim>& pair, const Vector<Dim>& u_1, const Vector<Dim>& u_2) const {
    const auto at = list_.position(surface_, pair, u_1, u_2);
    return at.gap < 0.0 && list_.overlap(pair, at.tangential_offset, area_).area > 0.0;
}

template <int Dim>
FirstLook FaceLaw<Dim>::decide_first(std::size_t p, State u, bool run_begins) const {
    const ContactPair<Dim>& pair = list_.pairs()[p];
    const Vector<Dim>&u_1 = u[pair.face_1], &u_2 = u[pair.face_2];
    const bool is_shallow = list_.position(surface_, pair, u_1, u_2).gap > -pair.admission_depth;
    return {first_admission(is_shallow, is_pressed_in(pair, u_1, u_2), run_begins)};
}

template <int Dim>
void FaceLaw<Dim>::set_coupling(FaceCoupling<Dim> coupling) {
    coupling_ = std::move(coupling);
    check_coupling<Dim>(surface_, faces_, coupling_);
}

// A step -------------------------------------------------------------------------------------------------------------

template <int Dim>
void FaceLaw<Dim>::clear(ContactStep<Dim>& step) const {
    step.faces = faces_;
    step.pairs.clear();
    step.mean_correction.assign(faces_.size(), Vector<Dim>::Zero());
    step.mean_gradient.assign(faces_.size(), Vector<Dim>::Zero());
    step.mean_normal_force.assign(faces_.size(), 0.0);
    step.energy = 0.0;
    step.friction.clear();
    step.report = {};
}

template <int Dim>
std::int64_t FaceLaw<Dim>::step(double dt, const Path& path, std::span<PairMemory> memory, FacetStore& facets,
                                ContactStep<Dim>& step) {
    const auto& [u_0, u_1, y_0, y_1] = path.faces;
    const bool is_mean = path.take == TakenForce::mean;
    check_path<Dim>(surface_, faces_, {u_0, u_1, is_mean ? y_0 : y_1, y_1});
    const std::int64_t inadmissible_overlaps = update_admission(memory, u_0);
    const ActivePairs<Dim>& active = apply(is_mean ? path.faces : FacePath<Dim>{u_1, u_1, y_1, y_1}, memory, step);
    if (friction_.any()) friction_.apply(surface_, list_, active, dt, u_0, u_1, path.take, facets, step);
    check_forces<Dim>(surface_, step);
    return inadmissible_overlaps;
}

template <int Dim>
void FaceLaw<Dim>::evaluate(const FacePath<Dim>& state, std::span<const PairMemory> memory, const FacetStore& facets,
                            ContactStep<Dim>& step) {
    check_path<Dim>(surface_, faces_, state);
    const ActivePairs<Dim>& active = apply(state, memory, step);
    if (friction_.any()) friction_.evaluate(surface_, list_, active, facets, step);
    check_forces<Dim>(surface_, step);
}

template <int Dim>
std::int64_t FaceLaw<Dim>::update_admission(std::span<PairMemory> memory, std::span<const Vector<Dim>> u) const {
    std::int64_t inadmissible_overlaps = 0;
    for (std::int32_t p = 0; p < list_.size(); ++p) {
        const ContactPair<Dim>& pair = list_[p];
        bool& admitted = memory[static_cast<std::size_t>(p)].admitted;
        const auto at = list_.position(surface_, pair, u[pair.listed_1], u[pair.listed_2]);
        const bool wanted = at.gap > -pair.admission_depth;
        if (wanted == admitted && wanted) continue;
        if (at.gap >= 0.0 || list_.stay_apart(pair, at.tangential_offset, at.tangential_offset) ||
            list_.overlap(pair, at.tangential_offset, area_).area == 0.0)
            admitted = wanted;
        else if (!admitted)
            ++inadmissible_overlaps;
    }
    return inadmissible_overlaps;
}

template <int Dim>
const ActivePairs<Dim>& FaceLaw<Dim>::apply(const FacePath<Dim>& path, std::span<const PairMemory> memory,
                                            ContactStep<Dim>& step) {
    const ActivePairs<Dim>& active = pieces_.find(surface_, list_, memory, path.displacement_0, path.displacement_1);
    measures_.fill(surface_, list_, active, step);
    law_.apply(surface_, list_, active, coupling_, path, step);
    return active;
}

template <int Dim>
std::vector<AdmittedOverlap<Dim>> FaceLaw<Dim>::admitted_overlaps(std::span<const Vector<Dim>> displacement,
                                                                  std::span<const PairMemory> memory) const {
    check_listed(displacement.size(), faces_.size());
    std::vector<AdmittedOverlap<Dim>> overlaps;
    for (std::size_t p = 0; p < memory.size(); ++p) {
        if (!memory[p].admitted) continue;
        const ContactPair<Dim>& pair = list_.pairs()[p];
        const auto at = list_.position(surface_, pair, displacement[pair.listed_1], displacement[pair.listed_2]);
        if (const double area = list_.overlap(pair, at.tangential_offset, area_).area; area > 0.0)
            overlaps.push_back({Face{pair.face_1}, Face{pair.face_2}, pair.frame.normal(), at.gap, area});
    }
    return overlaps;
}

template class FaceLaw<2>;
template class FaceLaw<3>;

}  // namespace abut::contact
