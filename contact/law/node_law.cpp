#include "abut/contact/law/node_law.hpp"

#include <algorithm>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"
#include "abut/contact/messages.hpp"

namespace abut::contact {

template <int Dim>
NodeLaw<Dim>::NodeLaw(NodalSurface<Dim> surface, const NodalOptions& options, Sharing* sharing)
    : surface_(std::move(surface)),
      options_(options),
      sharing_(sharing),
      sides_(surface_.facets().view()),
      pairs_(options_.facing, options_.friction, sharing),
      law_(options_.events, options_.friction, sharing) {
    const Surface<Dim>& facets = surface_.facets();
    for (std::int32_t facet = 0; facet < facets.size(); ++facet)
        if (!surface_.is_rigid(facets.body[facet]))
            for (std::int32_t v = Dim * facet; v < Dim * (facet + 1); ++v)
                least_force_size_ = std::max(least_force_size_, facets.face_vertices[v] + 1);
}

template <int Dim>
std::string NodeLaw<Dim>::face_name(Face face) const {
    const std::int32_t facet = surface_.facet_offsets()[static_cast<std::size_t>(face)];
    return contact::face_name(facets(), facet, number_of(face));
}

/// The search knows facets, the host its faces.
template <int Dim>
void NodeLaw<Dim>::search(CandidateSearch<Dim>& candidates, State x_0, State x_1) const {
    try {
        candidates.search_moved(x_0, x_1);
    } catch (const Diverged& error) {
        ErrorFacts facts = error.facts();
        const auto facet = static_cast<std::int32_t>(facts.face_1);
        const Face face = surface_.face_of(Facet{facet});
        const std::string of_facet = contact::face_name(facets(), facet);
        std::string text = error.what();
        if (const auto at = text.find(of_facet); at != std::string::npos) text.replace(at, of_facet.size(), face_name(face));
        facts.face_1 = number_of(face);
        throw Diverged(text, facts);
    }
}

template <int Dim>
bool NodeLaw<Dim>::is_pressed_in(std::size_t p, State x) const {
    const NodalPair<Dim>& pair = pairs_.pairs()[p];
    const geometry::PairCorners<Dim> corners = pair.at(x);
    return geometry::pair_placement<Dim>(corners, pair.law).place == geometry::PairPlace::unclear &&
           geometry::pair_state<Dim>(corners, pair.law).energy > 0.0;
}

template <int Dim>
void NodeLaw<Dim>::clear(NodalStep<Dim>& step) const {
    step.nodes = pairs_.nodes();
    step.least_force_size = least_force_size_;
    step.friction.clear();
    clear_step(pairs_, step);
}

template <int Dim>
std::int64_t NodeLaw<Dim>::step(double dt, const Path& path, std::span<PairMemory> memory, FacetStore& facets,
                                NodalStep<Dim>& step) {
    return law_.apply(surface_, sides_, pairs_, memory, facets, dt, path.x_0, path.x_1, path.take, step);
}

template <int Dim>
void NodeLaw<Dim>::evaluate(State x, std::span<const PairMemory> memory, const FacetStore& facets, NodalStep<Dim>& step) {
    law_.evaluate(surface_, pairs_, memory, facets, x, step);
}

template class NodeLaw<2>;
template class NodeLaw<3>;

}  // namespace abut::contact
