#pragma once
#include <filesystem>
#include <fstream>

#include "abut/dynamics/ledger.hpp"

namespace abut::examples {

/// energy.csv: a row for each ledger entry, 17 significant digits. It is called energy.csv.partial until `finish`.
template <int Dim>
class EnergyFile {
public:
    explicit EnergyFile(std::filesystem::path path);
    /// Throws std::runtime_error if the row cannot be written.
    void append(const dynamics::LedgerEntry<Dim>& entry);
    void finish();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] const std::filesystem::path& partial_path() const { return partial_; }

private:
    void check() const;

    std::filesystem::path path_;
    std::filesystem::path partial_;
    std::ofstream file_;
};

}  // namespace abut::examples
