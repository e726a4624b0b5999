#include "studies/program/flags.hpp"

#include "apps/support/command_line.hpp"

namespace abut::studies {

CLI::Option* Flags::number(const std::string& option, double& value, const std::string& help, const Limits& limits) {
    return grouped(apps::add_number(app_, option, value, help, limits));
}

CLI::Option* Flags::numbers(const std::string& option, std::vector<double>& values, const std::string& help,
                            const Limits& limits) {
    return grouped(apps::add_numbers(app_, option, values, help, limits));
}

CLI::Option* Flags::body_values(const std::string& option, apps::BodyValues& values, const std::string& help,
                                const Limits& limits) {
    return grouped(apps::add_body_values(app_, option, values, help, limits));
}

CLI::Option* Flags::count(const std::string& option, int& value, const std::string& help, int least) {
    return grouped(apps::add_count(app_, option, value, help, least));
}

CLI::Option* Flags::count(const std::string& option, std::int64_t& value, const std::string& help) {
    return grouped(app_.add_option(option, value, help)->check(CLI::PositiveNumber)->capture_default_str());
}

CLI::Option* Flags::counts(const std::string& option, std::vector<int>& values, const std::string& help, int least) {
    return grouped(apps::add_counts(app_, option, values, help, least));
}

CLI::Option* Flags::flag(const std::string& option, bool& value, const std::string& help) {
    return grouped(app_.add_flag(option, value, help)->default_str("off"));
}

CLI::Option* Flags::names(const std::string& option, std::vector<std::string>& values, const std::string& help,
                          const std::vector<std::string>& known) {
    return grouped(app_.add_option(option, values, help + "; by default all of " + apps::joined(known))
                       ->delimiter(',')
                       ->check(apps::one_of(known))
                       ->type_name("NAME,..."));
}

CLI::Option* Flags::lines(const std::string& option, std::vector<std::string>& values, const std::string& help,
                          const std::function<std::string(const std::string&)>& refusal) {
    const auto check = [refusal](const std::string& text) { return refusal(text); };
    return grouped(app_.add_option(option, values, help)
                       ->type_name("OPTIONS")
                       ->expected(1)
                       ->take_all()
                       ->check(CLI::Validator(check, "", "")));
}

CLI::Option* Flags::positional(const std::string& name, const std::string& help, const std::vector<std::string>& known) {
    const auto ignore = [](const std::string&) {};
    return app_.add_option_function<std::string>(name, ignore, help)->check(apps::one_of(known))->required();
}

CLI::Option* Flags::out(std::filesystem::path& folder) {
    return app_.add_option("--out", folder, "folder of all results; made if it is not there")
        ->type_name("DIR")
        ->capture_default_str()
        ->group("Output");
}

std::vector<CLI::Option*> Flags::of_group(const std::string& name) const {
    return app_.get_options([&](const CLI::Option* option) { return option->get_group() == name; });
}

CLI::Option* Flags::word(const std::string& option, const std::function<void(const std::string&)>& choose,
                         const std::string& help, const std::vector<std::string>& known, const std::string& by_default) {
    auto* added = app_.add_option_function<std::string>(option, choose, help)->check(apps::one_of(known));
    return grouped(added->type_name(apps::joined(known))->default_str(by_default));
}

CLI::Option* Flags::grouped(CLI::Option* option) const { return option->group(group_); }

void needs(CLI::Option* option, CLI::Option* other) { option->needs(other); }

bool is_given(const CLI::Option* option) { return option->count() > 0; }

std::string name_of(const CLI::Option* option) { return option->get_name(); }

}  // namespace abut::studies
