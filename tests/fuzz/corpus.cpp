#include "fuzz/corpus.hpp"

#include <gmsh.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "abut/mesh/io/write_vtp.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/mesh/shapes/surface_shapes.hpp"
#include "fuzz/read_bytes.hpp"

namespace abut::fuzz {
namespace {

/// In this machine's order of bytes, on those at hand the smallest first.
template <class Value>
void append_bytes(std::string& bytes, Value value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> obj_files() {
    return {
        "# a cube\no cube\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
        "vt 0 0\nvn 0 0 1\ng all\nusemtl none\ns off\nf 1/1/1 4/1/1 3/1/1 2/1/1\nf 5 6 7 8\nf 1//1 2//1 6//1 5//1\n"
        "f 2/1 3/1 7/1 6/1\nf -6 -5 -1 -2\nf 4 1 5 8\n",
        "\xEF\xBB\xBFv 0.5 -1e-3 2.25 0.1 0.2 0.3\r\nv 1 0 \\\r\n0\r\nv 1 1 0 # a comment\r\nl 1 2\r\np 3\r\nf 1 2 "
        "\\\r\n3\r\n"};
}

std::vector<std::string> off_files() {
    return {
        "OFF\n# a cube\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n"
        "4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n",
        "COFF\n3 1\n0 0 0 1 0 0 1\n1 0 0 255 0 0\n0 1 0\n3 0 1 2 0.5 0.5 0.5\n",
        "4OFF\n3 1 0\n0 0 0 1\n2 0 0 2\n0 1 0 1\n3 0 1 2\n"};
}

std::string binary_ply(bool little) {
    std::string bytes = std::string("ply\nformat binary_") + (little ? "little" : "big") +
                        "_endian 1.0\nelement vertex 3\nproperty double x\nproperty float y\nproperty short z\n"
                        "element face 2\nproperty uchar red\nproperty list uchar int vertex_indices\nend_header\n";
    const auto append = [&](auto value) {
        std::string piece;
        append_bytes(piece, value);
        bytes += little ? piece : std::string(piece.rbegin(), piece.rend());
    };
    for (const int i : {0, 1, 2}) {
        append(0.5 * i);
        append(0.25f * static_cast<float>(i * i));
        append(static_cast<std::int16_t>(i));
    }
    for (int face = 0; face < 2; ++face) {
        append(std::uint8_t{255});
        append(std::uint8_t{3});
        for (const std::int32_t v : {0, 1, 2}) append(v);
    }
    return bytes;
}

std::vector<std::string> ply_files() {
    return {
        "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 3 2 1\n",
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\nproperty double z\nelement "
        "tristrips 1\n"
        "property list int int vertex_indices\nelement edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 4 -1 0 1 2\n0 1\n",
        binary_ply(true), binary_ply(false)};
}

std::string binary_stl() {
    std::string bytes(80, ' ');
    append_bytes(bytes, std::uint32_t{2});
    for (const float z : {0.0f, 1.0f}) {
        for (const float x : {0.0f, 0.0f, 1.0f, 0.0f, 0.0f, z, 1.0f, 0.0f, z, 0.0f, 1.0f, z}) append_bytes(bytes, x);
        append_bytes(bytes, std::uint16_t{0});
    }
    return bytes;
}

std::vector<std::string> stl_files() {
    return {
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
        "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid a\n",
        binary_stl()};
}

/// A tetrahedron and a triangle, all as text.
const char* const text_vtu =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt64\">\n"
    "<UnstructuredGrid>\n<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">\n<CellData><DataArray type=\"Int32\" "
    "Name=\"body\" "
    "format=\"ascii\">1 2</DataArray></CellData>\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" "
    "format=\"ascii\">\n"
    "0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>\n<Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
    "format=\"ascii\">0 1 2 3 0 1 "
    "2</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4 7</DataArray>\n"
    "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10 "
    "5</DataArray></Cells>\n</Piece></UnstructuredGrid></VTKFile>\n";
/// The same, inline in base64, compressed by zlib, with headers of 64 bits.
const char* const inline_vtu =
    "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64"
    "\" compressor=\"vtkZLibDataCompressor\">\n"
    "<UnstructuredGrid>\n"
    "<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">\n"
    "<CellData><DataArray type=\"Int16\" Name=\"body\" format=\"binary\">\n"
    "AQAAAAAAAAAAgAAAAAAAAAQAAAAAAAAADAAAAAAAAAA=eF5jZGBiAAAADAAE</DataArray>\n"
    "</CellData>\n"
    "<Points><DataArray type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\" format=\"binary\">\n"
    "AQAAAAAAAAAAgAAAAAAAADAAAAAAAAAAEQAAAAAAAAA=eF5jYEAGDfYoXCx8ACe9Aj4=</DataArray>\n"
    "</Points>\n"
    "<Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"binary\">\n"
    "AQAAAAAAAAAAgAAAAAAAABwAAAAAAAAAFgAAAAAAAAA=eF5jYGBgYARiJiBmZoAAGB8AAJwACg==</DataArray>\n"
    "<DataArray type=\"Int32\" Name=\"offsets\" format=\"binary\">\n"
    "AQAAAAAAAAAAgAAAAAAAAAgAAAAAAAAADgAAAAAAAAA=eF5jYWBgYAdiAABEAAw=</DataArray>\n"
    "<DataArray type=\"UInt8\" Name=\"types\" format=\"binary\">\n"
    "AQAAAAAAAAAAgAAAAAAAAAIAAAAAAAAACgAAAAAAAAA=eF7jYgUAABsAEA==</DataArray>\n"
    "</Cells>\n"
    "</Piece>\n"
    "</UnstructuredGrid>\n"
    "</VTKFile>\n";
const char* const text_vtp =
    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n"
    "<Piece NumberOfPoints=\"4\" NumberOfPolys=\"1\" NumberOfStrips=\"1\">\n<PointData><DataArray type=\"Float64\" "
    "Name=\"displacement\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 1 1 0</DataArray></PointData>\n"
    "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 1 1 "
    "0</DataArray></Points>\n"
    "<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys>\n"
    "<Strips><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray></Strips>\n</Piece></PolyData></VTKFile>\n";

/// Two pieces of a line and a quadrangle, appended in base64, not compressed, with the highest byte first.
const char* const appended_vtp =
    "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"BigEndian\" header_type=\"UInt32\">\n"
    "<PolyData>\n"
    "<Piece NumberOfPoints=\"4\" NumberOfLines=\"1\" NumberOfPolys=\"1\">\n"
    "<PointData><DataArray type=\"Float32\" Name=\"displacement\" NumberOfComponents=\"3\" format=\"appen"
    "ded\" offset=\"0\"/>\n"
    "</PointData>\n"
    "<CellData><DataArray type=\"UInt8\" Name=\"body\" format=\"appended\" offset=\"72\"/>\n"
    "</CellData>\n"
    "<Points><DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"appended\" off"
    "set=\"80\"/>\n"
    "</Points>\n"
    "<Lines><DataArray type=\"Int64\" Name=\"connectivity\" format=\"appended\" offset=\"216\"/>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"appended\" offset=\"244\"/>\n"
    "</Lines>\n"
    "<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"appended\" offset=\"260\"/>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"appended\" offset=\"308\"/>\n"
    "</Polys>\n"
    "</Piece>\n"
    "<Piece NumberOfPoints=\"4\" NumberOfLines=\"1\" NumberOfPolys=\"1\">\n"
    "<PointData><DataArray type=\"Float32\" Name=\"displacement\" NumberOfComponents=\"3\" format=\"appen"
    "ded\" offset=\"0\"/>\n"
    "</PointData>\n"
    "<CellData><DataArray type=\"UInt8\" Name=\"body\" format=\"appended\" offset=\"72\"/>\n"
    "</CellData>\n"
    "<Points><DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"appended\" off"
    "set=\"80\"/>\n"
    "</Points>\n"
    "<Lines><DataArray type=\"Int64\" Name=\"connectivity\" format=\"appended\" offset=\"216\"/>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"appended\" offset=\"244\"/>\n"
    "</Lines>\n"
    "<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"appended\" offset=\"260\"/>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"appended\" offset=\"308\"/>\n"
    "</Polys>\n"
    "</Piece>\n"
    "</PolyData>\n"
    "<AppendedData encoding=\"base64\">\n"
    "_AAAAMAAAAAA/gAAAQAAAAEBAAABAgAAAQKAAAEDAAABA4AAAQQAAAEEQAABBIAAAQTAAAA==AAAAAgECAAAAYAAAAAAAAAAAAAA"
    "AAAAAAAAAAAAAAAAAAD/wAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAP/AAAAAAAAAAAAAAAAAAAD/wAAAAAAAAP/AAAAA"
    "AAAAAAAAAAAAAAA==AAAAEAAAAAAAAAAAAAAAAAAAAAE=AAAACAAAAAAAAAACAAAAIAAAAAAAAAAAAAAAAAAAAAEAAAAAAAAAAwA"
    "AAAAAAAACAAAACAAAAAAAAAAE\n"
    "</AppendedData>\n"
    "</VTKFile>\n";

std::vector<std::string> vtu_files() {
    const ScratchFile file("vtu");
    mesh::write_vtu(mesh::structured_box<3>({0, 0, 0}, {1, 1, 1}, {1, 1, 1}, mesh::CellShape::tetrahedron), file.path());
    return {text_vtu, inline_vtu, bytes_of(file.path())};
}

std::vector<std::string> vtp_files() {
    const ScratchFile file("vtp");
    mesh::write_vtp(mesh::sphere_surface({.n_subdivisions = 0}).soup(), file.path());
    return {text_vtp, appended_vtp, bytes_of(file.path())};
}

/// A tetrahedron and one of its faces, each in a physical group.
void make_gmsh_model() {
    const int volume = gmsh::model::addDiscreteEntity(3), surface = gmsh::model::addDiscreteEntity(2);
    gmsh::model::mesh::addNodes(3, volume, {1, 2, 3, 4}, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    gmsh::model::mesh::addElementsByType(volume, 4, {}, {1, 2, 3, 4});
    gmsh::model::mesh::addElementsByType(surface, 2, {}, {1, 2, 3});
    gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {volume}), "body");
    gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {surface}), "floor");
}

