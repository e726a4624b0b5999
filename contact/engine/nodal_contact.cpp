#include "abut/contact/nodal_contact.hpp"

#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/contact/engine/engine.hpp"
#include "abut/contact/engine/nodal_stable_step.hpp"
#include "abut/contact/host_checks.hpp"
#include "abut/contact/law/node_law.hpp"
#include "abut/contact/surface/bevel_shape.hpp"
#include "abut/contact/surface/bevels.hpp"

namespace abut::contact {
namespace {

NodalOptions checked(NodalOptions options, std::int32_t n_bodies, bool has_shear_stiffness) {
    check_options(options);
    check_friction(options.friction, has_shear_stiffness);
    check(options.interference);
    if (!options.pieces.empty() && std::ssize(options.pieces) != n_bodies)
        throw BadInput("nodal contact: pieces of " + std::to_string(options.pieces.size()) + " bodies are given for " +
                           std::to_string(n_bodies) + "; give one per body, -1 of a body by itself.",
                       {.value = static_cast<double>(options.pieces.size()), .allowed = static_cast<double>(n_bodies)});
    const geometry::FacingFade& facing = options.facing;
    if (!(facing.full >= -1.0 && facing.full < facing.none && facing.none <= 0.0))
        throw BadInput("nodal contact: pairs fade out from n_1 . n_2 = " + number(facing.full) + " to " +
                       number(facing.none) +
                       "; -1 <= facing.full < facing.none <= 0 is needed. -0.6 and -0.2 are the "
                       "defaults.");
    // 1 would list what is near alone, not what is deep
    options.search.facing_cosine = CandidateOptions{}.facing_cosine;
    options.search.self_contact_rings = 0;  // what lies inside of a body is told from its shape at rest
    return options;
}

template <int Dim>
void check_size(const NodalSurface<Dim>& surface, PointsView<Dim> x) {
    if (x.size() != surface.n_nodes())
        throw BadInput("nodal contact: positions of " + std::to_string(x.size()) + " nodes are given, the surface has " +
                           std::to_string(surface.n_nodes()) + "; give all nodes of the host.",
                       {.value = static_cast<double>(x.size()), .allowed = static_cast<double>(surface.n_nodes())});
}

/// A search for a law that wants to know nothing more of its list.
constexpr auto nothing_more = [](const auto&) {};

}  // namespace

/// There y^2 (3 - 2 y) is a quarter: y = 1/2 - sin(10 degrees).
double quarter_weight_cosine(const geometry::FacingFade& facing) {
    return facing.none - 0.32635182233306964 * (facing.none - facing.full);
}

void detail::check_force_size(std::int64_t given, std::int32_t needed) {
    if (given < needed)
        throw BadInput("nodal contact: forces of " + std::to_string(given) +
                           " nodes are given, and contact pushes nodes up to " + std::to_string(needed - 1) +
                           "; give one for each node of the deformable bodies.",
                       {.value = static_cast<double>(given), .allowed = static_cast<double>(needed)});
}

template <int Dim>
struct NodalContact<Dim>::Implementation {
    /// `options` have been checked.
    Implementation(NodalSurface<Dim>&& surface, const NodalOptions& options, Sharing* sharing)
        : engine(NodeLaw<Dim>(BevelledSurface<Dim>(std::move(surface)), options, sharing), options.search,
                 {options.compression_warning, options.compression_limit}, sharing),
          facing(options.facing) {}

    // Positions as the law wants them: of all nodes, or of those of the list.
    PointsView<Dim> start(PointsView<Dim> x) { return surface().place(x, start_); }
    PointsView<Dim> end(PointsView<Dim> x) { return surface().place(x, end_); }
    PointsView<Dim> listed_start(PointsView<Dim> x) { return surface().place(x, engine.law().listed_nodes(), start_); }
    PointsView<Dim> listed_end(PointsView<Dim> x) { return surface().place(x, engine.law().listed_nodes(), end_); }

    [[nodiscard]] const BevelledSurface<Dim>& surface() const { return engine.law().surface(); }

