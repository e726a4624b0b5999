#include "abut/run/user_words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <string_view>

#include "abut/run/option_table.hpp"

namespace abut::run {
namespace {

struct Name {
    std::string_view of_cpp;
    std::string_view word;
};

/// Longer ones before those that they begin with. tests/project/check_messages.py asks for every name of C++ that a
/// message of any layer has.
constexpr std::array names_of_cpp = std::to_array<Name>({
    {"BodyKinematics::scene", "run.kinematics = \"scene\""},
    {"Bond::fixed", "fixed"},
    {"CandidateOptions::largest_motion", "contact.largest_motion"},
    {"CandidateOptions::skin", "contact.skin"},
    {"Constraint::full", "constraint = \"full\""},
    {"Contact::faces", "the faces of contact"},
    {"ContactLaw::automatic", "\"automatic\""},
    {"ContactLaw::pair_potential", "contact.law = \"pair_potential\""},
    {"ContactLaw::reconstruction", "contact.law = \"reconstruction\""},
    {"MaterialLaw::st_venant_kirchhoff", "law = \"st_venant_kirchhoff\""},
    {"HostStep::coupling_of", "coupling_of"},
    {"HostStep::gradients_of", "gradients_of"},
    {"Kinematics::floating", "kinematics \"floating\""},
    {"Kinematics::finite", "kinematics \"finite\""},
    {"Kinematics::rigid", "kinematics \"rigid\""},
    {"Kinematics::small", "kinematics \"small\""},
    {"MeanForce::closed_trapezoid", "laboratory.mean_force = \"closed_trapezoid\" (--lab mean_force=closed_trapezoid)"},
    {"MeanForce::discrete_gradient", "laboratory.mean_force = \"discrete_gradient\""},
    {"PathMean::gauss_1", "the mean \"1\""},
    {"PathMean::system", "the mean \"system\""},
    {"Precision::double_precision", "laboratory.precision = \"double\" (--lab precision=double)"},
    {"RigidObstacle::path", "its path"},
    {"RigidObstacle::placement", "its path and its rotation"},
    {"Scene::added_velocity", "velocity"},
    {"Scene::after_step", "after_step"},
    {"Scene::displacement", "displacement"},
    {"Scene::energy_scale", "energy_scale"},
    {"Scene::solid", "the scene"},
    {"Scene::spin", "spin"},
    {"SearchLimits::bytes", "the limit on memory (abut detect: --max-memory)"},
    {"SearchLimits::pairs", "contact.max_pairs (--max-pairs)"},
    {"SolidOptions::acceleration", "gravity"},
    {"SolidOptions::temperature_rise", "temperature_rise"},
    {"SolidOptions::body_load", "the load on its cells"},
    {"SolidOptions::bonds", "[[bonds]]"},
    {"SolidOptions::contact", "contact.enabled = true"},
    {"SolidOptions::ignored_pairs", "contact.ignored_pairs"},
    {"SolidOptions::body_friction", "contact.pairs"},
    {"SolidOptions::friction", "contact.friction"},
    {"SolidOptions::interference", "contact.pairs"},
    {"SolidOptions::moments", "[moments]"},
    {"SolidOptions::springs", "[springs]"},
    {"StepDevice::host", "run.device = \"host\""},
    {"SurfaceOptions::displacement", "--displacement"},
    {"TractionCondition::value", "value"},
    {"UnusableFaces::skip", "--unusable skip"},
});

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// "body 3" and "body 3 ('ball')" become "body 'ball'".
void name_numbers(std::string& text, std::string_view what, const std::vector<std::string>& names) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) {
        if (at > 0 && std::isalpha(static_cast<unsigned char>(text[at - 1])) != 0) continue;
        const std::size_t begin = at + what.size();
        std::size_t number = 0;
        const char* const last = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data() + begin, last, number);
        if (error != std::errc() || number >= names.size()) continue;
        const std::string name = "'" + names[number] + "'", beside = " (" + name + ")";
        std::size_t length = static_cast<std::size_t>(stop - (text.data() + begin));
        if (std::string_view(stop, last).starts_with(beside)) length += beside.size();
        text.replace(begin, length, name);
    }
}

bool is_of_option(char c) { return (c >= 'a' && c <= 'z') || c == '-'; }

std::string_view head_of(std::string_view text, bool (*belongs)(char)) {
    return text.substr(0, static_cast<std::size_t>(std::ranges::find_if_not(text, belongs) - text.begin()));
}

/// The option of a command line that a scene has a key for; nullptr: there is none. `flag`: "--facing-cosine".
const OptionFacts* option_of(std::string_view flag) {
    for (const Option<RunOptions>& option : run_options())
        if (option.places.scene && option.kind != OptionKind::path && option.flag() == flag) return &option;
    return nullptr;
}

/// Value that stands behind an option; empty: nothing.
std::string_view value_in(const OptionFacts& option, std::string_view rest) {
    if (!rest.starts_with(' ')) return {};
    const auto is_of_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    const std::string_view word = head_of(rest.substr(1), is_of_word);
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    const bool is_number = !word.empty() && std::ranges::all_of(word, is_digit);
    const bool is_truth = option.is_switch && (word == "on" || word == "off");
    const bool is_word = std::ranges::find(option.words, word) != option.words.end();
    return is_number || is_truth || is_word ? word : std::string_view{};
}

/// `run.restart = 50`, `run.filter = "neutral"`, `laboratory.events = false`
std::string setting(const OptionFacts& option, std::string_view value) {
    const std::string key = option.table + "." + option.scene_key();
    if (value.empty()) return key;
    if (option.kind == OptionKind::truth) return key + (value == "on" ? " = true" : " = false");
    const std::string quote = option.kind == OptionKind::word ? "\"" : "";
    return key + " = " + quote + std::string(value) + quote;
}

/// How a command line gives it: "--restart 50", "--lab events=off".
std::string on_command_line(const OptionFacts& option, std::string_view flag, std::string_view value) {
    const bool is_in_laboratory = option.depth == OptionDepth::laboratory;
    std::string text = is_in_laboratory ? "--lab " + option.scene_key() : std::string(flag);
    if (!value.empty()) text += (is_in_laboratory ? "=" : " ") + std::string(value);
    return text;
}

}  // namespace

std::string in_user_words(std::string text, const SceneNames& names) {
    for (const Name& name : names_of_cpp) replace_all(text, name.of_cpp, name.word);
    if (text.find("contact: ") != std::string::npos) return text;  // its surface numbers bodies in another way
    name_numbers(text, "body ", names.bodies);
    name_numbers(text, "obstacle ", names.obstacles);
    return text;
}

std::string with_keys(const std::string& text) {
    std::string result;
    std::string_view rest = text;
    for (std::size_t at = rest.find("--"); at != std::string_view::npos; at = rest.find("--")) {
        result += rest.substr(0, at);
        const bool begins_word = at == 0 ? result.empty() || result.back() == ' ' : rest[at - 1] == ' ';
        rest.remove_prefix(at);
        const std::string_view option = head_of(rest, is_of_option);
        rest.remove_prefix(option.size());
        const OptionFacts* known = begins_word && option.size() > 2 ? option_of(option) : nullptr;
        if (!known) {
            result += option;
            continue;
        }
        const std::string_view value = value_in(*known, rest);
        result += setting(*known, value) + " (" + on_command_line(*known, option, value) + ")";
        rest.remove_prefix(value.empty() ? 0 : value.size() + 1);
    }
    return result + std::string(rest);
}

}  // namespace abut::run
