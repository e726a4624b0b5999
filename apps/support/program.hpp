#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/support/messages.hpp"

namespace abut::apps {

class CommandParser;

/// Name of a program and what it leaves behind.
struct Program {
    std::string name;     ///< as it is typed; results go to out/<name> by default
    std::string purpose;  ///< one sentence for --help
    std::string series;   ///< of its files for ParaView: <series>.pvd, <series>_surface.pvd and their frames
    std::string footer;   ///< ends --help
    /// Files that a restart needs, name and text: run::ResultFiles::keep_beside_checkpoints.
    std::vector<std::pair<std::string, std::string>> beside_checkpoints{};
    std::string note{};                    ///< a warning that a run begins with; empty: none
    Messages messages = Messages::normal;  ///< while it runs a scene
    bool takes_ranks = false;              ///< whether several ranks can run it together (run_scene)
};

/// The body of a main function: reads the command line and then calls `body`. One message on standard error and 1 if either
/// fails; 0 after --help or a good end; 130, 143 or 129 if SIGINT, SIGTERM or SIGHUP were noted (StopSignals) and
/// `body` ended well. Standard streams that are closed lead to /dev/null. A
/// command line that cannot be read touches no file. `program` is read again once the command line is: `messages` may be an
/// option.
int run_program(const Program& program, int argc, char** argv, const std::function<void(CommandParser&)>& add_options,
                const std::function<void()>& body);

}  // namespace abut::apps
