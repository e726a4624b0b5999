#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abut::apps {

/// Text of `abut help NAME`, and a section of the manual page.
struct Topic {
    std::string name;   ///< "exit-codes"
    std::string title;  ///< "Exit codes"
    std::string text;   ///< TopicPart by TopicPart
};

/// A paragraph, or an entry of a list: "  name   meaning" in the text, with more lines further in.
struct TopicPart {
    std::optional<std::string> entry;  ///< its name
    std::string text;                  ///< in one line
};
[[nodiscard]] std::vector<TopicPart> parts_of(const Topic& topic);

[[nodiscard]] std::span<const Topic> topics();

/// The text of a topic for a reader with so many columns. Throws BadInput if there is none of that name.
[[nodiscard]] std::string topic_text(const std::string& name, std::size_t width);
/// All topics, a line each.
[[nodiscard]] std::string topic_list();

}  // namespace abut::apps
