#include <Eigen/Dense>
#include <array>
#include <catch2/catch.hpp>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "abut/base/eigen.hpp"
#include "abut/base/error.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/body/body_frames.hpp"
#include "abut/solid/part/rank_part.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::test;
using solid::BodyFrame;
using solid::BodyFrames;
using solid::BodyPush;

namespace {

/// The whole of a solid of one body with n cells, for points that have their own places and masses.
template <int Dim>
struct WholePart {
    explicit WholePart(int n)
        : mesh(row(n)), bodies(mesh, {.materials = {solid::Material{}}}, {}), part(dynamics::one_rank(), bodies.points()) {}

    static mesh::Mesh<Dim> row(int n) {
        std::array<int, Dim> cells;
        cells.fill(1);
        cells[0] = n;
        return mesh::structured_box<Dim>(Vector<Dim>::Zero(), Vector<Dim>::Ones(), cells,
                                         Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron);
    }

    mesh::Mesh<Dim> mesh;
    solid::Bodies<Dim> bodies;
    solid::RankPart<Dim> part;
};

/// A body of some points with any energy u.K u/2 in its frame, and corners w + R u in it that are pushed by constant forces:
/// the potential of these is sum p.x. Neither K nor R knows of rigid motions.
template <int Dim>
struct AnyBody {
    static constexpr int n = 7, n_corners = 3;
    using Columns = Eigen::Matrix<double, Dim, Eigen::Dynamic>;

    explicit AnyBody(unsigned seed) : random(seed) {
        for (int i = 0; i < n; ++i) {
            rest.push_back(any_vector(1.0));
            masses.push_back(1.0 + any(0.5));
        }
        const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(Dim * n, Dim * n, [&] { return any(1.0); });
        stiffness = root * root.transpose();
        for (int v = 0; v < n_corners; ++v) {
            corner.push_back(any_vector(1.0));
            push.push_back(any_vector(1.0));
            reconstruction.push_back(Eigen::MatrixXd::NullaryExpr(Dim, Dim * n, [&] { return any(1.0); }));
        }
        frames.emplace(rest, masses, std::vector<std::int32_t>{0, n}, std::vector<bool>{true},
                       std::vector<std::string>{"any"}, whole.part);
    }

    double any(double size) { return std::uniform_real_distribution<double>(-size, size)(random); }
    Vector<Dim> any_vector(double size) {
        Vector<Dim> vector;
        for (double& value : vector) value = any(size);
        return vector;
    }

    /// Displacements of a body that has been turned, strained and shifted.
    std::vector<Vector<Dim>> any_state(double angle, double strain) {
        const Matrix<Dim> turn = turn_by(angle);
        const Vector<Dim> shift = any_vector(3.0);
        std::vector<Vector<Dim>> q;
        for (int i = 0; i < n; ++i) q.push_back(turn * rest[i] + any_vector(strain) + shift - rest[i]);
        return q;
    }
    Matrix<Dim> turn_by(double angle) {
        AxialVector<Dim> axis;
        for (double& value : axis) value = any(1.0);
        const Matrix<Dim> h = solid::hat<Dim>(axis.normalized());
        return Matrix<Dim>::Identity() + std::sin(angle) * h + (1.0 - std::cos(angle)) * h * h;
    }

    Eigen::VectorXd in_frame(const std::vector<Vector<Dim>>& q) {
        std::vector<Vector<Dim>> u(n);
        std::vector<std::int32_t> all(n);
        std::iota(all.begin(), all.end(), 0);
        frames->displacement(all, q, placed(q), u);
        return Eigen::Map<const Eigen::VectorXd>(u[0].data(), Dim * n);
    }
    std::vector<BodyFrame<Dim>> placed(const std::vector<Vector<Dim>>& q) {
        frames->stand_at(q);
        return {frames->end().begin(), frames->end().end()};
    }
    Vector<Dim> corner_at(int v, const std::vector<Vector<Dim>>& q) {
        return placed(q)[0](corner[v] + Vector<Dim>(reconstruction[v] * in_frame(q)));
    }
    double energy(const std::vector<Vector<Dim>>& q) {
        const Eigen::VectorXd u = in_frame(q);
        double energy = 0.5 * u.dot(stiffness * u);
        for (int v = 0; v < n_corners; ++v) energy += push[v].dot(corner_at(v, q));
        return energy;
    }
    /// Of the energy, without what cancels.
    double size_of_terms(const std::vector<Vector<Dim>>& q) {
        const Eigen::VectorXd u = in_frame(q);
        double size = 0.5 * u.dot(stiffness * u);
        for (int v = 0; v < n_corners; ++v) size += push[v].norm() * corner_at(v, q).norm();
        return size;
    }
    std::vector<Vector<Dim>> gradient(const std::vector<Vector<Dim>>& q_0, const std::vector<Vector<Dim>>& q_1) {
        const auto frames_0 = placed(q_0), frames_1 = placed(q_1);
        const solid::FrameStep<Dim> step(frames_0[0], frames_1[0]);
        Eigen::VectorXd f = stiffness * (0.5 * (in_frame(q_0) + in_frame(q_1)));
        std::vector<BodyPush<Dim>> pushes(1);
        for (int v = 0; v < n_corners; ++v) {
            f += reconstruction[v].transpose() * as_eigen(step.force_turn().transpose() * push[v]);
            const Vector<Dim> arm = 0.5 * (corner_at(v, q_0) - frames_0[0].centre + corner_at(v, q_1) - frames_1[0].centre);
            pushes[0].add(push[v], arm);
        }
        std::vector<Vector<Dim>> result(n);
        for (int i = 0; i < n; ++i) result[i] = f.segment<Dim>(Dim * i);
        frames->follow(q_0, q_1);
        frames->to_force(q_0, q_1, pushes, {}, result);
        for (Vector<Dim>& negative : result) negative = -negative;
        return result;
    }

