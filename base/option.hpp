#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// Options as tables: an option is one member of a struct and one line of a list. Command lines, keys of scene files,
/// arguments of Python and C, limits, summaries, help and documents are made from the list.
namespace abut {

/// A choice and its word in files, on command lines and in summaries.
template <class Choice>
struct Word {
    const char* word;
    Choice choice;
};

/// The word of a choice; empty where none of these has it.
template <class Choice, class Words>
[[nodiscard]] std::string word_of(const Words& words, Choice choice) {
    for (const Word<Choice>& one : words)
        if (one.choice == choice) return one.word;
    return "";
}

/// The values that a number may take.
struct Limits {
    const char* unit = "";                                    ///< empty: a plain number
    double above = -std::numeric_limits<double>::infinity();  ///< open, unless `from`
    double below = std::numeric_limits<double>::infinity();   ///< open, unless `closed`
    bool closed = false;                                      ///< `below` itself is allowed
    bool zero = false;                                        ///< 0 is allowed as well
    const char* remedy = "";                                  ///< ends the message of a command line
    bool from = false;                                        ///< `above` itself is allowed
    bool endless = false;                                     ///< infinity is allowed as well

    [[nodiscard]] bool allow(double value) const;
};

/// "above 0 kg/m^3", "above 0, at most 1"; empty where every finite number is allowed.
[[nodiscard]] std::string text_of(const Limits& limits);
/// "2 kg/m^3"
[[nodiscard]] std::string with_unit_of(const Limits& limits, double value);

enum class OptionKind {
    truth,
    count,
    number,
    numbers,  ///< a list that increases
    word,
    path,
};

/// A value of a truth, a count, a number, a word or a path, and numbers.
using OptionValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;

/// When a summary names an option.
enum class Named {
    always,
    changed,      ///< where it is not the default
    with_scheme,  ///< where the scheme that is used reads it, and it is a number
    never,        ///< the summary says in another place what was used
};

/// Who needs an option: help texts, keys and documents show them in this order.
enum class OptionDepth {
    everyday,
    expert,
    laboratory,  ///< compares methods; scenes have it in [laboratory], command lines as --lab KEY=VALUE
};

/// Places where an option may be given.
struct OptionPlaces {
    bool scene = true;
    bool command_line = true;
    bool python = true;
};

/// All that is told of an option beside its name and its member.
struct OptionTraits {
    std::string help;                                     ///< a phrase, without unit and default
    Limits limits{};                                      ///< of a number, and of each of a list
    std::int64_t least = 0;                               ///< of a count
    std::int64_t most = std::numeric_limits<int>::max();  ///< of a count
    std::string key{};                                    ///< in scene files; empty: the name
    std::string by_default{};                             ///< told for a default that is no value: "out/<scene>"
    /// Words of the laws of contact and of the schemes under which it has a meaning; empty: all
    std::vector<std::string> laws{}, schemes{};
    Named named = Named::always;
    OptionPlaces places{};
    bool is_switch = false;    ///< of a truth: "on" and "off" on command lines and in summaries; else it is a flag
    bool shapes_rest = false;  ///< bodies at rest depend on it as well
    bool of_build = false;  ///< of a choice: other values than its words are refused by what uses them, not by `check_value`
    bool free_on_resume = false;  ///< a run that goes on from a checkpoint may have another value
    std::string table{};          ///< of a scene file: "contact"
    std::string group{};          ///< of a help text: "Contact"
    OptionDepth depth = OptionDepth::expert;
};

struct OptionFacts : OptionTraits {
    std::string name;  ///< "facing_cosine"; of a command line it is --facing-cosine
    OptionKind kind = OptionKind::truth;
    std::vector<std::string> words{};  ///< of a choice, in the order of its values

