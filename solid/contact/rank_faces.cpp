#include "abut/solid/contact/rank_faces.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "abut/base/sort_unique.hpp"
#include "abut/solid/contact/contact_faces.hpp"
#include "abut/solid/contact/contact_patches.hpp"
#include "abut/solid/part/rank_sharing.hpp"
#include "abut/solid/part/value_reader.hpp"

namespace abut::solid {
namespace {

template <class Array>
void append(std::vector<double>& values, const Array& array) {
    for (const double value : array) values.push_back(value);
}

template <int Dim>
std::vector<Vector<Dim>> corners_of(const mesh::Mesh<Dim>& mesh, std::int32_t face) {
    std::vector<Vector<Dim>> corners;
    for (const std::int32_t v : mesh.face_vertices[face]) corners.push_back(mesh.vertices[v]);
    return corners;
}

/// On one rank.
template <int Dim>
class WholeFaces final : public SharedFaces<Dim> {
public:
    using Rest = typename SharedFaces<Dim>::Rest;

    WholeFaces(const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg) : mesh_(mesh), ccg_(ccg) {
        for (const BoundaryFace b : ccg.boundary_faces()) here_.push_back(b);
    }

    [[nodiscard]] Rest rest(std::size_t face) const override {
        const BoundaryFace b = here_[face];
        return {mesh_.cell_body[cell_of(mesh_, b)], contact_depth(mesh_, ccg_, b), ccg_.normal_stiffness(b),
                corners_of(mesh_, mesh_face(mesh_, b))};
    }
    [[nodiscard]] Vector<Dim> centroid(std::size_t face) const override { return ccg_.centroid(here_[face]); }
    [[nodiscard]] std::span<const std::int32_t> cells_of(std::size_t face) const override {
        return ccg_.cells_of(here_[face]);
    }
    [[nodiscard]] std::vector<dynamics::Hold<Dim>> holds_of(std::int32_t point) const override {
        return point < ccg_.n_cells() ? holds_of_cell(ccg_, point) : std::vector<dynamics::Hold<Dim>>{};
    }
    [[nodiscard]] bool is_own(std::size_t) const override { return true; }
    [[nodiscard]] contact::Sharing* sharing() override { return nullptr; }
    [[nodiscard]] std::vector<double> numbers_of_all(std::span<const double> of_own) const override {
        return {of_own.begin(), of_own.end()};
    }
    [[nodiscard]] std::vector<std::size_t> as_brought(std::span<const std::size_t>) const override { return {}; }
    void bring_displacement(std::span<const Vector<Dim>> of_boundary, std::span<Vector<Dim>> of_surface) const override {
        for (std::size_t i = 0; i < here_.size(); ++i) of_surface[i] = of_boundary[static_cast<std::size_t>(here_[i])];
    }
    void set_listed(std::span<const contact::Face> listed) override {
        own_listed_.clear();
        for (const contact::Face face : listed) own_listed_.push_back(here_[static_cast<std::size_t>(face)]);
    }
    void evaluate_listed(Ccg<Dim>& ccg, const Region<Dim>& region, std::span<const Vector<Dim>> q,
                         const BoundaryLoad<Dim>& load, std::span<Vector<Dim>> displacement,
                         std::span<Vector<Dim>> gradient) override {
        ccg.evaluate_faces(region, q, load, displacement, gradient);
    }
    [[nodiscard]] contact::FaceCoupling<Dim> coupling_of_all(contact::FaceCoupling<Dim> here) const override { return here; }

private:
    using SharedFaces<Dim>::here_;
    using SharedFaces<Dim>::own_listed_;

    const mesh::Mesh<Dim>& mesh_;
    const Ccg<Dim>& ccg_;
};

/// On several ranks. The constructor is a call of all of them.
template <int Dim>
class RankFaces final : public SharedFaces<Dim> {
public:
    using Rest = typename SharedFaces<Dim>::Rest;

    RankFaces(const RankPart<Dim>& part, const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg);

