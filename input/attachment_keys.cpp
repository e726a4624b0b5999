#include "abut/input/keys.hpp"
#include "abut/solid/options/number_tables.hpp"

namespace abut::input {
namespace {

Key<SpringSettings> anchor(std::string name, AnchorSettings SpringSettings::*member, std::string help) {
    const auto read = [](Reader& reader, const Node& node, const std::string& key) -> std::optional<AnchorSettings> {
        if (!reader.is_table(node, key)) return std::nullopt;
        AnchorSettings anchor{.where = node.where};
        read_table(anchor, node, key, anchor_keys(), reader);
        return anchor;
    };
    return required(key_of<SpringSettings>(std::move(name), "table", std::move(help), member, read));
}

}  // namespace

const Keys<AnchorSettings>& anchor_keys() {
    using Of = Make<AnchorSettings>;
    static const Keys<AnchorSettings> keys = {
        required(Of::vector("point", &AnchorSettings::point, "m", "", "where it is at rest, in the scene")),
        Of::text("body", &AnchorSettings::body, "text", "the body that it is on; by default the ground"),
        Of::number("radius", &AnchorSettings::radius, {.unit = "m", .above = 0.0, .zero = true},
                   "cells with their centre that near hold it; at least as many as span space do")};
    return keys;
}

const Keys<SpringSettings>& spring_keys() {
    using Spring = SpringSettings;
    using Law = solid::Spring<3>;
    const auto limits_of = [](double Law::*member) { return number_of(solid::spring_numbers<3>, member).limits; };
    using Of = Make<Spring>;
    static const Keys<Spring> keys = {
        anchor("from", &Spring::from, "one end, such as {body = \"left\", point = [0, 0]}"),
        anchor("to", &Spring::to, "the other end, as from"),
        Of::number("stiffness", &Spring::stiffness, limits_of(&Law::stiffness), "of the spring"),
        Of::number("length", &Spring::length, limits_of(&Law::length),
                   "where it is not tense, 0: a hinge; by default the distance of its ends at rest"),
        Of::number("damping", &Spring::damping, limits_of(&Law::damping),
                   "of the dashpot beside it, along it; of a hinge in all directions")};
    return keys;
}

const Keys<MomentSettings>& moment_keys() {
    using Moment = MomentSettings;
    using Of = Make<Moment>;
    static const Keys<Moment> keys = {
        required(Of::text("body", &Moment::body, "text", "the body that it acts on as a whole")),
        Of::axial_field("value", &Moment::value, "N m", "moment"),
        Of::number("damping", &Moment::damping, {.unit = "N m s", .above = 0.0, .zero = true},
                   "moment against the spin of the body, over that spin")};
    return keys;
}

}  // namespace abut::input
