#include "abut/geometry/face_tree.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "abut/geometry/convex_distance.hpp"

using namespace abut;
using geometry::FaceTree;

namespace {

using SoupOfFaces = std::vector<std::vector<Vector<3>>>;

SoupOfFaces random_triangles(std::mt19937& random, int n, const Vector<3>& around) {
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto vector = [&] { return Vector<3>(number(random), number(random), number(random)); };
    SoupOfFaces faces;
    for (int i = 0; i < n; ++i) {
        const Vector<3> place = around + vector();
        faces.push_back({place, place + 0.1 * vector(), place + 0.1 * vector()});
    }
    return faces;
}

}  // namespace

TEST_CASE("the distance of two surfaces is the least over all pairs of their faces", "[face_tree]") {
    std::mt19937 random(3);
    for (int n : {1, 4, 5, 60}) {
        const SoupOfFaces faces_1 = random_triangles(random, n, {0, 0, 0}),
                          faces_2 = random_triangles(random, 2 * n, {2.5, 0.3, 0});
        double least = 1e300;
        for (const auto& face_1 : faces_1)
            for (const auto& face_2 : faces_2) least = std::min(least, geometry::convex_distance<3>(face_1, face_2));
        const FaceTree<3> tree_1(faces_1), tree_2(faces_2);
        CHECK(geometry::distance_below(tree_1, tree_2, 1e300) == least);
        CHECK(geometry::distance_below(tree_1, tree_2, 0.5 * least) == 0.5 * least);
    }
}

TEST_CASE("the nearest faces of two surfaces are those of all pairs, by the numbers they were given with", "[face_tree]") {
    std::mt19937 random(5);
    for (int n : {1, 4, 5, 60}) {
        const SoupOfFaces faces_1 = random_triangles(random, n, {0, 0, 0}),
                          faces_2 = random_triangles(random, 2 * n, {2.5, 0.3, 0});
        double least = 1e300;
        for (const auto& face_1 : faces_1)
            for (const auto& face_2 : faces_2) least = std::min(least, geometry::nearest_points(face_1, face_2).distance);
        const FaceTree<3> tree_1(faces_1), tree_2(faces_2);
        const geometry::NearestFaces nearest = geometry::nearest_faces(tree_1, tree_2);
        CHECK(nearest.points.distance == least);
        CHECK(geometry::nearest_points(faces_1[static_cast<std::size_t>(nearest.face_1)],
                                       faces_2[static_cast<std::size_t>(nearest.face_2)])
                  .distance == least);
        CHECK(geometry::nearest_faces(tree_1, tree_2, 0.5 * least).face_1 == -1);
    }
}

TEST_CASE("nearest points of two triangles are as far apart as their convex hulls, and lie on them", "[face_tree]") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    int n_crossing = 0;
    for (int i = 0; i < 2000; ++i) {
        const double away = i % 4 == 0 ? 0.0 : i % 4;
        const auto corner = [&](double x) { return Vector<3>(x + number(random), number(random), number(random)); };
        const std::vector<Vector<3>> face_1 = {corner(0), corner(0), corner(0)},
                                     face_2 = {corner(away), corner(away), corner(away)};
        const auto [point_1, point_2, distance] = geometry::nearest_points(face_1, face_2);
        CHECK(distance == Approx(geometry::convex_distance<3>(face_1, face_2)).margin(5e-6));
        CHECK((point_2 - point_1).norm() == Approx(distance).margin(1e-14));
        for (const auto& [point, face] : {std::pair{point_1, &face_1}, {point_2, &face_2}})
            CHECK(geometry::convex_distance<3>(std::vector<Vector<3>>{point}, *face) < 1e-12);
        n_crossing += distance == 0.0;
    }
    CHECK(n_crossing > 50);
}

TEST_CASE("edges that cross at a distance, a corner over a face and faces that touch are as far apart as formulas say",
          "[face_tree]") {
    const double far = GENERATE(0.0, 4096.0);
    const auto moved = [far](std::vector<Vector<3>> face) {
        for (Vector<3>& x : face) x += Vector<3>(far, -far, 2.0 * far);
        return face;
    };
    const auto flat = moved({{-1, 0, 0}, {1, 0, 0}, {0, 2, -1}}), across = moved({{0, -1, 0.25}, {0, 1, 0.25}, {2, 0, 1}});
    CHECK(geometry::nearest_points(flat, across).distance == 0.25);
    const auto square = moved({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
    const auto above = moved({{1.5, 0.25, 0.125}, {3, 0, 1}, {3, 3, 1}});
    const auto [point_1, point_2, distance] = geometry::nearest_points(square, above);
    CHECK(distance == 0.125);
    CHECK(point_1 == moved({{1.5, 0.25, 0.0}})[0]);
    CHECK(point_2 == above[0]);
    CHECK(geometry::nearest_points(square, moved({{2, 2, 0}, {3, 3, 0}, {3, 2, 1}})).distance == 0.0);
    CHECK(geometry::nearest_points(square, moved({{1, 1, -1}, {1, 1, 1}, {1, 1.5, 1}})).distance == 0.0);
    CHECK(geometry::nearest_points(square, moved({{0, 0, 0.5}, {2, 0, 0.5}, {2, 2, 0.5}})).distance == 0.5);
}

TEST_CASE("2D: two combs of segments are as far apart as their nearest teeth", "[face_tree][2d]") {
    std::vector<std::vector<Vector<2>>> lower, upper;
    for (int i = 0; i < 50; ++i) {
        lower.push_back({{0.1 * i, 0.0}, {0.1 * i, 1.0}});
        upper.push_back({{0.1 * i + 0.03, i == 37 ? 0.9 : 1.5}, {0.1 * i + 0.03, 3.0}});
    }
    CHECK(geometry::distance_below(FaceTree<2>(lower), FaceTree<2>(upper), 10.0) == Approx(0.03).epsilon(1e-6));
}
