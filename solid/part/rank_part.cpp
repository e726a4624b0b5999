#include "abut/solid/part/rank_part.hpp"

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
RankPart<Dim>::RankPart(const dynamics::Ranks& ranks, const SolidPoints<Dim>& points)
    : is_whole_(ranks.is_one()),
      one_(is_whole_ ? static_cast<std::int32_t>(points.rest.size()) : 0, Dim),
      ranks_(is_whole_ ? one_ : ranks),
      n_points_(points.rest.size()) {
    const mesh::Mesh<Dim>& mesh = points.deformable;
    check(points);
    const auto positions = ranks_.positions();
    n_own_cells_ = static_cast<std::size_t>(std::ranges::lower_bound(positions, mesh.n_cells()) - positions.begin());
    own_cells_ = positions.first(n_own_cells_);
    take_points(points);
    set_cell_numbers(mesh);
    std::vector<bool> is_own(static_cast<std::size_t>(mesh.n_cells()), false);
    for (const std::int32_t cell : own_cells()) is_own[static_cast<std::size_t>(cell)] = true;
    for (const BoundaryFace face : boundary_faces(mesh)) {
        if (!is_own[static_cast<std::size_t>(cell_of(mesh, face))]) continue;
        own_faces_.push_back(face);
        face_keys_.push_back(key_of(mesh, face));
    }
    order_faces();
    set_body_begin(mesh);
    find_first_cells();
    find_own_rigid(points.rigid);
    check_rigid(points);
}

template <int Dim>
void RankPart<Dim>::take_points(const SolidPoints<Dim>& points) {
    rest_ = points.rest;
    masses_ = points.masses;
    inverse_masses_ = points.inverse_masses;
    body_ = points.body;
    if (is_whole_) return;
    for (const std::int32_t position : ranks_.positions()) {
        const auto point = static_cast<std::size_t>(position);
        rest_here_.push_back(rest_[point]);
        masses_here_.push_back(masses_[point]);
        inverse_masses_here_.insert(inverse_masses_here_.end(), Dim, inverse_masses_[point * Dim]);
        body_here_.push_back(body_[point]);
    }
    rest_ = rest_here_;
    masses_ = masses_here_;
    inverse_masses_ = inverse_masses_here_;
    body_ = body_here_;
    for (auto* array : {&state_, &start_, &end_}) array->assign(n_points_, Vector<Dim>::Constant(std::nan("")));
    result_.assign(n_points_, Vector<Dim>::Zero());
}

template <int Dim>
void RankPart<Dim>::take_rest(std::span<const Vector<Dim>> rest) {
    for (std::size_t i = 0; i < rest_here_.size(); ++i)
        rest_here_[i] = rest[static_cast<std::size_t>(ranks_.positions()[i])];
}

template <int Dim>
void RankPart<Dim>::check(const SolidPoints<Dim>& points) const {
    dynamics::agreed(ranks_, [&] {
        const auto own = ranks_.positions();
        const bool rises = std::ranges::adjacent_find(own, std::greater_equal{}) == own.end();
        if (ranks_.dimension() != Dim || !rises ||
            (!own.empty() && (own.front() < 0 || own.back() >= std::ssize(points.rest))))
            throw BadInput(points.name + ": the ranks are of points with " + std::to_string(ranks_.dimension()) +
                           " values, or at positions that this part does not have. Take both from one mesh::MeshPart "
                           "(solid::part_of, solid::points_of).");
    });
}

template <int Dim>
void RankPart<Dim>::set_cell_numbers(const mesh::Mesh<Dim>& mesh) {
    cell_numbers_.resize(n_points_);
    for (std::size_t i = 0; i < ranks_.positions().size(); ++i)
        cell_numbers_[static_cast<std::size_t>(ranks_.positions()[i])] = ranks_.numbers()[i];
    ranks_.fill(cell_numbers_, 1, dynamics::CopySet::all);
    dynamics::agreed(ranks_, [&] {
        if (std::ranges::adjacent_find(cell_numbers_, std::greater_equal{}) != cell_numbers_.end())
            throw BadInput(mesh.name +
                           ": the ranks do not fit the points of this part: their numbers do not rise. Take both from one "
                           "mesh::MeshPart (solid::part_of, solid::points_of).");
    });
    cell_numbers_.resize(static_cast<std::size_t>(mesh.n_cells()));
}

template <int Dim>
void RankPart<Dim>::fill_only(std::span<const std::int32_t> cells) {
    std::vector<std::int32_t> filled(cells.begin(), cells.end());
    for (auto point = cell_numbers_.size(); point < n_points_; ++point) filled.push_back(static_cast<std::int32_t>(point));
    copies_ = ranks_.copy_set(filled);
}

