#include "studies/program/entry.hpp"

namespace abut::studies {

apps::Program as_typed(apps::Program study) {
    study.name = "study " + study.name;
    return study;
}

int run_command(const apps::Program& typed, int argc, char** argv, const std::function<void(Flags&)>& add_options,
                const std::function<void()>& body) {
    const auto add = [&](CLI::App& app) {
        Flags flags(app);
        add_options(flags);
    };
    return apps::run_program(typed, argc, argv, add, body);
}

}  // namespace abut::studies
