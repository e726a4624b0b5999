#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <cstdint>
#include <utility>

#include "abut/mesh/mesh.hpp"

namespace abut::solid {

/// The cells of a body are [first, second).
template <int Dim>
[[nodiscard]] std::pair<std::int32_t, std::int32_t> cells_of_body(const mesh::Mesh<Dim>& mesh, std::int32_t body) {
    const auto [begin, end] = std::ranges::equal_range(mesh.cell_body, body);
    return {static_cast<std::int32_t>(begin - mesh.cell_body.begin()),
            static_cast<std::int32_t>(end - mesh.cell_body.begin())};
}

}  // namespace abut::solid
