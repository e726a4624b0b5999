#include "abut/contact/contact.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/contact/admission.hpp"
#include "abut/contact/finite_forces.hpp"
#include "abut/contact/host_checks.hpp"
#include "abut/contact/law/reconstruction.hpp"
#include "abut/contact/messages.hpp"
#include "abut/contact/pair_list.hpp"
#include "abut/contact/path/measures.hpp"
#include "abut/contact/path/pieces.hpp"
#include "abut/contact/report_counters.hpp"
#include "abut/contact/saved_contact.hpp"

namespace abut::contact {
namespace {

constexpr std::uint32_t state_version = 4;

}  // namespace

template <int Dim>
class Contact<Dim>::Implementation {
public:
    Implementation(SurfaceView<Dim> surface, const ContactOptions& options, Sharing* sharing)
        : surface_(surface),
          options_(checked(options)),
          candidates_(surface, options.search, sharing),
          admission_(surface_, list_, options.area),
          pieces_(options, sharing),
          law_(options, sharing) {}

    const ContactStep<Dim>& step(const HostStep<Dim>& host) {
        check_host_step(surface_, host);
        if (!is_valid_for(motion_since_search(host.displacement_0)) ||
            !is_valid_for(motion_since_search(host.displacement_1))) {
            search(host.displacement_0, host.displacement_1, host.coupling_of);
            searched_at_.assign(host.displacement_0.begin(), host.displacement_0.end());
        }
        const std::size_t n = faces_.size();
        for (auto* array : {&u_0_, &u_1_, &y_0_, &y_1_}) array->resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            u_0_[i] = host.displacement_0[static_cast<std::size_t>(faces_[i])];
            u_1_[i] = host.displacement_1[static_cast<std::size_t>(faces_[i])];
        }
        if (n > 0) host.gradients_of(faces_, y_0_, y_1_);
        return host.take == TakenForce::mean ? integrate({u_0_, u_1_, y_0_, y_1_}) : follow(u_0_, u_1_, y_1_);
    }

    [[nodiscard]] bool is_valid_for(double motion) const { return list_holds_ && candidates_.is_valid_for(motion); }

    void search(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1, const CouplingOf<Dim>& coupling_of) {
        if (!coupling_of)
            throw BadInput("contact: `search` asks for the coupling of the faces that it lists; give a function.");
        if (!std::exchange(list_holds_, false)) list_stored_pairs();
        searched_at_.clear();
        candidates_.search(u_0, u_1);
        found_.clear();
        for (const auto& [face_1, face_2] : candidates_.candidates())
            found_.push_back({SurfaceFace{face_1}, SurfaceFace{face_2}});
        keep_contacts(u_0);
        sort_unique(found_);

        list_.clear();
        for (const auto& [face_1, face_2] : found_)
            list_.append(surface_, number_of(face_1), number_of(face_2), options_.weighting);
        store_.follow(found_, [&](std::size_t i) {
            return PairMemory{is_admitted_at_first(list_[static_cast<std::int32_t>(i)], u_0)};
        });
        list_.list_faces(faces_);
        clear_step();
        coupling_ = coupling_of(faces_);
        check_coupling<Dim>(surface_, faces_, coupling_);
        list_holds_ = has_searched_ = true;
        ++report_.rebuilds;
        report_.candidates = list_.size();
        report_.candidates_max = std::max(report_.candidates_max, report_.candidates);
    }

    [[nodiscard]] std::span<const SurfaceFace> faces() const { return faces_; }

    const ContactStep<Dim>& integrate(const FacePath<Dim>& path) {
        require_list();
        check_path<Dim>(surface_, faces_, path);
        report_.inadmissible_overlaps = admission_.update(store_.memory(), path.displacement_0);
        apply_law(path);
        report_step();
        return step_;
    }

    const ContactStep<Dim>& follow(std::span<const Vector<Dim>> displacement_0, std::span<const Vector<Dim>> displacement_1,
                                   std::span<const Vector<Dim>> gradient_1) {
        require_list();
        check_path<Dim>(surface_, faces_, {displacement_0, displacement_1, gradient_1, gradient_1});
        report_.inadmissible_overlaps = admission_.update(store_.memory(), displacement_0);
        apply_law({displacement_1, displacement_1, gradient_1, gradient_1});
        report_step();
        return step_;
    }

    const ContactStep<Dim>& evaluate(std::span<const Vector<Dim>> displacement, std::span<const Vector<Dim>> gradient) {
        require_list();
        const FacePath<Dim> at_rest{displacement, displacement, gradient, gradient};
        check_path<Dim>(surface_, faces_, at_rest);
        apply_law(at_rest);
        return step_;
    }