    [[nodiscard]] Rest rest(std::size_t face) const override { return faces_[face].rest; }
    [[nodiscard]] Vector<Dim> centroid(std::size_t face) const override { return faces_[face].centroid; }
    [[nodiscard]] std::span<const std::int32_t> cells_of(std::size_t face) const override { return faces_[face].cells; }
    [[nodiscard]] std::vector<dynamics::Hold<Dim>> holds_of(std::int32_t point) const override;
    [[nodiscard]] bool is_own(std::size_t face) const override { return faces_[face].owner == part_.ranks().rank(); }
    [[nodiscard]] contact::Sharing* sharing() override { return &sharing_; }
    [[nodiscard]] std::vector<double> numbers_of_all(std::span<const double> of_own) const override;
    [[nodiscard]] std::vector<std::size_t> as_brought(std::span<const std::size_t> faces) const override;
    void bring_displacement(std::span<const Vector<Dim>> of_boundary, std::span<Vector<Dim>> of_surface) const override;
    void set_listed(std::span<const contact::Face> listed) override;
    void evaluate_listed(Ccg<Dim>& ccg, const Region<Dim>& region, std::span<const Vector<Dim>> q,
                         const BoundaryLoad<Dim>& load, std::span<Vector<Dim>> displacement,
                         std::span<Vector<Dim>> gradient) override;
    [[nodiscard]] contact::FaceCoupling<Dim> coupling_of_all(contact::FaceCoupling<Dim> here) const override;

private:
    using SharedFaces<Dim>::here_;
    using SharedFaces<Dim>::own_listed_;

    struct Face {
        std::int64_t key;
        int owner;
        Rest rest;
        Vector<Dim> centroid;             // at rest
        std::vector<std::int32_t> cells;  // that move it, by their numbers in the whole mesh
    };

    void append_own(const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg, BoundaryFace face, std::int64_t key,
                    std::vector<double>& values) const;
    void take_all(std::span<const double> values);
    void gather_holds(const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg);
    void find_here(const mesh::Mesh<Dim>& mesh);

