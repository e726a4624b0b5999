#pragma once
#include <filesystem>
#include <span>

#include "abut/geometry/health/face_soup.hpp"
#include "abut/mesh/io/write_vtu.hpp"

namespace abut::mesh {

/// Fields that a surface shows besides its faces.
struct SurfaceFields {
    std::span<const Field<3>> of_faces{};     ///< each with a value for every face
    std::span<const Field<3>> of_vertices{};  ///< each with a value for every vertex
    std::span<const NamedNumber> numbers{};
};

/// Faces as polygons in one .vtp file for ParaView, binary and compressed, in the order given; vertices that no face names
/// are kept. The file is written under another name and then moved. Throws BadInput for bad offsets, naming a
/// face with a vertex out of range, or the field whose size is wrong; MeshError if the file cannot be written.
void write_vtp(const geometry::FaceSoup& faces, const std::filesystem::path& path, const SurfaceFields& fields = {});

}  // namespace abut::mesh
