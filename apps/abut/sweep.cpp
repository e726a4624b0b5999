#include "apps/abut/sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/run/files/files.hpp"
#include "abut/run/files/folder_lock.hpp"
#include "apps/support/csv.hpp"
#include "apps/support/signals.hpp"
#include "apps/support/standard_streams.hpp"

namespace abut::apps {
namespace {

namespace fs = std::filesystem;

/// Columns of summary.json that sweep.csv repeats.
constexpr std::array<const char*, 8> figures{
    "steps",          "dt", "energy_excess_max", "parasitic_max", "momentum_drift_max", "events", "missed_contacts",
    "compression_max"};

/// Outcome of one run.
struct Outcome {
    std::string folder;
    std::vector<std::string> values;
    std::string state;
    std::string message;
    nlohmann::json summary = nlohmann::json::object();
};

/// At commas outside of brackets and quotation marks.
std::vector<std::string> parts_of(const std::string& text) {
    std::vector<std::string> parts(1);
    int depth = 0;
    char quote = 0;
    for (const char c : text) {
        if (quote != 0)
            quote = c == quote ? '\0' : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (c == '[' || c == '{' || c == '(')
            ++depth;
        else if (c == ']' || c == '}' || c == ')')
            --depth;
        else if (c == ',' && depth == 0) {
            parts.emplace_back();
            continue;
        }
        parts.back() += c;
    }
    return parts;
}

Sweep read_sweep(const std::string& text) {
    const auto equals = text.find('=');
    Sweep sweep{text.substr(0, equals), {}};
    if (equals != std::string::npos) sweep.values = parts_of(text.substr(equals + 1));
    const bool empty = std::ranges::any_of(sweep.values, [](const std::string& value) { return value.empty(); });
    if (sweep.key.empty() || sweep.values.empty() || empty)
        throw BadInput(fmt::format("--sweep {}: a key and its values are needed: --sweep bodies.left.density=1,2,4.", text));
    return sweep;
}

/// The values of run `index`, the last key varying fastest.
std::vector<std::string> values_of(std::size_t index, const std::vector<Sweep>& sweeps) {
    std::vector<std::string> values(sweeps.size());
    for (std::size_t i = sweeps.size(); i-- > 0;) {
        values[i] = sweeps[i].values[index % sweeps[i].values.size()];
        index /= sweeps[i].values.size();
    }
    return values;
}

/// "bodies.left.density=2"
std::vector<std::string> settings_of(const std::vector<std::string>& values, const std::vector<Sweep>& sweeps) {
    std::vector<std::string> settings;
    for (std::size_t i = 0; i < sweeps.size(); ++i) settings.push_back(sweeps[i].key + "=" + values[i]);
    return settings;
}

std::string state_of(ErrorKind kind) {
    if (kind == ErrorKind::diverged || kind == ErrorKind::too_deep) return "diverged";
    return kind == ErrorKind::bad_input || kind == ErrorKind::limit_exceeded ? "refused" : "failed";
}

/// A number of summary.json as a field; nothing where there is none.
std::string field(const nlohmann::json& summary, const std::string& name) {
    const auto found = summary.find(name);
    return found == summary.end() || !found->is_number() ? "" : all_digits(found->get<double>());
}

/// Over the scale of energies.
std::string drift(const nlohmann::json& summary) {
    if (!summary.contains("pseudo_energy_drift")) return "";
    const double scale = summary["energy_scale"]["value"].get<double>();
    return all_digits(scale > 0.0 ? summary["pseudo_energy_drift"].get<double>() / scale : 0.0);
}

std::string row_of(const Outcome& outcome) {
    std::vector<std::string> fields{outcome.folder};
    for (const std::string& value : outcome.values) fields.push_back(quoted(value));
    fields.push_back(outcome.state);
    fields.push_back(drift(outcome.summary));
    for (const char* figure : figures) fields.push_back(field(outcome.summary, figure));
    fields.push_back(outcome.summary.contains("seconds") ? field(outcome.summary["seconds"], "total") : "");
    fields.push_back(quoted(outcome.message));
    return fmt::format("{}\n", fmt::join(fields, ","));
}

void write_table(const fs::path& path, const std::vector<Outcome>& outcomes, const std::vector<Sweep>& sweeps) {
    std::vector<std::string> columns{"folder"};
    for (const Sweep& sweep : sweeps) columns.push_back(quoted(sweep.key));
    columns.insert(columns.end(), {"state", "pseudo_energy_drift_over_scale"});
    columns.insert(columns.end(), figures.begin(), figures.end());
    columns.insert(columns.end(), {"seconds", "message"});
    std::string text = fmt::format("{}\n", fmt::join(columns, ","));
    for (const Outcome& outcome : outcomes) text += row_of(outcome);
    run::write_whole(path, text);
}

/// Runs into `folder` of what the scene has for its results, which is kept in `out`.
Outcome outcome_of(const fs::path& scene, const input::Overrides& overrides, const std::string& folder, fs::path& out,
                   const std::function<void(const input::SceneFile&)>& run_one) {
    Outcome outcome{.folder = folder, .values = {}, .state = "held", .message = {}};
    const auto into_folder = [&](run::RunOptions& options) {
        if (overrides.options) overrides.options(options);
        out = options.out;
        options.out /= folder;
    };
    try {
        run_one(input::SceneFile(scene, {.set = overrides.set, .options = into_folder}));
        std::ifstream(out / folder / "summary.json") >> outcome.summary;
        if (!outcome.summary.value("complete", true)) outcome.state = "stopped";
    } catch (const Error& error) {
        if (out.empty()) throw;  // no scene at all
        outcome.state = state_of(error.kind());
        outcome.message = error.what();
    } catch (const std::exception& error) {
        outcome.state = "failed";
        outcome.message = error.what();
    }
    if (!outcome.message.empty() && run::holds_results(out / folder))
        run::remove_files(out / folder, {"summary.json"});  // of a sweep before
    return outcome;
}

/// The folders that a sweep writes its table to, which are its own while it runs.
class Folders {
public:
    void take(const fs::path& out) {
        if (std::ranges::find(taken_, out) != taken_.end()) return;
        locks_.emplace_back(out, "abut run --sweep");
        run::claim_results(out, {"sweep.csv"});
        taken_.push_back(out);
    }

private:
    std::vector<fs::path> taken_;
    std::vector<run::FolderLock> locks_;
};

/// Folder of the scene's results under these overrides; empty: there is no scene.
fs::path out_of(const fs::path& scene, const input::Overrides& overrides) {
    fs::path out;
    const auto note = [&](run::RunOptions& options) {
        if (overrides.options) overrides.options(options);
        out = options.out;
    };
    try {
        const input::SceneFile file(scene, {.set = overrides.set, .options = note});
    } catch (const Error&) {  // the run says so
    }
    return out;
}

void print_table(const std::vector<Outcome>& outcomes, const std::vector<Sweep>& sweeps, const fs::path& table) {
    std::string text = "Sweep\n";
    for (const Outcome& outcome : outcomes)
        text += fmt::format("  {}  {}  {}\n", outcome.folder, fmt::join(settings_of(outcome.values, sweeps), " "),
                            outcome.state);
    text += fmt::format("  table  {}\n", table.string());
    say(text);
}

void require_held(const std::vector<Outcome>& outcomes, std::size_t n_runs, const fs::path& table) {
    if (noted_signal() != 0) return;
    const auto n_bad = std::ranges::count_if(outcomes, [](const Outcome& outcome) { return outcome.state != "held"; });
    if (n_bad > 0)
        throw BadInput(fmt::format("{} of {} runs did not end. {} says which and why.", n_bad, n_runs, table.string()));
}

}  // namespace

std::vector<Sweep> read_sweeps(const std::vector<std::string>& texts) {
    std::vector<Sweep> sweeps;
    for (const std::string& text : texts) {
        Sweep sweep = read_sweep(text);
        if (std::ranges::any_of(sweeps, [&](const Sweep& other) { return other.key == sweep.key; }))
            throw BadInput(fmt::format("--sweep {}: the key is given twice. Give all its values at once.", text));
        sweeps.push_back(std::move(sweep));
    }
    return sweeps;
}

void run_sweep(const fs::path& scene, const input::Overrides& overrides, const std::vector<Sweep>& sweeps, Messages messages,
               const std::function<void(const input::SceneFile&)>& run_one) {
    set_log(messages);
    std::size_t n_runs = 1;
    for (const Sweep& sweep : sweeps) n_runs *= sweep.values.size();
    const auto width = static_cast<int>(std::to_string(n_runs).size());
    std::vector<Outcome> outcomes;
    Folders folders;
    fs::path out;
    for (std::size_t i = 0; i < n_runs && noted_signal() == 0; ++i) {
        const std::vector<std::string> values = values_of(i, sweeps), settings = settings_of(values, sweeps);
        spdlog::info("run {} of {}: {}", i + 1, n_runs, fmt::join(settings, " "));
        input::Overrides with_values = overrides;
        with_values.set.insert(with_values.set.end(), settings.begin(), settings.end());
        if (const fs::path of_run = out_of(scene, with_values); !of_run.empty()) folders.take(of_run);
        outcomes.push_back(outcome_of(scene, with_values, fmt::format("run_{:0{}}", i + 1, width), out, run_one));
        outcomes.back().values = values;
        if (!outcomes.back().message.empty()) spdlog::warn("{}: {}", outcomes.back().state, outcomes.back().message);
        write_table(out / "sweep.csv", outcomes, sweeps);
    }
    if (messages == Messages::normal) print_table(outcomes, sweeps, out / "sweep.csv");
    require_held(outcomes, n_runs, out / "sweep.csv");
}

}  // namespace abut::apps
