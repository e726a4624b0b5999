#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

/// Programs, with a command, and options of theirs that their help has to explain.
const std::vector<std::pair<std::string, std::string>> explained = {
    {"abut run",
     "--set --sweep --cfl --time --steps --dt --filter --restart --integrator --frames --threads --out --interval --preset "
     "--friction --self-contact --settle --quiet --json --skin --device --facing-full --facing-none --compression-limit "
     "--allow-unstable --lab"},
    {"study bouncing_strip",
     "--cells --eta --steps --cfl --dt --filter --restart --compression-limit --out --interval --frames --quiet --json"},
    {"study bouncing_bar",
     "--cells --gravity --cfl --steps --integrator --gauge --parts --fast --filter --patch --restart --out --interval"},
    {"study bar_impact", "--body --cells --cfl --filter --out --overlap --weighting --free-faces --skin"},
    {"study falling_bar", "--body --cells --cfl --filter --out"},
    {"study fixed_bar", "--body --cells --cfl --filter --out"},
    {"study two_bars", "--body --cells --cells-2 --speed --cfl --filter --out"},
    {"abut detect",
     "--connected --unusable --self-intersections --translate --rotate --script --displacement --steps "
     "--largest-motion --distance --depth --self --rings --facing --area --broad-phase --skin --max-pairs "
     "--max-memory --verify --verify-tests --verify-samples --seed --out --no-files --write-every --threads"},
    {"study fpu", "--omega --dt --time --integrator --mean --gauge --parts --fast --start --out --interval"},
    {"study orders", "--halvings --out"},
    {"study hertz",
     "--dim --support --load --radius --young --poisson --ratio --coarse --faces --tolerance --weighting --area "
     "--free-faces --corners --out"},
    {"study contact_patch", "--dim --mesh --strain --out"},
    {"study extremes", "--only --steps --quick --cfl --overlap --events --facing-cosine --out"},
    {"study long_runs", "--only --steps --period"},
    {"study turning", "--only --quick --scheme --filter --restart --cfl --steps --frames --out"},
    {"study trade", "--only --settings --also --levels --repetitions --limit --out"},
    {"study disc_on_plane", "--preset --cells --cfl --integrator --weighting --events --free-faces --out"},
    {"study disc_collision", "--preset --size --cfl --integrator --weighting --events --free-faces --out"},
    {"study sphere_collision", "--preset --faces --coarse --cfl --integrator --weighting --out"},
    {"study manufactured", "--dim --cells --levels --tolerance --out"},
    {"study bulk_patch", "--cells --mode-cells --out"},
    {"study spectrum", "--cells --poisson --eta --out"},
    {"study wave_speeds", "--case --mesh --cells --levels --cfl --out"},
    {"study slow_fast_wave", "--cells --cfl --time --ratio --integrator --refinements --out"}};

/// One for each option; where a long list of names has pushed the explanation to the next line, both in one.
std::vector<std::string> option_lines(const std::string& help) {
    std::vector<std::string> lines;
    std::istringstream text(help);
    bool open = false;
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("  --"))
            lines.push_back(line);
        else if (open && line.starts_with("      "))
            lines.back() += line;
        open = line.starts_with("  --");
    }
    return lines;
}

bool holds(const std::string& line, const std::string& word) { return line.find(word) != std::string::npos; }

}  // namespace

TEST_CASE("the text of --help explains every option in one line with unit and default", "[programs]") {
    const auto [program, options] = GENERATE(from_range(explained));
    const auto blank = std::min(program.find(' '), program.size());
    const std::string asks = program == "abut run" ? " --help-all" : " --help";
    const auto outcome = run_program(program.substr(0, blank), program.substr(blank) + asks, "");
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.error.empty());
    const auto lines = option_lines(outcome.out);
    std::istringstream words(options);
    for (std::string option; words >> option;) {
        INFO(option);
        CHECK(std::ranges::count_if(lines, [&](const auto& line) { return line.starts_with("  " + option + " "); }) == 1);
    }
    for (const auto& line : lines) {
        INFO(line);
        if (line.starts_with("  --help-all ")) continue;
        CHECK((holds(line, "(default ") || holds(line, "by default ")));
        if (holds(line, " X ") || holds(line, " X[,X] ") || holds(line, " N "))
            CHECK((holds(line, "[") && holds(line, "]")));
    }
}

TEST_CASE("the list of studies has a sentence for each, and a name that is not in it is refused with those that are",
          "[programs]") {
    const auto list = run_program("study", "list", "");
    CHECK(list.exit_code == 0);
    CHECK(list.error.empty());
    std::istringstream lines(list.out);
    std::vector<std::string> names;
    for (std::string line; std::getline(lines, line);) {
        CAPTURE(line);
        names.push_back(line.substr(0, line.find(' ')));
        CHECK(line.ends_with('.'));
        CHECK(run_program("study " + names.back(), "--help", "")
                  .out.starts_with(line.substr(line.find_first_not_of(' ', line.find(' ')))));
    }
    CHECK(std::ranges::is_sorted(names));
    for (const auto& [program, options] : explained)
        if (program.starts_with("study ")) CHECK(std::ranges::count(names, program.substr(6)) == 1);
    const auto refused = run_program("study", "herz", "");
    CHECK(refused.exit_code == 1);
    CHECK(holds(refused.error, "'herz' is not known"));
    for (const std::string& name : names) CHECK(holds(refused.error, name));
}

TEST_CASE("the text of --help names the default that a run uses", "[programs]") {
    const auto help = run_program("abut", slip("--help-all"), "").out;
    const auto outcome = run_well("abut", slip("--set values.size=0.25 --steps 1 --frames 0"), "defaults");
    const auto used = read_summary(outcome)["options"];
    for (const auto& [option, key] : std::vector<std::pair<std::string, std::string>>{
             {"--cfl", "cfl"}, {"--filter", "filter"}, {"--compression-limit", "compression_limit"}}) {
        INFO(option);
        std::ostringstream value;
        if (used[key].is_string())
            value << used[key].get<std::string>();
        else
            value << used[key].get<double>();
        const auto lines = option_lines(help);
        CHECK(std::ranges::count_if(lines, [&](const std::string& line) {
                  return line.starts_with("  " + option + " ") && holds(line, "(default " + value.str() + ")");
              }) == 1);
    }
}