std::vector<std::string> msh_files() {
    std::vector<std::string> files;
    const ScratchFile file("msh");
    for (const double version : {2.2, 4.1})
        for (const bool binary : {false, true}) {
            gmsh::initialize();
            gmsh::option::setNumber("General.Terminal", 0);
            make_gmsh_model();
            gmsh::option::setNumber("Mesh.MshFileVersion", version);
            gmsh::option::setNumber("Mesh.Binary", binary);
            gmsh::write(file.path().string());
            gmsh::finalize();
            files.push_back(bytes_of(file.path()));
        }
    // In the plane, of order 2, in parts, with data behind; and several elements of a kind.
    files.emplace_back(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 2 \"edge\"\n2 7 \"a plate\"\n$EndPhysicalNames\n"
        "$Nodes\n9\n1 0 0 0\n2 0.5 0 0\n3 1 0 0\n4 0 0.5 0\n5 0.5 0.5 0\n6 1 0.5 0\n7 0 1 0\n8 0.5 1 0\n9 1 1 0\n"
        "$EndNodes\n$Elements\n6\n1 1 2 2 1 1 2\n2 1 2 2 1 2 3\n3 3 2 7 1 1 2 5 4\n4 3 2 7 1 2 3 6 5\n"
        "5 2 2 7 1 4 5 8\n6 3 2 7 1 5 6 9 8\n$EndElements\n$ElementData\n1\n\"p\"\n0\n3\n0\n1\n1\n6 2.5\n"
        "$EndElementData");
    files.emplace_back(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 2 \"body\"\n$EndPhysicalNames\n"
        "$PartitionedEntities\n1\n1\n5 1\n0 0 1 1\n3 2 1 1 1 0 0 0 1 1 1 0 0\n1 3 1 1 1 0 0 0 1 1 1 1 2 1 3\n"
        "$EndPartitionedEntities\n$Entities\n1 0 0 1\n9 0 0 0 0\n1 0 0 0 1 1 1 1 -2 0\n$EndEntities\n"
        "$Nodes\n2 10 1 10\n2 3 1 1\n1\n0 0 0 0.5 0.5\n3 1 0 9\n2\n3\n4\n5\n6\n7\n8\n9\n10\n2 0 0\n0 2 0\n0 0 2\n"
        "1 0 0\n1 1 0\n0 1 0\n0 0 1\n0 1 1\n1 0 1\n$EndNodes\n$Elements\n2 2 1 2\n2 3 2 1\n1 1 2 3\n3 1 11 1\n"
        "2 1 2 3 4 5 6 7 8 9 10\n$EndElements\n$Periodic\n0\n$EndPeriodic\n");
    return files;
}

}  // namespace

const std::vector<std::string>& formats() {
    static const std::vector<std::string> all = {"obj", "stl", "ply", "off", "vtp", "vtu", "msh"};
    return all;
}

std::vector<std::string> corpus(const std::string& format) {
    if (format == "obj") return obj_files();
    if (format == "stl") return stl_files();
    if (format == "ply") return ply_files();
    if (format == "off") return off_files();
    if (format == "vtp") return vtp_files();
    if (format == "vtu") return vtu_files();
    if (format == "msh") return msh_files();
    throw std::invalid_argument("there is no format '" + format + "'. Take obj, stl, ply, off, vtp, vtu or msh.");
}

}  // namespace abut::fuzz
