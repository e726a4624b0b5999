#pragma once
#include <cstdint>
#include <optional>

#include "abut/run/observer.hpp"
#include "abut/run/values/checkpoint.hpp"

namespace abut::test {

/// Keeps the checkpoint of a step.
template <int Dim>
class Keep : public run::Observer<Dim> {
public:
    explicit Keep(std::int64_t step) : step_(step) {}
    [[nodiscard]] bool wants_look(std::int64_t) const override { return false; }
    [[nodiscard]] bool wants_checkpoint(std::int64_t step, bool) const override { return step == step_; }
    void keep(const run::Checkpoint& checkpoint) override { kept = checkpoint; }

    std::optional<run::Checkpoint> kept;

private:
    std::int64_t step_;
};

}  // namespace abut::test
