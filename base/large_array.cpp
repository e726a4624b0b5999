#include "abut/base/large_array.hpp"

#include <atomic>
#include <cstdint>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace abut {
namespace {

constexpr std::size_t cache_line = 64, large_page = std::size_t{1} << 21;

// Arrays that begin at the same place of a page meet in the same lines of a cache when they are swept together.
constexpr std::size_t shift = 67 * cache_line, n_shifts = 16;

}  // namespace

void* allocate_large(std::size_t bytes) {
    if (bytes < large_page) return ::operator new (bytes, std::align_val_t{cache_line});
    static std::atomic<std::size_t> count = 0;
    void* const memory = ::operator new (bytes + n_shifts * shift, std::align_val_t{large_page});
#ifdef __linux__
    static_cast<void>(madvise(memory, bytes + n_shifts * shift, MADV_HUGEPAGE));  // a request: nothing depends on it
#endif
    return static_cast<std::byte*>(memory) + count++ % n_shifts * shift;
}

void release_large(void* memory, std::size_t bytes) noexcept {
    if (bytes < large_page) return ::operator delete (memory, std::align_val_t{cache_line});
    const auto begin = reinterpret_cast<std::uintptr_t>(memory) / large_page * large_page;
    ::operator delete (reinterpret_cast<void*>(begin), std::align_val_t{large_page});
}

}  // namespace abut
