#pragma once
// Private to the sources of the layers.

#if defined(__SANITIZE_THREAD__)  // GCC; asked first, since Eigen defines a __has_feature that knows nothing
#define ABUT_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define ABUT_THREAD_SANITIZER
#endif
#endif

#if defined(ABUT_THREAD_SANITIZER)
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace abut {

/// Tells ThreadSanitizer in which order a parallel loop runs, since the libraries that run it are not compiled for it: all
/// that comes before the loop comes before each task, and each task comes before all that follows the loop. The tasks
/// themselves stay unordered, so a race between two of them is found. In other builds it is nothing.
class ForkJoin {
public:
    ForkJoin() = default;
    ~ForkJoin() { acquire(joined_); }
    ForkJoin(const ForkJoin&) = delete;
    ForkJoin& operator=(const ForkJoin&) = delete;

    /// All that is written before comes before each task; `body` is what they read first. Its address has to be known
    /// to have left: stores to an object that nobody else can see yet may be moved past the release.
    void begin(const void* body) {
#if defined(ABUT_THREAD_SANITIZER)
        asm volatile("" : : "r"(body) : "memory");
#else
        static_cast<void>(body);
#endif
        release(forked_);
    }

    /// Lives as long as a task.
    class Task {
    public:
        explicit Task(ForkJoin& loop) : loop_(loop) { acquire(loop.forked_); }
        ~Task() { release(loop_.joined_); }
        Task(const Task&) = delete;
        Task& operator=(const Task&) = delete;

    private:
        ForkJoin& loop_;
    };

private:
#if defined(ABUT_THREAD_SANITIZER)
    static void acquire(char& address) { __tsan_acquire(&address); }
    static void release(char& address) { __tsan_release(&address); }
#else
    static void acquire(char&) {}
    static void release(char&) {}
#endif
    char forked_ = 0, joined_ = 0;  // only their addresses matter
};

/// The body of a loop with its place in the order. What a library copies from thread to thread to call it is left to that
/// library: only what the body itself does is looked at.
template <class Body>
class OrderedBody {
public:
    OrderedBody(ForkJoin& loop, const Body& body) : loop_(loop), body_(body) { loop.begin(&body); }

    template <class... Arguments>
    [[gnu::no_sanitize_thread]] decltype(auto) operator()(const Arguments&... arguments) const {
        const ForkJoin::Task task(loop_);
        return body_(arguments...);
    }

private:
    ForkJoin& loop_;
    const Body& body_;
};

}  // namespace abut

#undef ABUT_THREAD_SANITIZER
