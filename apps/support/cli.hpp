#pragma once

// Names of CLI11 for headers that only pass them on: its own header takes seconds to compile, and is included where options
// are made (apps/support/command_line.hpp).
namespace CLI {
class App;
class Option;
}  // namespace CLI
