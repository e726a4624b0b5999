#include "abut/solid/combinations/combinations.hpp"

#include <algorithm>

#include "abut/base/error.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::solid {

std::optional<Conflict> first_conflict(FeatureSet features, FeatureSet among) {
    for (const Combination& row : combinations) {
        if (!features.has(row.feature)) continue;
        const FeatureSet others = row.without & features;
        const FeatureSet looked_at = among.has(row.feature) ? others : others & among;
        for (const FeatureWords& words : feature_words)
            if (looked_at.has(words.feature)) return Conflict{&row, words.feature};
    }
    return std::nullopt;
}

bool go_together(Feature one, Feature other) { return !first_conflict({one, other}, {one}); }

std::string text_of(const Conflict& conflict, const std::string& who) {
    const auto [first, second] = std::minmax(conflict.row->feature, conflict.other);
    const auto clause = [](Feature feature) { return std::string(words_of(feature).clause); };
    std::string text = is_of_body(first) ? who + " " + clause(first) : clause(first);
    text += (is_of_body(second) ? " and " : ", and ") + clause(second);
    return text + ": " + std::string(conflict.row->reason) + ". " + std::string(conflict.row->remedy);
}

void require_together(const std::string& where, const std::string& who, FeatureSet features) {
    if (const auto conflict = first_conflict(features, features))
        throw BadInput((where.empty() ? "" : where + ": ") + text_of(*conflict, who));
}

std::string combinations_table() {
    std::string table = "| feature | does not go with | since | do instead |\n|---|---|---|---|\n";
    for (const Combination& row : combinations) {
        std::string others;
        for (const FeatureWords& words : feature_words)
            if (row.without.has(words.feature)) others += (others.empty() ? "" : "; ") + std::string(words.name);
        table += "| " + std::string(words_of(row.feature).name) + " | " + others + " | " + std::string(row.reason) + " | " +
                 std::string(row.remedy) + " |\n";
    }
    return table;
}

FeatureSet features_of(Kinematics kinematics, const Material& material) {
    FeatureSet features{feature_of(kinematics)};
    const bool is_directed = !material.is_isotropic();
    features.add(Feature::turn, properties_of(kinematics).turns);
    features.add(Feature::large_strains,
                 material.law == MaterialLaw::neo_hookean || material.law == MaterialLaw::mooney_rivlin);
    features.add(Feature::flow, material.law == MaterialLaw::j2);
    features.add(Feature::damping, material.damping.any());
    features.add(Feature::directions, is_directed);
    features.add(Feature::directed_rate,
                 is_directed && (material.damping.stiffness > 0.0 || material.damping.linear_viscosity > 0.0 ||
                                 material.damping.quadratic_viscosity > 0.0));
    return features;
}

}  // namespace abut::solid