    Engine<NodeLaw<Dim>> engine;
    geometry::FacingFade facing;

private:
    std::vector<Vector<Dim>> start_, end_;  // work arrays, with bevels alone
};

template <int Dim>
NodalContact<Dim>::NodalContact(NodalSurface<Dim> surface, NodalOptions options, Sharing* sharing)
    : implementation_([&] {
          options = checked(std::move(options), surface.n_bodies(), surface.has_shear_stiffness());
          return std::make_unique<Implementation>(std::move(surface), options, sharing);
      }()) {}
template <int Dim>
NodalContact<Dim>::~NodalContact() = default;
template <int Dim>
NodalContact<Dim>::NodalContact(NodalContact&&) noexcept = default;
template <int Dim>
NodalContact<Dim>& NodalContact<Dim>::operator=(NodalContact&&) noexcept = default;

template <int Dim>
const NodalStep<Dim>& NodalContact<Dim>::step(double dt, PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take) {
    check_step_length(dt);
    check_size(surface(), x_0);
    check_size(surface(), x_1);
    auto& engine = implementation_->engine;
    const PointsView<Dim> start = implementation_->start(x_0), end = implementation_->end(x_1);
    if (!engine.is_valid_at(start) || !engine.is_valid_at(end)) engine.search(start, end, nothing_more);
    return engine.step(dt, {start, end, take});
}

template <int Dim>
const NodalStep<Dim>& NodalContact<Dim>::evaluate(PointsView<Dim> x) {
    check_size(surface(), x);
    auto& engine = implementation_->engine;
    const PointsView<Dim> at = implementation_->start(x);
    if (engine.has_searched() && !engine.is_valid_at(at)) return engine.evaluate_elsewhere(at);
    if (!engine.has_list()) engine.search(at, at, nothing_more);  // the run begins here
    return engine.evaluate(at);
}

template <int Dim>
bool NodalContact<Dim>::is_valid_for(double motion) const {
    return implementation_->engine.is_valid_for(implementation_->surface().stretch() * motion);
}

template <int Dim>
double NodalContact<Dim>::bevel_width() const {
    return implementation_->surface().bevels().width;
}

template <int Dim>
double NodalContact<Dim>::bevel_stretch() const {
    return implementation_->surface().stretch();
}

template <int Dim>
void NodalContact<Dim>::search(PointsView<Dim> x_0, PointsView<Dim> x_1) {
    check_size(surface(), x_0);
    check_size(surface(), x_1);
    implementation_->engine.search(implementation_->start(x_0), implementation_->end(x_1), nothing_more);
}

template <int Dim>
void NodalContact<Dim>::end_list() {
    implementation_->engine.end_list();
}

template <int Dim>
const NodalStep<Dim>& NodalContact<Dim>::step_listed(double dt, PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take) {
    return implementation_->engine.step(dt, {implementation_->listed_start(x_0), implementation_->listed_end(x_1), take});
}

template <int Dim>
const NodalStep<Dim>& NodalContact<Dim>::evaluate_listed(PointsView<Dim> x) {
    return implementation_->engine.evaluate(implementation_->listed_start(x));
}

template <int Dim>
std::span<const double> NodalContact<Dim>::interference() const {
    return implementation_->engine.law().interference();
}

template <int Dim>
const NodalStep<Dim>& NodalContact<Dim>::last() const {
    return implementation_->engine.last();
}

template <int Dim>
NodalStableStep NodalContact<Dim>::stable_step(std::span<const double> mass, double omega_free) const {
    return estimate_stable_step(surface(), mass, omega_free);
}

template <int Dim>
std::vector<BlindCorner<Dim>> NodalContact<Dim>::blind_corners() const {
    auto corners = contact::blind_corners<Dim>(surface().facets().view(), quarter_weight_cosine(implementation_->facing));
    const Bevels<Dim>& bevels = implementation_->surface().bevels();
    std::erase_if(corners, [&](const BlindCorner<Dim>& corner) { return bevels.is_at(corner.position); });
    return corners;
}

template <int Dim>
std::optional<EdgePair<Dim>> NodalContact<Dim>::unseen_edges() const {
    const auto edges = contact::unseen_edges<Dim>(surface().facets().view(), quarter_weight_cosine(implementation_->facing));
    const auto has_bevel = [&](const SharpestEdge<Dim>& edge) {
        return has_bevel_across(edge.half_angle_sine, edges->facing());
    };
    return edges && has_bevel(edges->edge_1) && has_bevel(edges->edge_2) ? std::nullopt : edges;
}

template <int Dim>
void NodalContact<Dim>::clear_report() {
    implementation_->engine.clear_report();
}

template <int Dim>
std::vector<std::byte> NodalContact<Dim>::state() const {
    return implementation_->engine.state();
}

template <int Dim>
void NodalContact<Dim>::restore(std::span<const std::byte> state) {
    implementation_->engine.restore(state);
}

template <int Dim>
void NodalContact<Dim>::surface_replaced(NodalSurface<Dim> surface, std::span<const std::int32_t> old_face_of) {
    auto& engine = implementation_->engine;
    NodeLaw<Dim> law = engine.law().on(std::move(surface));
    const std::vector<std::int32_t> old_of_new = old_acting_facets(engine.law().surface(), law.surface(), old_face_of);
    engine.replace(std::move(law), old_of_new);
}

template <int Dim>
void NodalContact<Dim>::take_over(const NodalContact& before, std::span<const std::int32_t> old_face_of) {
    const auto& from = before.implementation_->engine;
    auto& engine = implementation_->engine;
    engine.take_over(from, old_acting_facets(from.law().surface(), engine.law().surface(), old_face_of));
}

template <int Dim>
const NodalSurface<Dim>& NodalContact<Dim>::surface() const {
    return implementation_->surface().host();
}

template <int Dim>
const ContactReport& NodalContact<Dim>::report() const {
    return implementation_->engine.report();
}

template <int Dim>
const CandidateReport& NodalContact<Dim>::search_report() const {
    return implementation_->engine.search_report();
}

template <int Dim>
double NodalContact<Dim>::skin() const {
    return implementation_->engine.skin();
}

template class NodalContact<2>;
template class NodalContact<3>;

}  // namespace abut::contact
