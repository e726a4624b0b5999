#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "abut.h"
#include "abut/base/ids.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/contact/overlap/face_distance.hpp"
#include "abut/contact/search/near_overlaps.hpp"
#include "arguments.hpp"

using namespace abut;
using namespace abut::c_layer;

namespace {

/// Faces whose bodies are numbered without gaps, with depths and stiffnesses that nobody looks at.
struct SurfaceForOverlaps {
    explicit SurfaceForOverlaps(const abut_faces& given) : faces(given) {
        const auto of_host = span_of(given.body, given.n_faces, "abut_faces.body");
        std::vector<std::int32_t> numbers(of_host.begin(), of_host.end());
        sort_unique(numbers);
        for (const std::int32_t number : of_host)
            body.push_back(static_cast<std::int32_t>(std::ranges::lower_bound(numbers, number) - numbers.begin()) +
                           given.index_base);
        depth.assign(body.size(), 1.0);
        stiffness.assign(numbers.size(), 1.0);
        faces.body = body.data();
        faces.depth = depth.data();
        faces.stiffness = stiffness.data();
        faces.n_bodies = static_cast<std::int64_t>(numbers.size());
    }
    SurfaceForOverlaps(const SurfaceForOverlaps&) = delete;

    abut_faces faces;
    std::vector<std::int32_t> body;
    std::vector<double> depth, stiffness;
};

template <int Dim>
void find_all_overlaps(const abut_array& x, const abut_faces& faces, double distance, abut_overlap* overlaps,
                       std::size_t entry_size, std::int64_t capacity, std::int64_t* n) {
    const SurfaceForOverlaps of_bodies(faces);
    const contact::NodalSurface<Dim> surface = surface_of<Dim>(x, of_bodies.faces);
    const auto near = contact::find_near_overlaps<Dim>(surface, distance);
    const contact::Surface<Dim>& facets = surface.facets();
    const std::size_t n_wanted = std::min(near.found.size(), static_cast<std::size_t>(std::max<std::int64_t>(capacity, 0)));
    const std::vector<double> distances =
        contact::face_distances<Dim>(facets.view(), facets.vertices, std::span(near.found).first(n_wanted));
    copy_entries(near.found, overlaps, entry_size, capacity, n, [&](const contact::Overlap<Dim>& overlap) {
        abut_overlap entry{};
        entry.face_1 = number_of(surface.face_of(contact::Facet{overlap.face_1})) + faces.index_base;
        entry.face_2 = number_of(surface.face_of(contact::Facet{overlap.face_2})) + faces.index_base;
        entry.area = overlap.area;
        entry.gap = overlap.gap;
        entry.distance = distances[static_cast<std::size_t>(&overlap - near.found.data())];
        copy_vector<Dim>(overlap.normal, entry.normal);
        return entry;
    });
}

}  // namespace

int abut_find_overlaps(int32_t dim, abut_array x, const abut_faces* faces, double distance, abut_overlap* overlaps,
                       size_t entry_size, int64_t capacity, int64_t* n, abut_error* error) {
    return guarded(error, faces == nullptr ? 0 : faces->index_base, [&] {
        check_dim(dim);
        check_struct(faces, "abut_faces");
        if (dim == 2)
            find_all_overlaps<2>(x, *faces, distance, overlaps, entry_size, capacity, n);
        else
            find_all_overlaps<3>(x, *faces, distance, overlaps, entry_size, capacity, n);
    });
}
