#include "abut/ranks/partition.hpp"

#include <array>
#include <cmath>
#include <memory>

#include "abut/ranks/mpi.hpp"
// What it needs of MPI comes first.
#include <zoltan.h>

namespace abut::ranks {
namespace {

/// The points that this rank hands to Zoltan: those from `begin` on among all in their order.
template <int Dim>
struct Slice {
    std::span<const Vector<Dim>> points;
    std::span<const double> weights;  // of these
    bool has_weights;                 // else all weigh 1
    std::size_t begin;

    [[nodiscard]] std::size_t size() const { return points.size(); }
};

/// First point of the slice of each rank, one more at the end.
std::vector<std::size_t> slice_begin(const Communicator& communicator, std::size_t n_points) {
    const auto n_ranks = static_cast<std::size_t>(communicator.size());
    std::vector<std::size_t> begin;
    for (std::size_t rank = 0; rank <= n_ranks; ++rank) begin.push_back(n_points * rank / n_ranks);
    return begin;
}

template <int Dim>
int n_points(void* slice, int* error) {
    *error = ZOLTAN_OK;
    return static_cast<int>(static_cast<const Slice<Dim>*>(slice)->size());
}

template <int Dim>
void list_points(void* data, int, int, ZOLTAN_ID_PTR numbers, ZOLTAN_ID_PTR local, int has_weights, float* weights,
                 int* error) {
    const auto& slice = *static_cast<const Slice<Dim>*>(data);
    for (std::size_t i = 0; i < slice.size(); ++i) {
        numbers[i] = static_cast<ZOLTAN_ID_TYPE>(slice.begin + i);
        local[i] = static_cast<ZOLTAN_ID_TYPE>(i);
        if (has_weights > 0) weights[i] = static_cast<float>(slice.weights[i]);
    }
    *error = ZOLTAN_OK;
}

template <int Dim>
int n_coordinates(void*, int* error) {
    *error = ZOLTAN_OK;
    return Dim;
}

template <int Dim>
void list_coordinates(void* data, int, int, int n, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int, double* coordinates,
                      int* error) {
    const auto& slice = *static_cast<const Slice<Dim>*>(data);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < Dim; ++k) coordinates[i * Dim + k] = slice.points[local[i]][k];
    *error = ZOLTAN_OK;
}

struct Destroy {
    void operator()(Zoltan_Struct* zoltan) const { Zoltan_Destroy(&zoltan); }
};

void check_weights(std::size_t n_points, std::span<const double> weights) {
    if (!weights.empty() && weights.size() != n_points)
        throw BadInput("partition: " + std::to_string(weights.size()) + " weights are given for " +
                       std::to_string(n_points) + " points. Give one per point, or none.");
    for (std::size_t i = 0; i < weights.size(); ++i)
        if (!(weights[i] >= 0.0) || std::isinf(weights[i]))
            throw BadInput("partition: the weight of point " + std::to_string(i) + " is " + std::to_string(weights[i]) +
                               ", finite and >= 0 is allowed.",
                           {.value = weights[i], .allowed = 0.0});
}

void check(const Communicator& communicator, std::size_t n_points, std::span<const double> weights) {
    std::array<std::int64_t, 1> of_first{static_cast<std::int64_t>(n_points)};
    broadcast<std::int64_t>(communicator, of_first);
    agreed(communicator, [&] {
        if (static_cast<std::int64_t>(n_points) != of_first[0])
            throw BadInput("partition: " + std::to_string(n_points) + " points are given, but " +
                           std::to_string(of_first[0]) + " on rank 0. Give all ranks the same.");
        check_weights(n_points, weights);
    });
}

void require_zoltan(const Communicator& communicator, int result, const char* call) {
    agreed(communicator, [&] {
        if (result != ZOLTAN_OK && result != ZOLTAN_WARN)
            throw LimitExceeded(std::string("partition: ") + call + " of Zoltan has failed (" + std::to_string(result) +
                                "). Take fewer ranks, or give owners of your own.");
    });
}

/// The rank of each point of a slice. A call of all ranks.
template <int Dim>
std::vector<std::int32_t> ranks_of(const Communicator& communicator, Slice<Dim>& slice) {
    float version = 0.0f;
    require_zoltan(communicator, Zoltan_Initialize(0, nullptr, &version), "Zoltan_Initialize");
    const std::unique_ptr<Zoltan_Struct, Destroy> zoltan(Zoltan_Create(handle(communicator)));
    require_zoltan(communicator, zoltan ? ZOLTAN_OK : ZOLTAN_MEMERR, "Zoltan_Create");
    const auto set = [&](const char* name, const char* value) { Zoltan_Set_Param(zoltan.get(), name, value); };
    set("DEBUG_LEVEL", "0");
    set("LB_METHOD", "RCB");
    set("RETURN_LISTS", "PARTS");
    set("OBJ_WEIGHT_DIM", slice.has_weights ? "1" : "0");
    set("RCB_OUTPUT_LEVEL", "0");
    Zoltan_Set_Num_Obj_Fn(zoltan.get(), n_points<Dim>, &slice);
    Zoltan_Set_Obj_List_Fn(zoltan.get(), list_points<Dim>, &slice);
    Zoltan_Set_Num_Geom_Fn(zoltan.get(), n_coordinates<Dim>, &slice);
    Zoltan_Set_Geom_Multi_Fn(zoltan.get(), list_coordinates<Dim>, &slice);

    int changed = 0, id_size = 0, local_size = 0, n_import = 0, n_export = 0;
    ZOLTAN_ID_PTR import_ids = nullptr, import_local = nullptr, export_ids = nullptr, export_local = nullptr;
    int *import_ranks = nullptr, *import_parts = nullptr, *export_ranks = nullptr, *export_parts = nullptr;
    const int result = Zoltan_LB_Partition(zoltan.get(), &changed, &id_size, &local_size, &n_import, &import_ids,
                                           &import_local, &import_ranks, &import_parts, &n_export, &export_ids,
                                           &export_local, &export_ranks, &export_parts);
    std::vector<std::int32_t> mine(slice.size(), communicator.rank());
    for (int i = 0; i < n_export; ++i) mine[export_local[i]] = export_parts[i];
    Zoltan_LB_Free_Part(&import_ids, &import_local, &import_ranks, &import_parts);
    Zoltan_LB_Free_Part(&export_ids, &export_local, &export_ranks, &export_parts);
    require_zoltan(communicator, result, "Zoltan_LB_Partition");
    return mine;
}

/// The values of this rank's slice of points, of `width` numbers each, from all of rank 0.
std::vector<double> slice_of_first(const Communicator& communicator, const std::vector<std::size_t>& begin,
                                   std::size_t width, std::span<const double> of_all) {
    std::vector<int> counts;
    for (std::size_t rank = 0; rank + 1 < begin.size(); ++rank)
        counts.push_back(as_count(width * (begin[rank + 1] - begin[rank])));
    const std::vector<int> offsets = offsets_of(counts);
    std::vector<double> mine(static_cast<std::size_t>(counts[static_cast<std::size_t>(communicator.rank())]));
    require(MPI_Scatterv(of_all.data(), counts.data(), offsets.data(), MPI_DOUBLE, mine.data(), as_count(mine.size()),
                         MPI_DOUBLE, 0, handle(communicator)),
            "MPI_Scatterv");
    return mine;
}

}  // namespace

