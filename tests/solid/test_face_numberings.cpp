// A face has four numbers: in its mesh, among the boundary faces, in the surface of contact, in the list of candidates.
#include <catch2/catch.hpp>

#include <concepts>
#include <cstdint>
#include <type_traits>

#include "abut/contact/surface/surface.hpp"
#include "abut/solid/boundary/boundary_face.hpp"

using namespace abut;

namespace {

using MeshFace = std::int32_t;  // the plain index of the arrays of a mesh

template <class A, class B>
constexpr bool mix = std::is_convertible_v<A, B> || std::is_convertible_v<B, A> || std::is_assignable_v<A&, B> ||
                     std::is_assignable_v<B&, A> || std::equality_comparable_with<A, B>;

template <class Id, class Index>
constexpr bool can_index = requires(IdVector<Id, double> values, Index i) {
    values[i];
};

}  // namespace

TEST_CASE("no number of a face can be taken for one of another numbering", "[solid]") {
    using contact::Face, contact::Facet, contact::ListedFace, solid::BoundaryFace;
    STATIC_REQUIRE_FALSE(mix<MeshFace, BoundaryFace>);
    STATIC_REQUIRE_FALSE(mix<MeshFace, Face>);
    STATIC_REQUIRE_FALSE(mix<MeshFace, ListedFace>);
    STATIC_REQUIRE_FALSE(mix<BoundaryFace, Face>);
    STATIC_REQUIRE_FALSE(mix<BoundaryFace, ListedFace>);
    STATIC_REQUIRE_FALSE(mix<Face, ListedFace>);
    STATIC_REQUIRE_FALSE(mix<Face, Facet>);
    STATIC_REQUIRE(can_index<BoundaryFace, BoundaryFace>);
    STATIC_REQUIRE_FALSE(can_index<BoundaryFace, Face>);
    STATIC_REQUIRE_FALSE(can_index<ListedFace, Face>);
    STATIC_REQUIRE_FALSE(can_index<ListedFace, MeshFace>);
}
