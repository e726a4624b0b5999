#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "abut/run/values/forward.hpp"

namespace abut::run {

struct BodyPictures;

/// A file beside a report.
struct ReportFile {
    std::string name;     ///< in the same folder
    std::string meaning;  ///< "energies, a row per record"
};

/// Sources that a report shows of a run beside its result.
struct ReportSources {
    const BodyPictures* pictures = nullptr;  ///< none: there are none
    std::filesystem::path forces{};          ///< table of ForceFile; empty: there is none
    std::filesystem::path probes{};          ///< that of ProbeFile
};

/// The text of report.html, for people: verdict, pictures of the bodies, if there are
/// any, and of the energies, bodies and their materials, contact, probes, warnings, settings, times,
/// files. It needs nothing beside it and no network, runs no script, and is well-formed XML. Each figure that summary.json
/// has is in an element `data` with an `id`, its path there (bodies.0.mass), and a `value`, the JSON that stands there.
template <int Dim>
[[nodiscard]] std::string report_html(const std::string& program, const Scene<Dim>& scene, const RunResult<Dim>& result,
                                      const std::vector<ReportFile>& files, const ReportSources& sources = {});

/// The text of a page like that of report.html for a run that failed: what the bodies looked like until then.
[[nodiscard]] std::string failure_html(const std::string& program, const BodyPictures& pictures);

}  // namespace abut::run