template <int Dim>
std::vector<int> partition(const Communicator& communicator, std::span<const Vector<Dim>> points,
                           std::span<const double> weights) {
    check(communicator, points.size(), weights);
    if (communicator.size() == 1) return std::vector<int>(points.size(), 0);
    const std::vector<std::size_t> begins = slice_begin(communicator, points.size());
    const auto rank = static_cast<std::size_t>(communicator.rank());
    const std::size_t begin = begins[rank], n = begins[rank + 1] - begin;
    Slice<Dim> slice{points.subspan(begin, n), weights.empty() ? weights : weights.subspan(begin, n), !weights.empty(),
                     begin};
    return gather_to_all<std::int32_t>(communicator, ranks_of(communicator, slice)).values;
}

template <int Dim>
std::vector<int> partition_of_first(const Communicator& communicator, std::span<const Vector<Dim>> points,
                                    std::span<const double> weights) {
    const bool is_first = communicator.rank() == 0;
    agreed(communicator, [&] {
        if (is_first) check_weights(points.size(), weights);
    });
    if (communicator.size() == 1) return std::vector<int>(points.size(), 0);
    std::array<std::int64_t, 2> known{std::ssize(points), weights.empty() ? 0 : 1};
    broadcast<std::int64_t>(communicator, known);
    const std::vector<std::size_t> begin = slice_begin(communicator, static_cast<std::size_t>(known[0]));
    const std::span<const double> coordinates(points.empty() ? nullptr : points.front().data(), Dim * points.size());
    const std::vector<double> of_slice = slice_of_first(communicator, begin, Dim, coordinates);
    std::vector<double> weights_of_slice;
    if (known[1] != 0) weights_of_slice = slice_of_first(communicator, begin, 1, weights);
    Slice<Dim> slice{as_vectors<Dim>(std::span(of_slice)), weights_of_slice, known[1] != 0,
                     begin[static_cast<std::size_t>(communicator.rank())]};
    return gather_to_first<std::int32_t>(communicator, ranks_of(communicator, slice)).values;
}

SharedPoints shared_points(const Communicator& communicator, int dimension, std::int32_t n_points,
                           std::span<const std::int32_t> number, std::span<const int> owner) {
    SharedPoints points{.dimension = dimension, .n_points = n_points, .n_entries = number.size()};
    for (std::size_t i = 0; i < number.size(); ++i) {
        const auto position = static_cast<std::int32_t>(i);
        if (owner[i] == communicator.rank()) {
            points.numbers.push_back(number[i]);
            points.position.push_back(position);
        } else {
            points.copies.push_back(position);
            points.owner.push_back(owner[i]);
            points.copied_point.push_back(number[i]);
        }
    }
    return points;
}

#define ABUT_INSTANTIATE(Dim)                                                                                        \
    template std::vector<int> partition(const Communicator&, std::span<const Vector<Dim>>, std::span<const double>); \
    template std::vector<int> partition_of_first(const Communicator&, std::span<const Vector<Dim>>, std::span<const double>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::ranks
