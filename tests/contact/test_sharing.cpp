// Parts that share contact have the bits of one process, each does its share, and an error of one is that of all.
#include <catch2/catch.hpp>

#include <new>
#include <numeric>

#include "abut/base/error.hpp"
#include "abut/contact/shared_work.hpp"
#include "contact/nodal_scenes.hpp"
#include "contact/parts.hpp"
#include "contact/plates.hpp"

using namespace abut;
using namespace abut::test;
using contact::TakenForce;

namespace {

constexpr std::array part_numbers{2, 3, 8};

/// Faces answer to their own displacement and to that of the next in the list, positive definite.
template <int Dim>
contact::FaceCoupling<Dim> coupled_in_a_row(std::size_t n) {
    contact::FaceCoupling<Dim> coupling;
    for (std::size_t f = 0; f < n; ++f) {
        for (std::size_t g = f == 0 ? 0 : f - 1; g < std::min(n, f + 2); ++g) {
            coupling.columns.push_back(static_cast<std::int32_t>(g));
            coupling.blocks.push_back((f == g ? 3.0 : 0.7) * Matrix<Dim>::Identity());
        }
        coupling.offsets.push_back(static_cast<std::int32_t>(coupling.columns.size()));
    }
    return coupling;
}

template <int Dim>
using States = std::vector<std::vector<Vector<Dim>>>;

/// A run of a contact whose host is moved by hand through these states, and all that is to be seen of it.
template <int Dim>
PartResult run_through(const contact::Surface<Dim>& surface, const contact::ContactOptions& options,
                       const States<Dim>& states, contact::Sharing* sharing) {
    contact::Contact<Dim> contact(surface.view(), options, sharing);
    PartResult result;
    for (std::size_t i = 0; i + 1 < states.size(); ++i) {
        const auto& step =
            contact.step(1.0, {.displacement_0 = states[i],
                               .displacement_1 = states[i + 1],
                               .coupling_of = [](auto listed) { return coupled_in_a_row<Dim>(listed.size()); },
                               .gradients_of =
                                   [](auto listed, auto y_0, auto y_1) {
                                       for (std::size_t f = 0; f < listed.size(); ++f) {
                                           y_0[f] = std::sin(1.0 + f) * Vector<Dim>::Ones();
                                           y_1[f] = std::cos(2.0 * f) * Vector<Dim>::Ones();
                                       }
                                   },
                               .take = i % 3 == 2 ? TakenForce::end : TakenForce::mean});
        result.bits.add(step);
        result.bits.add(contact.search_report());
        result.active_pairs = std::max(result.active_pairs, std::ssize(step.pairs));
        std::vector<Vector<Dim>> u, y;
        for (const contact::Face face : contact.faces()) {
            u.push_back(states[i + 1][static_cast<std::size_t>(face)]);
            y.push_back(0.1 * Vector<Dim>::Ones());
        }
        result.bits.add(contact.evaluate(u, y));
    }
    result.bits.add(contact.state());
    return result;
}

template <int Dim>
States<Dim> random_states(const contact::Surface<Dim>& surface, int n) {
    std::mt19937 random(5);
    States<Dim> states;
    for (int i = 0; i < n; ++i) states.push_back(random_displacement(random, surface, 0.2, 0.05 * i));
    return states;
}

template <int Dim>
PartResult run_nodal(const NodalScene<Dim>& scene, const contact::NodalOptions& options, contact::Sharing* sharing) {
    contact::NodalContact<Dim> contact(scene.surface(), options, sharing);
    const auto at = [&](int i) {
        const double s = i / 12.0;
        const Vector<Dim> centre = 0.5 * Vector<Dim>::Ones() + up<Dim>();
        return placed<Dim>(scene, 1,
                           turned_about<Dim>(centre, 0.05 * std::sin(5.0 * s), -0.08 * std::sin(3.1 * s) * up<Dim>()));
    };
    PartResult result;
    for (int i = 0; i < 12; ++i) {
        const auto& step = contact.step(1.0, at(i), at(i + 1), i % 4 == 3 ? TakenForce::end : TakenForce::mean);
        result.bits.add(step);
        result.bits.add(contact.search_report());
        result.active_pairs = std::max(result.active_pairs, std::ssize(step.pairs));
        result.bits.add(contact.evaluate(at(i + 1)));
        if (i == 5) result.bits.add(contact.evaluate(at(9)));  // elsewhere
    }
    result.bits.add(contact.state());
    return result;
}

/// run(sharing) on one process and on several parts: the same; and these have met at least `least_gathers` times.
template <class Run>
void check_parts(const Run& run, std::size_t least_gathers) {
    const PartResult alone = run(nullptr);
    for (const int n : part_numbers) {
        CAPTURE(n, alone.active_pairs);
        const auto of_parts = on_parts(n, [&](ThreadPart& part) {
            PartResult result = run(&part);
            result.n_gathers = part.n_gathers;
            return result;
        });
        for (const PartResult& result : of_parts) {
            CHECK(result.bits == alone.bits);
            CHECK(result.n_gathers >= least_gathers);
        }
    }
}

/// Kind and text of what call() throws, with a figure of it.
template <class Call>
std::string thrown_by(const Call& call) {
    try {
        call();
    } catch (const geometry::SearchLimitError& error) {
        return std::string("search limit: ") + error.what();
    } catch (const Error& error) {
        return std::string(name(error.kind())) + ": " + error.what() + " " + std::to_string(error.facts().face_1) + " " +
               std::to_string(error.facts().value);
    } catch (const std::bad_alloc&) {
        return "no memory";
    } catch (const std::exception& error) {
        return std::string("other: ") + error.what();
    }
    return "";
}

/// Squares of a plane that look up, and one below each that looks down, none next to another: as many pairs as squares.
contact::Surface<3> pairs_of_tiles(int n) {
    contact::Surface<3> surface;
    for (int body = 0; body < 2; ++body)
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                surface.append(tile<3>(Vector<3>(i, j, 0.0), (body == 0 ? 1.0 : -1.0) * up<3>(), 0.2), 0.2, 1.0 + body,
                               body);
    return surface;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("parts that share a contact of random faces have the bits of one process", "[contact][sharing][long]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(3);
    auto surface = random_surface<Dim>(random, Dim == 2 ? 40 : 33);
    contact::ContactOptions options;
    options.compression_limit = 1e9;
    options.events = GENERATE(true, false);
    options.overlap = GENERATE(contact::OverlapMode::moving, contact::OverlapMode::frozen);
    SECTION("as it comes") {}
    SECTION("within one body") {
        surface.body.assign(surface.body.size(), 0);
        options.search.self_contact = true;
    }
    SECTION("with other options") {
        options.area = geometry::AreaMethod::exact;
        options.weighting = contact::InterfaceWeighting::half;
        options.quadrature = 1;
        options.search.skin = 0.05;
        contact::append(surface, contact::plane_obstacle<Dim>(-0.05 * up<Dim>(), up<Dim>(), 1.0), 2);
    }
    const auto states = random_states(surface, 3);
    REQUIRE(run_through<Dim>(surface, options, states, nullptr).active_pairs > 64);
    // a search at least, and two gathers for each of 4 steps and states
    check_parts([&](contact::Sharing* sharing) { return run_through<Dim>(surface, options, states, sharing); }, 9);
}

TEMPLATE_TEST_CASE_SIG("parts that share a search have the list and the counts of one process by every broad phase",
                       "[contact][sharing][candidates]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(8);
    const auto surface = random_surface<Dim>(random, 150, 0.3, 3.0);
    const bool self_contact = GENERATE(false, true);
    const double facing_cosine = GENERATE(-0.2, 1.0);
    for (const geometry::BroadPhase method : geometry::broad_phases()) {
        CAPTURE(geometry::name(method));
        const auto run = [&](contact::Sharing* sharing) {
            contact::CandidateSearch<Dim> search(
                surface.view(),
                {.broad_phase = method, .facing_cosine = facing_cosine, .distance = 0.05, .self_contact = self_contact},
                sharing);
            std::mt19937 moves(4);
            PartResult result;
            for (int i = 0; i < 3; ++i) {  // the skin learns
                const auto u_0 = random_displacement(moves, surface, 0.01, 0.02 * i);
                search.search(u_0, random_displacement(moves, surface, 0.01, 0.02 * i));
                for (const auto& [a, b] : search.candidates()) result.bits.add(a), result.bits.add(b);
                result.bits.add(search.report());
                result.bits.add(search.next_skin());
                auto x = surface.vertices;
                for (Vector<Dim>& vertex : x) vertex += random_vector<Dim>(moves, 0.02);
                search.search_moved(x, surface.vertices);
                for (const auto& [a, b] : search.candidates()) result.bits.add(a), result.bits.add(b);
                result.bits.add(search.report());
                result.active_pairs = search.report().candidates;
            }
            return result;
        };
        REQUIRE(run(nullptr).active_pairs > 500);
        check_parts(run, 6);
    }
}

TEMPLATE_TEST_CASE_SIG("parts that share a contact of nodes have the bits of one process", "[contact][sharing][nodal]",
                       ((int Dim), Dim), 2, 3) {
    const auto scene = two_boxes<Dim>(Dim == 2 ? 60 : 5, Dim == 2 ? 50 : 4, 0.02);
    contact::NodalOptions options;
    options.events = GENERATE(true, false);
    options.search.skin = GENERATE(0.0, 0.02);
    options.compression_limit = 10.0;
    REQUIRE(run_nodal<Dim>(scene, options, nullptr).active_pairs > 32);
    // a search with its outlooks, and one gather for each of 12 steps
    check_parts([&](contact::Sharing* sharing) { return run_nodal<Dim>(scene, options, sharing); }, 14);
}

TEST_CASE("parts without a pair, and with fewer than they are, have the bits of one process", "[contact][sharing]") {
    auto surface = GENERATE(0, 1) == 0 ? plates<3>(3) : pairs_of_tiles(6);
    States<3> states;
    SECTION("the bodies are far from each other") {
        for (int i = 0; i < 4; ++i) states.push_back(moved(surface, -50.0 - i, 0.0));
        REQUIRE(run_through<3>(surface, deep(), states, nullptr).active_pairs == 0);
    }
    SECTION("one pair touches") {
        for (int i = 0; i < 4; ++i) {
            states.push_back(moved(surface, -50.0, 0.0));
            const std::size_t above = surface.body.size() / 2;
            states.back()[above] = 0.05 * i * up<3>() * -1.0;
        }
        states.insert(states.begin(), moved(surface, -50.0, 0.0));
        states.front()[surface.body.size() / 2] = 0.1 * up<3>();
        REQUIRE(run_through<3>(surface, deep(), states, nullptr).active_pairs > 0);
        REQUIRE(run_through<3>(surface, deep(), states, nullptr).active_pairs < 3);
    }
    check_parts([&](contact::Sharing* sharing) { return run_through<3>(surface, deep(), states, sharing); }, 0);
}

TEST_CASE("a contact too small to be shared asks nobody", "[contact][sharing]") {
    const auto surface = plates<3>(3);
    const auto states = path_of_plates(surface);
    const auto n_gathers = on_parts(2, [&](ThreadPart& part) {
        run_through<3>(surface, deep(), states, &part);
        return part.n_gathers;
    });
    CHECK(n_gathers == std::vector<std::size_t>{0, 0});
}

TEST_CASE("each part sends its share of pairs, pieces and gradients", "[contact][sharing]") {
    const auto surface = pairs_of_tiles(10);
    const States<3> states{moved(surface, 0.02, 0.0), moved(surface, 0.05, 0.0)};
    States<3> flat = states;  // no pair differs from another
    for (auto& u : flat)
        for (std::size_t f = 0; f < u.size(); ++f)
            if (surface.body[f] == 0) u[f].setZero();
    REQUIRE(run_through<3>(surface, deep(), flat, nullptr).active_pairs == 100);
    for (const int n : part_numbers) {
        const auto sizes = on_parts(n, [&](ThreadPart& part) {
            run_through<3>(surface, deep(), flat, &part);
            return std::vector<std::size_t>(part.sizes().begin(), part.sizes().end());
        });
        REQUIRE(sizes[0].size() == 5);  // candidates; pieces and gradients of the step, and of the state at its end
        for (std::size_t call = 0; call < 5; ++call) {
            std::size_t least = std::numeric_limits<std::size_t>::max(), most = 0, total = 0;
            for (const auto& of_part : sizes) {
                least = std::min(least, of_part[call]);
                most = std::max(most, of_part[call]);
                total += of_part[call];
            }
            CAPTURE(n, call, least, most, total);
            // a candidate is two numbers; a piece has 14, and its pair 3 short ones more; a gradient has 4; a run has 5
            const std::array<std::size_t, 5> pair{8, 14 * 8 + 12, 4 * 8, 14 * 8 + 12, 4 * 8};
            CHECK(most - least <= pair[call] + 5 * 8);
            CHECK(total >= 100 * pair[call]);
            CHECK(total <= 100 * pair[call] + static_cast<std::size_t>(n) * 100 + 200);
        }
    }
}

TEST_CASE("what goes wrong in the share of a part is the same error on all", "[contact][sharing][errors]") {
    const auto errors_of = [](int n, const auto& work) {
        return on_parts(n, [&](ThreadPart& part) {
            contact::SharedWork shared(&part);
            const std::string error = thrown_by([&] {
                shared.run(
                    100, [&](const contact::IndexRange&, contact::ShareWriter&) { work(part.part()); },
                    [](const contact::IndexRange&, contact::ShareReader&) {});
            });
            // the next call is as if nothing had happened
            std::int64_t sum = 0;
            shared.run(
                100,
                [&](const contact::IndexRange& mine, contact::ShareWriter& out) {
                    for (std::size_t i = mine.begin; i < mine.end; ++i) out.put(static_cast<std::int64_t>(i));
                },
                [&](const contact::IndexRange& of_part, contact::ShareReader& in) {
                    for (std::size_t i = of_part.begin; i < of_part.end; ++i) sum += in.get<std::int64_t>();
                });
            return error + " " + std::to_string(sum);
        });
    };
    const auto all = [](int n, const std::string& error) {
        return std::vector<std::string>(static_cast<std::size_t>(n), error + " 4950");
    };
    const int n = GENERATE(2, 3, 8);
    CHECK(errors_of(n, [&](int part) {
              if (part == n - 1) throw TooDeep("pressed in", {.face_1 = 7, .value = 2.5});
          }) == all(n, "too deep: pressed in 7 2.500000"));
    CHECK(errors_of(n, [](int part) { throw BadInput("part " + std::to_string(part), {.face_1 = part, .value = 1.0}); }) ==
          all(n, "bad input: part 0 0 1.000000"));
    CHECK(errors_of(n, [](int part) {
              if (part == 1) throw std::bad_alloc();
          }) == all(n, "no memory"));
    CHECK(errors_of(n, [](int part) {
              if (part == 0) throw std::out_of_range("beyond");
          }) == all(n, "other: beyond"));
    CHECK(errors_of(n, [](int) {}) == all(n, ""));
}

TEST_CASE("parts that differ in what they do are told so", "[contact][sharing][errors]") {
    const auto errors = on_parts(3, [&](ThreadPart& part) {
        contact::SharedWork shared(&part);
        return thrown_by([&] {
            shared.run(
                part.part() == 2 ? 101 : 100, [](const contact::IndexRange&, contact::ShareWriter&) {},
                [](const contact::IndexRange&, contact::ShareReader&) {});
        });
    });
    for (const std::string& error : errors)
        CHECK(error.starts_with("misuse: contact: the parts that share it have different"));
}

TEST_CASE("a search that one part gives up is given up by all, and so is one with too many pairs in all",
          "[contact][sharing][errors]") {
    std::mt19937 random(8);
    const auto surface = random_surface<3>(random, 100, 0.3, 2.0);
    const auto u = at_rest(surface);
    contact::CandidateSearch<3> alone(surface.view());
    alone.search(u, u);
    const std::int64_t n = alone.report().candidates;
    REQUIRE(n > 600);
    const auto errors_with = [&](const auto& limit_of) {
        return on_parts(3, [&](ThreadPart& part) {
            contact::CandidateOptions options;
            options.limits.pairs = limit_of(part.part());
            contact::CandidateSearch<3> search(surface.view(), options, &part);
            const std::string error = thrown_by([&] { search.search(u, u); });
            const bool is_as_after_an_error = search.candidates().empty() && !search.is_valid_for(0.0);
            return error + (is_as_after_an_error ? "" : ", but there is a list");
        });
    };
    const auto of_one = errors_with([&](int part) { return part == 1 ? 5 : n; });
    CHECK(of_one[0].starts_with("search limit: broad phase: "));
    CHECK(of_one == std::vector<std::string>(3, of_one[0]));
    const auto of_all = errors_with([&](int) { return n - 1; });
    CHECK(of_all[0].starts_with("search limit: contact: " + std::to_string(n) + " pairs of faces can touch"));
    CHECK(of_all == std::vector<std::string>(3, of_all[0]));
    CHECK(errors_with([&](int) { return n; })[0] == ", but there is a list");
}
