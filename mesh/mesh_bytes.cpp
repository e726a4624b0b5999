#include "abut/mesh/mesh_bytes.hpp"

#include <cstring>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/state_fields.hpp"

namespace abut::mesh {
namespace {

constexpr std::uint32_t version = 1;

/// Writes members; arrays of plain values as they are in memory.
class Writer {
public:
    explicit Writer(const std::string& kind) : state_(kind, version) {}

    template <class T>
    void array(const std::vector<T>& values) {
        state_.put_all(std::as_bytes(std::span(values)));
    }
    template <class T>
    void value(const T& value) {
        put_value(state_, value);
    }
    std::vector<std::byte> finish() && { return std::move(state_).finish(); }

private:
    StateWriter state_;
};

/// Reads the same members.
class Reader {
public:
    Reader(std::span<const std::byte> bytes, const std::string& kind) : state_(bytes, kind, version) {}

    template <class T>
    void array(std::vector<T>& values) {
        const std::vector<std::byte> bytes = state_.get_all<std::byte>();
        if (bytes.size() % sizeof(T) != 0) throw BadInput("mesh: its bytes are damaged. Send them again.");
        values.resize(bytes.size() / sizeof(T));
        if (!bytes.empty()) std::memcpy(static_cast<void*>(values.data()), bytes.data(), bytes.size());
    }
    template <class T>
    void value(T& value) {
        get_value(state_, value);
    }
    void finish() const { state_.finish(); }

private:
    StateReader state_;
};

template <class State, class R>
void carry_rows(State& state, R& rows) {
    state.array(rows.offsets);
    state.array(rows.values);
}

template <class State, class Report>
void carry_report(State& state, Report& report) {
    state.value(report.n_unused_vertices);
    state.value(report.n_ignored_elements);
    state.value(report.warnings);
    state.value(report.n_coincident_vertices);
    state.value(report.n_non_planar_faces);
    state.value(report.n_cut_cells);
    state.value(report.n_turned_cells);
    state.value(report.joined_bodies);
    state.value(report.worst_planarity);
    state.value(report.worst_face_cell);
}

template <class Groups>
void carry_groups(Writer& state, const Groups& groups) {
    state.value(groups.size());
    for (const BoundaryGroup& group : groups) {
        state.value(group.name);
        state.array(group.faces);
    }
}

template <class Groups>
void carry_groups(Reader& state, Groups& groups) {
    std::size_t n = 0;
    state.value(n);
    for (; n > 0; --n) {
        BoundaryGroup& group = groups.emplace_back();
        state.value(group.name);
        state.array(group.faces);
    }
}

/// Names each member once, for both directions.
template <class State, class M>
void carry_mesh(State& state, M& mesh) {
    state.value(mesh.name);
    state.array(mesh.vertices);
    state.array(mesh.cell_shape);
    carry_rows(state, mesh.cell_vertices);
    carry_rows(state, mesh.cell_faces);
    state.array(mesh.cell_body);
    state.array(mesh.cell_measure);
    state.array(mesh.cell_centroid);
    carry_rows(state, mesh.face_vertices);
    state.array(mesh.face_cells);
    state.array(mesh.face_measure);
    state.array(mesh.face_centroid);
    state.array(mesh.face_normal);
    state.array(mesh.boundary_faces);
    state.value(mesh.body_names);
    carry_groups(state, mesh.groups);
    state.array(mesh.cell_label);
    state.array(mesh.vertex_label);
    carry_report(state, mesh.report);
    state.value(mesh.has_lost_cells);
}

template <class State, class Part>
void carry_part(State& state, Part& part) {
    carry_mesh(state, part.mesh);
    state.array(part.cell_number);
    state.array(part.cell_owner);
    state.value(part.n_cells);
}

template <int Dim>
std::string kind_of(const std::string& what) {
    return what + " in " + std::to_string(Dim) + "D";
}

const std::string whole = "mesh", part_of_mesh = "part of a mesh";

}  // namespace

template <int Dim>
std::vector<std::byte> bytes_of(const Mesh<Dim>& mesh) {
    Writer state(kind_of<Dim>(whole));
    carry_mesh(state, mesh);
    return std::move(state).finish();
}

template <int Dim>
std::vector<std::byte> bytes_of(const MeshPart<Dim>& part) {
    Writer state(kind_of<Dim>(part_of_mesh));
    carry_part(state, part);
    return std::move(state).finish();
}

template <int Dim>
Mesh<Dim> mesh_in(std::span<const std::byte> bytes) {
    Reader state(bytes, kind_of<Dim>(whole));
    Mesh<Dim> mesh;
    carry_mesh(state, mesh);
    state.finish();
    return mesh;
}

template <int Dim>
MeshPart<Dim> part_in(std::span<const std::byte> bytes) {
    Reader state(bytes, kind_of<Dim>(part_of_mesh));
    MeshPart<Dim> part;
    carry_part(state, part);
    state.finish();
    return part;
}

#define ABUT_INSTANTIATE(Dim)                                       \
    template std::vector<std::byte> bytes_of(const Mesh<Dim>&);     \
    template std::vector<std::byte> bytes_of(const MeshPart<Dim>&); \
    template Mesh<Dim> mesh_in(std::span<const std::byte>);         \
    template MeshPart<Dim> part_in(std::span<const std::byte>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::mesh
