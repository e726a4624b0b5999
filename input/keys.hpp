#pragma once
// Private to the layer.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "abut/input/key.hpp"
#include "abut/input/settings.hpp"

namespace abut::input {

/// A kind of body or obstacle and the keys that it has beside those of all.
template <class Section, class Kind>
struct Variety {
    std::string word;
    Kind choice;
    std::vector<int> dimensions;
    Keys<Section> keys;
};

[[nodiscard]] Keys<Settings> all_keys();         ///< of a scene; `values` and `materials`, read before, without effect
[[nodiscard]] Key<Settings> materials_key();     ///< reads them, before all others
[[nodiscard]] const Keys<Settings>& top_keys();  ///< those in no table
[[nodiscard]] const Keys<Settings>& run_keys();
[[nodiscard]] const Keys<Settings>& contact_keys();
[[nodiscard]] const Keys<Settings>& laboratory_keys();  ///< what compares methods
[[nodiscard]] const Keys<Settings>& output_keys();
[[nodiscard]] const Keys<MaterialSettings>& material_keys();
[[nodiscard]] const Keys<ProbeSettings>& probe_keys();
[[nodiscard]] const Keys<BodySettings>& body_keys();  ///< of all bodies
[[nodiscard]] const Keys<BodySettings>& part_keys();  ///< of a body of a file with several
[[nodiscard]] const Keys<PairSettings>& pair_keys();
[[nodiscard]] const Keys<PatternSettings>& pattern_keys();
[[nodiscard]] const Keys<SymmetrySettings>& symmetry_keys();
[[nodiscard]] const Keys<BondSettings>& bond_keys();
[[nodiscard]] const Keys<ObstacleSettings>& obstacle_keys();
[[nodiscard]] const Keys<SupportSettings>& support_keys();
[[nodiscard]] const Keys<TractionSettings>& traction_keys();
[[nodiscard]] const Keys<SpringSettings>& spring_keys();
[[nodiscard]] const Keys<AnchorSettings>& anchor_keys();  ///< of the ends of a spring
[[nodiscard]] const Keys<MomentSettings>& moment_keys();
[[nodiscard]] const Keys<RefinementSettings>& refinement_keys();
[[nodiscard]] const Keys<FractureSettings>& fracture_keys();
[[nodiscard]] const Keys<solid::ErosionLimits>& erosion_keys();

/// Puts in front of them `none`, the first choice, with all their keys.
template <class Section, class Kind>
[[nodiscard]] std::vector<Variety<Section, Kind>> with_all_keys(std::vector<Variety<Section, Kind>> varieties) {
    Variety<Section, Kind> all{"", Kind::none, {2, 3}, {}};
    for (const auto& variety : varieties)
        for (Key<Section> key : variety.keys) {
            key.required = false;
            const bool known = std::ranges::any_of(all.keys, [&](const auto& other) { return other.name == key.name; });
            if (!known) all.keys.push_back(std::move(key));
        }
    varieties.insert(varieties.begin(), std::move(all));
    return varieties;
}

/// In both the first is `none` with all keys of the others: what is read where the shape is not known.
[[nodiscard]] const std::vector<Variety<BodySettings, Shape>>& body_varieties();
[[nodiscard]] const std::vector<Variety<ObstacleSettings, ObstacleShape>>& obstacle_varieties();

}  // namespace abut::input
