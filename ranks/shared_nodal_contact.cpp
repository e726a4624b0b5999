#include "abut/ranks/shared_nodal_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <numeric>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/state_bytes.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/ranks/copy_checks.hpp"
#include "abut/ranks/mpi.hpp"
#include "abut/ranks/node_gather.hpp"
#include "abut/ranks/same_values.hpp"
#include "abut/ranks/shared_surface.hpp"

namespace abut::ranks {
namespace {

using contact::Face;
using contact::NodalStep;

template <int Dim>
bool same_bits(const Vector<Dim>& a, const Vector<Dim>& b) {
    return std::memcmp(a.data(), b.data(), Dim * sizeof(double)) == 0;
}

/// Puts another number behind a word of a text, from `begin` on; returns where to go on.
std::size_t renumber(std::string& text, const std::string& word, std::int64_t from, std::int64_t to, std::size_t begin = 0) {
    const std::string old = word + std::to_string(from) + " ", renewed = word + std::to_string(to) + " ";
    const std::size_t at = text.find(old, begin);
    if (at == std::string::npos) return begin;
    text.replace(at, old.size(), renewed);
    return at + renewed.size();
}

}  // namespace

template <int Dim>
class SharedNodalContact<Dim>::Implementation {
public:
    Implementation(const Communicator& communicator, SharedSurface<Dim>&& shared, contact::NodalOptions&& options,
                   CopyForce copies)
        : communicator_(communicator),
          numbers_(std::move(shared.numbers)),
          forces_on_copies_(copies == CopyForce::on_each),
          checks_(communicator_.rank(), numbers_, shared.surface),
          contact_(std::move(shared.surface), in_numbers(std::move(options))) {
        every_node_.resize(numbers_.node.size());
        std::iota(every_node_.begin(), every_node_.end(), 0);
        all_.assign(communicator_, numbers_, every_node_);
        for (auto* x : {&x_0_, &x_1_, &x_state_}) x->resize(numbers_.node.size());
        for (std::size_t node = 0; node < numbers_.node.size(); ++node)
            if (gets_force(node) && checks_.is_deformable(node))
                step_.least_force_size = std::max(step_.least_force_size, numbers_.own_node[node] + 1);
    }
    Implementation(const Implementation&) = delete;  // `wanted` and the like have views of the numbers

    const NodalStep<Dim>& step(double dt, PointsView<Dim> x_0, PointsView<Dim> x_1, contact::TakenForce take) {
        const Look seen = look(dt, x_0, x_1);
        check_length(dt);
        if (!contact_.is_valid_for(seen.motion)) {
            all_.bring<Dim>(communicator_, {{x_0, x_0_}, {x_1, x_1_}}, traffic_);
            search([&] { contact_.search(x_0_, x_1_); }, x_0, x_1);
            searched_at_ = x_0_;
        } else if (seen.goes_on) {
            std::swap(x_0_, x_1_);
            list_.bring<Dim>(communicator_, {{x_1, x_1_}}, traffic_);
        } else {
            list_.bring<Dim>(communicator_, {{x_0, x_0_}, {x_1, x_1_}}, traffic_);
        }
        named([&] { contact_.step_listed(dt, x_0_, x_1_, take); });
        return take_results();
    }

    const NodalStep<Dim>& evaluate(PointsView<Dim> x) {
        const Look seen = look(no_step, x, x);
        if (!contact_.is_valid_for(seen.motion)) {
            all_.bring<Dim>(communicator_, {{x, x_1_}}, traffic_);
            x_0_ = x_1_;
            const std::int64_t rebuilds = contact_.report().rebuilds;
            search([&] { contact_.evaluate(x_1_); }, x, x);
            if (contact_.report().rebuilds != rebuilds) searched_at_ = x_1_;  // the run begins here
        } else if (seen.goes_on) {
            named([&] { contact_.evaluate_listed(x_1_); });
        } else {
            list_.bring<Dim>(communicator_, {{x, x_state_}}, traffic_);
            named([&] { contact_.evaluate_listed(x_state_); });
        }
        return take_results();
    }

