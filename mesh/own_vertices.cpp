#include "abut/mesh/own_vertices.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "abut/base/sort_unique.hpp"
#include "abut/mesh/cell_shape.hpp"

namespace abut::mesh {
namespace {

/// The numbers of shared vertices in their bodies, by old number and body: those of the first body stay.
using Copies = std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t>;

/// For each vertex the first body that has it, -1: none; and whether others have it, too.
struct Owners {
    std::vector<std::int32_t> body;
    std::vector<char> is_shared;
};

template <int Dim>
Owners owners_of(const CellSoup<Dim>& soup) {
    Owners owners{std::vector<std::int32_t>(soup.vertices.size(), -1), std::vector<char>(soup.vertices.size(), 0)};
    for (std::int32_t cell = 0; cell < soup.cell_vertices.size(); ++cell)
        for (const std::int32_t vertex : soup.cell_vertices[cell]) {
            const std::int32_t body = soup.cell_body[static_cast<std::size_t>(cell)];
            std::int32_t& owner = owners.body[static_cast<std::size_t>(vertex)];
            if (owner < 0) owner = body;
            if (owner != body) owners.is_shared[static_cast<std::size_t>(vertex)] = 1;
        }
    return owners;
}

/// Bodies of each face all corners of which are shared, by these in increasing order.
template <int Dim>
std::map<std::vector<std::int32_t>, std::set<std::int32_t>> shared_faces(const CellSoup<Dim>& soup, const Owners& owners) {
    std::map<std::vector<std::int32_t>, std::set<std::int32_t>> faces;
    for (std::int32_t cell = 0; cell < soup.cell_vertices.size(); ++cell) {
        const auto vertices = soup.cell_vertices[cell];
        const CellShape shape = soup.cell_shape[static_cast<std::size_t>(cell)];
        for (int face = 0; face < n_faces(shape); ++face) {
            std::vector<std::int32_t> corners;
            for (const std::int8_t i : face_vertices(shape, face)) corners.push_back(vertices[static_cast<std::size_t>(i)]);
            if (!std::ranges::all_of(corners, [&](std::int32_t v) { return owners.is_shared[static_cast<std::size_t>(v)]; }))
                continue;
            std::ranges::sort(corners);
            faces[corners].insert(soup.cell_body[static_cast<std::size_t>(cell)]);
        }
    }
    return faces;
}

template <int Dim>
Copies copy_shared_vertices(CellSoup<Dim>& soup, const Owners& owners) {
    Copies copies;
    for (std::int32_t cell = 0; cell < soup.cell_vertices.size(); ++cell)
        for (auto i = static_cast<std::size_t>(soup.cell_vertices.offsets[static_cast<std::size_t>(cell)]);
             i < static_cast<std::size_t>(soup.cell_vertices.offsets[static_cast<std::size_t>(cell) + 1]); ++i) {
            std::int32_t& vertex = soup.cell_vertices.values[i];
            const std::int32_t body = soup.cell_body[static_cast<std::size_t>(cell)];
            const auto old = static_cast<std::size_t>(vertex);
            if (owners.is_shared[old] == 0 || owners.body[old] == body) continue;
            const auto [copy, is_new] = copies.try_emplace({vertex, body}, static_cast<std::int32_t>(soup.vertices.size()));
            if (is_new) {
                soup.vertices.push_back(Vector<Dim>(soup.vertices[old]));
                soup.vertex_label.push_back(soup.vertex_label[old]);
            }
            vertex = copy->second;
        }
    return copies;
}

/// A named face of shared vertices is one of each body that has a face there; any other one is of the body that has all
/// its vertices.
template <int Dim>
void take_named_faces(CellSoup<Dim>& soup, const Owners& owners, const Copies& copies,
                      const std::map<std::vector<std::int32_t>, std::set<std::int32_t>>& shared) {
    using NamedFace = typename CellSoup<Dim>::NamedFace;
    std::vector<NamedFace> faces;
    for (const NamedFace& face : soup.named_faces) {
        std::vector<std::int32_t> corners = face.vertices;
        std::ranges::sort(corners);
        std::set<std::int32_t> bodies;
        if (const auto found = shared.find(corners); found != shared.end()) bodies = found->second;
        for (const std::int32_t v : corners)
            if (bodies.empty() && owners.is_shared[static_cast<std::size_t>(v)] == 0)
                bodies.insert(owners.body[static_cast<std::size_t>(v)]);
        if (bodies.empty()) faces.push_back(face);
        for (const std::int32_t body : bodies) {
            faces.push_back(face);
            for (std::int32_t& v : faces.back().vertices)
                if (const auto copy = copies.find({v, body}); copy != copies.end()) v = copy->second;
        }
    }
    soup.named_faces = std::move(faces);
}

}  // namespace

template <int Dim>
std::vector<std::array<std::int32_t, 2>> give_own_vertices(CellSoup<Dim>& soup) {
    const Owners owners = owners_of(soup);
    if (std::ranges::count(owners.is_shared, 1) == 0) return {};
    const auto shared = shared_faces(soup, owners);
    std::vector<std::array<std::int32_t, 2>> pairs;
    for (const auto& [corners, bodies] : shared)
        if (bodies.size() == 2) pairs.push_back({*bodies.begin(), *bodies.rbegin()});
    sort_unique(pairs);
    const Copies copies = copy_shared_vertices(soup, owners);
    take_named_faces(soup, owners, copies, shared);
    return pairs;
}

template std::vector<std::array<std::int32_t, 2>> give_own_vertices(CellSoup<2>&);
template std::vector<std::array<std::int32_t, 2>> give_own_vertices(CellSoup<3>&);

}  // namespace abut::mesh
