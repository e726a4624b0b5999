#include "support/options.hpp"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <vector>

namespace abut::benchmark {

namespace {

template <class Value>
constexpr bool is_list = false;
template <class Value>
constexpr bool is_list<std::vector<Value>> = true;

}  // namespace

struct Options::Implementation {
    CLI::App app;
    CLI::Option* last = nullptr;
};

Options::Options(const std::string& purpose) : implementation_(new Implementation{CLI::App(purpose)}) {
    implementation_->app.option_defaults()->always_capture_default();
}
Options::~Options() = default;

template <class Value>
Options& Options::add(const std::string& name, Value& value, const std::string& help) {
    implementation_->last = implementation_->app.add_option(name, value, help);
    if constexpr (is_list<Value>) implementation_->last->delimiter(',');
    return *this;
}

Options& Options::positive() {
    implementation_->last->check(CLI::PositiveNumber);
    return *this;
}

Options& Options::not_negative() {
    implementation_->last->check(CLI::NonNegativeNumber);
    return *this;
}

Options& Options::between(double least, double most) {
    implementation_->last->check(CLI::Range(least, most));
    return *this;
}

Options& Options::one_of(std::initializer_list<const char*> words) {
    implementation_->last->check(CLI::IsMember(std::vector<std::string>(words.begin(), words.end())));
    return *this;
}

Options& Options::hidden() {
    implementation_->last->group("");
    return *this;
}

void Options::flag(const std::string& name, bool& value, const std::string& help) {
    implementation_->app.add_flag(name, value, help);
}

std::optional<int> Options::parse(int argc, char** argv) {
    try {
        implementation_->app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return implementation_->app.exit(error);
    }
    return std::nullopt;
}

template Options& Options::add(const std::string&, bool&, const std::string&);
template Options& Options::add(const std::string&, int&, const std::string&);
template Options& Options::add(const std::string&, std::int64_t&, const std::string&);
template Options& Options::add(const std::string&, std::size_t&, const std::string&);
template Options& Options::add(const std::string&, double&, const std::string&);
template Options& Options::add(const std::string&, std::string&, const std::string&);
template Options& Options::add(const std::string&, std::vector<int>&, const std::string&);
template Options& Options::add(const std::string&, std::vector<std::size_t>&, const std::string&);
template Options& Options::add(const std::string&, std::vector<double>&, const std::string&);
template Options& Options::add(const std::string&, std::vector<std::string>&, const std::string&);

}  // namespace abut::benchmark
