#include "studies/program/flags.hpp"

#include "apps/support/command_line.hpp"

namespace abut::studies {

apps::Flag Flags::number(const std::string& option, double& value, const std::string& help, const Limits& limits) {
    return grouped(apps::add_number(parser_, option, value, help, limits));
}

apps::Flag Flags::numbers(const std::string& option, std::vector<double>& values, const std::string& help,
                          const Limits& limits) {
    return grouped(apps::add_numbers(parser_, option, values, help, limits));
}

apps::Flag Flags::body_values(const std::string& option, apps::BodyValues& values, const std::string& help,
                              const Limits& limits) {
    return grouped(apps::add_body_values(parser_, option, values, help, limits));
}

apps::Flag Flags::count(const std::string& option, int& value, const std::string& help, int least) {
    return grouped(apps::add_count(parser_, option, value, help, least));
}

apps::Flag Flags::count(const std::string& option, std::int64_t& value, const std::string& help, int least) {
    return grouped(apps::add_count(parser_, option, value, help, least));
}

apps::Flag Flags::counts(const std::string& option, std::vector<int>& values, const std::string& help, int least) {
    return grouped(apps::add_counts(parser_, option, values, help, least));
}

apps::Flag Flags::flag(const std::string& option, bool& value, const std::string& help) {
    return grouped(parser_.flag(option, value, help).by_default("off"));
}

apps::Flag Flags::names(const std::string& option, std::vector<std::string>& values, const std::string& help,
                        const std::vector<std::string>& known) {
    return grouped(parser_.texts(option, values, help + "; by default all of " + apps::joined(known))
                       .comma_separated()
                       .one_of(known)
                       .takes("NAME,..."));
}

apps::Flag Flags::lines(const std::string& option, std::vector<std::string>& values, const std::string& help,
                        const std::function<std::string(const std::string&)>& refusal) {
    return grouped(parser_.texts(option, values, help).takes("OPTIONS").several().refuse(refusal));
}

apps::Flag Flags::positional(const std::string& name, const std::string& help, const std::vector<std::string>& known) {
    const auto ignore = [](const std::string&) {};
    return parser_.text(name, ignore, help).one_of(known).required();
}

apps::Flag Flags::out(std::filesystem::path& folder) { return apps::add_out(parser_, folder); }

std::vector<apps::Flag> Flags::of_group(const std::string& name) const { return parser_.of_group(name); }

apps::Flag Flags::word(const std::string& option, const std::function<void(const std::string&)>& choose,
                       const std::string& help, const std::vector<std::string>& known, const std::string& by_default) {
    return grouped(apps::add_word(parser_, option, choose, help, known, by_default));
}

apps::Flag Flags::grouped(apps::Flag option) const { return option.group(group_); }

}  // namespace abut::studies