    const RankPart<Dim>& part_;
    RankSharing sharing_;
    std::vector<Face> faces_;                                          // in the order of the whole mesh
    std::vector<std::pair<std::int32_t, dynamics::Hold<Dim>>> holds_;  // of cells, by their numbers in the whole mesh
    std::vector<std::size_t> all_as_brought_;                          // faces as `gather` brings them: rank after rank
    std::vector<std::size_t> listed_;                                  // in the surface
    std::vector<std::size_t> listed_as_brought_;                       // in the list
    std::vector<Vector<Dim>> own_displacement_, own_gradient_;         // work arrays of `evaluate_listed`
};

template <int Dim>
RankFaces<Dim>::RankFaces(const RankPart<Dim>& part, const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg)
    : part_(part), sharing_(part.ranks()) {
    std::vector<double> mine{static_cast<double>(part.own_faces().size())};  // then the faces
    for (std::size_t i = 0; i < part.own_faces().size(); ++i)
        append_own(mesh, ccg, part.own_faces()[i], part.face_keys()[i], mine);
    take_all(part.ranks().gather(mine));
    gather_holds(mesh, ccg);
    find_here(mesh);
}

template <int Dim>
void RankFaces<Dim>::append_own(const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg, BoundaryFace face, std::int64_t key,
                                std::vector<double>& values) const {
    const std::int32_t in_mesh = mesh_face(mesh, face);
    const auto corners = mesh.face_vertices[in_mesh];
    values.insert(values.end(), {static_cast<double>(key), static_cast<double>(mesh.cell_body[cell_of(mesh, face)]),
                                 contact_depth(mesh, ccg, face), ccg.normal_stiffness(face),
                                 static_cast<double>(corners.size()), static_cast<double>(ccg.cells_of(face).size())});
    append(values, mesh.face_centroid[in_mesh]);
    for (const std::int32_t v : corners) append(values, mesh.vertices[v]);
    for (const std::int32_t c : ccg.cells_of(face)) values.push_back(part_.cell_numbers()[static_cast<std::size_t>(c)]);
}

template <int Dim>
void RankFaces<Dim>::take_all(std::span<const double> values) {
    ValueReader reader(values);
    for (int rank = 0; !reader.is_done(); ++rank)
        for (auto left = reader.next_as<std::int64_t>(); left > 0; --left) {
            Face& face = faces_.emplace_back();
            face.key = reader.next_as<std::int64_t>();
            face.owner = rank;
            face.rest.body = reader.next_as<std::int32_t>();
            face.rest.depth = reader.next();
            face.rest.stiffness = reader.next();
            face.rest.corners.resize(reader.next_as<std::size_t>());
            face.cells.resize(reader.next_as<std::size_t>());
            face.centroid = reader.next_array<Vector<Dim>>();
            for (Vector<Dim>& corner : face.rest.corners) corner = reader.next_array<Vector<Dim>>();
            for (std::int32_t& cell : face.cells) cell = reader.next_as<std::int32_t>();
        }
    std::ranges::sort(faces_, {}, &Face::key);
    std::vector<std::size_t> all(faces_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    all_as_brought_ = as_brought(all);
}

template <int Dim>
void RankFaces<Dim>::gather_holds(const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg) {
    std::vector<std::int32_t> cells;
    for (const BoundaryFace face : part_.own_faces())
        if (!ccg.prescribed()[face].isZero(0.0)) cells.push_back(cell_of(mesh, face));
    sort_unique(cells);
    std::vector<double> mine;  // cell, hold
    for (const std::int32_t c : cells)
        for (const dynamics::Hold<Dim>& hold : holds_of_cell(ccg, c)) {
            mine.push_back(part_.cell_numbers()[static_cast<std::size_t>(c)]);
            append(mine, hold.position);
            append(mine, hold.direction);
        }
    const std::vector<double> all = part_.ranks().gather(mine);
    for (ValueReader reader(all); !reader.is_done();) {
        const auto cell = reader.next_as<std::int32_t>();
        const auto position = reader.next_array<Vector<Dim>>(), direction = reader.next_array<Vector<Dim>>();
        holds_.emplace_back(cell, dynamics::Hold<Dim>{position, direction});
    }
    std::ranges::stable_sort(holds_, {}, [](const auto& entry) { return entry.first; });
}

template <int Dim>
std::vector<dynamics::Hold<Dim>> RankFaces<Dim>::holds_of(std::int32_t point) const {
    std::vector<dynamics::Hold<Dim>> holds;
    for (const auto& entry : std::ranges::equal_range(holds_, point, {}, [](const auto& of) { return of.first; }))
        holds.push_back(entry.second);
    return holds;
}

/// Faces with the same key. Where the part ends inside a body it has others, of which the surface knows nothing.
template <int Dim>
void RankFaces<Dim>::find_here(const mesh::Mesh<Dim>& mesh) {
    here_.assign(faces_.size(), no_face);
    for (const BoundaryFace b : boundary_faces(mesh)) {
        const std::int64_t key = part_.key_of(mesh, b);
        const auto found = std::ranges::lower_bound(faces_, key, {}, &Face::key);
        if (found != faces_.end() && found->key == key) here_[static_cast<std::size_t>(found - faces_.begin())] = b;
    }
}

template <int Dim>
std::vector<std::size_t> RankFaces<Dim>::as_brought(std::span<const std::size_t> faces) const {
    std::vector<std::size_t> order(faces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return faces_[faces[i]].owner; });
    return order;
}

template <int Dim>
std::vector<double> RankFaces<Dim>::numbers_of_all(std::span<const double> of_own) const {
    const std::vector<double> all = part_.ranks().gather(of_own);
    std::vector<double> of_faces(faces_.size());
    for (std::size_t i = 0; i < all.size(); ++i) of_faces[all_as_brought_[i]] = all[i];
    return of_faces;
}

template <int Dim>
void RankFaces<Dim>::bring_displacement(std::span<const Vector<Dim>> of_boundary, std::span<Vector<Dim>> of_surface) const {
    std::vector<double> mine;
    for (std::size_t i = 0; i < faces_.size(); ++i)
        if (is_own(i)) append(mine, of_boundary[static_cast<std::size_t>(here_[i])]);
    const std::vector<double> all = part_.ranks().gather(mine);
    ValueReader reader(all);
    for (const std::size_t i : all_as_brought_) of_surface[i] = reader.next_array<Vector<Dim>>();
}

template <int Dim>
void RankFaces<Dim>::set_listed(std::span<const contact::Face> listed) {
    listed_.clear();
    own_listed_.clear();
    for (const contact::Face face : listed) {
        const auto i = static_cast<std::size_t>(face);
        listed_.push_back(i);
        if (is_own(i)) own_listed_.push_back(here_[i]);
    }
    listed_as_brought_ = as_brought(listed_);
}

template <int Dim>
void RankFaces<Dim>::evaluate_listed(Ccg<Dim>& ccg, const Region<Dim>& region, std::span<const Vector<Dim>> q,
                                     const BoundaryLoad<Dim>& load, std::span<Vector<Dim>> displacement,
                                     std::span<Vector<Dim>> gradient) {
    for (auto* array : {&own_displacement_, &own_gradient_}) array->resize(region.faces.size());
    ccg.evaluate_faces(region, q, load, own_displacement_, own_gradient_);
    if (listed_.empty()) return;
    std::vector<double> mine;
    for (std::size_t i = 0; i < own_displacement_.size(); ++i) {
        append(mine, own_displacement_[i]);
        append(mine, own_gradient_[i]);
    }
    const std::vector<double> all = part_.ranks().gather(mine);
    ValueReader reader(all);
    for (const std::size_t i : listed_as_brought_) {
        displacement[i] = reader.next_array<Vector<Dim>>();
        gradient[i] = reader.next_array<Vector<Dim>>();
    }
}

template <int Dim>
contact::FaceCoupling<Dim> RankFaces<Dim>::coupling_of_all(contact::FaceCoupling<Dim> here) const {
    std::vector<std::size_t> in_list;  // of the rows here
    for (std::size_t i = 0; i < listed_.size(); ++i)
        if (here_[listed_[i]] != no_face) in_list.push_back(i);
    std::vector<double> mine;  // rows of own faces: number of columns; columns with their blocks
    for (std::size_t row = 0; row < in_list.size(); ++row) {
        if (!is_own(listed_[in_list[row]])) continue;
        mine.push_back(here.offsets[row + 1] - here.offsets[row]);
        for (auto k = static_cast<std::size_t>(here.offsets[row]); k < static_cast<std::size_t>(here.offsets[row + 1]);
             ++k) {
            mine.push_back(static_cast<double>(in_list[static_cast<std::size_t>(here.columns[k])]));
            append(mine, here.blocks[k]);
        }
    }
    struct Row {
        std::vector<std::int32_t> columns;
        std::vector<Matrix<Dim>> blocks;
    };
    std::vector<Row> rows(listed_.size());
    const std::vector<double> all = part_.ranks().gather(mine);
    ValueReader reader(all);
    for (const std::size_t i : listed_as_brought_)
        for (auto left = reader.next_as<std::int32_t>(); left > 0; --left) {
            rows[i].columns.push_back(reader.next_as<std::int32_t>());
            rows[i].blocks.push_back(reader.next_array<Matrix<Dim>>());
        }
    contact::FaceCoupling<Dim> coupling;
    for (const Row& row : rows) {
        coupling.columns.insert(coupling.columns.end(), row.columns.begin(), row.columns.end());
        coupling.blocks.insert(coupling.blocks.end(), row.blocks.begin(), row.blocks.end());
        coupling.offsets.push_back(static_cast<std::int32_t>(coupling.columns.size()));
    }
    return coupling;
}

}  // namespace

template <int Dim>
std::unique_ptr<SharedFaces<Dim>> shared_faces(const RankPart<Dim>& part, const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg) {
    if (part.is_whole()) return std::make_unique<WholeFaces<Dim>>(mesh, ccg);
    return std::make_unique<RankFaces<Dim>>(part, mesh, ccg);
}

template std::unique_ptr<SharedFaces<2>> shared_faces(const RankPart<2>&, const mesh::Mesh<2>&, const Ccg<2>&);
template std::unique_ptr<SharedFaces<3>> shared_faces(const RankPart<3>&, const mesh::Mesh<3>&, const Ccg<3>&);

}  // namespace abut::solid
