#include "abut/input/fault.hpp"

#include <fmt/format.h>

#include <utility>

namespace abut::input {
namespace {

std::string headed(const std::vector<Fault>& faults) {
    return faults.size() == 1 ? text_of(faults) : fmt::format("{} faults\n{}", faults.size(), text_of(faults));
}

}  // namespace

std::string text_of(const std::vector<Fault>& faults) {
    std::string text;
    for (const Fault& fault : faults) text += (text.empty() ? "" : "\n") + fault.where + ": " + fault.text;
    return text;
}

SceneError::SceneError(std::vector<Fault> faults) : BadInput(headed(faults)), faults_(std::move(faults)) {}

}  // namespace abut::input
