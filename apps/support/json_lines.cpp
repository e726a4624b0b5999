#include "apps/support/json_lines.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <optional>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/user_words.hpp"
#include "abut/run/words/verdict.hpp"
#include "abut/run/words/warnings.hpp"
#include "apps/support/csv.hpp"

namespace abut::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds between_lines{500};

void print_line(const Json& json) {
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
}

void print_warnings(const std::vector<run::Warning>& warnings) {
    for (const run::Warning& warning : warnings)
        print_line({{"event", "warning"},
                    {"severity", warning.severity == run::Severity::note ? "note" : "warning"},
                    {"text", warning.text},
                    {"value", json_number(warning.value)},
                    {"threshold", json_number(warning.threshold)}});
}

}  // namespace

template <int Dim>
JsonLines<Dim>::JsonLines(std::string program) : program_(std::move(program)) {}

template <int Dim>
void JsonLines<Dim>::settling(std::int64_t step, double speed) {
    const auto now = Clock::now();
    if (now - last_ < between_lines) return;
    last_ = now;
    print_line({{"event", "settling"}, {"step", step}, {"speed", json_number(speed)}});
}

template <int Dim>
void JsonLines<Dim>::begin(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) {
    scene_ = &scene;
    n_steps_ = result.run.steps;
    time_left_ = TimeLeft(result.run.steps);
    start_ = last_ = Clock::now();
    print_line({{"event", "start"},
                {"program", program_},
                {"version", ABUT_VERSION},
                {"dim", Dim},
                {"cells", scene.mesh.n_cells()},
                {"boundary_faces", scene.mesh.boundary_faces.size()},
                {"bodies", scene.mesh.body_names},
                {"steps", result.run.steps},
                {"dt", result.run.dt},
                {"energy_scale", {{"name", result.energy.scale.name}, {"value", json_number(result.energy.scale.value)}}},
                {"out", result.options.out.string()}});
    print_warnings(run::warnings_before(scene, result));
}

template <int Dim>
void JsonLines<Dim>::record(const dynamics::LedgerEntry<Dim>& entry, const run::RunResult<Dim>&) {
    Json line = {{"event", "record"}};
    const auto names = dynamics::ledger_columns<Dim>();
    const auto values = dynamics::ledger_values(entry);
    for (std::size_t i = 0; i < names.size(); ++i) line[names[i]] = json_number(values[i]);
    print_line(line);
}

template <int Dim>
void JsonLines<Dim>::progress(std::int64_t step, double time) {
    const auto now = Clock::now();
    if (step == 0) return;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    time_left_.add(step, elapsed);
    if (step < n_steps_ && now - last_ < between_lines) return;
    last_ = now;
    print_line({{"event", "progress"},
                {"step", step},
                {"steps", n_steps_},
                {"time", time},
                {"seconds", elapsed},
                {"seconds_left", time_left_.seconds()}});
}

template <int Dim>
void JsonLines<Dim>::end(const run::RunResult<Dim>& result, int exit_code) {
    print_warnings(run::warnings_after(result));
    const auto said = scene_ != nullptr ? std::optional(run::verdict(*scene_, result)) : std::nullopt;
    print_line({{"event", "end"},
                {"complete", result.run.complete},
                {"steps", result.run.steps},
                {"time", result.ledger.entries().back().time},
                {"pseudo_energy_drift", json_number(result.ledger.pseudo_energy_drift())},
                {"energy_drift", json_number(result.ledger.energy_drift())},
                {"energy_excess_max", json_number(result.ledger.energy_excess())},
                {"parasitic_max", json_number(result.ledger.parasitic())},
                {"events", result.contact.report.events},
                {"missed_contacts", result.contact.report.missed_contacts},
                {"good", said && said->good},
                {"verdict", said ? Json(said->text) : Json()},
                {"seconds", result.seconds.total},
                {"out", result.options.out.string()},
                {"exit_code", exit_code}});
}

void json_note(const std::string& text) {
    print_line({{"event", "warning"}, {"severity", "warning"}, {"text", text}, {"value", nullptr}, {"threshold", nullptr}});
}

void json_error(const std::exception& error, int exit_code) {
    const auto* ours = dynamic_cast<const Error*>(&error);
    print_line({{"event", "error"},
                {"kind", ours ? name(ours->kind()) : "other"},
                {"text", run::in_user_words(error.what())},
                {"exit_code", exit_code}});
}

template class JsonLines<2>;
template class JsonLines<3>;

}  // namespace abut::apps
