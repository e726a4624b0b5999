#include "abut/input/grammar.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "abut/input/keys.hpp"

namespace abut::input {
namespace {

constexpr const char* table_head = "| key | value | unit | default | meaning |\n|---|---|---|---|---|\n";

template <class Section>
std::string rows(const Keys<Section>& keys) {
    std::string text;
    for (const auto& key : keys)
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.value, key.unit,
                            key.required ? "**required**" : key.by_default, key.help);
    return text;
}

template <class Section>
std::string table(const std::string& title, const Keys<Section>& keys) {
    return fmt::format("### {}\n\n{}{}\n", title, table_head, rows(keys));
}

/// Any names: no key reads them.
std::string numbers_table() {
    return fmt::format(
        "### [values]\n\n{}| NAME | number |  |  | what formulas of all keys know by this name; its own formula may "
        "use those before it |\n\n",
        table_head);
}

/// The kinds of a body or an obstacle, and then the keys of all.
template <class Section, class Kind>
std::string varied(const std::string& title, const std::vector<Variety<Section, Kind>>& varieties,
                   const Keys<Section>& common) {
    std::string text = fmt::format("### {}\n\n", title);
    for (const auto& variety : varieties)
        if (variety.choice != Kind::none)
            text += fmt::format("`shape = \"{}\"` ({}D)\n\n{}{}\n", variety.word, fmt::join(variety.dimensions, "D, "),
                                table_head, rows(variety.keys));
    return text + fmt::format("Of every shape\n\n{}{}\n", table_head, rows(common));
}

}  // namespace

std::string grammar() {
    return table("In no table", top_keys()) + numbers_table() + table("[materials.NAME]", material_keys()) +
           varied("[bodies.NAME]", body_varieties(), body_keys()) + table("[bodies.NAME.refinement]", refinement_keys()) +
           table("[bodies.NAME.fracture]", fracture_keys()) + table("[bodies.NAME.erosion]", erosion_keys()) +
           table("[bodies.NAME.BODY], BODY being one of the bodies of `mesh` or a region", part_keys()) +
           table("[[patterns]]", pattern_keys()) + table("[[symmetry]]", symmetry_keys()) +
           table("[[contact.pairs]]", pair_keys()) + table("[[bonds]]", bond_keys()) +
           varied("[obstacles.NAME]", obstacle_varieties(), obstacle_keys()) + table("[supports.NAME]", support_keys()) +
           table("[tractions.NAME]", traction_keys()) + table("[springs.NAME]", spring_keys()) +
           table("[springs.NAME.from], [springs.NAME.to]", anchor_keys()) + table("[moments.NAME]", moment_keys()) +
           table("[run]", run_keys()) + table("[contact]", contact_keys()) + table("[output]", output_keys()) +
           table("[output.probes.NAME]", probe_keys()) + table("[laboratory]", laboratory_keys());
}

}  // namespace abut::input
