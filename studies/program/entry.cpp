#include "studies/program/entry.hpp"

#include <algorithm>

namespace abut::studies {
namespace {

std::vector<Entry>& listed() {
    static std::vector<Entry> studies;
    return studies;
}

}  // namespace

bool list(Entry study) {
    listed().push_back(std::move(study));
    return true;
}

std::vector<Entry> all_studies() {
    std::vector<Entry> studies = listed();
    std::ranges::sort(studies, {}, &Entry::name);
    return studies;
}

apps::Program as_typed(apps::Program study) {
    study.name = "study " + study.name;
    return study;
}

int run_command(const apps::Program& typed, int argc, char** argv, const std::function<void(Flags&)>& add_options,
                const std::function<void()>& body) {
    const auto add = [&](apps::CommandParser& parser) {
        Flags flags(parser);
        add_options(flags);
    };
    return apps::run_program(typed, argc, argv, add, body);
}

}  // namespace abut::studies