template <int Dim>
std::int32_t RankPart<Dim>::position_of(std::int32_t number) const {
    if (number >= n_all_cells()) return number - n_all_cells() + static_cast<std::int32_t>(cell_numbers_.size());
    return static_cast<std::int32_t>(std::ranges::lower_bound(cell_numbers_, number) - cell_numbers_.begin());
}

/// Faces are numbered by their cell, then by their position in it.
template <int Dim>
std::int64_t RankPart<Dim>::key_of(const mesh::Mesh<Dim>& mesh, BoundaryFace face) const {
    const std::int32_t cell = cell_of(mesh, face);
    const auto faces = mesh.cell_faces[cell];
    return key_of(cell, std::ranges::find(faces, mesh_face(mesh, face)) - faces.begin());
}

template <int Dim>
std::int64_t RankPart<Dim>::key_of(std::int32_t cell, std::ptrdiff_t position) const {
    return most_faces * static_cast<std::int64_t>(cell_numbers_[static_cast<std::size_t>(cell)]) + position;
}

template <int Dim>
void RankPart<Dim>::order_faces() {
    const std::vector<double> keys = ranks_.gather(std::vector<double>(face_keys_.begin(), face_keys_.end()));
    all_face_keys_.assign(keys.begin(), keys.end());
    std::ranges::sort(all_face_keys_);
    for (const double key : keys) gathered_position_.push_back(face_number(static_cast<std::int64_t>(key)));
}

template <int Dim>
std::size_t RankPart<Dim>::face_number(std::int64_t key) const {
    const auto found = std::ranges::lower_bound(all_face_keys_, key);
    return found != all_face_keys_.end() && *found == key ? static_cast<std::size_t>(found - all_face_keys_.begin())
                                                          : all_face_keys_.size();
}

template <int Dim>
std::vector<BoundaryFace> RankPart<Dim>::faces_by_number(const mesh::Mesh<Dim>& mesh) const {
    std::vector<BoundaryFace> faces(n_all_faces(), no_face);
    for (const BoundaryFace face : boundary_faces(mesh))
        if (const std::size_t number = face_number(key_of(mesh, face)); number < faces.size()) faces[number] = face;
    return faces;
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
        const std::size_t position = face_number(key_of(mesh, face));
        values.push_back(position < of_all.size() ? of_all[position] : Vector<Dim>::Zero());
    }
    return values;
}

template <int Dim>
void RankPart<Dim>::set_body_begin(const mesh::Mesh<Dim>& mesh) {
    std::vector<double> counts(static_cast<std::size_t>(mesh.n_bodies()), 0.0);
    for (const std::int32_t cell : own_cells()) ++counts[static_cast<std::size_t>(mesh.cell_body[cell])];
    const std::vector<double> of_ranks = ranks_.gather(counts);
    body_begin_.assign(counts.size() + 1, 0);
    for (std::size_t i = 0; i < of_ranks.size(); ++i)
        body_begin_[i % counts.size() + 1] += static_cast<std::int32_t>(of_ranks[i]);
    for (std::size_t body = 0; body < counts.size(); ++body) body_begin_[body + 1] += body_begin_[body];
}