    [[nodiscard]] const ContactStep<Dim>& last() const { return step_; }

    [[nodiscard]] std::vector<AdmittedOverlap<Dim>> admitted_overlaps(std::span<const Vector<Dim>> displacement) const {
        require_list();
        check_listed(displacement.size(), faces_.size());
        std::vector<AdmittedOverlap<Dim>> overlaps;
        for (std::int32_t p = 0; p < list_.size(); ++p) {
            if (!is_admitted(p)) continue;
            const ContactPair<Dim>& pair = list_[p];
            const auto at = list_.position(surface_, pair, displacement[pair.listed_1], displacement[pair.listed_2]);
            if (const double area = list_.overlap(pair, at.tangential_offset, options_.area).area; area > 0.0)
                overlaps.push_back({SurfaceFace{pair.face_1}, SurfaceFace{pair.face_2}, pair.frame.normal(), at.gap, area});
        }
        return overlaps;
    }

    [[nodiscard]] const PairStore& pair_store() const { return store_; }

    [[nodiscard]] std::vector<std::byte> state() const {
        return saved(state_key(), {has_searched_, candidates_.next_skin(), report_, store_, {}});
    }

    void restore(std::span<const std::byte> bytes) {
        SavedContact from = read_saved(state_key(), bytes);
        candidates_.restore_skin(from.next_skin);
        store_ = std::move(from.store);
        report_ = from.report;
        has_searched_ = from.has_searched;
        list_holds_ = false;
        searched_at_.clear();
        faces_.clear();
        clear_step();
    }

    [[nodiscard]] const SurfaceView<Dim>& surface() const { return surface_; }
    [[nodiscard]] const ContactReport& report() const { return report_; }
    [[nodiscard]] const CandidateReport& search_report() const { return candidates_.report(); }
    [[nodiscard]] double skin() const { return candidates_.skin(); }
    [[nodiscard]] const FaceCoupling<Dim>& coupling() const { return coupling_; }

private:
    static const ContactOptions& checked(const ContactOptions& options) {
        check_options(options);
        return options;
    }

    [[nodiscard]] StateKey state_key() const {
        return {"contact " + std::to_string(Dim) + "D", state_version, fingerprint(surface_), surface_.size()};
    }

    [[nodiscard]] bool is_admitted(std::int32_t pair) const {
        return store_.memory()[static_cast<std::size_t>(pair)].admitted;
    }

    /// Of any face from where the last search of `step` began [m]; infinite before.
    [[nodiscard]] double motion_since_search(std::span<const Vector<Dim>> u) const {
        if (searched_at_.empty()) return std::numeric_limits<double>::infinity();
        return largest(static_cast<std::ptrdiff_t>(u.size()),
                       [&](std::ptrdiff_t i) { return (u[i] - searched_at_[i]).norm(); });
    }

    /// A pair in contact stays in the list however deep it is.
    void keep_contacts(std::span<const Vector<Dim>> u_0) {
        for (std::int32_t p = 0; p < list_.size(); ++p)
            if (is_admitted(p) && admission_.is_pressed_in(list_[p], u_0[list_[p].face_1], u_0[list_[p].face_2]))
                found_.push_back(store_.pairs()[static_cast<std::size_t>(p)]);
    }

    /// The list of all that the store knows, where something else than a search changed the store; faces are not numbered.
    void list_stored_pairs() {
        list_.clear();
        for (const auto& [face_1, face_2] : store_.pairs())
            list_.append(surface_, number_of(face_1), number_of(face_2), options_.weighting);
    }

    /// A list without a step so far.
    void clear_step() {
        step_.faces = faces_;
        step_.pairs.clear();
        step_.mean_correction.assign(faces_.size(), Vector<Dim>::Zero());
        step_.mean_gradient.assign(faces_.size(), Vector<Dim>::Zero());
        step_.mean_normal_force.assign(faces_.size(), 0.0);
        step_.energy = 0.0;
        step_.report = {};
    }

    [[nodiscard]] bool is_admitted_at_first(const ContactPair<Dim>& pair, std::span<const Vector<Dim>> u_0) {
        const FirstAdmission first = admission_.decide_first(pair, u_0, !has_searched_);
        if (first == FirstAdmission::missed) ++report_.missed_contacts;
        return first == FirstAdmission::admitted;
    }

