// The bound on the motion of corners that tells how long a candidate list is valid: never below the motion, and close to it.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <random>

#include "abut/base/rotation.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/contact/corner_surface.hpp"
#include "abut/solid/contact/near_faces.hpp"
#include "abut/solid/part/rank_part.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using mesh::CellShape;
using solid::Kinematics;

namespace {

template <int Dim>
std::array<int, Dim> counts(int n) {
    std::array<int, Dim> cells;
    cells.fill(n);
    return cells;
}

/// A floating body of simplices, one of cells of other shapes, and one that is held on two sides, in one of them along one
/// axis alone.
template <int Dim>
mesh::Mesh<Dim> some_bodies() {
    const auto box = [](double at, CellShape shape, const std::string& name) {
        const Vector<Dim> lower = Vector<Dim>::Constant(at), upper = lower + Vector<Dim>::Ones();
        return mesh::structured_box<Dim>(lower, upper, counts<Dim>(2), shape, name);
    };
    return mesh::combine<Dim>(std::vector<mesh::Mesh<Dim>>{
        box(0.0, Dim == 2 ? CellShape::triangle : CellShape::tetrahedron, "simplices"),
        box(2.0, Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron, "others"),
        box(4.0, Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron, "held"), round_body<Dim>(0.6)});
}

template <int Dim>
solid::SolidOptions<Dim> some_options() {
    solid::SolidOptions<Dim> options = bodies<Dim>(4);
    options.kinematics = {Kinematics::floating, Kinematics::floating, Kinematics::small, Kinematics::floating};
    options.boundary.dirichlet.push_back({.group = "held.xmin"});
    solid::DirichletCondition<Dim> along{.group = "held.ymax", .constraint = solid::Constraint::components};
    along.components[1] = true;
    options.boundary.dirichlet.push_back(along);
    return options;
}

/// The corners of these bodies, placed at will.
template <int Dim>
struct Corners {
    using Points = std::vector<Vector<Dim>>;

    mesh::Mesh<Dim> mesh = some_bodies<Dim>();
    solid::SolidOptions<Dim> options = some_options<Dim>();
    solid::Bodies<Dim> bodies{mesh, options, {}};
    solid::RankPart<Dim> part{dynamics::one_rank(), bodies.points()};
    std::optional<solid::Ccg<Dim>> ccg;
    std::optional<solid::BodyFrames<Dim>> frames;
    solid::Obstacles<Dim> obstacles{std::span<const contact::RigidObstacle<Dim>>{}};
    std::optional<solid::CornerSurface<Dim>> surface;
    std::optional<typename solid::CornerSurface<Dim>::Listed> all;
    solid::BoundaryLoad<Dim> load;

    Corners() {
        bodies.place_cell_points(part);
        part.take_rest(bodies.rest());
        const solid::SolidOptions<Dim>& chosen = bodies.deformable_options();
        ccg.emplace(bodies.deformable(), chosen.materials, chosen.boundary, chosen.kinematics, solid::CellForm::automatic,
                    chosen.precision, chosen.device, chosen.finite, solid::FreeFaces::are_pushed);
        frames.emplace(bodies.frames(part));
        surface.emplace(bodies, *ccg, *frames, obstacles, part);
        all = surface->list_all();
        load = ccg->load_at(0.0, 0.0);
    }

    /// The body turns as a whole, translates and is disturbed; one that is held is disturbed alone.
    [[nodiscard]] std::vector<Vector<Dim>> moved(double angle, double shift, double noise, unsigned seed) const {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> any(-1.0, 1.0);
        const auto any_vector = [&] {
            Vector<Dim> vector;
            for (double& value : vector) value = any(random);
            return vector;
        };
        const Matrix<Dim> turn = turned(angle);
        std::vector<Vector<Dim>> q;
        for (std::size_t c = 0; c < bodies.rest().size(); ++c) {
            const bool turns = options.kinematics[static_cast<std::size_t>(bodies.body_of_points()[c])] != Kinematics::small;
            const Vector<Dim>& rest = bodies.rest()[c];
            q.push_back(noise * any_vector());
            if (turns) q.back() += turn * rest - rest + Vector<Dim>::Constant(shift);
        }
        return q;
    }

    [[nodiscard]] static Matrix<Dim> turned(double angle) {
        if constexpr (Dim == 2)
            return rotation_in_plane(angle);
        else
            return rotation_about(Vector<3>(1.0, 2.0, -1.0).normalized(), angle);
    }

    [[nodiscard]] std::vector<std::int32_t> nodes_of(std::int32_t face) const {
        std::vector<std::int32_t> nodes;
        for (const std::int32_t n : all->nodes)
            if (surface->face_of(n) == static_cast<std::size_t>(face)) nodes.push_back(n);
        return nodes;
    }