    [[nodiscard]] contact::NodalStableStep stable_step(std::span<const double> mass, double omega_free) const {
        agreed(communicator_, [&] { checks_.check_masses(mass, all_.owned()); });
        NodeGather gather;
        gather.assign(communicator_, numbers_, every_node_);
        std::vector<Vector<1>> of_surface(numbers_.node.size());
        Traffic not_counted;
        gather.bring<1>(communicator_, {{mass, of_surface}}, not_counted);
        agreed(communicator_, [&] { checks_.check_copies(mass, of_surface, all_.copies()); });
        contact::NodalStableStep step =
            contact_.stable_step(as_values<1>(std::span(of_surface)), communicator_.largest(omega_free));
        if (step.node < 0) return step;
        const std::int32_t number = numbers_.node[static_cast<std::size_t>(step.node)];
        renumber(step.reason, "node ", step.node, number);
        step.node = number;
        return step;
    }

    void restore(std::span<const std::byte> state) {
        Checksum checksum;
        checksum.add(state);
        if (!is_same(communicator_, checksum.value()))
            throw BadInput(
                "shared nodal contact: ranks give different states to be restored. Give all ranks the same bytes.");
        contact_.restore(state);
        follow_list();
        take_results();
    }

    [[nodiscard]] const contact::NodalContact<Dim>& contact() const { return contact_; }
    [[nodiscard]] const NodalStep<Dim>& last() const { return step_; }
    [[nodiscard]] const Traffic& traffic() const { return traffic_; }

private:
    static constexpr double no_step = 0.0;

    /// View of all ranks together on a step before it.
    struct Look {
        double motion;  ///< the farthest from where the list was searched for [m]; NaN where a node is not finite
        bool goes_on;   ///< the listed nodes begin where they were brought to last
    };
    /// Node of this rank that gets a force.
    struct Pushed {
        std::int32_t own;
        std::size_t listed;  ///< index in the listed nodes
    };

    [[nodiscard]] contact::NodalOptions in_numbers(contact::NodalOptions options) const {
        if (options.wanted)
            options.wanted = [this, wanted = std::move(options.wanted)](Face face_1, Face face_2) {
                return wanted(number_of_face(face_1), number_of_face(face_2));
            };
        if (auto& law_of = options.friction.law_of)
            law_of = [this, by_number = std::move(law_of)](Face face_1, Face face_2) {
                return by_number(number_of_face(face_1), number_of_face(face_2));
            };
        if (auto& of = options.interference.of)
            of = [this, by_number = std::move(of)](Face face_1, Face face_2) {
                return by_number(number_of_face(face_1), number_of_face(face_2));
            };
        return options;
    }
    [[nodiscard]] Face number_of_face(Face face) const { return Face{numbers_.face[static_cast<std::size_t>(face)]}; }

    /// Before a search, which a step that is refused must not leave behind; `look` has found all ranks to give the same.
    static void check_length(double dt) {
        if (!(dt > 0.0) || !std::isfinite(dt))
            throw BadInput("shared nodal contact: a step has the length dt = " + number(dt) +
                               " s; it must be finite and > 0. Give the time from the start of the step to its end.",
                           {.value = dt});
    }

    /// A call of all ranks, one reduction; throws on all what is wrong on one.
    Look look(double dt, PointsView<Dim> x_0, PointsView<Dim> x_1) {
        const double length = std::isfinite(dt) ? dt : no_step;  // both are refused
        // 1: not a number, 2: an error; motion; whether it begins elsewhere; longest step; shortest step, negative
        std::array<double, 5> found{0.0, 0.0, 0.0, length, -length};
        std::exception_ptr error;
        try {
            checks_.check_size(x_0.size());
            checks_.check_size(x_1.size());
            const double motion = contact_.is_valid_for(0.0) ? larger(motion_until(x_0), motion_until(x_1)) : 0.0;
            const auto begins_elsewhere = [&](const NodeGather::Here& node) {
                return !same_bits<Dim>(x_0[node.own], x_1_[static_cast<std::size_t>(node.surface)]);
            };
            found = {std::isnan(motion) ? 1.0 : 0.0, std::isnan(motion) ? 0.0 : motion,
                     std::ranges::any_of(list_.owned(), begins_elsewhere) ? 1.0 : 0.0, length, -length};
        } catch (...) {
            error = std::current_exception();
            found[0] = 2.0;
        }
        take_largest(communicator_, found);
        ++traffic_.reductions;
        if (found[0] == 2.0) communicator_.agree(error);
        if (found[3] != -found[4])
            throw BadInput("shared nodal contact: ranks give steps from " + number(-found[4]) + " to " + number(found[3]) +
                               " s long. Give all ranks the same dt.",
                           {.value = -found[4], .allowed = found[3]});
        return {found[0] == 1.0 ? std::nan("") : found[1], found[2] == 0.0};
    }