    void require_list() const {
        if (!list_holds_) throw Misuse("contact: there is no candidate list. Call `search` first.");
    }

    void apply_law(const FacePath<Dim>& path) {
        const ActivePairs<Dim>& active =
            pieces_.find(surface_, list_, store_.memory(), path.displacement_0, path.displacement_1);
        measures_.fill(surface_, list_, active, step_);
        law_.apply(surface_, list_, active, coupling_, path, step_);
        check_forces<Dim>(surface_, step_);
    }

    void report_step() {
        count_step(report_, step_, options_.compression_warning);
        if (step_.report.compression > options_.compression_limit) refuse_depth();
    }

    [[noreturn]] void refuse_depth() const {
        const PairStep<Dim>& pair = step_.pairs[static_cast<std::size_t>(step_.report.most_compressed)];
        throw too_deep(face_name(surface_, number_of(pair.face_1)), face_name(surface_, number_of(pair.face_2)), pair,
                       options_.compression_limit);
    }

    SurfaceView<Dim> surface_;
    ContactOptions options_;
    CandidateSearch<Dim> candidates_;
    bool has_searched_ = false;  // once at least: the run has begun
    bool list_holds_ = false;    // the last search came to its end
    PairList<Dim> list_;
    Admission<Dim> admission_;
    PairStore store_;  // in the order of the list
    std::vector<SurfaceFace> faces_;
    FaceCoupling<Dim> coupling_;
    PieceFinder<Dim> pieces_;
    PathMeasures<Dim> measures_;
    Reconstruction<Dim> law_;
    ContactStep<Dim> step_;
    ContactReport report_;
    std::vector<FacePair> found_;           // work array of `search`
    std::vector<Vector<Dim>> searched_at_;  // all faces at the start of the step of the last search; of `step` alone
    std::vector<Vector<Dim>> u_0_, u_1_, y_0_, y_1_;  // work arrays of `step`
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
const ContactStep<Dim>& Contact<Dim>::step(const HostStep<Dim>& host) {
    return implementation_->step(host);
}
template <int Dim>
bool Contact<Dim>::is_valid_for(double motion) const {
    return implementation_->is_valid_for(motion);
}
template <int Dim>
void Contact<Dim>::search(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1,
                          const CouplingOf<Dim>& coupling_of) {
    implementation_->search(u_0, u_1, coupling_of);
}
template <int Dim>
std::span<const SurfaceFace> Contact<Dim>::faces() const {
    return implementation_->faces();
}
template <int Dim>
const ContactStep<Dim>& Contact<Dim>::integrate(const FacePath<Dim>& path) {
    return implementation_->integrate(path);
}
template <int Dim>
const ContactStep<Dim>& Contact<Dim>::follow(std::span<const Vector<Dim>> displacement_0,
                                             std::span<const Vector<Dim>> displacement_1,
                                             std::span<const Vector<Dim>> gradient_1) {
    return implementation_->follow(displacement_0, displacement_1, gradient_1);
}
template <int Dim>
const ContactStep<Dim>& Contact<Dim>::evaluate(std::span<const Vector<Dim>> displacement,
                                               std::span<const Vector<Dim>> gradient) {
    return implementation_->evaluate(displacement, gradient);
}
template <int Dim>
const ContactStep<Dim>& Contact<Dim>::last() const {
    return implementation_->last();
}
template <int Dim>
std::vector<AdmittedOverlap<Dim>> Contact<Dim>::admitted_overlaps(std::span<const Vector<Dim>> displacement) const {
    return implementation_->admitted_overlaps(displacement);
}
template <int Dim>
const PairStore& Contact<Dim>::pair_store() const {
    return implementation_->pair_store();
}
template <int Dim>
std::vector<std::byte> Contact<Dim>::state() const {
    return implementation_->state();
}
template <int Dim>
void Contact<Dim>::restore(std::span<const std::byte> state) {
    implementation_->restore(state);
}
template <int Dim>
const SurfaceView<Dim>& Contact<Dim>::surface() const {
    return implementation_->surface();
}
template <int Dim>
const ContactReport& Contact<Dim>::report() const {
    return implementation_->report();
}
template <int Dim>
const CandidateReport& Contact<Dim>::search_report() const {
    return implementation_->search_report();
}
template <int Dim>
double Contact<Dim>::skin() const {
    return implementation_->skin();
}
template <int Dim>
const FaceCoupling<Dim>& Contact<Dim>::coupling() const {
    return implementation_->coupling();
}

template class Contact<2>;
template class Contact<3>;

}  // namespace abut::contact
