#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "abut/input/fault.hpp"
#include "abut/input/scene_file.hpp"

namespace abut::input {

/// Resources that a run would take.
struct Estimate {
    std::int32_t bodies = 0;
    std::int32_t cells = 0;
    std::int64_t boundary_faces = 0;
    double stable_dt = 0.0;  ///< [s]
    /// "cell 12 of body 'left' at (0.5, 1): a wave takes 1e-6 s through it, 0.2 of the median": the one that a wave crosses
    /// fastest; empty where no cell deforms.
    std::string cell_of_step{};
    double dt = 0.0;  ///< [s], of memm_async before its levels
    std::int64_t steps = 0;
    /// Two ways to take fewer of them, with their numbers; empty for a run of at most 100,000 or a given `dt` or `steps`
    std::string fewer_steps{};
    /// Proposed damping of bodies that rub, "stiffness_damping = 1e-05, ..."; empty if nothing rubs or a body is damped
    std::string damping{};
    std::string law;       ///< of contact, that which acts: "pair_potential"; empty without contact
    double end = 0.0;      ///< of the run [s]
    double seconds = 0.0;  ///< that it takes about: steps and records as long as the state at the start takes to evaluate
    std::string inertia;   ///< the least share of it that the points of a body have, and of which body
    std::string edges{};   ///< "0.02 m on average in 'left', 0.01 to 0.03 m": of the body whose cells are smallest
    std::string across{};  ///< "at most 4 in 'left'": cells across the thinnest body that deforms; empty if none does
    std::string bonds;     ///< how much of them is bonded (run::bonded_text); empty without bonds
    double bytes = 0.0;    ///< that this process has taken at most, once the solid was made; the run takes about as much
};

struct CheckedScene {
    std::vector<Fault> faults;          ///< in order
    std::optional<Estimate> estimate;   ///< where there is no fault
    std::vector<std::string> warnings;  ///< of run::warnings_before, without notes, where a run could begin
};

/// All that can be known before a run: faults of keys and values, of meshes, groups and places, and all that run::simulate
/// refuses before its first step, which is asked itself. What a body with a fault would say of others is not looked
/// for. Throws nothing for a scene that is wrong.
[[nodiscard]] CheckedScene check_scene(const std::filesystem::path& path, const Overrides& overrides = {});

/// A line for each figure, with its unit.
[[nodiscard]] std::string text_of(const Estimate& estimate);

}  // namespace abut::input
