// A race on purpose: tasks of one parallel loop add to the same number. ThreadSanitizer must report it and name this file.
#include <chrono>
#include <cstdio>
#include <thread>

#include "abut/base/parallel.hpp"

int main() {
    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism, 4);
    double sum = 0.0;
    oneapi::tbb::task_arena(4).execute([&] {
        abut::parallel_tasks(200, [&](int i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));  // long enough for other threads to join
            sum += i;
        });
    });
    std::printf("%g\n", sum);
}
