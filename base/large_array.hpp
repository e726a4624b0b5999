#pragma once
#include <cstddef>
#include <vector>

namespace abut {

/// Memory for arrays that are swept again and again: on a cache line of its own, from 2 MiB on with pages of 2 MiB where the
/// system gives them (Linux, transparent huge pages "madvise" or "always"). Throws std::bad_alloc.
[[nodiscard]] void* allocate_large(std::size_t bytes);
/// Frees memory that `allocate_large` gave for that many bytes.
void release_large(void* memory, std::size_t bytes) noexcept;

/// The allocator of LargeArray.
template <class T>
struct LargeAllocator {
    using value_type = T;

    LargeAllocator() = default;
    template <class Other>
    LargeAllocator(const LargeAllocator<Other>&) {}

    [[nodiscard]] T* allocate(std::size_t n) { return static_cast<T*>(allocate_large(n * sizeof(T))); }
    void deallocate(T* memory, std::size_t n) noexcept { release_large(memory, n * sizeof(T)); }
    friend bool operator==(LargeAllocator, LargeAllocator) { return true; }
};

template <class T>
using LargeArray = std::vector<T, LargeAllocator<T>>;

}  // namespace abut
