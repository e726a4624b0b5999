#pragma once
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>

namespace abut::benchmark {

/// Options of the command line of a benchmark, without the header of CLI11, which takes seconds to compile. What follows `add`
/// is about the option that was added last; its default is the present value.
class Options {
public:
    explicit Options(const std::string& purpose);
    ~Options();

    /// Numbers, words, and lists of them, separated by commas.
    template <class Value>
    Options& add(const std::string& name, Value& value, const std::string& help = "");
    Options& positive();
    Options& not_negative();
    Options& between(double least, double most);
    Options& one_of(std::initializer_list<const char*> words);
    Options& hidden();  ///< from --help
    void flag(const std::string& name, bool& value, const std::string& help);

    /// Exit status where the program has nothing else to do: --help, or an error, whose message is printed.
    [[nodiscard]] std::optional<int> parse(int argc, char** argv);

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace abut::benchmark
