#pragma once
#include <string>

namespace abut::apps {

/// Main function of the program abut. 0 after a good end; 1 with a message on standard error for a command line or a scene
/// that is wrong, and for a run that fails; 2 for two runs that differ (diff); 130, 143 or 129 after SIGINT, SIGTERM or
/// SIGHUP.
int run_abut(int argc, char** argv);

/// The commented scene that `abut new` writes.
[[nodiscard]] const std::string& new_scene();

}  // namespace abut::apps
