#include "abut/solid/law_options.hpp"

#include <array>
#include <string>

#include "abut/base/error.hpp"

namespace abut::solid {
namespace {

/// A choice of contact that one law alone reads, by its key. All others have a meaning under both.
template <int Dim>
struct Choice {
    const char* key;
    ContactLaw law;
    bool (*is_made)(const SolidOptions<Dim>& given, const SolidOptions<Dim>& plain);
    void (*take_back)(SolidOptions<Dim>& given, const SolidOptions<Dim>& plain);
};

template <int Dim>
const auto& choices() {
    using Given = const SolidOptions<Dim>&;
    using Taken = SolidOptions<Dim>&;
    using enum ContactLaw;
    static constexpr auto all = std::to_array<Choice<Dim>>({
        {"overlap", reconstruction, [](Given a, Given b) { return a.contact->overlap != b.contact->overlap; },
         [](Taken a, Given b) { a.contact->overlap = b.contact->overlap; }},
        {"weights", reconstruction, [](Given a, Given b) { return a.contact->weighting != b.contact->weighting; },
         [](Taken a, Given b) { a.contact->weighting = b.contact->weighting; }},
        {"area", reconstruction, [](Given a, Given b) { return a.contact->area != b.contact->area; },
         [](Taken a, Given b) { a.contact->area = b.contact->area; }},
        {"quadrature", reconstruction,
         [](Given a, Given b) { return a.contact->quadrature != b.contact->quadrature && a.contact->quadrature != Dim; },
         [](Taken a, Given b) { a.contact->quadrature = b.contact->quadrature; }},
        {"facing_cosine", reconstruction,
         [](Given a, Given b) { return a.contact->search.facing_cosine != b.contact->search.facing_cosine; },
         [](Taken a, Given b) { a.contact->search.facing_cosine = b.contact->search.facing_cosine; }},
        {"self", reconstruction,
         [](Given a, Given b) { return a.contact->search.self_contact != b.contact->search.self_contact; },
         [](Taken a, Given b) { a.contact->search.self_contact = b.contact->search.self_contact; }},
        {"facing_full", pair_potential, [](Given a, Given b) { return a.facing.full != b.facing.full; },
         [](Taken a, Given b) { a.facing.full = b.facing.full; }},
        {"facing_none", pair_potential, [](Given a, Given b) { return a.facing.none != b.facing.none; },
         [](Taken a, Given b) { a.facing.none = b.facing.none; }},
    });
    return all;
}

/// The keys of choices made that `law` alone reads: "overlap and area", or nothing.
template <int Dim>
std::string made(ContactLaw law, const SolidOptions<Dim>& options) {
    if (!options.contact) return "";
    SolidOptions<Dim> plain;
    plain.contact.emplace();
    std::string keys;
    for (const Choice<Dim>& choice : choices<Dim>())
        if (choice.law == law && choice.is_made(options, plain))
            keys += (keys.empty() ? "contact." : " and contact.") + std::string(choice.key);
    return keys;
}

}  // namespace

template <int Dim>
bool asks_for(ContactLaw law, const SolidOptions<Dim>& options) {
    return !made(law, options).empty();
}

template <int Dim>
void refuse_choices_of_other_law(ContactLaw acting, const SolidOptions<Dim>& options) {
    const bool acts_by_pairs = acting == ContactLaw::pair_potential;
    const std::string keys = made(acts_by_pairs ? ContactLaw::reconstruction : ContactLaw::pair_potential, options);
    if (keys.empty()) return;
    const std::string one = acts_by_pairs ? "pair_potential" : "reconstruction";
    const std::string other = acts_by_pairs ? "reconstruction" : "pair_potential";
    throw BadInput(keys + (keys.find(" and ") == std::string::npos ? " has" : " have") + " no effect under law = \"" + one +
                   "\", which acts here. Set law = \"" + other + "\" (contact.law)" +
                   (acts_by_pairs ? ", which is for bodies of kinematics \"small\" and obstacles that do not turn" : "") +
                   ", or leave " + (keys.find(" and ") == std::string::npos ? "it" : "them") + " out.");
}

template <int Dim>
void take_back_choices_of_one_law(SolidOptions<Dim>& options) {
    if (!options.contact) return;
    SolidOptions<Dim> plain;
    plain.contact.emplace();
    for (const Choice<Dim>& choice : choices<Dim>()) choice.take_back(options, plain);
}

#define ABUT_INSTANTIATE(Dim)                                                             \
    template bool asks_for<Dim>(ContactLaw, const SolidOptions<Dim>&);                    \
    template void refuse_choices_of_other_law<Dim>(ContactLaw, const SolidOptions<Dim>&); \
    template void take_back_choices_of_one_law<Dim>(SolidOptions<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
