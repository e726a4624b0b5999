#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "abut.h"
#include "abut/contact/surface/cell_surface.hpp"
#include "arguments.hpp"

using namespace abut;
using namespace abut::c_layer;

/// Counted from `index_base`.
struct abut_surface {
    std::vector<std::int32_t> nodes, offsets, body, cell;
    std::vector<double> depth;
    std::int32_t index_base;
};

namespace {

std::vector<std::int32_t> offsets_of(const abut_cells& cells) {
    if (cells.offsets != nullptr)
        return from_zero(span_of(cells.offsets, cells.n_cells + 1, "abut_cells.offsets"), cells.index_base);
    const std::int64_t n_corners = cells.n_cells > 0 ? cells.n_nodes / cells.n_cells : 0;
    if (n_corners * cells.n_cells != cells.n_nodes)
        throw BadInput("abut_cells: " + std::to_string(cells.n_nodes) + " corners cannot be as many for each of " +
                       std::to_string(cells.n_cells) + " cells; give offsets.");
    std::vector<std::int32_t> offsets;
    for (std::int32_t cell = 0; cell <= checked_count(cells.n_cells, "abut_cells"); ++cell)
        offsets.push_back(static_cast<std::int32_t>(cell * n_corners));
    return offsets;
}

template <int Dim>
abut_surface found(const abut_array& rest, const abut_cells& cells) {
    if (cells.index_base != 0 && cells.index_base != 1)
        throw BadInput("abut_cells: index_base is " + std::to_string(cells.index_base) + "; 0 and 1 are allowed.");
    const auto nodes = from_zero(span_of(cells.nodes, cells.n_nodes, "abut_cells.nodes"), cells.index_base);
    const auto offsets = offsets_of(cells);
    std::vector<std::int32_t> body;
    if (cells.body != nullptr) body = from_zero(span_of(cells.body, cells.n_cells, "abut_cells.body"), cells.index_base);
    auto surface = contact::surface_of<Dim>(view_of<Dim>(rest, "rest"), {.nodes = nodes, .offsets = offsets, .body = body});
    for (auto* const numbers : {&surface.nodes, &surface.offsets, &surface.body, &surface.cell})
        for (std::int32_t& number : *numbers) number += cells.index_base;
    return {std::move(surface.nodes), std::move(surface.offsets), std::move(surface.body),
            std::move(surface.cell),  std::move(surface.depth),   cells.index_base};
}

}  // namespace

int abut_surface_of(int32_t dim, abut_array rest, const abut_cells* cells, abut_surface** surface, abut_error* error) {
    return guarded(error, cells == nullptr ? 0 : cells->index_base, [&] {
        check_dim(dim);
        check_struct(cells, "abut_cells");
        check_pointer(surface, "the place for the surface");
        *surface = std::make_unique<abut_surface>(dim == 2 ? found<2>(rest, *cells) : found<3>(rest, *cells)).release();
    });
}

int abut_surface_faces(const abut_surface* surface, abut_faces* faces, const int32_t** cell, abut_error* error) {
    return guarded(error, 0, [&] {
        check_pointer(surface, "the handle `surface`");
        check_struct(faces, "abut_faces");
        faces->n_faces = std::ssize(surface->body);
        faces->nodes = surface->nodes.data();
        faces->n_nodes = std::ssize(surface->nodes);
        faces->offsets = surface->offsets.data();
        faces->body = surface->body.data();
        faces->depth = surface->depth.data();
        faces->index_base = surface->index_base;
        if (cell != nullptr) *cell = surface->cell.data();
    });
}

void abut_surface_destroy(abut_surface* surface) { delete surface; }
