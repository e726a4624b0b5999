#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "abut/base/state_fields.hpp"

namespace abut {

/// Answers to questions that several processes ask in the same order, and that one of them alone can answer: it finds the
/// answers and keeps them, the others are given what it has kept.
class Answers {
public:
    Answers() = default;  ///< finds and keeps them
    /// Answers that another process has kept. Throws BadInput for bytes that are none.
    explicit Answers(std::vector<std::byte> kept) : given_(std::move(kept)), reader_(std::in_place, given_, kind, version) {}
    Answers(const Answers&) = delete;
    Answers& operator=(const Answers&) = delete;

    [[nodiscard]] bool are_given() const { return reader_.has_value(); }
    /// find(), or what it returned there: a value as put_value takes it. Throws BadInput where no answers are left.
    template <class Find>
    [[nodiscard]] auto of(const Find& find) -> decltype(find()) {
        decltype(find()) answer{};
        if (reader_) {
            get_value(*reader_, answer);
            return answer;
        }
        answer = find();
        put_value(writer_, answer);
        return answer;
    }
    /// Calls check() where answers are found; where they are given, it found nothing wrong there.
    template <class Check>
    void check(const Check& check) const {
        if (!reader_) check();
    }
    /// All answers so far, once.
    [[nodiscard]] std::vector<std::byte> kept() && { return std::move(writer_).finish(); }

private:
    static constexpr const char* kind = "answers";
    static constexpr std::uint32_t version = 1;

    StateWriter writer_{kind, version};
    std::vector<std::byte> given_;
    std::optional<StateReader> reader_;
};

}  // namespace abut
