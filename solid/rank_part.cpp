#include "abut/solid/rank_part.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "abut/base/error.hpp"

namespace abut::solid {
namespace {

constexpr std::int64_t most_faces = 8;  // of a cell

}  // namespace

template <int Dim>
RankPart<Dim>::RankPart(const dynamics::Ranks& ranks, const Bodies<Dim>& bodies) : ranks_(ranks) {
    const mesh::Mesh<Dim>& mesh = bodies.mesh();
    const auto n_part = static_cast<std::size_t>(mesh.n_cells());
    check(mesh);
    cell_numbers_.resize(n_part);
    std::vector<bool> is_own(n_part, false);
    for (std::size_t i = 0; i < own_cells().size(); ++i) {
        const auto cell = static_cast<std::size_t>(own_cells()[i]);
        is_own[cell] = true;
        cell_numbers_[cell] = ranks.numbers()[i];
        rest_.push_back(bodies.rest()[cell]);
        masses_.push_back(bodies.masses()[cell]);
        inverse_masses_.insert(inverse_masses_.end(), Dim, bodies.inverse_masses()[cell * Dim]);
        body_.push_back(bodies.body_of_points()[cell]);
    }
    ranks.fill(cell_numbers_, 1, dynamics::CopySet::all);
    dynamics::agreed(&ranks, [&] {
        if (std::ranges::adjacent_find(cell_numbers_, std::greater_equal{}) != cell_numbers_.end())
            throw BadInput(mesh.name +
                           ": the ranks do not fit the cells of this part: their numbers do not rise. Take both from one "
                           "mesh::MeshPart.");
    });
    for (const BoundaryFace face : boundary_faces(mesh)) {
        if (!is_own[static_cast<std::size_t>(cell_of(mesh, face))]) continue;
        own_faces_.push_back(face);
        face_keys_.push_back(key_of(mesh, face));
    }
    order_faces();
    for (auto* array : {&state_, &start_, &end_}) array->assign(n_part, Vector<Dim>::Constant(std::nan("")));
    result_.assign(n_part, Vector<Dim>::Zero());
    set_body_begin(mesh.n_bodies());
    find_first_cells();
}

template <int Dim>
void RankPart<Dim>::check(const mesh::Mesh<Dim>& mesh) const {
    dynamics::agreed(&ranks_, [&] {
        const auto own = own_cells();
        const bool rises = std::ranges::adjacent_find(own, std::greater_equal{}) == own.end();
        if (ranks_.dimension() != Dim || !rises || (!own.empty() && (own.front() < 0 || own.back() >= mesh.n_cells())))
            throw BadInput(mesh.name + ": the ranks are of points with " + std::to_string(ranks_.dimension()) +
                           " values, or at positions that this part does not have. Take both from one mesh::MeshPart.");
    });
}

/// Faces are numbered by their cell, then by their position in it.
template <int Dim>
std::int64_t RankPart<Dim>::key_of(const mesh::Mesh<Dim>& mesh, BoundaryFace face) const {
    const std::int32_t cell = cell_of(mesh, face);
    const auto faces = mesh.cell_faces[cell];
    const auto position = std::ranges::find(faces, mesh_face(mesh, face)) - faces.begin();
    return most_faces * static_cast<std::int64_t>(cell_numbers_[static_cast<std::size_t>(cell)]) + position;
}

template <int Dim>
void RankPart<Dim>::order_faces() {
    const std::vector<double> keys = ranks_.gather(std::vector<double>(face_keys_.begin(), face_keys_.end()));
    all_face_keys_.assign(keys.begin(), keys.end());
    std::ranges::sort(all_face_keys_);
    for (const double key : keys) gathered_position_.push_back(position_of(static_cast<std::int64_t>(key)));
}

/// Among the boundary faces of the whole mesh; their number where it does not have this one.
template <int Dim>
std::size_t RankPart<Dim>::position_of(std::int64_t key) const {
    const auto found = std::ranges::lower_bound(all_face_keys_, key);
    return found != all_face_keys_.end() && *found == key ? static_cast<std::size_t>(found - all_face_keys_.begin())
                                                          : all_face_keys_.size();
}

template <int Dim>
std::vector<Vector<Dim>> RankPart<Dim>::gather_faces(std::span<const Vector<Dim>> of_faces) const {
    std::vector<double> mine;
    for (const BoundaryFace face : own_faces_)
        for (const double value : of_faces[static_cast<std::size_t>(face)]) mine.push_back(value);
    const std::vector<double> all = ranks_.gather(mine);
    const auto vectors = as_vectors<Dim>(std::span<const double>(all));
    std::vector<Vector<Dim>> ordered(all_face_keys_.size());
    for (std::size_t i = 0; i < vectors.size(); ++i) ordered[gathered_position_[i]] = vectors[i];
    return ordered;
}

template <int Dim>
std::vector<Vector<Dim>> RankPart<Dim>::faces_here(const mesh::Mesh<Dim>& mesh, std::span<const Vector<Dim>> of_all) const {
    std::vector<Vector<Dim>> values;
    for (const BoundaryFace face : boundary_faces(mesh)) {
        const std::size_t position = position_of(key_of(mesh, face));
        values.push_back(position < of_all.size() ? of_all[position] : Vector<Dim>(Vector<Dim>::Zero()));
    }
    return values;
}

template <int Dim>
void RankPart<Dim>::set_body_begin(std::int32_t n_bodies) {
    std::vector<double> counts(static_cast<std::size_t>(n_bodies), 0.0);
    for (const std::int32_t body : body_) ++counts[static_cast<std::size_t>(body)];
    const std::vector<double> of_ranks = ranks_.gather(counts);
    body_begin_.assign(counts.size() + 1, 0);
    for (std::size_t i = 0; i < of_ranks.size(); ++i)
        body_begin_[i % counts.size() + 1] += static_cast<std::int32_t>(of_ranks[i]);
    for (std::size_t body = 0; body < counts.size(); ++body) body_begin_[body + 1] += body_begin_[body];
}

template <int Dim>
void RankPart<Dim>::find_first_cells() {
    const auto numbers = ranks_.numbers();
    for (const std::int32_t begin : body_begin_)
        own_begin_.push_back(static_cast<std::int32_t>(std::ranges::lower_bound(numbers, begin) - numbers.begin()));
    std::vector<double> mine;  // bodies
    for (std::size_t body = 0; body + 1 < body_begin_.size(); ++body) {
        const auto own = own_cells_of(body);
        if (own.empty() || numbers[static_cast<std::size_t>(own_begin_[body])] != body_begin_[body]) continue;
        own_first_cells_.push_back(own.front());
        mine.push_back(static_cast<double>(body));
    }
    for (const double body : ranks_.gather(mine)) gathered_body_.push_back(static_cast<std::size_t>(body));
}

template <int Dim>
std::vector<Vector<Dim>> RankPart<Dim>::of_first_cells(std::span<const Vector<Dim>> of_part) const {
    std::vector<double> mine;
    for (const std::int32_t cell : own_first_cells_)
        for (const double value : of_part[static_cast<std::size_t>(cell)]) mine.push_back(value);
    const std::vector<double> all = ranks_.gather(mine);
    const auto vectors = as_vectors<Dim>(std::span<const double>(all));
    std::vector<Vector<Dim>> of_bodies(body_begin_.size() - 1, Vector<Dim>::Zero());
    for (std::size_t i = 0; i < vectors.size(); ++i) of_bodies[gathered_body_[i]] = vectors[i];
    return of_bodies;
}

template <int Dim>
std::span<const Vector<Dim>> RankPart<Dim>::fill(std::span<const Vector<Dim>> q, std::vector<Vector<Dim>>& of_part) const {
    const auto own = own_cells();
    for (std::size_t i = 0; i < own.size(); ++i) of_part[static_cast<std::size_t>(own[i])] = q[i];
    ranks_.fill(as_values<Dim>(of_part), Dim, copies_);
    return of_part;
}

template <int Dim>
std::pair<std::span<const Vector<Dim>>, std::span<const Vector<Dim>>> RankPart<Dim>::step(std::span<const Vector<Dim>> q_0,
                                                                                          std::span<const Vector<Dim>> q_1) {
    std::swap(start_, end_);
    bool moved = false;
    const auto own = own_cells();
    for (std::size_t i = 0; i < own.size(); ++i) moved = moved || start_[static_cast<std::size_t>(own[i])] != q_0[i];
    if (any(moved)) fill(q_0, start_);
    fill(q_1, end_);
    return {start_, end_};
}

template <int Dim>
std::vector<Vector<Dim>> RankPart<Dim>::filled(std::span<const Vector<Dim>> q) const {
    std::vector<Vector<Dim>> of_part(state_.size());
    fill(q, of_part);
    return of_part;
}

template <int Dim>
std::vector<Vector<Dim>> RankPart<Dim>::own(std::span<const Vector<Dim>> of_part) const {
    std::vector<Vector<Dim>> values;
    for (const std::int32_t cell : own_cells()) values.push_back(of_part[static_cast<std::size_t>(cell)]);
    return values;
}

template <int Dim>
void RankPart<Dim>::take_result(std::span<Vector<Dim>> of_own) const {
    const auto own = own_cells();
    for (std::size_t i = 0; i < own.size(); ++i) of_own[i] = result_[static_cast<std::size_t>(own[i])];
}

template class RankPart<2>;
template class RankPart<3>;

}  // namespace abut::solid