    /// The farthest that a node which this rank owns is from where the list was searched for [m].
    [[nodiscard]] double motion_until(PointsView<Dim> x) const {
        const auto owned = all_.owned();
        return std::sqrt(largest(std::ssize(owned), [&](std::ptrdiff_t i) {
            return (x[owned[i].own] - searched_at_[static_cast<std::size_t>(owned[i].surface)]).squaredNorm();
        }));
    }

    /// Calls body(), which makes a list from x_0_ and x_1_, the positions that all ranks have been brought. Where it
    /// fails on one rank, all go back to where they were before, so that they stay the same.
    template <class Body>
    void search(const Body& body, PointsView<Dim> x_0, PointsView<Dim> x_1) {
        const std::vector<std::byte> before = contact_.state();
        try {
            agreed(communicator_, [&] {
                checks_.check_copies(x_0, x_0_, all_.copies());
                checks_.check_copies(x_1, x_1_, all_.copies());
                named(body);
            });
            traffic_.reductions += 2;
            if (!is_same(communicator_, checksum_of_list()))
                throw BadInput(
                    "shared nodal contact: ranks have found different pairs that may touch. `wanted` must give the "
                    "same answers on all ranks.");
        } catch (...) {
            contact_.restore(before);
            throw;
        }
        follow_list();
    }

    [[nodiscard]] std::uint64_t checksum_of_list() const {
        Checksum checksum;
        checksum.add_values(std::span<const std::int32_t>(contact_.last().nodes));
        checksum.add_values(std::span(&contact_.report().candidates, 1));
        return checksum.value();
    }

    /// Takes the present list: where its nodes are, and which of them this rank has.
    void follow_list() {
        const std::vector<std::int32_t>& nodes = contact_.last().nodes;
        list_.assign(communicator_, numbers_, nodes);
        pushed_.clear();
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (const auto node = static_cast<std::size_t>(nodes[i]); gets_force(node))
                pushed_.push_back({numbers_.own_node[node], i});
        std::ranges::sort(pushed_, {}, &Pushed::own);
        step_.nodes.clear();
        for (const Pushed& node : pushed_) step_.nodes.push_back(node.own);
    }

    [[nodiscard]] bool gets_force(std::size_t node) const {
        return numbers_.own_node[node] >= 0 && (forces_on_copies_ || numbers_.owner[node] == communicator_.rank());
    }

    const NodalStep<Dim>& take_results() {
        const NodalStep<Dim>& found = contact_.last();
        step_.gradient.clear();
        for (const Pushed& node : pushed_) step_.gradient.push_back(found.gradient[node.listed]);
        step_.pairs = found.pairs;
        for (contact::PairStep<Dim>& pair : step_.pairs) {
            pair.face_1 = number_of_face(pair.face_1);
            pair.face_2 = number_of_face(pair.face_2);
        }
        step_.friction = found.friction;
        for (contact::FaceFriction& of_face : step_.friction) of_face.face = number_of_face(of_face.face);
        step_.bodies = found.bodies;
        step_.body_pairs = found.body_pairs;
        step_.energy_0 = found.energy_0;
        step_.interference_work = found.interference_work;
        step_.energy = found.energy;
        step_.work = found.work;
        step_.report = found.report;
        return step_;
    }