template <int Dim>
void RankPart<Dim>::find_first_cells() {
    const auto numbers = ranks_.numbers().first(n_own_cells_);
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
    if (is_whole_) {
        std::vector<Vector<Dim>> of_bodies;
        for (const std::int32_t cell : own_first_cells_) of_bodies.push_back(of_part[static_cast<std::size_t>(cell)]);
        return of_bodies;
    }
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
void RankPart<Dim>::find_own_rigid(std::span<const std::int32_t> first_points) {
    const auto own_points = ranks_.positions().subspan(n_own_cells_);
    for (std::size_t body = 0; body < first_points.size(); ++body)
        if (std::ranges::binary_search(own_points, first_points[body]))
            own_rigid_.push_back(static_cast<std::int32_t>(body));
    for (const double body : ranks_.gather(std::vector<double>(own_rigid_.begin(), own_rigid_.end())))
        gathered_rigid_.push_back(static_cast<std::size_t>(body));
}

/// One rank owns all points of a body, and they are where it has them only if all cells of the body are here.
template <int Dim>
void RankPart<Dim>::check_rigid(const SolidPoints<Dim>& points) const {
    if (is_whole_ || points.rigid.empty()) return;
    constexpr std::size_t width = Dim + 1;
    std::vector<double> here;  // rest position and mass of each point
    for (std::size_t i = 0; i < points.rest.size(); ++i) {
        here.insert(here.end(), points.rest[i].begin(), points.rest[i].end());
        here.push_back(points.masses[i]);
    }
    std::vector<double> of_owner = here;
    ranks_.fill(of_owner, width, dynamics::CopySet::all);
    dynamics::agreed(ranks_, [&] {
        if (ranks_.positions().size() != n_own_cells_ + own_rigid_.size() * points_per_rigid_body<Dim> ||
            gathered_rigid_.size() != points.rigid.size())
            throw BadInput(points.name +
                           ": the points of a rigid body are on several ranks. Give them to one (solid::points_of).");
        for (std::size_t i = width * cell_numbers_.size(); i < here.size(); ++i)
            if (here[i] != of_owner[i])
                throw BadInput(points.name + ": rigid body " + std::to_string(points.body[i / width]) +
                               " is another one than at the rank that owns it. Give each rank the whole of it "
                               "(solid::part_of).");
    });
}

template <int Dim>
std::vector<double> RankPart<Dim>::gather_rigid(std::span<const double> of_own) const {
    const std::vector<double> all = ranks_.gather(of_own);
    if (all.empty()) return all;
    const std::size_t width = all.size() / gathered_rigid_.size();
    std::vector<double> by_body(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) by_body[gathered_rigid_[i / width] * width + i % width] = all[i];
    return by_body;
}

template <int Dim>
void RankPart<Dim>::spread_rigid(std::span<const Vector<Dim>> of_own, std::vector<Vector<Dim>>& of_part) const {
    of_part.resize(n_points_);
    const auto positions = ranks_.positions();
    for (std::size_t i = n_own_cells_; i < positions.size(); ++i)
        of_part[static_cast<std::size_t>(positions[i])] = of_own[i];
}

template <int Dim>
void RankPart<Dim>::take_rigid(std::span<const Vector<Dim>> of_part, std::span<Vector<Dim>> of_own) const {
    const auto positions = ranks_.positions();
    for (std::size_t i = n_own_cells_; i < positions.size(); ++i)
        of_own[i] = of_part[static_cast<std::size_t>(positions[i])];
}

template <int Dim>
void RankPart<Dim>::fill(std::span<const Vector<Dim>> q, std::vector<Vector<Dim>>& of_part) const {
    const auto own = ranks_.positions();
    for (std::size_t i = 0; i < own.size(); ++i) of_part[static_cast<std::size_t>(own[i])] = q[i];
    ranks_.fill(as_values<Dim>(of_part), Dim, copies_);
}

template <int Dim>
std::pair<std::span<const Vector<Dim>>, std::span<const Vector<Dim>>> RankPart<Dim>::step(std::span<const Vector<Dim>> q_0,
                                                                                          std::span<const Vector<Dim>> q_1) {
    if (is_whole_) return {q_0, q_1};
    std::swap(start_, end_);
    bool moved = false;
    const auto own = ranks_.positions();
    for (std::size_t i = 0; i < own.size(); ++i) moved = moved || start_[static_cast<std::size_t>(own[i])] != q_0[i];
    if (any(moved)) fill(q_0, start_);
    fill(q_1, end_);
    return {start_, end_};
}

template <int Dim>
std::span<const Vector<Dim>> RankPart<Dim>::filled(std::span<const Vector<Dim>> q, std::vector<Vector<Dim>>& kept) const {
    if (is_whole_) return q;
    kept.resize(n_points_);
    fill(q, kept);
    return kept;
}

template <int Dim>
std::vector<double> RankPart<Dim>::of_owners(std::span<const double> of_cells) const {
    std::vector<double> values(of_cells.begin(), of_cells.end());
    values.resize(n_points_);
    ranks_.fill(values, 1, dynamics::CopySet::all);
    values.resize(of_cells.size());
    return values;
}

template <int Dim>
std::vector<Vector<Dim>> RankPart<Dim>::own(std::span<const Vector<Dim>> of_part) const {
    std::vector<Vector<Dim>> values;
    for (const std::int32_t point : ranks_.positions()) values.push_back(of_part[static_cast<std::size_t>(point)]);
    return values;
}

template <int Dim>
void RankPart<Dim>::take_result(std::span<Vector<Dim>> of_own) const {
    if (is_whole_) return;
    const auto own = ranks_.positions();
    for (std::size_t i = 0; i < own.size(); ++i) of_own[i] = result_[static_cast<std::size_t>(own[i])];
}

template class RankPart<2>;
template class RankPart<3>;

}  // namespace abut::solid
