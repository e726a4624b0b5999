#pragma once
#include <map>
#include <string>

#include "abut/mesh/mesh.hpp"

namespace abut::input {

/// Meshes that bodies of a scene have in place of files: by the text that is their key `mesh`.
struct GivenMeshes {
    std::map<std::string, mesh::Mesh<2>> plane;
    std::map<std::string, mesh::Mesh<3>> space;

    template <int Dim>
    [[nodiscard]] const std::map<std::string, mesh::Mesh<Dim>>& of() const {
        if constexpr (Dim == 2)
            return plane;
        else
            return space;
    }
};

}  // namespace abut::input
