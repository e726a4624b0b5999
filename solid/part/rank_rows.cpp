#include "abut/solid/part/rank_rows.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/sort_unique.hpp"

namespace abut::solid {
namespace {

/// A number that tells rows apart, of so many bits that it is a double (FNV-1a, cut).
class Fingerprint {
public:
    void add(std::int64_t value) {
        for (int byte = 0; byte < 8; ++byte) {
            hash_ ^= static_cast<std::uint64_t>(value >> 8 * byte) & 0xff;
            hash_ *= 0x100000001b3u;
        }
    }
    void add(double value) { add(std::bit_cast<std::int64_t>(value)); }
    template <int Dim>
    void add(const Matrix<Dim>& matrix) {
        for (const double value : matrix) add(value);
    }
    [[nodiscard]] double number() const { return static_cast<double>(hash_ >> 12); }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

[[noreturn]] void refuse_rows(const std::string& what) {
    throw BadInput(what + " Give ranks more layers of copies (solid::part_of).");
}

template <int Dim>
class RowCheck {
public:
    RowCheck(const RankPart<Dim>& part, const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg)
        : part_(part), mesh_(mesh), ccg_(ccg), number_(part.cell_numbers()) {
        boundary_.assign(static_cast<std::size_t>(mesh.n_faces()), no_face);
        for (const BoundaryFace b : boundary_faces(mesh)) boundary_[static_cast<std::size_t>(mesh_face(mesh, b))] = b;
    }

    /// Checks copies of the cells that forces on own cells depend on: the same faces and rows as at their owners.
    void check_copies() const {
        const Region<Dim> region = ccg_.region_of_cells(part_.own_cells());
        std::vector<double> here(number_.size());
        for (std::int32_t c = 0; c < mesh_.n_cells(); ++c) here[static_cast<std::size_t>(c)] = fingerprint(c);
        const std::vector<double> of_owner = part_.of_owners(here);
        dynamics::agreed(part_.ranks(), [&] {
            std::vector<std::int32_t> cells = region.displacement_gradient_cells;
            for (const std::int32_t f : region.reconstructed) cells.push_back(mesh_.face_cells[f][0]);
            for (const BoundaryFace b : region.reconstructed_boundary) cells.push_back(cell_of(mesh_, b));
            sort_unique(cells);
            for (const std::int32_t c : cells)
                if (const auto i = static_cast<std::size_t>(c); here[i] != of_owner[i])
                    refuse_rows(mesh_.name + ": cell " + std::to_string(mesh_.cell_label[i]) +
                                " has other faces, or other cells in their reconstruction, than at the rank that owns it.");
        });
    }

    /// Faces whose displacement is made of an own cell are here.
    void check_uses() const {
        const auto own = part_.own_cells();
        std::vector<bool> is_own(number_.size(), false);
        for (const std::int32_t c : own) is_own[static_cast<std::size_t>(c)] = true;
        std::vector<double> foreign;                   // cell used, cell of the face, by numbers
        std::vector<std::pair<double, double>> known;  // the same of own cells that are used here
        const auto visit = [&](std::int32_t cell, std::int32_t used) {
            const auto i = static_cast<std::size_t>(cell), j = static_cast<std::size_t>(used);
            if (is_own[j]) known.emplace_back(number_[j], number_[i]);
            if (is_own[i] && !is_own[j]) foreign.insert(foreign.end(), {number_[j], number_[i]});
        };
        for (std::int32_t f = 0; f < mesh_.n_faces(); ++f) {
            const std::int32_t cell = mesh_.face_cells[f][0];
            if (const BoundaryFace b = boundary_[static_cast<std::size_t>(f)]; b != no_face)
                for (const std::int32_t used : ccg_.cells_of(b)) visit(cell, used);
            for (const std::int32_t used : ccg_.stencils()[static_cast<std::size_t>(f)].cells) visit(cell, used);
        }
        sort_unique(known);
        const std::vector<double> all = part_.ranks().gather(foreign);
        dynamics::agreed(part_.ranks(), [&] {
            const auto numbers = part_.ranks().numbers();
            for (std::size_t i = 0; i < all.size(); i += 2)
                if (std::ranges::binary_search(numbers, static_cast<std::int32_t>(all[i])) &&
                    !std::ranges::binary_search(known, std::pair(all[i], all[i + 1])))
                    refuse_rows(mesh_.name + ": a face of cell " + std::to_string(static_cast<std::int64_t>(all[i + 1])) +
                                " (counted from 0 in the whole mesh) is reconstructed from cell " +
                                std::to_string(static_cast<std::int64_t>(all[i])) + ", whose rank does not have it.");
        });
    }

private:
    /// Fingerprint of what a cell brings along: which of its faces are boundary, and the rows of those whose first side
    /// it is.
    [[nodiscard]] double fingerprint(std::int32_t cell) const {
        Fingerprint print;
        for (const std::int32_t f : mesh_.cell_faces[cell]) {
            const BoundaryFace b = boundary_[static_cast<std::size_t>(f)];
            print.add(std::int64_t{b != no_face});
            if (mesh_.face_cells[f][0] != cell) continue;
            const FaceStencil<Dim>& stencil = ccg_.stencils()[static_cast<std::size_t>(f)];
            for (std::size_t j = 0; j <= Dim; ++j) {
                print.add(number_[static_cast<std::size_t>(stencil.cells[j])]);
                print.add(stencil.weights[j]);
            }
            if (b == no_face) continue;
            const BoundaryReconstruction<Dim>& boundary = ccg_.boundary();
            print.add(boundary.normal_stiffness[static_cast<std::size_t>(b)]);
            for (std::int32_t i = boundary.offsets[number_of(b)]; i < boundary.offsets[number_of(b) + 1]; ++i) {
                print.add(number_[static_cast<std::size_t>(boundary.cells[static_cast<std::size_t>(i)])]);
                print.template add<Dim>(boundary.weights[static_cast<std::size_t>(i)]);
            }
        }
        return print.number();
    }

    const RankPart<Dim>& part_;
    const mesh::Mesh<Dim>& mesh_;
    const Ccg<Dim>& ccg_;
    std::span<const double> number_;      // of each cell in the whole mesh
    std::vector<BoundaryFace> boundary_;  // of each face
};

}  // namespace

template <int Dim>
void check_rows_of_ranks(const RankPart<Dim>& part, const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg) {
    const RowCheck<Dim> check(part, mesh, ccg);
    check.check_copies();
    check.check_uses();
}

template void check_rows_of_ranks(const RankPart<2>&, const mesh::Mesh<2>&, const Ccg<2>&);
template void check_rows_of_ranks(const RankPart<3>&, const mesh::Mesh<3>&, const Ccg<3>&);

}  // namespace abut::solid
