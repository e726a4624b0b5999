#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "studies/extremes/scenes.hpp"
#include "studies/table/figures.hpp"

namespace abut::studies::extremes {

/// Verdict on a run at an extreme.
enum class Verdict {
    held,     ///< it ran to its end, and all that is asked of it is so (the constants below)
    refused,  ///< it ended with a message
    failed,   ///< it ran to its end, but something that is asked of it is not so
};
[[nodiscard]] std::string name_of(Verdict verdict);

/// Limits asked of a run for `held`, beside that the bodies meet and no contact is lost.
inline constexpr double largest_drift = 1e-10;           ///< of H~ over the scale of the scene
inline constexpr double largest_momentum_drift = 1e-10;  ///< over the sum of m |v| at the start
inline constexpr double largest_excess = 1.0;        ///< H - H~ over the scale: the parasitic mode owns less than the run
inline constexpr double largest_speed_aside = 0.05;  ///< over the speed: of a corner on a flat side, along it
inline constexpr double largest_deviation = 1e-9;    ///< of numbers that are known, or must not depend on the units

/// A number without a unit.
struct Number {
    std::string name;
    double value;
};

/// A line of the table: figures of a run, `parasitic` over the speed of the trial, momentum over the sum of m |v| at
/// the start. Numbers of a refused run are NaN or 0.
struct Row : Figures {
    std::string family, value;
    Verdict verdict = Verdict::refused;
    std::string message;                ///< of a refusal; what is not so of a failure; what is worth saying
    bool is_finite = false;             ///< all energies, momenta and speeds are
    double sliding = run::not_given;    ///< largest |g| |dA/ds| over the smaller face
    double slipped = run::not_given;    ///< largest |g|/D of pairs that slid off each other
    double deviation = run::not_given;  ///< from the same run in other units or at another place
    std::int64_t active_pairs_max = 0, blind_corners = 0;
    std::vector<Number> numbers;  ///< speeds of the bodies at the end first, then energies and counts
};

/// A run and what is expected of it.
template <int Dim>
struct Trial {
    std::string family;
    std::string value;           ///< "E_2/E_1 = 1e+06"
    double speed = 1.0;          ///< |e|/m is given over it [m/s]
    bool keeps_momentum = true;  ///< false: walls or gravity act
    bool meets = true;           ///< false: there is no contact to expect
    std::function<run::Scene<Dim>()> make;
    run::RunOptions run;
    /// Further demand on the run: it returns what is not so, or nothing. It may set numbers of the row; empty: no more.
    std::function<std::string(const run::RunResult<Dim>&, Row&)> ask_more;
};

/// Two blocks that run into each other.
template <int Dim>
[[nodiscard]] Trial<Dim> meeting_of_blocks(const std::string& family, const std::string& value, const Meeting<Dim>& meeting,
                                           const std::array<Block<Dim>, 2>& pair, const run::RunOptions& run);

/// Runs it; every exception becomes a row.
template <int Dim>
[[nodiscard]] Row attempt(const Trial<Dim>& trial);

/// Sets `deviation`: the largest difference of the first `how_many` numbers from those of the reference, over 1 or the
/// number, whichever is larger; and `failed` where it is more than `allowed`.
void compare(Row& row, const Row& reference, std::size_t how_many, double allowed);

}  // namespace abut::studies::extremes
