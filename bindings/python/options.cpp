#include <pybind11/stl/filesystem.h>

#include <functional>
#include <map>
#include <utility>

#include "scenes.hpp"

namespace abut::python {
namespace {

using Take = std::function<void(run::RunOptions&, const py::handle&)>;

template <class Value, class Member>
Take take_value(Member member) {
    return [member](run::RunOptions& options, const py::handle& value) { member(options) = py::cast<Value>(value); };
}

template <class Choice, std::size_t N, class Member>
Take take_word(const std::array<run::Word<Choice>, N>& words, Member member) {
    return [&words, member](run::RunOptions& options, const py::handle& value) {
        const auto given = py::cast<std::string>(value);
        std::string known;
        for (const auto& [word, choice] : words) {
            if (given == word) {
                member(options) = choice;
                return;
            }
            known += (known.empty() ? "'" : ", '") + std::string(word) + "'";
        }
        throw py::value_error("'" + given + "' is not known; there are " + known);
    };
}

#define ABUT_OPTION(member) \
    [](run::RunOptions & options) -> auto& { return options.member; }

const std::map<std::string, Take>& known_options() {
    static const std::map<std::string, Take> known{
        {"time", take_value<double>(ABUT_OPTION(time))},
        {"steps", take_value<int>(ABUT_OPTION(steps))},
        {"cfl", take_value<double>(ABUT_OPTION(cfl))},
        {"dt", take_value<double>(ABUT_OPTION(dt))},
        {"allow_unstable", take_value<bool>(ABUT_OPTION(allow_unstable))},
        {"integrator", take_word(run::integrator_words, ABUT_OPTION(integrator))},
        {"precision", take_word(run::precision_words, ABUT_OPTION(precision))},
        {"device", take_word(run::device_words, ABUT_OPTION(device))},
        {"levels", take_value<int>(ABUT_OPTION(levels))},
        {"contact_margin", take_value<int>(ABUT_OPTION(contact_margin))},
        {"contact_levels", take_value<int>(ABUT_OPTION(contact_levels))},
        {"gauge", take_value<double>(ABUT_OPTION(gauge))},
        {"filter", take_word(run::filter_words, ABUT_OPTION(filter))},
        {"restart", take_value<int>(ABUT_OPTION(restart))},
        {"kinematics", take_word(run::kinematics_words, ABUT_OPTION(kinematics))},
        {"law", take_word(run::law_words, ABUT_OPTION(law))},
        {"overlap", take_word(run::overlap_words, ABUT_OPTION(contact.overlap))},
        {"weights", take_word(run::weighting_words, ABUT_OPTION(contact.weighting))},
        {"area", take_word(run::area_words, ABUT_OPTION(contact.area))},
        {"events", take_word(run::event_words, ABUT_OPTION(contact.events))},
        {"quadrature", take_value<int>(ABUT_OPTION(contact.quadrature))},
        {"skin", take_value<double>(ABUT_OPTION(contact.search.skin))},
        {"self_contact", take_value<bool>(ABUT_OPTION(contact.search.self_contact))},
        {"facing_cosine", take_value<double>(ABUT_OPTION(contact.search.facing_cosine))},
        {"facing_full", take_value<double>(ABUT_OPTION(facing.full))},
        {"facing_none", take_value<double>(ABUT_OPTION(facing.none))},
        {"compression_limit", take_value<double>(ABUT_OPTION(contact.compression_limit))},
        {"neumann", take_word(run::free_face_words, ABUT_OPTION(neumann))},
        {"corners", take_word(run::corner_words, ABUT_OPTION(corners))},
        {"threads", take_value<int>(ABUT_OPTION(threads))},
        {"out", take_value<std::filesystem::path>(ABUT_OPTION(out))},
        {"interval", take_value<int>(ABUT_OPTION(interval))},
        {"frames", take_value<int>(ABUT_OPTION(frames))},
    };
    return known;
}

#undef ABUT_OPTION

}  // namespace

run::RunOptions options_of(const py::dict& given) {
    run::RunOptions options;
    for (const auto& [key, value] : given) {
        const auto name = py::cast<std::string>(key);
        const auto found = known_options().find(name);
        if (found == known_options().end()) {
            std::string names;
            for (const auto& [one, take] : known_options()) names += (names.empty() ? "" : ", ") + one;
            throw py::type_error("there is no option '" + name + "'; there are " + names);
        }
        try {
            found->second(options, value);
        } catch (const py::cast_error&) {
            throw py::type_error(name + " cannot be " + std::string(py::str(py::repr(value))));
        } catch (const py::value_error& error) {
            throw py::value_error(name + ": " + error.what());
        }
    }
    for (const auto& [name, value] : {std::pair("interval", options.interval), std::pair("threads", options.threads),
                                      std::pair("frames", options.frames), std::pair("steps", options.steps)})
        if (value < 0) throw py::value_error(std::string(name) + ": " + std::to_string(value) + "; 0 and more are allowed");
    return options;
}

}  // namespace abut::python
