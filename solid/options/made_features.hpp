#pragma once
#include "abut/solid/combinations/combinations.hpp"
#include "abut/solid/options/options.hpp"

namespace abut::dynamics {
class Ranks;
}
namespace abut::mesh {
template <int Dim>
struct Mesh;
}

namespace abut::solid {

/// Features of the whole of these options, and of one of its bodies without those of groups of its faces.
template <int Dim>
[[nodiscard]] FeatureSet features_of(const SolidOptions<Dim>& options);
template <int Dim>
[[nodiscard]] FeatureSet features_of(const SolidOptions<Dim>& options, std::size_t body);
[[nodiscard]] FeatureSet features_of(const dynamics::Ranks& ranks);

/// Throws BadInput for the first two features that do not go together, with the body or obstacle that has them: of the
/// options, of `more`, which whoever asks adds, and of supports and tractions. Those of bodies that are
/// `unknown` yet are left out.
template <int Dim>
void require_together(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, FeatureSet more = {},
                      FeatureSet unknown = {});

}  // namespace abut::solid
