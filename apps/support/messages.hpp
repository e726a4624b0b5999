#pragma once

namespace abut::apps {

class CommandParser;

/// Messages of a program while it runs a scene. Errors are on standard error in any case.
enum class Messages {
    normal,  ///< log, progress and a table at the end
    quiet,   ///< nothing
    json,    ///< lines of JSON: JsonLines
};

/// The log is off unless messages are normal.
void set_log(Messages messages);

/// --quiet and --json, of which one at most is taken.
void add_message_options(CommandParser& parser, Messages& messages);

}  // namespace abut::apps
