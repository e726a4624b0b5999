#pragma once
#include <string>

#include "abut/base/error.hpp"

namespace abut {

/// Throws the error of that kind, with the same facts and another text: to say in front where in a run it happened.
[[noreturn]] void throw_again(const Error& error, const std::string& what);

}  // namespace abut
