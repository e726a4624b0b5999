#pragma once
#include <filesystem>
#include <string>

namespace abut::apps {

/// Arguments of `abut diff`.
struct DiffOptions {
    std::filesystem::path first, second;  ///< folders of results
    double tolerance = 0.0;               ///< see run::compare_runs; 0: bitwise
};

/// Exit code of two runs that differ; 1 is that of errors.
inline constexpr int exit_code_of_difference = 2;

/// Comparison of two runs in words.
struct DiffAnswer {
    std::string text;  ///< the verdict, then a line for each thing that differs
    bool is_same;      ///< of the results; scenes and settings may differ
};

/// Throws BadInput as run::compare_runs.
[[nodiscard]] DiffAnswer diff(const DiffOptions& options);

}  // namespace abut::apps
