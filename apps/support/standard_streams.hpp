#pragma once
#include <csignal>
#include <string>

namespace abut::apps {

/// Opens /dev/null in place of standard input, output and error where whoever started the program has closed them: otherwise
/// the next file that is opened takes that place, and what the program says goes into it. To be called before anything else.
void open_closed_streams();

/// From here on a file that reaches the limit of file sizes (ulimit -f) ends the process by no signal: what writes it
/// fails, as on a full disc, and says so. Children inherit it.
void go_on_at_largest_file();

/// Puts a text on standard output. That nobody reads it is no error.
void say(const std::string& text);

/// While it lives, a pipe behind standard output or error whose reader has gone (`| head -1`) does not end the process: what
/// goes there from then on is lost, and standard error, where it is still read, says so once. Where whoever started the
/// program ignores SIGPIPE, that stays. A child that is started meanwhile has SIGPIPE as it is by default.
class GoOnWithoutReader {
public:
    GoOnWithoutReader();
    ~GoOnWithoutReader();
    GoOnWithoutReader(const GoOnWithoutReader&) = delete;
    GoOnWithoutReader& operator=(const GoOnWithoutReader&) = delete;

private:
    using Action = struct sigaction;

    Action before_{};
};

}  // namespace abut::apps
