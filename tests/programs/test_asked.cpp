// Commands of abut that answer with text: version, help, info, completion, manual page.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "abut/contact/option_table.hpp"
#include "abut/run/option_table.hpp"
#include "apps/support/terminal.hpp"
#include "programs/program.hpp"

namespace {

using namespace abut;
using namespace abut::test::programs;
using Catch::Contains;
namespace fs = std::filesystem;

const std::vector<std::string> topics = {"scene", "units", "materials", "contact", "kinematics", "output", "exit-codes"};
const std::vector<std::string> commands = {"run",  "check", "new",  "keys",       "materials", "detect",
                                           "diff", "info",  "help", "completion", "man"};

std::string answer(const std::string& arguments, const std::string& before = "") {
    const Outcome outcome = run_program("abut", arguments, "", before);
    INFO(arguments << "\n" << outcome.error);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.error.empty());
    return outcome.out;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::size_t longest_line(const std::string& text) {
    std::size_t longest = 0;
    for (const std::string& line : lines_of(text)) longest = std::max(longest, line.size());
    return longest;
}

/// Words alone, whatever is between them.
std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

/// Long options that a help lists.
std::set<std::string> options_of(const std::string& help) {
    std::set<std::string> options;
    for (const std::string& line : lines_of(help)) {
        const auto begin = line.find("--");
        if ((line.starts_with("  --") || line.starts_with("  -h")) && begin != std::string::npos)
            options.insert(line.substr(begin, line.find_first_of(" ,", begin) - begin));
    }
    return options;
}

/// With those that --help-all alone shows.
std::set<std::string> all_options_of(const std::string& command) {
    const auto everyday = options_of(answer(command + " --help"));
    return everyday.contains("--help-all") ? options_of(answer(command + " --help-all")) : everyday;
}

/// Whether a shell is installed; says so where it is not.
bool has_shell(const std::string& shell) {
    if (std::system(fmt::format("command -v {} > /dev/null", shell).c_str()) == 0) return true;
    WARN("skipped: " << shell << " is not installed");
    return false;
}

/// What a script of a shell prints, whose first argument is abut and whose others are words of a command line.
std::vector<std::string> printed_by(const std::string& shell, const std::string& script, const std::string& line) {
    const Folder folder("completion_" + shell);
    const fs::path path = folder.path() / "complete";
    std::ofstream(path) << script;
    return lines_of(answer(line, fmt::format("{} '{}'", shell, path.string())));
}

/// What fish offers for a command line: words, without their meaning.
std::vector<std::string> completed_by_fish(const std::string& line) {
    auto offered =
        printed_by("fish", "$argv[1] completion fish | source\ncomplete -C \"abut $argv[2]\"\n", "'" + line + "'");
    for (std::string& word : offered) word.resize(std::min(word.size(), word.find('\t')));
    return offered;
}

/// What zsh is asked to offer behind words of a command line: the arguments of its function _arguments.
std::vector<std::string> asked_of_zsh(const std::string& line) {
    return printed_by("zsh", R"sh(_arguments() { print -rl -- "$@" }
_describe() { print -rl -- "${commands[@]}" }
script=$($1 completion zsh)
shift
words=(abut "$@")
CURRENT=${#words}
eval "$script"
)sh",
                      line);
}

/// What bash offers for a command line, the last word of which is being typed.
std::vector<std::string> completed(const std::string& line) {
    const Folder folder("completion");
    const fs::path script = folder.path() / "complete";
    std::ofstream(script) << R"sh(source <("$1" completion bash)
shift
COMP_WORDS=(abut "$@")
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_abut
printf '%s\n' "${COMPREPLY[@]}"
)sh";
    return words_of(answer(line, fmt::format("bash '{}'", script.string())));
}

}  // namespace

TEST_CASE("lines are broken at spaces, under their own beginning", "[programs][asked]") {
    CHECK(apps::wrapped("one two three", 7) == "one two\nthree");
    CHECK(apps::wrapped("  one two three", 9) == "  one two\n  three");
    CHECK(apps::wrapped("  name  one two three", 16) == "  name  one two\n        three");
    CHECK(apps::wrapped("one incomprehensibilities two", 10) == "one\nincomprehensibilities\ntwo");
    CHECK(apps::wrapped("short\n\nlines\n", 10) == "short\n\nlines\n");
    CHECK(apps::wrapped("\xC3\xA9\xC3\xA9\xC3\xA9 \xC3\xA9\xC3\xA9\xC3\xA9", 7).find('\n') ==
          std::string::npos);  // 7 letters
}

