#pragma once
#include <array>

#include "abut/base/option.hpp"
#include "abut/contact/friction.hpp"
#include "abut/contact/options.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"

namespace abut::contact {

struct NodalOptions;

inline constexpr std::array<Word<OverlapMode>, 2> overlap_words{
    {{"moving", OverlapMode::moving}, {"frozen", OverlapMode::frozen}}};
inline constexpr std::array<Word<InterfaceWeighting>, 2> weighting_words{
    {{"half", InterfaceWeighting::half}, {"stiffness", InterfaceWeighting::stiffness}}};
inline constexpr std::array<Word<geometry::AreaMethod>, 2> area_words{
    {{"fast", geometry::AreaMethod::fast}, {"exact", geometry::AreaMethod::exact}}};

/// The options of contact, as tables. A law that an option names in OptionTraits::laws is a word of solid::ContactLaw.
/// Of a search alone `facing_cosine` may be up to 1; contact needs one below 0.
[[nodiscard]] const OptionList<CandidateOptions>& search_options();
[[nodiscard]] const OptionList<ContactOptions>& contact_options();
[[nodiscard]] const OptionList<geometry::FacingFade>& facing_options();
[[nodiscard]] const OptionList<NodalOptions>& nodal_options();
[[nodiscard]] const OptionList<Friction>& friction_options();
/// Options of the pair potential alone beside `facing_options`, of a contact or of a run.
template <class Owner>
[[nodiscard]] OptionList<Owner> path_options() {
    return {
        option("gauss", &Owner::gauss,
               {.help = "of the pair potential: Gauss's rule for the force of every pair over a step; else the mean of its "
                        "ends where that is enough",
                .laws = {"pair_potential"},
                .named = Named::changed,
                .is_switch = true,
                .depth = OptionDepth::laboratory})};
}

}  // namespace abut::contact
