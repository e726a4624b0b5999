#include "abut/contact/option_table.hpp"

#include "abut/contact/nodal_contact.hpp"

namespace abut::contact {
namespace {

const std::vector<std::string> reconstruction{"reconstruction"}, pair_potential{"pair_potential"};

std::vector<Word<geometry::BroadPhase>> broad_phase_words() {
    std::vector<Word<geometry::BroadPhase>> words;
    for (const geometry::BroadPhase method : geometry::broad_phases())
        words.push_back({geometry::name(method).data(), method});
    return words;
}

/// Members that the options of both engines have.
template <class Owner>
Option<Owner> events() {
    return option("events", &Owner::events,
                  {.help = "cut steps where a pair opens, closes or changes its overlap; of the pair potential: look closer "
                           "where the mean of "
                           "the ends of a step is not enough",
                   .is_switch = true,
                   .depth = OptionDepth::laboratory});
}
template <class Owner>
Option<Owner> compression_warning() {
    return option(
        "compression_warning", &Owner::compression_warning,
        {.help = "depth of a pair of faces over that of its cells from which on a step counts as strongly compressed",
         .limits = {.above = 0.0, .endless = true},
         .named = Named::changed});
}
template <class Owner>
Option<Owner> compression_limit() {
    return option("compression_limit", &Owner::compression_limit,
                  {.help = "depth of a pair of faces over that of its cells at which the run stops",
                   .limits = {.above = 0.0, .endless = true}});
}

OptionList<CandidateOptions> make_search_options() {
    using Of = CandidateOptions;
    return {
        choice("broad_phase", &Of::broad_phase, broad_phase_words(),
               {.help = "what finds faces that are near; results are the same to the last digit",
                .of_build = true,
                .depth = OptionDepth::laboratory}),
        option("self_contact", &Of::self_contact,
               {.help = "contact acts between parts of one body, too",
                .key = "self",
                .named = Named::changed,
                .is_switch = true,
                .depth = OptionDepth::everyday}),
        option("self_contact_rings", &Of::self_contact_rings,
               {.help = "of contact between parts of one body: faces within so many steps over common corners do not "
                        "touch; 0: all may",
                .laws = reconstruction,
                .named = Named::changed,
                .depth = OptionDepth::laboratory}),
        option("facing_cosine", &Of::facing_cosine,
               {.help = "faces look at each other where the cosine between their normals is below it; nearer to 0 sharper "
                        "tips are seen",
                .limits = {.above = -1.0, .below = 1.0, .closed = true},
                .laws = reconstruction,
                .depth = OptionDepth::laboratory}),
        option("candidate_distance", &Of::distance,
               {.help = "gap up to which faces are listed; contact needs 0",
                .limits = {.unit = "m", .above = 0.0, .zero = true},
                .named = Named::changed,
                .places = {.scene = false, .command_line = false, .python = false}}),
        option("skin", &Of::skin,
               {.help = "how far faces move before the list of near faces is rebuilt; 0: chosen from the number of faces "
                        "and pairs and the motion",
                .limits = {.unit = "m", .above = 0.0, .zero = true},
                .named = Named::never}),
        option("largest_motion", &Of::largest_motion,
               {.help = "a face that moves farther within a step than this times the extent of all surfaces has diverged",
                .limits = {.above = 0.0, .endless = true},
                .named = Named::changed}),
        within(&Of::limits, option("max_pairs", &geometry::SearchLimits::pairs,
                                   {.help = "pairs of near faces that a search may list",
                                    .most = std::numeric_limits<std::int64_t>::max(),
                                    .named = Named::changed}))};
}

OptionList<ContactOptions> make_contact_options() {
    using Of = ContactOptions;
    const auto of_search = [](const char* name) { return within(&Of::search, named(search_options(), name)); };
    Option<Of> facing_cosine = of_search("facing_cosine");
    facing_cosine.limits = {.above = -1.0, .below = 0.0};
    return {of_search("broad_phase"),
            choice("overlap", &Of::overlap, overlap_words,
                   {.help = "area that follows the motion in a step (energy exact) or is frozen (cheaper)",
                    .laws = reconstruction,
                    .depth = OptionDepth::laboratory}),
            choice("weighting", &Of::weighting, weighting_words,
                   {.help = "share of a correction between two faces: halves or by their stiffness",
                    .laws = reconstruction,
                    .shapes_rest = true,
                    .depth = OptionDepth::laboratory}),
            choice("area", &Of::area, area_words,
                   {.help = "arithmetic of overlap areas: filtered doubles or CGAL's exact numbers",
                    .laws = reconstruction,
                    .shapes_rest = true,
                    .depth = OptionDepth::laboratory}),
            events<Of>(),
            option("quadrature", &Of::quadrature,
                   {.help = "Gauss points on each part of a step; 0: the exact number, 2 in 2D, 3 in 3D",
                    .most = 3,
                    .laws = reconstruction,
                    .depth = OptionDepth::laboratory}),
            facing_cosine,
            compression_limit<Of>(),
            of_search("self_contact"),
            of_search("self_contact_rings"),
            of_search("candidate_distance"),
            of_search("largest_motion"),
            compression_warning<Of>(),
            of_search("skin"),
            of_search("max_pairs")};
}

OptionList<geometry::FacingFade> make_facing_options() {
    using Of = geometry::FacingFade;
    return {option("facing_full", &Of::full,
                   {.help = "of the pair potential: cosine between the normals of two faces up to which their pair has its "
                            "whole weight",
                    .limits = {.above = -1.0, .below = 0.0, .from = true},
                    .laws = pair_potential,
                    .named = Named::changed}),
            option("facing_none", &Of::none,
                   {.help = "of the pair potential: cosine from which on a pair has no weight; nearer to 0 sharper tips and "
                            "edges are seen",
                    .limits = {.above = -1.0, .below = 0.0, .closed = true},
                    .laws = pair_potential,
                    .named = Named::changed})};
}

OptionList<Friction> make_friction_options() {
    using Of = Friction;
    const Limits from_zero{.above = 0.0, .from = true};
    return {
        option("friction", &Of::coefficient,
               {.help = "coefficient of friction between faces that touch; 0: none",
                .limits = from_zero,
                .named = Named::changed,
                .depth = OptionDepth::everyday}),
        option("sliding_friction", &Of::sliding_coefficient,
               {.help = "coefficient of fast sliding, where it is another than at rest: give decay_speed or decay_slip, too",
                .limits = from_zero,
                .by_default = "that at rest",
                .named = Named::changed}),
        option("decay_speed", &Of::decay_speed,
               {.help = "speed of sliding at which friction has gone 1 - 1/e of the way from rest to fast sliding",
                .limits = {.unit = "m/s", .above = 0.0, .endless = true},
                .by_default = "infinity",
                .named = Named::changed}),
        option("decay_slip", &Of::decay_slip,
               {.help = "path of sliding after which friction is that of fast sliding",
                .limits = {.unit = "m", .above = 0.0, .endless = true},
                .by_default = "infinity",
                .named = Named::changed}),
        option("shear_strength", &Of::strength,
               {.help = "shear stress that faces in contact bear beside friction, whatever presses them (Tresca)",
                .limits = {.unit = "Pa", .above = 0.0, .from = true},
                .named = Named::changed}),
        option("relaxation_time", &Of::relaxation_time,
               {.help = "time in which a force by which faces stick falls by 1/e: damps rigid bodies that flutter, and lets "
                        "all creep",
                .limits = {.unit = "s", .above = 0.0, .endless = true},
                .by_default = "infinity",
                .named = Named::changed})};
}

/// An option of the first law, that of all pairs. Without a law its values are the defaults, and they make none.
Option<NodalOptions> of_first_law(const Option<Friction>& inner) {
    return {static_cast<const OptionFacts&>(inner),
            [get = inner.get](const NodalOptions& options) {
                return get(options.friction.any() ? options.friction.laws.front() : Friction{});
            },
            [get = inner.get, set = inner.set](NodalOptions& options, const OptionValue& value) {
                std::vector<Friction>& laws = options.friction.laws;
                if (laws.empty() && is_same(value, get(Friction{}))) return;
                if (laws.empty()) laws.emplace_back();
                set(laws.front(), value);
            }};
}

OptionList<NodalOptions> make_nodal_options() {
    using Of = NodalOptions;
    const auto of_search = [](const char* name) { return within(&Of::search, named(search_options(), name)); };
    OptionList<Of> options{of_search("skin"), of_search("largest_motion"), of_search("max_pairs"), compression_warning<Of>(),
                           compression_limit<Of>()};
    for (const Option<Of>& option : within(&Of::facing, facing_options())) options.push_back(option);
    for (const Option<Friction>& option : friction_options()) options.push_back(of_first_law(option));
    options.push_back(events<Of>());
    for (const Option<Of>& option : path_options<Of>()) options.push_back(option);
    options.push_back(of_search("self_contact"));
    return options;
}

}  // namespace

const OptionList<CandidateOptions>& search_options() {
    static const OptionList<CandidateOptions> options = make_search_options();
    return options;
}
const OptionList<ContactOptions>& contact_options() {
    static const OptionList<ContactOptions> options = make_contact_options();
    return options;
}
const OptionList<geometry::FacingFade>& facing_options() {
    static const OptionList<geometry::FacingFade> options = make_facing_options();
    return options;
}
const OptionList<Friction>& friction_options() {
    static const OptionList<Friction> options = make_friction_options();
    return options;
}
const OptionList<NodalOptions>& nodal_options() {
    static const OptionList<NodalOptions> options = make_nodal_options();
    return options;
}

}  // namespace abut::contact
