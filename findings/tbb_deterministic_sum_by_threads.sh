#!/bin/bash
# oneTBB: parallel_deterministic_reduce with its two kinds of partition, on one to four threads
# Packages of Debian 12: libtbb-dev=2021.8.0-2+deb12u1, libtbb12=2021.8.0-2+deb12u1. Needs g++.
# Guess: the function is there for sums that are bitwise identical on any number of threads, and it accepts no partitioner that breaks this.
# Seen: static_partitioner, one of the two that it accepts, makes as many parts as the arena has threads: each number of threads has a sum
#   of its own. With simple_partitioner, which it takes by itself, all are bitwise identical.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libtbb-dev=2021.8.0-2+deb12u1 libtbb12=2021.8.0-2+deb12u1
for deb in *.deb; do dpkg -x "$deb" .; done
lib="$work/usr/lib/x86_64-linux-gnu"

cat > sums.cpp <<'C'
#include <cstdio>
#include <functional>
#include <initializer_list>
#include <random>
#include <set>
#include <vector>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

static std::vector<double> random_numbers() {
    std::mt19937 generator(1);
    std::vector<double> numbers(100000);
    for (double& number : numbers)
        number = std::generate_canonical<double, 53>(generator);
    return numbers;
}

static const std::vector<double> numbers = random_numbers();

template <class Partitioner>
static double sum(int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] {
        return tbb::parallel_deterministic_reduce(
            tbb::blocked_range<std::size_t>(0, numbers.size(), 1000), 0.0,
            [](const tbb::blocked_range<std::size_t>& range, double partial) {
                for (std::size_t i = range.begin(); i < range.end(); ++i)
                    partial += numbers[i];
                return partial;
            },
            std::plus<double>(), Partitioner());
    });
}

template <class Partitioner>
static void show(const char* name) {
    std::set<double> sums;
    for (const int threads : {1, 2, 3, 4})
        sums.insert(sum<Partitioner>(threads));
    std::printf("%s: %zu different sums on 1 to 4 threads\n", name, sums.size());
}

int main() {
    show<tbb::simple_partitioner>("simple_partitioner");
    show<tbb::static_partitioner>("static_partitioner");
}
C
g++ -O1 -std=c++17 -Iusr/include sums.cpp "$lib/libtbb.so.12" -o sums
LD_LIBRARY_PATH="$lib" ./sums 2> /dev/null | tee output
diff output - <<'E'
simple_partitioner: 1 different sums on 1 to 4 threads
static_partitioner: 4 different sums on 1 to 4 threads
E
