#pragma once
// Surfaces as files, and what the tests of surfaces ask of them.
#include <catch2/catch.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "abut/geometry/health/surface_health.hpp"
#include "abut/mesh/io/read_surface.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh::test {

inline void save(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

template <class Value>
void append_bytes(std::string& bytes, Value value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);  // on the machines at hand the smallest first
}

inline std::string binary_stl(const SurfaceMesh& mesh, const std::string& head = "made by a test") {
    std::string bytes = head;
    bytes.resize(80, ' ');
    append_bytes(bytes, static_cast<std::uint32_t>(mesh.faces.size()));
    for (std::int32_t face = 0; face < mesh.faces.size(); ++face) {
        for (int i = 0; i < 3; ++i) append_bytes(bytes, 0.0f);
        for (const std::int32_t v : mesh.faces[face])
            for (const double x : mesh.vertices[static_cast<std::size_t>(v)]) append_bytes(bytes, static_cast<float>(x));
        append_bytes(bytes, std::uint16_t{0});
    }
    return bytes;
}

inline std::string complaint_about(const std::filesystem::path& path, const SurfaceOptions& options = {}) {
    try {
        (void)read_surface(path, options);
    } catch (const MeshError& error) {
        return error.what();
    }
    return "nothing";
}

inline geometry::SurfaceReport health_of(const SurfaceMesh& mesh) { return geometry::check_surface(mesh.soup()); }

/// Watertight, with that volume, and one body called like the file.
inline void check_is_solid(const SurfaceMesh& mesh, double volume, const std::string& body) {
    const auto health = health_of(mesh);
    CHECK(health.sound());
    REQUIRE(health.components.size() == 1);
    CHECK(health.components[0].volume == Approx(volume).epsilon(1e-6));
    CHECK(mesh.body_names == std::vector<std::string>{body});
    CHECK(mesh.face_body == std::vector<std::int32_t>(static_cast<std::size_t>(mesh.faces.size()), 0));
}

}  // namespace abut::mesh::test
