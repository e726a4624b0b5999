#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

/// Programs, and options of theirs that their help has to explain.
const std::vector<std::pair<std::string, std::string>> explained = {
    {"slipping_cylinders",
     "--dim --radius --length --young --poisson --density --speed --offset --gap --size --cfl --time --steps "
     "--dt --skin --mesh --overlap --weights --area --events --quadrature --neumann --corners --eta --filter --restart "
     "--integrator --precision --device "
     "--levels --contact-margin --contact-levels --gauge --refine --refine-over --frames --threads --out "
     "--broad-phase --interval --allow-unstable --compression-limit --preset --facing-cosine --facing-full --facing-none "
     "--quiet --json"},
    {"bouncing_strip",
     "--cells --eta --steps --cfl --dt --filter --restart --compression-limit --out --interval --frames --quiet --json"},
    {"bouncing_bar",
     "--cells --gravity --cfl --steps --integrator --gauge --parts --fast --filter --patch --restart --out --interval"},
    {"bar_impact", "--body --cells --cfl --filter --out --overlap --weights --neumann --skin"},
    {"falling_bar", "--body --cells --cfl --filter --out"},
    {"fixed_bar", "--body --cells --cfl --filter --out"},
    {"two_bars", "--body --cells --cells-2 --speed --cfl --filter --out"},
    {"detect",
     "--connected --unusable --self-intersections --translate --rotate --script --displacement --steps "
     "--largest-motion --distance --depth --self --rings --facing --area --broad-phase --skin --max-pairs "
     "--max-memory --verify --verify-tests --verify-samples --seed --out --no-files --write-every --threads"},
    {"fpu", "--omega --dt --time --integrator --mean --gauge --parts --fast --start --out --interval"},
    {"hertz",
     "--dim --support --load --radius --young --poisson --ratio --coarse --faces --tolerance --weights --area "
     "--neumann --corners --out"},
    {"contact_patch", "--dim --mesh --strain --out"},
    {"extremes", "--only --steps --quick --cfl --overlap --events --facing-cosine --out"},
    {"long_runs", "--only --steps --period"},
    {"turning", "--only --quick --scheme --filter --restart --cfl --steps --frames --out"},
    {"trade", "--only --settings --also --levels --repetitions --limit --out"},
    {"disc_on_plane", "--preset --cells --cfl --integrator --weights --events --neumann --out"},
    {"disc_collision", "--preset --size --cfl --integrator --weights --events --neumann --out"},
    {"sphere_collision", "--preset --faces --coarse --cfl --integrator --weights --out"},
    {"manufactured", "--dim --cells --levels --tolerance --out"},
    {"bulk_patch", "--cells --mode-cells --out"},
    {"spectrum", "--cells --poisson --eta --out"},
    {"wave_speeds", "--case --mesh --cells --levels --cfl --out"},
    {"slow_fast_wave", "--cells --cfl --time --ratio --integrator --refinements --out"}};

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
    const auto outcome = run_program(program, "--help", "");
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
        CHECK((holds(line, "(default ") || holds(line, "by default ")));
        if (holds(line, " X ") || holds(line, " X[,X] ") || holds(line, " N "))
            CHECK((holds(line, "[") && holds(line, "]")));
    }
}

TEST_CASE("the text of --help names the default that a run uses", "[programs]") {
    const auto help = run_program("slipping_cylinders", "--help", "").out;
    const auto outcome = run_well("slipping_cylinders", "--size 0.25 --steps 1 --frames 0", "defaults");
    const auto used = read_summary(outcome)["options"];
    for (const auto& [option, key] :
         std::vector<std::pair<std::string, std::string>>{{"--dim", "dim"},
                                                          {"--cfl", "cfl"},
                                                          {"--gap", "gap"},
                                                          {"--overlap", "overlap"},
                                                          {"--weights", "weights"},
                                                          {"--neumann", "neumann"},
                                                          {"--filter", "filter"},
                                                          {"--compression-limit", "compression_limit"}}) {
        INFO(option);
        std::ostringstream value;
        if (used[key].is_string())
            value << used[key].get<std::string>();
        else
            value << used[key].get<double>();
        for (const auto& line : option_lines(help))
            if (line.starts_with("  " + option + " ")) CHECK(holds(line, "(default " + value.str() + ")"));
    }
}
