#include "abut/contact/contact.hpp"

#include "abut/base/error.hpp"
#include "abut/contact/engine/engine.hpp"
#include "abut/contact/host_checks.hpp"
#include "abut/contact/law/face_law.hpp"

namespace abut::contact {
namespace {

template <int Dim>
const ContactOptions& checked(const SurfaceView<Dim>& surface, const ContactOptions& options) {
    check_options(options);
    check_friction(options.friction, !surface.shear_stiffness.empty());
    return options;
}

}  // namespace

template <int Dim>
struct Contact<Dim>::Implementation {
    Implementation(const SurfaceView<Dim>& surface, const ContactOptions& options, Sharing* sharing)
        : engine(FaceLaw<Dim>(surface, checked(surface, options), sharing), options.search,
                 {options.compression_warning, options.compression_limit}, sharing) {}

    Engine<FaceLaw<Dim>> engine;
    std::vector<Vector<Dim>> u_0, u_1, y_0, y_1;  // work arrays of `step`
};

template <int Dim>
Contact<Dim>::Contact(SurfaceView<Dim> surface, const ContactOptions& options, Sharing* sharing)
    : implementation_(std::make_unique<Implementation>(surface, options, sharing)) {}
template <int Dim>
Contact<Dim>::~Contact() = default;
template <int Dim>
Contact<Dim>::Contact(Contact&&) noexcept = default;
template <int Dim>
Contact<Dim>& Contact<Dim>::operator=(Contact&&) noexcept = default;

template <int Dim>
const ContactStep<Dim>& Contact<Dim>::step(double dt, const HostStep<Dim>& host) {
    check_step_length(dt);
    check_host_step(surface(), host);
    auto& [engine, u_0, u_1, y_0, y_1] = *implementation_;
    if (!engine.is_valid_at(host.displacement_0) || !engine.is_valid_at(host.displacement_1))
        search(host.displacement_0, host.displacement_1, host.coupling_of);
    const auto listed = faces();
    for (auto* array : {&u_0, &u_1, &y_0, &y_1}) array->resize(listed.size());
    for (std::size_t i = 0; i < listed.size(); ++i) {
        u_0[i] = host.displacement_0[static_cast<std::size_t>(listed[i])];
        u_1[i] = host.displacement_1[static_cast<std::size_t>(listed[i])];
    }
    if (!listed.empty()) host.gradients_of(listed, y_0, y_1);
    return integrate(dt, {u_0, u_1, y_0, y_1}, host.take);
}

template <int Dim>
bool Contact<Dim>::is_valid_for(double motion) const {
    return implementation_->engine.is_valid_for(motion);
}

template <int Dim>
void Contact<Dim>::search(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1,
                          const CouplingOf<Dim>& coupling_of) {
    if (!coupling_of) throw BadInput("contact: `search` asks for the coupling of the faces that it lists; give a function.");
    implementation_->engine.search(u_0, u_1, [&](FaceLaw<Dim>& law) { law.set_coupling(coupling_of(law.faces())); });
}

template <int Dim>
std::span<const Face> Contact<Dim>::faces() const {
    return implementation_->engine.law().faces();
}

template <int Dim>
const ContactStep<Dim>& Contact<Dim>::integrate(double dt, const FacePath<Dim>& path, TakenForce take) {
    return implementation_->engine.step(dt, {path, take});
}

template <int Dim>
const ContactStep<Dim>& Contact<Dim>::evaluate(std::span<const Vector<Dim>> displacement,
                                               std::span<const Vector<Dim>> gradient) {
    return implementation_->engine.evaluate(FacePath<Dim>{displacement, displacement, gradient, gradient});
}

template <int Dim>
const ContactStep<Dim>& Contact<Dim>::last() const {
    return implementation_->engine.last();
}

template <int Dim>
std::vector<AdmittedOverlap<Dim>> Contact<Dim>::admitted_overlaps(std::span<const Vector<Dim>> displacement) const {
    const auto& engine = implementation_->engine;
    engine.require_list();
    return engine.law().admitted_overlaps(displacement, engine.pairs().memory());
}

template <int Dim>
const PairStore& Contact<Dim>::pair_store() const {
    return implementation_->engine.pairs();
}

template <int Dim>
void Contact<Dim>::clear_report() {
    implementation_->engine.clear_report();
}

template <int Dim>
std::vector<std::byte> Contact<Dim>::state() const {
    return implementation_->engine.state();
}

template <int Dim>
void Contact<Dim>::restore(std::span<const std::byte> state) {
    implementation_->engine.restore(state);
}

template <int Dim>
void Contact<Dim>::take_over(const Contact& before, std::span<const std::int32_t> old_face_of) {
    check_old_faces(old_face_of, surface().size(), before.surface().size());
    implementation_->engine.take_over(before.implementation_->engine, old_face_of);
}

template <int Dim>
const SurfaceView<Dim>& Contact<Dim>::surface() const {
    return implementation_->engine.law().facets();
}

template <int Dim>
const ContactReport& Contact<Dim>::report() const {
    return implementation_->engine.report();
}

template <int Dim>
const CandidateReport& Contact<Dim>::search_report() const {
    return implementation_->engine.search_report();
}

template <int Dim>
double Contact<Dim>::skin() const {
    return implementation_->engine.skin();
}

template <int Dim>
const FaceCoupling<Dim>& Contact<Dim>::coupling() const {
    return implementation_->engine.law().coupling();
}

template class Contact<2>;
template class Contact<3>;

}  // namespace abut::contact