TEST_CASE("abut --version says how it was built, and with what", "[programs][asked]") {
    const auto lines = lines_of(answer("--version"));
    CHECK(lines.front().starts_with("abut 0."));
    const auto holds = [&](const std::string& first, const std::string& second) {
        return std::ranges::count_if(lines, [&](const std::string& line) {
            const auto words = words_of(line);
            return words.size() >= 2 && words[0] == first && line.find(second) != std::string::npos;
        });
    };
    CHECK(holds("Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)) == 1);
    CHECK(holds("fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)) == 1);
    CHECK(holds("compiler", fmt::format("{}.{}", __GNUC__, __GNUC_MINOR__)) == 1);
    for (const char* library : {"TBB", "CGAL", "Embree", "FCL", "Gmsh", "pugixml", "toml++", "muParser", "CLI11", "spdlog"})
        CHECK(holds(library, ".") == 1);
}

TEST_CASE("abut help explains topics and commands in as many columns as there are", "[programs][asked]") {
    const std::string list = answer("help");
    for (const std::string& topic : topics) {
        CAPTURE(topic);
        CHECK_THAT(list, Contains("  " + topic + " "));
        const std::string wide = answer("help " + topic, "COLUMNS=200"), narrow = answer("help " + topic, "COLUMNS=60");
        CHECK(longest_line(narrow) <= 60);
        CHECK(longest_line(wide) > 60);
        CHECK(words_of(wide) == words_of(narrow));
        CHECK(longest_line(answer("help " + topic)) <= 80);
    }
    CHECK(answer("help run") == answer("run --help"));
    for (const char* code : {"0 ", "1 ", "2 ", "130 ", "143 "})
        CHECK_THAT(answer("help exit-codes"), Contains(std::string("\n  ") + code));
    const Outcome unknown = run_program("abut", "help nothing", "");
    CHECK(unknown.exit_code == 1);
    CHECK_THAT(unknown.error, Contains("abut help"));
}

TEST_CASE("messages are as wide as the terminal, and whole where there is none", "[programs][asked]") {
    const std::string wrong = "check nowhere.toml";
    const Outcome narrow = run_program("abut", wrong, "", "COLUMNS=40"), piped = run_program("abut", wrong, "");
    CHECK(narrow.exit_code == 1);
    CHECK(longest_line(narrow.error) <= 40);
    CHECK(words_of(narrow.error) == words_of(piped.error));
    CHECK(lines_of(piped.error).size() < lines_of(narrow.error).size());
    const std::string help = answer("run --help", "COLUMNS=70");
    CHECK(words_of(help) == words_of(answer("run --help")));
    CHECK(std::ranges::count_if(lines_of(help), [](const std::string& line) { return line.size() > 70; }) <
          3);  // long choices
}

TEST_CASE("abut info says what is in scenes, surfaces and meshes", "[programs][asked]") {
    const std::string scene = answer(fmt::format("info '{}/falling_bar.toml'", ABUT_SCENES));
    CHECK_THAT(scene, Contains("a scene in 2D") && Contains("200 quadrangle") && Contains("(0, 0.5) to (0.2, 10.5) m") &&
                          Contains("2 kg") && Contains("'bar.xmin'"));  // 0.2 m x 10 m, 1 kg/m^3
    const std::string surface = answer(fmt::format("info '{}/ball.stl'", ABUT_SCENES));
    CHECK_THAT(surface, Contains("a surface") && Contains("80 faces") && Contains("closed"));
    CHECK_THAT(surface,
               Contains("200 m long") && Contains("unit = \"mm\"") && Contains("ball.stl:unit=mm"));  // it is in mm

    const Folder folder("info_meshes");
    const fs::path mesh = folder.path() / "square.msh";
    std::ofstream(mesh) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 7 \"plate\"\n$EndPhysicalNames\n"
                           "$Nodes\n4\n1 0 0 0\n2 2 0 0\n3 2 3 0\n4 0 3 0\n$EndNodes\n"
                           "$Elements\n1\n1 3 2 7 1 1 2 3 4\n$EndElements\n";
    CHECK_THAT(answer("info " + mesh.string()),
               Contains("a mesh in 2D") && Contains("1 quadrangle") && Contains("body 'plate'") && Contains("6 m^2"));
    const fs::path sheet = folder.path() / "sheet.msh";  // a triangle in space
    std::ofstream(sheet) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 0 1\n$EndNodes\n"
                            "$Elements\n1\n1 2 2 7 1 1 2 3\n$EndElements\n";
    CHECK_THAT(answer("info " + sheet.string()), Contains("a surface") && Contains("no mesh") && Contains("sheet.msh: "));
    for (const char* name : {"broken.msh", "unknown.xyz"}) {
        std::ofstream(folder.path() / name) << "nothing\n";
        const Outcome outcome = run_program("abut", "info " + (folder.path() / name).string(), "");
        CHECK(outcome.exit_code == 1);
        CHECK_THAT(outcome.error, Contains(name));
    }
    CHECK(run_program("abut", "info nowhere.stl", "").exit_code == 1);
}

TEST_CASE("abut info says what a run has left, finished or not", "[programs][asked]") {
    const auto run = run_well("abut", slip("--set values.size=0.25 --steps 20 --frames 3"), "info_results");
    const auto summary = read_summary(run);
    const std::string text = answer(fmt::format("info '{}'", run.directory.string()));
    CHECK_THAT(text, Contains("slipping_cylinders") && Contains("true") && Contains("body 'left'") &&
                         Contains("3 .vtu files") && Contains("report.html"));
    const double drift = summary["pseudo_energy_drift"].get<double>() / summary["energy_scale"]["value"].get<double>();
    CHECK_THAT(text, Contains(fmt::format("{:.2e} of K0", drift)));

    const Folder folder("info_partial");
    CHECK(run_program("abut", fmt::format("info '{}'", folder.path().string()), "").exit_code == 1);
    std::ofstream(folder.path() / "energy.csv.partial") << "step,time\n0,0\n7,0.1\n14,0.2\n";
    CHECK_THAT(answer(fmt::format("info '{}'", folder.path().string())),
               Contains("3 records") && Contains("the last of step 14"));
    std::ofstream(folder.path() / "summary.json") << "[1, 2";
    CHECK(run_program("abut", fmt::format("info '{}'", folder.path().string()), "").exit_code == 1);
}

TEST_CASE("bash completes commands, options, words and topics", "[programs][asked]") {
    const auto first = completed("''");
    for (const std::string& command : commands) CHECK(std::ranges::count(first, command) == 1);
    CHECK(completed("ch") == std::vector<std::string>{"check"});
    CHECK(completed("run --law pair") == std::vector<std::string>{"pair_potential"});
    CHECK(completed("run --preset ''") == std::vector<std::string>{"fast", "balanced", "exact"});
    CHECK(completed("run --cfl ''").empty());
    for (const std::string& command : commands) {
        CAPTURE(command);
        const auto offered = completed(command + " --");
        const auto options = all_options_of(command);
        CHECK(std::set<std::string>(offered.begin(), offered.end()) == options);
    }
    const auto help = completed("help ''");
    for (const std::string& topic : topics) CHECK(std::ranges::count(help, topic) == 1);
    const auto files = completed(fmt::format("run '{}/falling_b'", ABUT_SCENES));
    CHECK(files == std::vector<std::string>{fmt::format("{}/falling_bar.toml", ABUT_SCENES)});
}

TEST_CASE("fish completes commands, options, words and files", "[programs][asked]") {
    if (!has_shell("fish")) return;
    const auto first = completed_by_fish("");
    for (const std::string& command : commands) CHECK(std::ranges::count(first, command) == 1);
    CHECK(completed_by_fish("ch") == std::vector<std::string>{"check"});
    CHECK(completed_by_fish("run --law pair") == std::vector<std::string>{"pair_potential"});
    CHECK(completed_by_fish("run --preset ").size() == 3);
    CHECK(completed_by_fish("help uni") == std::vector<std::string>{"units"});
    for (const std::string& command : commands) {
        CAPTURE(command);
        const auto offered = completed_by_fish(command + " --");
        const auto options = all_options_of(command);
        CHECK(std::set<std::string>(offered.begin(), offered.end()) == options);
    }
    const auto files = completed_by_fish(fmt::format("run {}/falling_b", ABUT_SCENES));
    CHECK(files == std::vector<std::string>{fmt::format("{}/falling_bar.toml", ABUT_SCENES)});
}

TEST_CASE("zsh is told all commands and options, and which take words, folders and files", "[programs][asked]") {
    if (!has_shell("zsh")) return;
    const auto begins = [](const std::vector<std::string>& lines, const std::string& start) {
        return std::ranges::count_if(lines, [&](const std::string& line) { return line.starts_with(start); });
    };
    const auto holds = [](const std::vector<std::string>& lines, const std::string& start, const std::string& end) {
        return std::ranges::any_of(lines,
                                   [&](const std::string& line) { return line.starts_with(start) && line.ends_with(end); });
    };
    const auto first = asked_of_zsh("''");
    for (const std::string& command : commands) CHECK(begins(first, command + ":") == 1);
    for (const std::string& command : commands) {
        CAPTURE(command);
        const auto asked = asked_of_zsh(command + " ''");
        for (const std::string& option : all_options_of(command))
            CHECK(begins(asked, option + "[") + begins(asked, "*" + option + "[") == 1);
    }
    const auto run = asked_of_zsh("run ''");
    CHECK(holds(run, "*--preset[", "]:value:(fast balanced exact)"));
    CHECK(holds(run, "*--out[", "]:value:_directories"));
    CHECK(holds(run, "*:what", ":_files"));
    CHECK(holds(run, "*--quiet[", "]"));
}

TEST_CASE("the manual page has all commands, options and topics, and troff finds nothing wrong with it",
          "[programs][asked]") {
    const std::string page = answer("man");
    for (const std::string& command : commands) CHECK_THAT(page, Contains(".SS \\fBabut " + command + "\\fR"));
    for (std::string option : all_options_of("run")) {
        if (option == "--help") continue;
        for (std::size_t i = option.find('-'); i != std::string::npos; i = option.find('-', i + 2)) option.insert(i, "\\");
        CHECK_THAT(page, Contains(".TP\n\\fB" + option + "\\fR"));
    }
    for (const char* title : {".SH SCENES", ".SH UNITS", ".SH EXIT CODES", ".SH RESULTS"}) CHECK_THAT(page, Contains(title));
    if (std::system("command -v groff >/dev/null") != 0) {
        WARN("groff is not installed: the page is not formatted");
        return;
    }
    const Folder folder("man");
    std::ofstream(folder.path() / "abut.1") << page;
    const auto errors = folder.path() / "errors";
    CHECK(std::system(fmt::format("groff -ww -man -Tascii '{}' >/dev/null 2>'{}'", (folder.path() / "abut.1").string(),
                                  errors.string())
                          .c_str()) == 0);
    CHECK(read_text(errors).empty());
}

TEST_CASE("every option of a run is in help, manual page and completions, and in keys where scenes have it",
          "[programs][asked][options]") {
    const std::string help = answer("run --help-all"), page = answer("man"), keys = answer("keys");
    const std::string bash = answer("completion bash"), zsh = answer("completion zsh"), fish = answer("completion fish");
    for (const auto& option : run::run_options()) {
        CAPTURE(option.name);
        if (option.places.scene) CHECK_THAT(keys, Contains("| `" + option.scene_key() + "` |"));
        if (!option.places.command_line || option.depth == OptionDepth::laboratory) continue;
        const std::string flag = option.flag();
        std::string in_troff;
        for (const char c : flag) in_troff += c == '-' ? "\\-" : std::string(1, c);
        CHECK(options_of(help).contains(flag));
        CHECK_THAT(page, Contains(".TP\n\\fB" + in_troff + "\\fR"));
        CHECK_THAT(bash, Contains(" " + flag));
        CHECK_THAT(zsh, Contains("*" + flag + "["));
        CHECK_THAT(fish, Contains(" -l " + flag.substr(2)));
    }
}

TEST_CASE("detect explains what it has in common with runs in the words of their table", "[programs][asked][options]") {
    const std::string help = answer("detect --help");
    for (const char* name : {"broad_phase", "facing_cosine", "largest_motion", "self_contact_rings"})
        CHECK_THAT(help, Contains(named(contact::search_options(), name).help));
    CHECK_THAT(help, Contains(named(contact::contact_options(), "area").help));
}