    [[nodiscard]] const std::string& scene_key() const { return key.empty() ? name : key; }
    [[nodiscard]] std::string flag() const;  ///< "--facing-cosine"
};

template <class Owner>
struct Option : OptionFacts {
    std::function<OptionValue(const Owner&)> get;
    std::function<void(Owner&, const OptionValue&)> set;  ///< takes a value of its kind that `allows` allows
};
template <class Owner>
using OptionList = std::vector<Option<Owner>>;

/// An option of one owner, which must outlive it.
struct BoundOption {
    const OptionFacts* facts;
    std::function<OptionValue()> get;
    std::function<void(const OptionValue&)> set;
};

/// Whether an option may have this value, which is of its kind.
[[nodiscard]] bool allows(const OptionFacts& option, const OptionValue& value);
/// First fault of a list that has to increase within limits, and its remedy: "number 2 is 0.1 s, after 0.3 s. Give them in
/// increasing order, each once."; empty: there is none.
[[nodiscard]] std::string fault_in(const Limits& limits, std::span<const double> numbers);
/// "above 0 s", "0 to 3", "0 or more"; of a word "0 (half) and 1 (stiffness)".
[[nodiscard]] std::string allowed_values(const OptionFacts& option);
/// "0.9", "0.1,0.3", "memm"; of a truth "on" or "off".
[[nodiscard]] std::string text_of(const OptionValue& value);
/// As text_of; of a value that stands for "not given" what `by_default` tells, or nothing.
[[nodiscard]] std::string default_text(const OptionFacts& option, const OptionValue& by_default);
/// Whether they are equal; NaN, as of a number that is not given, is equal to itself.
[[nodiscard]] bool is_same(const OptionValue& a, const OptionValue& b);
/// Throws BadInput where `allows` is false: "<whose>area is 2; 0 (fast) and 1 (exact) are allowed.", for a list its fault.
void check_value(const std::string& whose, const OptionFacts& option, const OptionValue& value,
                 const OptionValue& by_default);

template <class Owner>
[[nodiscard]] BoundOption bound(const Option<Owner>& option, Owner& owner) {
    return {&option, [&] { return option.get(owner); }, [&](const OptionValue& value) { option.set(owner, value); }};
}

/// The option of this name; throws std::out_of_range if there is none.
template <class Owner>
[[nodiscard]] const Option<Owner>& named(const OptionList<Owner>& options, const std::string& name) {
    for (const Option<Owner>& option : options)
        if (option.name == name) return option;
    throw std::out_of_range("there is no option " + name);
}

/// Throws BadInput for the first option with a value that is not allowed.
template <class Owner>
void check_options(const std::string& whose, const OptionList<Owner>& options, const Owner& owner) {
    const Owner plain{};
    for (const Option<Owner>& option : options) check_value(whose, option, option.get(owner), option.get(plain));
}

/// A truth, a count, a number, numbers or a path, by the type of the member.
template <class Owner, class Value>
[[nodiscard]] Option<Owner> option(std::string name, Value Owner::*member, OptionTraits traits) {
    Option<Owner> made{{std::move(traits), std::move(name)}, {}, {}};
    if constexpr (std::is_same_v<Value, std::filesystem::path>) {
        made.kind = OptionKind::path;
        made.get = [member](const Owner& owner) { return OptionValue((owner.*member).string()); };
        made.set = [member](Owner& owner, const OptionValue& value) { owner.*member = std::get<std::string>(value); };
    } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
        made.kind = OptionKind::numbers;
        made.get = [member](const Owner& owner) { return OptionValue(owner.*member); };
        made.set = [member](Owner& owner, const OptionValue& value) {
            owner.*member = std::get<std::vector<double>>(value);
        };
    } else {
        static_assert(std::is_arithmetic_v<Value>, "an enumeration has words: see `choice`");
        using Held = std::conditional_t<std::is_same_v<Value, bool>, bool,
                                        std::conditional_t<std::is_floating_point_v<Value>, double, std::int64_t>>;
        made.kind = std::is_same_v<Held, bool>     ? OptionKind::truth
                    : std::is_same_v<Held, double> ? OptionKind::number
                                                   : OptionKind::count;
        made.get = [member](const Owner& owner) { return OptionValue(static_cast<Held>(owner.*member)); };
        made.set = [member](Owner& owner, const OptionValue& value) {
            owner.*member = static_cast<Value>(std::get<Held>(value));
        };
    }
    return made;
}

/// One of a few words. `words`: a range of Word<Choice>, in the order of the values.
template <class Owner, class Choice, class Words>
[[nodiscard]] Option<Owner> choice(std::string name, Choice Owner::*member, const Words& words, OptionTraits traits) {
    Option<Owner> made{{std::move(traits), std::move(name)}, {}, {}};
    made.kind = OptionKind::word;
    std::vector<Choice> choices;
    for (const Word<Choice>& word : words) {
        made.words.emplace_back(word.word);
        choices.push_back(word.choice);
    }
    made.get = [member, words = made.words, choices](const Owner& owner) {
        for (std::size_t i = 0; i < choices.size(); ++i)
            if (owner.*member == choices[i]) return OptionValue(words[i]);
        return OptionValue(std::to_string(static_cast<int>(owner.*member)));
    };
    made.set = [member, words = made.words, choices](Owner& owner, const OptionValue& value) {
        for (std::size_t i = 0; i < choices.size(); ++i)
            if (std::get<std::string>(value) == words[i]) owner.*member = choices[i];
    };
    return made;
}

/// An option of a member as one of the struct that holds it.
template <class Outer, class Owner>
[[nodiscard]] Option<Outer> within(Owner Outer::*member, const Option<Owner>& inner) {
    return {static_cast<const OptionFacts&>(inner),
            [member, get = inner.get](const Outer& outer) { return get(outer.*member); },
            [member, set = inner.set](Outer& outer, const OptionValue& value) { set(outer.*member, value); }};
}
template <class Outer, class Owner>
[[nodiscard]] OptionList<Outer> within(Owner Outer::*member, const OptionList<Owner>& inner) {
    OptionList<Outer> made;
    for (const Option<Owner>& one : inner) made.push_back(within(member, one));
    return made;
}

}  // namespace abut
