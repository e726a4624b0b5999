#include "abut/geometry/face_tree.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
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

TEST_CASE("2D: two combs of segments are as far apart as their nearest teeth", "[face_tree][2d]") {
    std::vector<std::vector<Vector<2>>> lower, upper;
    for (int i = 0; i < 50; ++i) {
        lower.push_back({{0.1 * i, 0.0}, {0.1 * i, 1.0}});
        upper.push_back({{0.1 * i + 0.03, i == 37 ? 0.9 : 1.5}, {0.1 * i + 0.03, 3.0}});
    }
    CHECK(geometry::distance_below(FaceTree<2>(lower), FaceTree<2>(upper), 10.0) == Approx(0.03).epsilon(1e-6));
}
