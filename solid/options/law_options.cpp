#include "abut/solid/options/law_options.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/contact/option_table.hpp"
#include "abut/solid/options/option_words.hpp"

namespace abut::solid {
namespace {

bool is_of(const OptionFacts& option, ContactLaw law) {
    return std::ranges::find(option.laws, word_of(law_words, law)) != option.laws.end();
}

/// Keys of the options with other values than both owners have that the law alone reads.
template <class Owner>
void append_made(std::vector<std::string>& keys, ContactLaw law, const OptionList<Owner>& options, const Owner& given,
                 const Owner& plain, const Owner& also_plain) {
    for (const Option<Owner>& option : options) {
        const OptionValue value = option.get(given);
        if (is_of(option, law) && value != option.get(plain) && value != option.get(also_plain))
            keys.push_back((option.depth == OptionDepth::laboratory ? "laboratory." : "contact.") + option.scene_key());
    }
}

template <class Owner>
void take_back(const OptionList<Owner>& options, Owner& given) {
    const Owner plain;
    for (const Option<Owner>& option : options)
        if (!option.laws.empty()) option.set(given, option.get(plain));
}

/// The keys of choices made that `law` alone reads: "overlap and area", or nothing.
template <int Dim>
std::string made(ContactLaw law, const SolidOptions<Dim>& options) {
    if (!options.contact) return "";
    contact::ContactOptions with_exact_number;
    with_exact_number.quadrature = Dim;
    std::vector<std::string> keys;
    append_made(keys, law, contact::contact_options(), *options.contact, {}, with_exact_number);
    append_made(keys, law, contact::facing_options(), options.facing, {}, {});
    append_made(keys, law, contact::path_options<SolidOptions<Dim>>(), options, {}, {});
    std::string text;
    for (const std::string& key : keys) text += (text.empty() ? "" : " and ") + key;
    return text;
}

}  // namespace

template <int Dim>
void refuse_choices_of_other_law(ContactLaw acting, const SolidOptions<Dim>& options) {
    const bool acts_by_pairs = acting == ContactLaw::pair_potential;
    const std::string keys = made(acts_by_pairs ? ContactLaw::reconstruction : ContactLaw::pair_potential, options);
    if (keys.empty()) return;
    const std::string one = word_of(law_words, acting);
    const std::string other = word_of(law_words, acts_by_pairs ? ContactLaw::reconstruction : ContactLaw::pair_potential);
    throw BadInput(keys + (keys.find(" and ") == std::string::npos ? " has" : " have") + " no effect under law = \"" + one +
                   "\", which acts here. Set law = \"" + other + "\" (contact.law)" +
                   (acts_by_pairs ? ", which is for bodies of kinematics \"small\" and obstacles that do not turn" : "") +
                   ", or leave " + (keys.find(" and ") == std::string::npos ? "it" : "them") + " out.");
}

template <int Dim>
void take_back_choices_of_one_law(SolidOptions<Dim>& options) {
    if (!options.contact) return;
    take_back(contact::contact_options(), *options.contact);
    take_back(contact::facing_options(), options.facing);
    take_back(contact::path_options<SolidOptions<Dim>>(), options);
}

#define ABUT_INSTANTIATE(Dim)                                                             \
    template void refuse_choices_of_other_law<Dim>(ContactLaw, const SolidOptions<Dim>&); \
    template void take_back_choices_of_one_law<Dim>(SolidOptions<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
