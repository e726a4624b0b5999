#pragma once
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace abut::run {

/// A value that differs between two runs.
struct ValueDifference {
    std::string name;    ///< column with its unit, key of summary.json, or field with its cell or point and component
    std::string first;   ///< in the first run; numbers with as many digits as every bit needs
    std::string second;  ///< in the second run
    /// |difference| over the largest value of the column or field; infinite where one is no finite number.
    double relative = std::numeric_limits<double>::infinity();
};

/// The first place in time at which a file of two runs differs.
struct Parting {
    std::string place;                                       ///< "row 12, step 110", "frame 3"; empty: at the end
    double time = std::numeric_limits<double>::quiet_NaN();  ///< [s]; NaN: unknown
    ValueDifference value;
};

/// Comparison of a table, a series of frames or a checkpoint.
struct PartComparison {
    std::string name;                      ///< "energy.csv", "bodies.pvd"
    std::string compared;                  ///< "101 rows, 43 columns": what both have
    std::optional<Parting> parting;        ///< nothing: what both have is the same
    std::vector<ValueDifference> largest;  ///< up to three columns or fields, the largest relative difference first
    std::vector<std::string> lacks;        ///< what one run has and the other lacks: rows, frames, columns, the file
    std::vector<std::string> remarks;      ///< what was not compared, and why

    [[nodiscard]] bool is_same() const { return !parting && lacks.empty(); }
};

/// Comparison of the results of two runs.
struct RunComparison {
    std::vector<ValueDifference> settings;  ///< options, cells, step and bodies as summary.json has them
    std::vector<PartComparison> parts;      ///< of files that at least one run has

    [[nodiscard]] bool is_same() const {
        for (const PartComparison& part : parts)
            if (!part.is_same()) return false;
        return true;
    }
    /// The part that differs first in time, of several the first one; null if none does. Unknown times are last.
    [[nodiscard]] const PartComparison* first_to_part() const {
        const auto time_of = [](const PartComparison& part) {
            const double time = part.parting->time;
            return std::isnan(time) ? std::numeric_limits<double>::infinity() : time;
        };
        const PartComparison* found = nullptr;
        for (const PartComparison& part : parts)
            if (part.parting && (!found || time_of(part) < time_of(*found))) found = &part;
        return found;
    }
};

}  // namespace abut::run
