#include "abut/solid/load/group_faces.hpp"

#include <algorithm>

#include "abut/solid/part/body_cells.hpp"

namespace abut::solid {
namespace {

/// Whether this rank has the points of a rigid body of the mesh.
template <int Dim>
bool is_own_rigid(const Bodies<Dim>& bodies, const RankPart<Dim>& part, std::int32_t body) {
    return std::ranges::any_of(part.own_rigid(), [&](std::int32_t rigid) {
        return bodies.rigid().mesh_body(static_cast<std::size_t>(rigid)) == body;
    });
}

}  // namespace

template <int Dim>
GroupFaces<Dim>::GroupFaces(const Bodies<Dim>& bodies, const RankPart<Dim>& part, const std::string& group) : part_(&part) {
    const mesh::Mesh<Dim>& mesh = bodies.mesh();
    std::vector<Key> here, own;
    for (const std::int32_t face : mesh.group(group).faces) {
        const std::int32_t cell = mesh.face_cells[static_cast<std::size_t>(face)][0];
        const std::int32_t body = mesh.cell_body[static_cast<std::size_t>(cell)];
        const std::int32_t deformable = bodies.deformable_cell(cell).first;
        const bool is_rigid = deformable < 0;
        const double number =
            is_rigid ? cell - cells_of_body(mesh, body).first : part.cell_numbers()[static_cast<std::size_t>(deformable)];
        const auto position = std::ranges::find(mesh.cell_faces[cell], face) - mesh.cell_faces[cell].begin();
        here.push_back({static_cast<double>(body), number, static_cast<double>(position)});
        if (!(is_rigid ? is_own_rigid(bodies, part, body) : std::ranges::binary_search(part.own_cells(), deformable)))
            continue;
        own_.push_back(face);
        own.push_back(here.back());
    }
    number_faces(here, own);
}

template <int Dim>
void GroupFaces<Dim>::number_faces(std::span<const Key> here, std::span<const Key> own) {
    std::vector<double> mine;
    for (const Key& key : own) mine.insert(mine.end(), key.begin(), key.end());
    const std::vector<double> values = part_->ranks().gather(mine);
    std::vector<Key> brought;
    for (std::size_t i = 0; i < values.size(); i += 3) brought.push_back({values[i], values[i + 1], values[i + 2]});
    std::vector<Key> all = brought;
    std::ranges::sort(all);
    const auto numbers_of = [&](std::span<const Key> keys) {
        std::vector<std::int32_t> numbers;
        for (const Key& key : keys)
            numbers.push_back(static_cast<std::int32_t>(std::ranges::lower_bound(all, key) - all.begin()));
        return numbers;
    };
    numbers_ = numbers_of(own);
    numbers_here_ = numbers_of(here);
    gathered_ = numbers_of(brought);
}

template <int Dim>
std::vector<double> GroupFaces<Dim>::gather(std::span<const double> of_own, std::size_t width) const {
    const std::vector<double> brought = part_->ranks().gather(of_own);
    std::vector<double> ordered(brought.size());
    for (std::size_t i = 0; i < brought.size(); ++i)
        ordered[static_cast<std::size_t>(gathered_[i / width]) * width + i % width] = brought[i];
    return ordered;
}

template <int Dim>
std::vector<Vector<Dim>> GroupFaces<Dim>::gather(std::span<const Vector<Dim>> of_own) const {
    std::vector<double> mine;
    for (const Vector<Dim>& value : of_own) mine.insert(mine.end(), value.begin(), value.end());
    const std::vector<double> all = gather(mine, Dim);
    const auto vectors = as_vectors<Dim>(std::span<const double>(all));
    return {vectors.begin(), vectors.end()};
}

template <int Dim>
std::vector<Vector<Dim>> GroupFaces<Dim>::chosen(std::span<const Vector<Dim>> of_all,
                                                 std::span<const std::int32_t> numbers) {
    std::vector<Vector<Dim>> values;
    for (const std::int32_t number : numbers) values.push_back(of_all[static_cast<std::size_t>(number)]);
    return values;
}

template class GroupFaces<2>;
template class GroupFaces<3>;

}  // namespace abut::solid
