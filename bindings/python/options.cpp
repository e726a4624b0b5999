#include <pybind11/stl/filesystem.h>

#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/given_value.hpp"
#include "abut/run/option_table.hpp"
#include "abut/run/steps/preset.hpp"
#include "numbers.hpp"
#include "scenes.hpp"

namespace abut::python {
namespace {

/// "'memm', 'leapfrog'"
std::string quoted(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "'" : ", '") + word + "'";
    return text;
}

/// Value of the kind of the option; py::cast_error where it cannot be that.
OptionValue value_of(const OptionFacts& option, const py::handle& value) {
    switch (option.kind) {
        case OptionKind::truth:
            if (option.is_switch && py::isinstance<py::str>(value))
                return word_among({"off", "on"}, option.name, py::cast<std::string>(value)) == 1;
            return py::cast<bool>(value);
        case OptionKind::count:
            return py::cast<std::int64_t>(value);
        case OptionKind::number:
            return number_of_argument(option.name, option.limits.unit, value);
        case OptionKind::numbers:
            return numbers_in(option.limits.unit, value);
        case OptionKind::path:
            return py::cast<std::filesystem::path>(value).string();
        case OptionKind::word:
            break;
    }
    return option.words[word_among(option.words, option.name, py::cast<std::string>(value))];
}

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const auto& [word, preset] : run::preset_words) names.emplace_back(word);
    return names;
}

/// Calls with an option by name; a value of another type is named.
template <class Call>
void take(const std::string& name, const py::handle& value, const Call& call) {
    try {
        call();
    } catch (const py::cast_error&) {
        throw py::type_error(name + " cannot be " + std::string(py::str(py::repr(value))));
    }
}

const Option<run::RunOptions>& option_of(const std::string& name) {
    std::string names = "preset";
    for (const auto& option : run::run_options()) {
        if (!option.places.python) continue;
        if (option.name == name) return option;
        names += ", " + option.name;
    }
    throw py::type_error("there is no option '" + name + "'; there are " + names);
}

/// "{'memm', 'leapfrog'}"
std::string type_of(const OptionFacts& option) {
    switch (option.kind) {
        case OptionKind::truth:
            return option.is_switch ? "bool, 'on' or 'off'" : "bool";
        case OptionKind::count:
            return "int";
        case OptionKind::number:
            return "float";
        case OptionKind::numbers:
            return "list of float";
        case OptionKind::path:
            return "path";
        case OptionKind::word:
            break;
    }
    return "{" + quoted(option.words) + "}";
}

}  // namespace

run::RunOptions options_of(const py::dict& given) {
    run::RunOptions options;
    take_options(given, options);
    return options;
}

void take_options(const py::dict& given, run::RunOptions& options) {
    const run::RunOptions plain;
    if (given.contains("steps")) options.time = run::not_given;
    if (given.contains("time")) options.steps = 0;
    if (given.contains("cfl") || given.contains("preset")) {
        options.dt = run::not_given;
        options.allow_unstable = false;
    }
    if (given.contains("frames")) {
        if (given.contains("times")) throw py::type_error("frames are given, and times of them; give one of both");
        options.times.clear();
    }
    if (given.contains("preset"))
        take("preset", given["preset"], [&] {  // below all others
            run::apply(choice_called(run::preset_words, "preset", py::cast<std::string>(given["preset"])), options);
        });
    for (const auto& [key, value] : given) {
        const auto name = py::cast<std::string>(key);
        if (name == "preset") continue;
        const Option<run::RunOptions>& option = option_of(name);
        take(name, value, [&, &value = value] {
            const OptionValue taken = value_of(option, value);
            if (option.name != "cfl") check_value("", option, taken, option.get(plain));  // the step that it gives is judged
            option.set(options, taken);
        });
    }
}

std::string option_text() {
    const run::RunOptions plain;
    std::string text = "preset : {" + quoted(preset_names()) + "}\n    Several choices at once, below all others.\n";
    for (const auto& option : run::run_options()) {
        if (!option.places.python) continue;
        const std::string usual = default_text(option, option.get(plain));
        text += option.name + " : " + type_of(option) + (usual.empty() ? "" : ", default " + usual) + "\n    " + option.help;
        text += (*option.limits.unit != '\0' ? " [" + std::string(option.limits.unit) + "]" : "") + "\n";
    }
    return text;
}

}  // namespace abut::python
