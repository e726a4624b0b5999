#include "apps/abut/commands.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <utility>
#include <vector>

#include "abut/base/counted.hpp"
#include "abut/base/error.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/input/check.hpp"
#include "abut/input/grammar.hpp"
#include "abut/input/materials.hpp"
#include "abut/input/scene_file.hpp"
#include "apps/abut/asked.hpp"
#include "apps/abut/build_info.hpp"
#include "apps/abut/diff.hpp"
#include "apps/abut/restart.hpp"
#include "apps/abut/sweep.hpp"
#include "apps/detect/detect.hpp"
#include "apps/support/command_line.hpp"
#include "apps/support/preset.hpp"
#include "apps/support/program.hpp"
#include "apps/support/rank_session.hpp"
#include "apps/support/run_options.hpp"
#include "apps/support/run_scene.hpp"

namespace abut::apps {
namespace {

namespace fs = std::filesystem;

/// Content of a command line.
struct CommandLine {
    fs::path scene;
    fs::path new_file;
    fs::path results;
    run::RunOptions restarted;  ///< threads, ranks and how they share the scene out, and the end
    std::vector<std::string> set;
    std::vector<std::string> laboratory;
    std::vector<std::string> sweep;
    run::RunOptions options;
    Messages messages = Messages::normal;
    CommandParser* run = nullptr;
    CommandParser* check = nullptr;
    CommandParser* restart = nullptr;
    CommandParser* make = nullptr;
    CommandParser* keys = nullptr;
    CommandParser* materials = nullptr;
    CommandParser* detect = nullptr;
    CommandParser* diff = nullptr;
    Asked asked;
    DetectOptions detection;
    DiffOptions difference;
};

const Program abut_program{.name = "abut",
                           .purpose = "Runs scenes of deformable bodies in contact that are written in TOML.",
                           .series = "bodies",
                           .footer =
                               "abut run --help lists the options of a run, abut help the topics. Units are SI. Exit codes: "
                               "0 good, 1 an error, with "
                               "its message, 2 two runs differ, 130, 143 or 129 ended by SIGINT, SIGTERM or SIGHUP.",
                           .takes_ranks = true};

void add_scene_options(CommandParser& command, CommandLine& line) {
    command.path("scene", line.scene, "the scene, a TOML file").required().takes("FILE");
    command
        .texts("--set", line.set,
               "a value in place of that of the file, bodies.left.density=2; may be repeated; by default none")
        .several()
        .takes("KEY=VALUE");
    add_preset_option(command, line.options, OptionDepth::expert);
    add_time_options(command, line.options, "that of the scene", OptionDepth::expert);
    add_contact_options(command, line.options, OptionDepth::expert);
    add_output_options(command, line.options, OptionDepth::expert);
    command.at("--out").by_default("out/SCENE");
    command
        .texts("--lab", line.laboratory,
               "a key of [laboratory], which compares methods: --lab overlap=frozen; may be repeated; by default none")
        .several()
        .takes("KEY=VALUE")
        .group("Laboratory")
        .rarely_needed();
    command.add_help_of_all();
    command.end_help_with("abut " + command.name() + " --help-all lists what is rarely needed, too.");
}

void add_commands(CommandParser& parser, CommandLine& line) {
    parser.add_version(version_text());
    line.run = &parser.add_command("run", "runs a scene; options overrule its values");
    add_scene_options(*line.run, line);
    add_message_options(*line.run, line.messages);
    line.run
        ->texts("--sweep", line.sweep,
                "a run for each value, or combination of them, in a folder of its own, and sweep.csv for all; may be "
                "repeated; by default none")
        .several()
        .takes("KEY=A,B,...");
    line.check = &parser.add_command("check", "lists every error of a scene at once, or estimates the cost of its run");
    add_scene_options(*line.check, line);
    line.restart = &parser.add_command("restart", "continues a run that was stopped or killed, from its last checkpoint");
    line.restart->path("results", line.results, "the folder of its results, that of --out").required().takes("DIR");
    add_number(*line.restart, "--until", line.restarted.time,
               "another end of the run than it had; a run that has come to its end goes on if it was made with "
               "--keep-last-checkpoint",
               {.unit = "s", .above = 0.0})
        .group("Time");
    add_count(*line.restart, "--threads", line.restarted.threads,
              "threads; 0: as the run had. The results do not depend on it", 0);
    add_ranks_options(*line.restart, line.restarted);
    add_message_options(*line.restart, line.messages);
    line.make = &parser.add_command("new", "writes a commented scene to start from");
    line.make->path("name", line.new_file, "the file; .toml is added").required().takes("NAME");
    line.keys = &parser.add_command("keys", "prints all keys of a scene");
    line.materials = &parser.add_command("materials", "prints the materials that scenes know by name, with sources");
    line.detect = &parser.add_command("detect", "finds which faces of bodies lie opposite each other, and how near");
    line.detect->end_help_with(detect_program.footer);
    add_options(*line.detect, line.detection);
    line.diff =
        &parser.add_command("diff", "says whether the results of two runs are the same, and where they first differ");
    line.diff->path("first", line.difference.first, "the folder of results of a run").required().takes("DIR");
    line.diff->path("second", line.difference.second, "that of another run").required().takes("DIR");
    add_number(*line.diff, "--tolerance", line.difference.tolerance,
               "part of the largest value of a column or a field by which values may differ; 0: no bit",
               {.above = 0.0, .from = true});
    line.diff->end_help_with("Exit codes: 0 the same, 2 they differ, 1 an error.");
    add_asked(parser, line.asked);
    parser.explain_unknown(where_in_laboratory);
}

/// The file, or that with .toml behind it where this one alone is there.
fs::path scene_file(const fs::path& given) {
    fs::path with_ending = given;
    with_ending += ".toml";
    std::error_code unknown;
    const bool is_there = fs::exists(given, unknown) && !fs::is_directory(given, unknown);
    return !is_there && fs::is_regular_file(with_ending, unknown) ? with_ending : given;
}

/// Drops an option of the scene where one on the command line excludes it.
void drop_excluded(const CommandParser& command, run::RunOptions& options) {
    if (command.at("--steps").is_given()) options.time = run::not_given;
    if (command.at("--time").is_given()) options.steps = 0;
    if (command.at("--cfl").is_given() || command.at("--preset").is_given()) {
        options.dt = run::not_given;
        options.allow_unstable = false;
    }
    if (command.at("--frames").is_given()) options.times.clear();
}

/// Reads the command line once more, above the options of the scene.
input::Overrides overrides(int argc, char** argv, const CommandLine& first) {
    return {.set = first.set, .options = [argc, argv](run::RunOptions& options) {
                CommandParser parser;
                CommandLine line{.options = options};
                add_commands(parser, line);
                parser.parse(argc, argv);
                take_laboratory(line.laboratory, line.options);
                options = line.options;
                drop_excluded(line.run->is_given() ? *line.run : *line.check, options);
            }};
}

using TextFiles = std::vector<std::pair<std::string, std::string>>;

/// `beside`: what a restart needs; empty where one run of several is made.
void run_file(const Program& program, const input::SceneFile& file, const TextFiles& beside) {
    Program named = program;
    named.name = file.name();
    named.beside_checkpoints = beside;
    if (file.dimension() == 2)
        run_scene<2>(named, file.options(), [&](Answers& mesh) { return file.scene<2>(mesh); });
    else
        run_scene<3>(named, file.options(), [&](Answers& mesh) { return file.scene<3>(mesh); });
}

/// Nothing is removed for a scene that cannot be read, which may not say where its results go. The message names those of an
/// earlier run, so that nobody takes them for results of this scene.
input::SceneFile read_to_run(const fs::path& path, const input::Overrides& overrides) {
    try {
        return input::SceneFile(path, overrides);
    } catch (const input::SceneError& error) {
        run::RunOptions options{.out = fs::path("out") / path.stem()};
        overrides.options(options);
        if (options.resume || !fs::exists(options.out / "summary.json")) throw;
        throw_again(error,
                    fmt::format("{}\n{} still has the results of an earlier run.", error.what(), options.out.string()));
    }
}

/// A run from the start leaves what a restart needs; one that goes on has the scene that it began with.
void run_scene_file(const Program& program, const fs::path& path, const input::Overrides& overrides,
                    const std::vector<std::string>& arguments) {
    const input::SceneFile file = read_to_run(path, overrides);
    if (!file.options().resume) return run_file(program, file, files_for_restart({fs::absolute(path), arguments}, path));
    if (const std::string changes = changes_since(path, file.options().out); !changes.empty())
        throw BadInput(changes + " Go on with the scene as it was by abut restart " + file.options().out.string() +
                       ", or run from the start without --resume.");
    run_file(program, file, {});
}

/// The command line of the run is read once more.
void restart_run(const Program& program, const fs::path& results, const run::RunOptions& now) {
    Restart restart = read_restart(results);
    if (!std::isnan(now.time)) restart.until = now.time;
    std::vector<char*> words;
    std::vector<std::string> arguments = restart.arguments;
    for (std::string& argument : arguments) words.push_back(argument.data());
    CommandParser parser;
    CommandLine line;
    add_commands(parser, line);
    parser.parse(static_cast<int>(words.size()), words.data());
    input::Overrides over = overrides(static_cast<int>(words.size()), words.data(), line);
    over.origin = restart.scene;
    over.options = [&, options = over.options](run::RunOptions& of_run) {
        options(of_run);
        of_run.out = results;
        of_run.resume = true;
        if (now.threads > 0) of_run.threads = now.threads;
        of_run.ranks = now.ranks;
        of_run.rebalance = now.rebalance;
        of_run.rebalance_above = now.rebalance_above;
        if (restart.until) {
            of_run.time = *restart.until;
            of_run.steps = 0;
            of_run.other_end = true;
        }
    };
    const fs::path copy = scene_for_restart(results);
    Program with_note = program;
    if (const std::string changes = changes_since(restart.scene, results); !changes.empty())
        with_note.note = changes + " The run goes on with the scene as it was.";
    run_file(with_note, input::SceneFile(copy, over), std::isnan(now.time) ? TextFiles{} : files_for_restart(restart, copy));
}

void check_file(const fs::path& path, const input::Overrides& overrides) {
    const input::CheckedScene checked = input::check_scene(path, overrides);
    if (!checked.faults.empty()) throw input::SceneError(checked.faults);
    const std::int64_t n = std::ssize(checked.warnings);
    fmt::print("{}: no fault found{}\n{}", path.string(), n == 0 ? "" : ", " + counted(n, "warning"),
               input::text_of(*checked.estimate));
    for (const std::string& warning : checked.warnings) fmt::print("  {:<16}{}\n", "warning", warning);
}

/// The exit code.
int print_diff(const DiffOptions& options) {
    const DiffAnswer answer = diff(options);
    fmt::print("{}", answer.text);
    return answer.is_same ? 0 : exit_code_of_difference;
}

void write_new_scene(fs::path path) {
    if (path.extension() != ".toml") path += ".toml";
    if (fs::exists(path)) throw BadInput(fmt::format("{}: the file is there already. Give another name.", path.string()));
    std::ofstream file(path);
    file << new_scene();
    file.close();
    if (!file) throw BadInput(fmt::format("{}: the file cannot be written. Give a folder that can.", path.string()));
    const std::string name = path.string();
    const bool is_word = name.find_first_of(" \t'\"$&();<>|*?") == std::string::npos;
    fmt::print("{}: written. Next: abut check {}\n", name, is_word ? name : fmt::format("'{}'", name));
}

}  // namespace

int run_abut(int argc, char** argv) {
    CommandLine line;
    Program program = abut_program;
    int answered = 0;
    const auto add_options = [&](CommandParser& parser) { add_commands(parser, line); };
    const int exit_code = run_program(program, argc, argv, add_options, [&] {
        program.messages = line.messages;
        line.scene = scene_file(line.scene);
        if (!line.run->is_given() && !line.restart->is_given()) refuse_ranks("this command");
        if (line.run->is_given() && !line.sweep.empty()) {
            refuse_ranks("--sweep");
            run_sweep(line.scene, overrides(argc, argv, line), read_sweeps(line.sweep), program.messages,
                      [&](const input::SceneFile& file) { run_file(program, file, {}); });
        } else if (line.run->is_given()) {
            run_scene_file(program, line.scene, overrides(argc, argv, line), {argv, argv + argc});
        } else if (line.restart->is_given())
            restart_run(program, line.results, line.restarted);
        else if (line.check->is_given())
            check_file(line.scene, overrides(argc, argv, line));
        else if (line.make->is_given())
            write_new_scene(line.new_file);
        else if (line.keys->is_given())
            fmt::print("{}", input::grammar());
        else if (line.materials->is_given())
            fmt::print("{}", input::table_of_materials());
        else if (line.detect->is_given())
            detect(line.detection);
        else if (line.diff->is_given())
            answered = print_diff(line.difference);
        else
            fmt::print("{}", answer(line.asked));
    });
    return exit_code == 0 ? answered : exit_code;
}

}  // namespace abut::apps