    std::mt19937 random;
    std::vector<Vector<Dim>> rest;
    std::vector<double> masses;
    Eigen::MatrixXd stiffness;
    std::vector<Vector<Dim>> corner, push;
    std::vector<Eigen::MatrixXd> reconstruction;
    WholePart<Dim> whole{n};
    std::optional<BodyFrames<Dim>> frames;
};

struct Defects {
    double energy = 0.0, momentum = 0.0, moment = 0.0;
};

/// Over the largest terms of each sum, for many bodies that turn by up to `angle` in a step.
template <int Dim>
Defects worst_of_steps(double angle, double strain) {
    Defects worst;
    for (unsigned seed = 0; seed < 200; ++seed) {
        AnyBody<Dim> body(seed);
        const auto q_0 = body.any_state(body.any(3.0), strain);
        auto q_1 = q_0;
        const Matrix<Dim> turn = body.turn_by(angle);
        const Vector<Dim> shift = body.any_vector(1.0);
        for (int i = 0; i < body.n; ++i)
            q_1[i] = turn * (body.rest[i] + q_0[i]) + shift + body.any_vector(strain) - body.rest[i];
        const auto gradient = body.gradient(q_0, q_1);

        double work = body.energy(q_0) - body.energy(q_1), size = body.size_of_terms(q_0);
        Vector<Dim> sum = Vector<Dim>::Zero();
        AxialVector<Dim> moment_sum = AxialVector<Dim>::Zero();
        double force = 0.0;
        for (int i = 0; i < body.n; ++i) {
            work += gradient[i].dot(q_1[i] - q_0[i]);
            size += std::abs(gradient[i].dot(q_1[i] - q_0[i]));
            sum += gradient[i];
            moment_sum += moment<Dim>(body.rest[i] + 0.5 * (q_0[i] + q_1[i]), gradient[i]);
            force += gradient[i].norm();
        }
        for (int v = 0; v < body.n_corners; ++v) {
            sum -= body.push[v];
            moment_sum -= moment<Dim>(0.5 * (body.corner_at(v, q_0) + body.corner_at(v, q_1)), body.push[v]);
        }
        raise(worst.energy, std::abs(work) / size);
        raise(worst.momentum, sum.norm() / force);
        raise(worst.moment, moment_sum.norm() / force);
    }
    return worst;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a step in a floating frame does exactly the work that the energy changes by", "[solid][frame]",
                       ((int Dim), Dim), 2, 3) {
    const double angle = GENERATE(0.0, 1e-8, 0.03, 0.3, 1.0, 2.0);
    const Defects worst = worst_of_steps<Dim>(angle, 0.1);
    CAPTURE(angle);
    CHECK(worst.energy <= 1e-13);
    CHECK(worst.momentum <= 1e-14);
    CHECK(worst.moment <= 1e-13);
}

TEMPLATE_TEST_CASE_SIG("with one state at both ends a step in a floating frame is the gradient", "[solid][frame]",
                       ((int Dim), Dim), 2, 3) {
    double worst = 0.0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        AnyBody<Dim> body(seed);
        const auto q = body.any_state(body.any(3.0), 0.1);
        const auto gradient = body.gradient(q, q);
        for (int i = 0; i < body.n; ++i)
            for (int k = 0; k < Dim; ++k) {
                const double step = 1e-5;
                auto up = q, down = q;
                up[i][k] += step;
                down[i][k] -= step;
                raise(worst, std::abs((body.energy(up) - body.energy(down)) / (2.0 * step) - gradient[i][k]) /
                                 (1.0 + std::abs(gradient[i][k])));
            }
    }
    CHECK(worst <= 1e-7);
}

TEMPLATE_TEST_CASE_SIG("a rigid motion shows no displacement in the frame of a body", "[solid][frame]", ((int Dim), Dim), 2,
                       3) {
    double worst = 0.0;
    for (unsigned seed = 0; seed < 50; ++seed) {
        AnyBody<Dim> body(seed);
        raise(worst, body.in_frame(body.any_state(body.any(3.1), 0.0)).cwiseAbs().maxCoeff());
    }
    CHECK(worst <= 2e-14);
}

TEST_CASE("a body whose cells lie on a line cannot turn in space", "[solid][frame]") {
    const std::vector<Vector<3>> rest{{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {2.0, 2.0, 0.0}};
    const std::vector<double> masses(3, 1.0);
    const std::vector<std::string> names{"rod"};
    const WholePart<3> whole(3);
    CHECK_THROWS_AS(BodyFrames<3>(rest, masses, {0, 3}, {true}, names, whole.part), BadInput);
    CHECK_NOTHROW(BodyFrames<3>(rest, masses, {0, 3}, {false}, names, whole.part));
    const std::vector<Vector<2>> in_plane{{0.0, 0.0}, {1.0, 1.0}};
    CHECK_NOTHROW(BodyFrames<2>(in_plane, std::vector<double>(2, 1.0), {0, 2}, {true}, names, WholePart<2>(2).part));
}