    [[nodiscard]] solid::CornerMotion<Dim> motion_from(const typename solid::CornerSurface<Dim>::Listed& listed,
                                                       std::span<const Vector<Dim>> q,
                                                       std::span<const solid::BodyFrame<Dim>> in, const Points& x) const {
        auto motion = surface->motion();
        surface->begin(motion, listed, q, in, x);
        return motion;
    }

    /// Displacements of all cells in the frames where the bodies stand.
    [[nodiscard]] Points in_frames(std::span<const Vector<Dim>> q) const {
        std::vector<std::int32_t> cells(q.size());
        std::iota(cells.begin(), cells.end(), 0);
        Points u(q.size());
        frames->displacement(cells, q, frames->end(), u);
        return u;
    }

    [[nodiscard]] Points place(std::span<const Vector<Dim>> q) {
        Points x = surface->rest();
        frames->stand_at(q);
        surface->place(*all, q, frames->end(), load, 0.0, x);
        return x;
    }
};

template <int Dim>
double farthest(const std::vector<Vector<Dim>>& from, const std::vector<Vector<Dim>>& to) {
    double farthest = 0.0;
    for (std::size_t n = 0; n < from.size(); ++n) raise(farthest, (to[n] - from[n]).norm());
    return farthest;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("no corner moves farther than the bound of its face tells", "[solid][candidates]", ((int Dim), Dim),
                       2, 3) {
    Corners<Dim> corners;
    const double angle = GENERATE(0.0, 0.02, 0.7, 3.0), shift = GENERATE(0.0, 0.3), noise = GENERATE(0.0, 1e-6, 0.01);
    for (unsigned seed = 0; seed < 5; ++seed) {
        const auto q_0 = corners.moved(1.0 + seed, 0.5, 0.01, seed);
        const auto x_0 = corners.place(q_0);
        const auto frames_0 = std::vector(corners.frames->end().begin(), corners.frames->end().end());
        const auto q_1 = corners.moved(1.0 + seed + angle, 0.5 + shift, noise, 100 + seed);
        const auto x_1 = corners.place(q_1);
        for (const std::int32_t face : corners.all->faces) {
            const auto of_face = corners.surface->list(corners.nodes_of(face));
            auto motion = corners.motion_from(of_face, q_0, frames_0, x_0);
            const auto bound = motion.until(q_1, corners.frames->end());
            double in_space = 0.0, in_frame = 0.0;
            const std::size_t body = corners.surface->body_of(static_cast<std::size_t>(face));
            const auto seen = [body](std::span<const solid::BodyFrame<Dim>> frames, const Vector<Dim>& x) {
                return Vector<Dim>(frames[body].turn.transpose() * (x - frames[body].centre));
            };
            for (const std::int32_t n : of_face.nodes) {
                raise(in_space, (x_1[n] - x_0[n]).norm());
                raise(in_frame, (seen(corners.frames->end(), x_1[n]) - seen(frames_0, x_0[n])).norm());
            }
            CHECK(bound.in_space >= in_space * (1.0 - 1e-10) - 1e-14);
            CHECK(bound.in_frame >= in_frame * (1.0 - 1e-10) - 1e-14);
        }
    }
}

TEMPLATE_TEST_CASE_SIG("bounds that grow from step to step are never below the motion", "[solid][candidates]",
                       ((int Dim), Dim), 2, 3) {
    constexpr double any = std::numeric_limits<double>::infinity();
    const double spin = GENERATE(0.0, 0.01, 0.3), noise = GENERATE(0.0, 1e-3, 0.02);
    const int steps_between_looks = GENERATE(1, 4, 100);
    Corners<Dim> corners;
    auto q = corners.moved(0.3, 0.0, noise, 0);
    const auto x_0 = corners.place(q);
    auto motion = corners.motion_from(*corners.all, q, corners.frames->end(), x_0);
    for (unsigned step = 1; step <= 20; ++step) {
        const auto u_before = corners.in_frames(q);
        q = corners.moved(0.3 + step * spin, 0.01 * step, noise, step);
        const auto x = corners.place(q);
        motion.advance(corners.frames->end(), farthest<Dim>(u_before, corners.in_frames(q)));
        const double moved = farthest<Dim>(x_0, x);
        if (moved == 0.0) continue;
        CHECK_FALSE(motion.is_within({(1.0 - 1e-10) * moved, any}));
        if (step % static_cast<unsigned>(steps_between_looks) != 0) continue;
        const auto beyond = motion.beyond({0.5 * moved, any});
        motion.look(beyond, q, corners.frames->end());
        CHECK_FALSE(motion.is_within({(1.0 - 1e-10) * moved, any}));
        for (const std::int32_t i : motion.beyond({(1.0 - 1e-10) * moved, any}))
            motion.set_in_space(i, corners.surface->motion(corners.all->own[i], x_0, x));
        CHECK(motion.is_within({(1.0 + 1e-10) * moved, any}));
    }
}

TEMPLATE_TEST_CASE_SIG("the bound on the motion of corners is the motion where bodies translate", "[solid][candidates]",
                       ((int Dim), Dim), 2, 3) {
    Corners<Dim> corners;
    const auto q_0 = corners.moved(0.4, 0.1, 0.0, 1), q_1 = corners.moved(0.4, 0.3, 0.0, 1);
    const auto x_0 = corners.place(q_0);
    auto motion = corners.motion_from(*corners.all, q_0, corners.frames->end(), x_0);
    const auto x_1 = corners.place(q_1);
    const auto bound = motion.until(q_1, corners.frames->end());
    CHECK(bound.in_space == Approx(farthest<Dim>(x_0, x_1)).epsilon(1e-9));
    CHECK(bound.in_frame < 1e-9);
}

TEMPLATE_TEST_CASE_SIG("the bound of a face is that of its motion beyond its slack", "[solid][candidates]", ((int Dim), Dim),
                       2, 3) {
    constexpr double any = std::numeric_limits<double>::infinity();
    Corners<Dim> corners;
    const auto q_0 = corners.moved(0.4, 0.1, 0.0, 1), q_1 = corners.moved(0.5, 0.3, 0.01, 2);
    const auto x_0 = corners.place(q_0);
    auto motion = corners.motion_from(*corners.all, q_0, corners.frames->end(), x_0);
    auto plain = motion;
    std::vector<double> slack;
    for (std::size_t i = 0; i < corners.all->own.size(); ++i) slack.push_back(0.01 * static_cast<double>(i % 7));
    motion.set_slack(slack);
    const auto x_1 = corners.place(q_1);
    const auto u_0 = corners.in_frames(q_0), u_1 = corners.in_frames(q_1);
    std::vector<std::int32_t> all(slack.size());
    std::iota(all.begin(), all.end(), 0);
    for (auto* const of : {&motion, &plain}) {
        of->advance(corners.frames->end(), farthest<Dim>(u_0, u_1));
        of->look(all, q_1, corners.frames->end());
    }
    for (const bool is_known : {false, true}) {
        if (is_known)
            for (const std::int32_t i : all)
                for (auto* const of : {&motion, &plain})
                    of->set_in_space(i, corners.surface->motion(corners.all->own[i], x_0, x_1));
        for (const double allowed : {0.0, 0.05, 0.2, 0.3, 0.4}) {
            std::vector<std::int32_t> beyond;
            for (const std::int32_t i : all) {
                const auto of_plain = plain.beyond({allowed + slack[i], any});
                if (std::ranges::binary_search(of_plain, i)) beyond.push_back(i);
            }
            CHECK(motion.beyond({allowed, any}) == beyond);
            CHECK(motion.is_within({allowed, any}) == beyond.empty());
        }
    }
}

TEMPLATE_TEST_CASE_SIG("boxes of other bodies are as far away as the nearest of them", "[solid][candidates]",
                       ((int Dim), Dim), 2, 3) {
    const double most = GENERATE(0.3, 1.0, 100.0);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    std::vector<geometry::Box<Dim>> boxes;
    std::vector<std::int32_t> body;
    for (std::int32_t i = 0; i < 400; ++i) {  // body 2 has none
        body.push_back(i % 5 == 0 ? 0 : i % 5 < 3 ? 1 : 3);
        Vector<Dim> lower, size;
        for (double& value : lower) value = 2.0 * body.back() + 3.0 * any(random);
        for (double& value : size) value = 0.1 * any(random);
        boxes.push_back({lower, lower + size});
    }
    std::vector<double> expected(boxes.size(), most);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = 0; j < boxes.size(); ++j) {
            if (body[i] == body[j]) continue;
            double apart = 0.0;
            for (int k = 0; k < Dim; ++k)
                apart = std::max({apart, boxes[i].lower[k] - boxes[j].upper[k], boxes[j].lower[k] - boxes[i].upper[k]});
            expected[i] = std::min(expected[i], apart);
        }
    CHECK(solid::distances_to_others<Dim>(boxes, body, most) == expected);
    const std::vector<double> to_groups = solid::distances_to_groups<Dim>(boxes, body, most);
    REQUIRE(to_groups.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) CHECK(to_groups[i] <= expected[i]);
    CHECK(std::ranges::max(to_groups) > 0.5 * std::ranges::max(expected));  // they tell something
}

TEMPLATE_TEST_CASE_SIG("a position that is not finite is farther than any bound allows", "[solid][candidates]",
                       ((int Dim), Dim), 2, 3) {
    Corners<Dim> corners;
    auto q = corners.moved(0.4, 0.1, 0.0, 1);
    const auto x = corners.place(q);
    auto motion = corners.motion_from(*corners.all, q, corners.frames->end(), x);
    q.front()[0] = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(motion.until(q, corners.frames->end()).in_space <= 1e300);
}
