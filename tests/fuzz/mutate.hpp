#pragma once
#include <random>
#include <string>
#include <vector>

namespace abut::fuzz {

/// One of the files with one to four changes: bits turned, bytes and lines deleted or doubled, numbers replaced by such that
/// readers trip over, a piece of another file put in.
[[nodiscard]] std::string mutated(const std::vector<std::string>& files, std::mt19937_64& random);

}  // namespace abut::fuzz
