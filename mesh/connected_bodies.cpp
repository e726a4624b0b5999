#include "abut/mesh/connected_bodies.hpp"

#include <algorithm>
#include <unordered_map>

#include "abut/base/disjoint_sets.hpp"

namespace abut::mesh {

template <int Dim>
void name_connected_bodies(CellSoup<Dim>& soup) {
    DisjointSets connected(soup.vertices.size());
    const auto n_cells = soup.cell_vertices.size();
    for (std::int32_t cell = 0; cell < n_cells; ++cell) {
        if (soup.cell_body[static_cast<std::size_t>(cell)] >= 0) continue;
        const auto vertices = soup.cell_vertices[cell];
        for (const std::int32_t vertex : vertices.subspan(1)) connected.join(vertices[0], vertex);
    }
    std::unordered_map<std::int32_t, std::int32_t> body_of_set;
    int number = 0;
    const auto next_free_name = [&] {
        std::string name;
        do name = std::string("body_") + std::to_string(++number);
        while (std::find(soup.body_names.begin(), soup.body_names.end(), name) != soup.body_names.end());
        return name;
    };
    for (std::int32_t cell = 0; cell < n_cells; ++cell) {
        auto& body = soup.cell_body[static_cast<std::size_t>(cell)];
        if (body >= 0) continue;
        const auto next = static_cast<std::int32_t>(soup.body_names.size());
        const auto [entry, is_new] = body_of_set.emplace(connected.find(soup.cell_vertices[cell][0]), next);
        body = entry->second;
        if (is_new) soup.body_names.push_back(next_free_name());
    }
}

template void name_connected_bodies<2>(CellSoup<2>&);
template void name_connected_bodies<3>(CellSoup<3>&);

}  // namespace abut::mesh