    /// Calls body(); errors of contact name faces by their numbers.
    template <class Body>
    void named(const Body& body) const {
        try {
            body();
        } catch (const Error& error) {
            ErrorFacts facts = error.facts();
            std::string text = error.what();
            std::size_t at = 0;
            for (std::int64_t* face : {&facts.face_1, &facts.face_2}) {
                if (*face < 0) continue;
                const std::int64_t shown = numbers_.face[static_cast<std::size_t>(*face)];
                at = renumber(text, "face ", *face, shown, at);
                *face = shown;
            }
            throw_again(Error(error.kind(), text, facts), text);
        }
    }

    const Communicator& communicator_;
    SharedNumbers numbers_;
    bool forces_on_copies_;
    CopyChecks<Dim> checks_;
    contact::NodalContact<Dim> contact_;

    std::vector<std::int32_t> every_node_;
    NodeGather all_;   // of all nodes of the surface
    NodeGather list_;  // of those of the candidate list
    std::vector<Pushed> pushed_;
    // Of all nodes of the surface; without a search between, those of the list alone are up to date.
    std::vector<Vector<Dim>> x_0_, x_1_, x_state_;
    std::vector<Vector<Dim>> searched_at_;
    NodalStep<Dim> step_;
    Traffic traffic_;
};

template <int Dim>
SharedNodalContact<Dim>::SharedNodalContact(const Communicator& communicator, const NodalPart<Dim>& part,
                                            contact::NodalOptions options, CopyForce copies) {
    std::vector<NamedValue> values = named_values(options);
    values.push_back({"`copies`", static_cast<double>(copies)});
    require_same(communicator, values);
    SharedSurface<Dim> shared = share_surface(communicator, part);
    agreed(communicator, [&] {
        implementation_ = std::make_unique<Implementation>(communicator, std::move(shared), std::move(options), copies);
    });
}
template <int Dim>
SharedNodalContact<Dim>::~SharedNodalContact() = default;
template <int Dim>
SharedNodalContact<Dim>::SharedNodalContact(SharedNodalContact&&) noexcept = default;
template <int Dim>
SharedNodalContact<Dim>& SharedNodalContact<Dim>::operator=(SharedNodalContact&&) noexcept = default;

template <int Dim>
const NodalStep<Dim>& SharedNodalContact<Dim>::step(double dt, PointsView<Dim> x_0, PointsView<Dim> x_1,
                                                    contact::TakenForce take) {
    return implementation_->step(dt, x_0, x_1, take);
}
template <int Dim>
const NodalStep<Dim>& SharedNodalContact<Dim>::evaluate(PointsView<Dim> x) {
    return implementation_->evaluate(x);
}
template <int Dim>
contact::NodalStableStep SharedNodalContact<Dim>::stable_step(std::span<const double> mass, double omega_free) const {
    return implementation_->stable_step(mass, omega_free);
}
template <int Dim>
void SharedNodalContact<Dim>::restore(std::span<const std::byte> state) {
    implementation_->restore(state);
}
template <int Dim>
std::vector<std::byte> SharedNodalContact<Dim>::state() const {
    return implementation_->contact().state();
}
template <int Dim>
const NodalStep<Dim>& SharedNodalContact<Dim>::last() const {
    return implementation_->last();
}
template <int Dim>
const contact::ContactReport& SharedNodalContact<Dim>::report() const {
    return implementation_->contact().report();
}
template <int Dim>
const contact::CandidateReport& SharedNodalContact<Dim>::search_report() const {
    return implementation_->contact().search_report();
}
template <int Dim>
double SharedNodalContact<Dim>::skin() const {
    return implementation_->contact().skin();
}
template <int Dim>
std::vector<std::int32_t> SharedNodalContact<Dim>::inward_bodies() const {
    return implementation_->contact().surface().inward_bodies();
}
template <int Dim>
std::vector<contact::BlindCorner<Dim>> SharedNodalContact<Dim>::blind_corners() const {
    return implementation_->contact().blind_corners();
}
template <int Dim>
std::optional<contact::EdgePair<Dim>> SharedNodalContact<Dim>::unseen_edges() const {
    return implementation_->contact().unseen_edges();
}
template <int Dim>
const Traffic& SharedNodalContact<Dim>::traffic() const {
    return implementation_->traffic();
}

template class SharedNodalContact<2>;
template class SharedNodalContact<3>;

}  // namespace abut::ranks
