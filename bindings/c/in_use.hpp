#pragma once
// Private to the bindings.
#include <atomic>

#include "abut/base/error.hpp"

namespace abut::bindings {

/// An object while a call has it to itself. Throws Misuse with `text` where another call has it.
class Use {
public:
    Use(std::atomic_flag& in_use, const char* text) : in_use_(in_use) {
        if (in_use_.test_and_set(std::memory_order_acquire)) throw Misuse(text);
    }
    ~Use() { in_use_.clear(std::memory_order_release); }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

private:
    std::atomic_flag& in_use_;
};

}  // namespace abut::bindings
