#pragma once
// Private to the layer.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace abut::input {

/// A value of a TOML file, and where it stands.
struct Node {
    enum class Type { table, array, text, number, whole, truth, date };

    Type type = Type::table;
    std::string where;  ///< Fault::where
    std::string text;   ///< of Type::text
    double number = 0.0;
    std::int64_t whole = 0;
    bool truth = false;
    std::vector<std::string> names;  ///< (n items) of a table, in the order of the file
    std::vector<Node> items;         ///< of a table or an array

    /// Null if there is none.
    [[nodiscard]] const Node* find(const std::string& name) const;
};

/// "the text 'heavy'", "a table": what stands there instead of what is wanted.
[[nodiscard]] std::string description(const Node& node);

/// Throws SceneError if the file cannot be opened or is no TOML.
[[nodiscard]] Node read_document(const std::filesystem::path& path);

/// A text without a file: messages call it `name`, and tell no lines. Throws SceneError if it is no TOML.
[[nodiscard]] Node read_text(const std::string& text, const std::string& name);

/// "bodies.left.density=2" as a document that holds this alone. What is no TOML value is taken for a text: filter=neutral.
/// Throws SceneError.
[[nodiscard]] Node read_override(const std::string& text);

/// Puts the values of a document into another one; tables are merged.
void merge(Node& document, const Node& more);

}  // namespace abut::input
