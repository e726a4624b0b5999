// Counts every allocation of this program: libraries included, since they call the same operator new.
#include <catch2/catch.hpp>

#include <atomic>
#include <cstdlib>
#include <new>

#include "contact/parts.hpp"
#include "contact/surfaces.hpp"

namespace {
std::atomic<long> n_allocations{0};

void* counted(std::size_t size, const std::nothrow_t&) noexcept {
    ++n_allocations;
    return std::malloc(size == 0 ? 1 : size);
}

void* counted(std::size_t size) {
    if (void* memory = counted(size, std::nothrow)) return memory;
    throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void* operator new(std::size_t size, const std::nothrow_t& tag) noexcept { return counted(size, tag); }
void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept { return counted(size, tag); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

using namespace abut;
using namespace abut::test;

TEMPLATE_TEST_CASE_SIG("integrating a step allocates nothing once the work arrays have grown", "[contact][path]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(21);
    const auto surface = random_surface<Dim>(random, 30);
    contact::ContactOptions options;
    options.search.skin = 5.0;
    options.compression_limit = 1e9;
    contact::Contact<Dim> contact(surface.view(), options);
    std::vector<std::vector<Vector<Dim>>> states;
    for (int i = 0; i < 8; ++i) states.push_back(random_displacement(random, surface, 0.4, 0.1));
    const auto rest = random_displacement(random, surface, 0.0, -1.0);
    contact.search(rest, rest, [](std::span<const contact::Face> faces) { return uncoupled<Dim>(faces.size()); });
    const std::size_t n = contact.faces().size();
    REQUIRE(n == static_cast<std::size_t>(surface.size()));
    const std::vector<Vector<Dim>> y(n, Vector<Dim>::Ones());
    const auto run_through = [&] {
        std::int64_t active = 0;
        for (std::size_t i = 0; i + 1 < states.size(); ++i) {
            contact.integrate(1.0, {states[i], states[i + 1], y, y});
            active += contact.report().active_pairs;
            contact.evaluate(states[i], y);
        }
        return active;
    };
    run_through();
    const long before = n_allocations;
    const std::int64_t active = run_through();
    const long after = n_allocations;
    CHECK(active > 50);
    CHECK(after - before == 0);
}

TEST_CASE("nor do parts that share it", "[contact][path][sharing]") {
    std::mt19937 random(21);
    const auto surface = random_surface<3>(random, 30);
    contact::ContactOptions options;
    options.search.skin = 5.0;
    options.compression_limit = 1e9;
    std::vector<std::vector<Vector<3>>> states;
    for (int i = 0; i < 8; ++i) states.push_back(random_displacement(random, surface, 0.4, 0.1));
    const auto rest = random_displacement(random, surface, 0.0, -1.0);
    const std::vector<Vector<3>> y(states[0].size(), Vector<3>::Ones());
    const auto allocations = on_parts(2, [&](ThreadPart& part) {
        contact::Contact<3> contact(surface.view(), options, &part);
        contact.search(rest, rest, [](auto faces) { return uncoupled<3>(faces.size()); });
        const auto run_through = [&] {
            for (std::size_t i = 0; i + 1 < states.size(); ++i) {
                contact.integrate(1.0, {states[i], states[i + 1], y, y});
                contact.evaluate(states[i], y);
            }
        };
        const std::size_t before_steps = part.n_gathers;
        run_through();
        run_through();
        const long before = n_allocations;  // the other part is near: all of its arrays have grown, too
        run_through();
        const long after = n_allocations;
        static_cast<void>(part.gather({}));  // no part ends before all have counted
        return std::pair(part.n_gathers - before_steps > 60, after - before);
    });
    for (const auto& [was_shared, n] : allocations) {
        CHECK(was_shared);
        CHECK(n == 0);
    }
}
