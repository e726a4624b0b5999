#pragma once
// Private to the layer.
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/option.hpp"
#include "abut/base/unit.hpp"
#include "abut/input/document.hpp"
#include "abut/input/fault.hpp"
#include "abut/input/given_keys.hpp"
#include "abut/input/settings.hpp"

namespace abut::input {

/// Takes values out of nodes; what cannot be taken becomes a fault and nothing. `key` is what messages call the node.
class Reader {
public:
    int dimension = 0;                             ///< of vectors; 0: not known, 2 or 3
    std::vector<NamedNumber> numbers;              ///< that formulas may use
    std::vector<std::shared_ptr<GivenKey>> given;  ///< of all sections that keep them

    void fault(const Node& node, std::string text);
    [[nodiscard]] std::vector<Fault>& faults() { return faults_; }

    /// A number, or a formula of numbers.
    [[nodiscard]] std::optional<double> number(const Node& node, const std::string& key, const Limits& limits);
    [[nodiscard]] std::optional<int> count(const Node& node, const std::string& key, int least, int most);
    [[nodiscard]] std::optional<bool> truth(const Node& node, const std::string& key);
    [[nodiscard]] std::optional<std::string> text(const Node& node, const std::string& key);
    /// The index of one of these words.
    [[nodiscard]] std::optional<std::size_t> word(const Node& node, const std::string& key,
                                                  const std::vector<std::string>& words);
    [[nodiscard]] std::optional<Vector<3>> vector(const Node& node, const std::string& key, const Limits& limits);
    /// About z in the plane.
    [[nodiscard]] std::optional<Vector<3>> axial(const Node& node, const std::string& key, const Limits& limits);
    [[nodiscard]] std::optional<Formula> formula(const Node& node, const std::string& key, const Limits& limits,
                                                 Variables variables);
    /// A number with or without a unit, as [values] have it, in SI units.
    struct Measured {
        double value = 0.0;
        std::optional<Unit::Powers> dimension;  ///< NamedNumber::dimension
    };
    [[nodiscard]] std::optional<Measured> measured(const Node& node, const std::string& key);
    [[nodiscard]] std::optional<FieldSettings> field(const Node& node, const std::string& key, const Limits& limits,
                                                     Variables variables);
    /// In time, about z in the plane.
    [[nodiscard]] std::optional<FieldSettings> axial_field(const Node& node, const std::string& key, const Limits& limits);
    [[nodiscard]] std::optional<std::array<int, 3>> counts(const Node& node, const std::string& key);
    [[nodiscard]] std::optional<std::vector<Vector<3>>> points(const Node& node, const std::string& key,
                                                               const Limits& limits);
    /// Numbers of which each is larger than the one before, one or more.
    [[nodiscard]] std::optional<std::vector<double>> increasing(const Node& node, const std::string& key,
                                                                const Limits& limits);
    /// Indices of some of these words.
    [[nodiscard]] std::optional<std::vector<std::size_t>> words(const Node& node, const std::string& key,
                                                                const std::vector<std::string>& words);
    [[nodiscard]] std::optional<std::vector<IgnoredPair>> pairs(const Node& node, const std::string& key);
    /// "x", "y", "z"
    [[nodiscard]] std::optional<std::array<bool, 3>> components(const Node& node, const std::string& key);
    [[nodiscard]] bool is_table(const Node& node, const std::string& key);
    /// A fault for a value of another type than `wanted`.
    void wrong_type(const Node& node, const std::string& key, const std::string& wanted);

private:
    /// In the unit `wanted`. Throws BadInput.
    [[nodiscard]] Formula formula_of(const std::string& text, const std::string& wanted, Variables variables);
    [[nodiscard]] Formula in_unit(const ValueWithUnit& value, const Unit& from, const Unit& to, Variables variables);
    /// Throws BadInput for a formula of values with units that has another dimension than `wanted`.
    void require_dimension(const std::string& formula, const Unit::Powers& wanted, const std::string& remedy) const;
    /// Whether it is about z: a number, not a list.
    [[nodiscard]] bool is_in_plane(const Node& node) const;
    [[nodiscard]] bool has_components(const Node& node, const std::string& key, const std::string& of_what);

    std::vector<Fault> faults_;
};

}  // namespace abut::input
