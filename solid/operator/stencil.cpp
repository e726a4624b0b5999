#include "abut/solid/operator/stencil.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <nanoflann.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/solid/operator/joined_cells.hpp"

namespace abut::solid {
namespace {

template <int Dim>
inline constexpr std::size_t n_nearest = Dim == 2 ? 10 : 14;
inline constexpr double volume_floor = 0.05;  // of the volume of the face's first cell
inline constexpr int max_floor_halvings = 20;
inline constexpr double extrapolation_step = 1e-3;
inline constexpr double resolution = 1e-6;  // relative: numbers nearer to each other differ by rounding only
inline constexpr double one_surface = 0.5;  // cosine of the angle between normals of faces of one surface, at least
inline constexpr double as_deep = 0.999;    // a cell below this of its own depth stands around a hollow

/// Centroids of one body's cells (a contiguous range), as nanoflann wants them.
template <int Dim>
struct BodyCentroids {
    std::span<const Vector<Dim>> points;
    std::int32_t first_cell;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return points[i][static_cast<std::ptrdiff_t>(axis)];
    }
    template <class Bounds>
    bool kdtree_get_bbox(Bounds&) const {
        return false;
    }
};

template <int Dim>
class NearestCells {
public:
    struct Near {
        double distance;
        std::int32_t cell;
    };

    NearestCells(const mesh::Mesh<Dim>& mesh) {
        std::int32_t begin = 0;
        for (std::int32_t body = 0; body < mesh.n_bodies(); ++body) {
            const auto end = static_cast<std::int32_t>(std::upper_bound(mesh.cell_body.begin(), mesh.cell_body.end(), body) -
                                                       mesh.cell_body.begin());
            bodies_.push_back(std::make_unique<BodyTree>(
                BodyCentroids<Dim>{{mesh.cell_centroid.data() + begin, static_cast<std::size_t>(end - begin)}, begin}));
            begin = end;
        }
    }

    /// The nearest `wanted` cells of a body, or all if it has fewer, by distance, then number. Distances are whole multiples
    /// of `resolution` times the least one: which of two equal ones rounding made the smaller does not count, so that a mesh
    /// has the same stencils in any unit of length and anywhere.
    /// `guess` holds cells that may be near, of the query before: it saves time and changes nothing.
    [[nodiscard]] std::vector<Near> find(std::int32_t body, const Vector<Dim>& point, std::size_t wanted,
                                         std::vector<std::int32_t>& guess) const {
        const BodyTree& tree = *bodies_[body];
        auto near = tree.find(point, wanted + with_ties, guess);
        // Of cells at one distance the tree found some: look at all of them.
        if (near.size() == wanted + with_ties && near[wanted - 1].distance == near.back().distance)
            near = tree.find(point, 2 * wanted, guess);
        near.resize(std::min(near.size(), wanted));
        return near;
    }

private:
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, BodyCentroids<Dim>>,
                                                     BodyCentroids<Dim>, Dim, std::uint32_t>;
    static constexpr std::size_t with_ties = 3;

    struct BodyTree {
        explicit BodyTree(BodyCentroids<Dim> c) : centroids(c), index(Dim, centroids) { index.buildIndex(); }

        /// The nearest `count` cells, or all if there are fewer, by distance, then number.
        [[nodiscard]] std::vector<Near> find(const Vector<Dim>& point, std::size_t count,
                                             std::vector<std::int32_t>& guess) const {
            std::vector<std::uint32_t> place(count);
            std::vector<double> squared(count);
            nanoflann::KNNResultSet<double, std::uint32_t> found(count);
            found.init(place.data(), squared.data());
            squared.back() = bound_of(point, count, guess);
            index.findNeighbors(found, point.data(), nanoflann::SearchParams());
            const std::size_t n = found.size();
            const double unit = n > 0 && squared[0] > 0.0 ? resolution * std::sqrt(squared[0]) : 1.0;
            std::vector<Near> near;
            near.reserve(n);
            guess.clear();
            for (std::size_t i = 0; i < n; ++i) {
                guess.push_back(centroids.first_cell + static_cast<std::int32_t>(place[i]));
                near.push_back({std::round(std::sqrt(squared[i]) / unit), guess.back()});
            }
            std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) {
                return std::tie(a.distance, a.cell) < std::tie(b.distance, b.cell);
            });
            return near;
        }
        /// A squared distance within which there are `count` cells for sure: the tree need not look beyond.
        [[nodiscard]] double bound_of(const Vector<Dim>& point, std::size_t count,
                                      std::span<const std::int32_t> guess) const {
            const auto n = static_cast<std::int32_t>(centroids.points.size());
            double farthest = 0.0;
            std::size_t n_known = 0;
            for (const std::int32_t cell : guess) {
                const std::int32_t i = cell - centroids.first_cell;
                if (i < 0 || i >= n || n_known == count) continue;
                farthest = std::max(farthest, (centroids.points[i] - point).squaredNorm());
                ++n_known;
            }
            return n_known == count && farthest > 0.0 ? (1.0 + resolution) * farthest : std::numeric_limits<double>::max();
        }

        BodyCentroids<Dim> centroids;
        Tree index;
    };
    std::vector<std::unique_ptr<BodyTree>> bodies_;
};

/// A simplex of cells around a point. The less, the better.
template <int Dim>
struct Candidate {
    FaceStencil<Dim> stencil{};
    double extrapolation = std::numeric_limits<double>::infinity();  // whole steps; infinite: none was found
    double distances = std::numeric_limits<double>::infinity();      // their sum
    std::array<std::int32_t, Dim + 1> cells{};                       // in increasing order

    bool operator<(const Candidate& other) const {
        return std::tie(extrapolation, distances, cells) < std::tie(other.extrapolation, other.distances, other.cells);
    }
    [[nodiscard]] std::optional<FaceStencil<Dim>> found() const {
        return std::isinf(extrapolation) ? std::nullopt : std::optional(stencil);
    }
};

/// Searches the simplices of the nearest cells around a point.
template <int Dim>
class SimplexSearch {
public:
    using Near = typename NearestCells<Dim>::Near;

    SimplexSearch(const mesh::Mesh<Dim>& mesh, const Vector<Dim>& point, std::span<const Near> near)
        : mesh_(mesh), point_(point), near_(near) {}

    /// The one that extrapolates least, then the nearest.
    [[nodiscard]] std::optional<FaceStencil<Dim>> best() {
        Candidate<Dim> best;
        // Once a simplex holds the point, none with a larger sum can be better; of equal sums the cell numbers decide.
        for_each([&](const Candidate<Dim>& found) { best = std::min(best, found); },
                 [&](double distances) { return best.extrapolation == 0.0 && distances > best.distances; });
        return best.found();
    }
    /// The one that second derivatives make least wrong; of equal ones the best.
    [[nodiscard]] std::optional<FaceStencil<Dim>> most_exact() {
        std::vector<std::pair<double, Candidate<Dim>>> all;  // with their spreads
        for_each([&](const Candidate<Dim>& found) { all.emplace_back(spread_of(found.stencil), found); },
                 [](double) { return false; });
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [spread, found] : all) least = std::min(least, spread);
        Candidate<Dim> best;
        for (const auto& [spread, found] : all)
            if (spread <= (1.0 + resolution) * least) best = std::min(best, found);
        return best.found();
    }
    /// Whether all simplices are smaller than a volume.
    [[nodiscard]] bool all_are_below(double volume) {
        if (!largest_) {
            largest_ = 0.0;
            descend(
                0, 0, 0.0, [&](double) { largest_ = std::max(*largest_, std::abs(edges().determinant())); },
                [](double) { return false; });
        }
        return *largest_ < unit_volume * volume;
    }
    void set_smallest_volume(double volume) { smallest_volume_ = volume; }

private:
    /// visit(Candidate) for each simplex that is large enough, leaving out those of which are_worse(least sum of distances).
    template <class Visit, class AreWorse>
    void for_each(const Visit& visit, const AreWorse& are_worse) {
        const auto visit_large = [&](double distances) {
            if (const auto found = candidate(distances)) visit(*found);
        };
        descend(0, 0, 0.0, visit_large, are_worse);
    }
    template <class Visit, class AreWorse>
    void descend(int corner, std::size_t first, double distances, const Visit& visit, const AreWorse& are_worse) {
        if (corner == Dim + 1) return visit(distances);
        for (std::size_t i = first; i < near_.size(); ++i) {
            if (are_worse(distances + near_[i].distance * (Dim + 1 - corner))) return;  // distances increase
            chosen_[corner] = i;
            descend(corner + 1, i + 1, distances + near_[i].distance, visit, are_worse);
        }
    }

    [[nodiscard]] const Vector<Dim>& origin() const { return mesh_.cell_centroid[near_[chosen_[0]].cell]; }
    /// Edges of the simplex of the chosen cells, from its first one.
    [[nodiscard]] Matrix<Dim> edges() const {
        Matrix<Dim> edges;
        for (int j = 0; j < Dim; ++j) edges.col(j) = mesh_.cell_centroid[near_[chosen_[j + 1]].cell] - origin();
        return edges;
    }
    /// The simplex of the chosen cells; nothing where it is too small.
    [[nodiscard]] std::optional<Candidate<Dim>> candidate(double distances) const {
        const Matrix<Dim> edges = this->edges();
        if (std::abs(edges.determinant()) < unit_volume * smallest_volume_) return std::nullopt;
        const Vector<Dim> coordinates = edges.inverse() * (point_ - origin());
        Candidate<Dim> found{.distances = distances};
        for (int j = 0; j <= Dim; ++j) {
            found.stencil.cells[j] = near_[chosen_[j]].cell;
            found.stencil.weights[j] = j == 0 ? 1.0 - coordinates.sum() : coordinates[j - 1];
        }
        const double lowest = *std::min_element(found.stencil.weights.begin(), found.stencil.weights.end());
        found.extrapolation = extrapolation_step * std::floor(std::max(0.0, -lowest) / extrapolation_step + resolution);
        found.cells = found.stencil.cells;
        std::sort(found.cells.begin(), found.cells.end());
        return found;
    }

    /// |sum w (x - x_f) (x - x_f)^T|: twice the largest error of the value where second derivatives are 1 [m^2].
    [[nodiscard]] double spread_of(const FaceStencil<Dim>& stencil) const {
        Matrix<Dim> sum = Matrix<Dim>::Zero();
        for (std::size_t j = 0; j <= Dim; ++j) {
            const Vector<Dim> arm = mesh_.cell_centroid[stencil.cells[j]] - point_;
            sum += stencil.weights[j] * arm * arm.transpose();
        }
        return sum.norm();
    }

    static constexpr double unit_volume = Dim == 2 ? 2.0 : 6.0;  // determinant of the edges over the volume

    const mesh::Mesh<Dim>& mesh_;
    Vector<Dim> point_;
    std::span<const Near> near_;
    double smallest_volume_ = 0.0;
    std::optional<double> largest_;  // determinant of the edges; empty: nobody has asked
    std::array<std::size_t, Dim + 1> chosen_{};
};

/// Whether a boundary face is around a hollow: one of the cells near it is nearer to its plane than to a boundary face
/// of its own that looks the same way. There the simplex that extrapolates least may span the hollow, however far its
/// cells are.
template <int Dim>
bool is_hollow(const mesh::Mesh<Dim>& mesh, std::int32_t face, std::span<const typename NearestCells<Dim>::Near> near) {
    return std::ranges::any_of(near, [&](const auto& of_cell) {
        if (of_cell.cell == mesh.face_cells[face][0]) return false;
        const auto depth_below = [&](std::int32_t f) {
            return (mesh.face_centroid[f] - mesh.cell_centroid[of_cell.cell]).dot(mesh.face_normal[f]);
        };
        return std::ranges::any_of(mesh.cell_faces[of_cell.cell], [&](std::int32_t own) {
            return mesh.is_boundary(own) && mesh.face_normal[own].dot(mesh.face_normal[face]) > one_surface &&
                   depth_below(face) < as_deep * depth_below(own);
        });
    });
}

/// Adds the cells that share a face with a cell, where they are not among those near the point: of long cells around a
/// hollow the nearest may all be of one layer.
template <int Dim>
void add_neighbours(const mesh::Mesh<Dim>& mesh, std::int32_t cell, const Vector<Dim>& point,
                    std::vector<typename NearestCells<Dim>::Near>& near) {
    using Near = typename NearestCells<Dim>::Near;
    const auto distance = [&](std::int32_t of) { return (mesh.cell_centroid[of] - point).norm(); };
    const double unit = distance(near.front().cell) / near.front().distance;
    for (const std::int32_t face : mesh.cell_faces[cell])
        for (const std::int32_t neighbour : mesh.face_cells[face])
            if (neighbour >= 0 && std::ranges::find(near, neighbour, &Near::cell) == near.end())
                near.push_back({std::round(distance(neighbour) / unit), neighbour});
}

/// Leaves cells near a point that hang together with `cell`; the others are across a crack.
template <int Dim>
void keep_joined(JoinedCells<Dim>& joined, std::int32_t cell, std::vector<typename NearestCells<Dim>::Near>& near) {
    using Near = typename NearestCells<Dim>::Near;
    const auto is_joined = [&](const Near& of) { return joined.has(of.cell); };
    static_cast<void>(joined.around(cell, [&] { return std::ranges::all_of(near, is_joined); }));
    std::erase_if(near, [&](const Near& of) { return !is_joined(of); });
}

/// Cells within two faces of that of a face, by distance, then number. Of cells much longer than thick the nearest may all
/// be of one row.
template <int Dim>
std::vector<typename NearestCells<Dim>::Near> within_two_faces(const mesh::Mesh<Dim>& mesh, const NearestCells<Dim>& nearest,
                                                               std::int32_t face, std::vector<std::int32_t>& guess) {
    const std::int32_t cell = mesh.face_cells[face][0];
    const Vector<Dim>& point = mesh.face_centroid[face];
    auto near = nearest.find(mesh.cell_body[cell], point, 1, guess);
    add_neighbours<Dim>(mesh, cell, point, near);
    for (const auto& beside : std::vector(near)) add_neighbours<Dim>(mesh, beside.cell, point, near);
    std::ranges::sort(near, {}, [](const auto& of) { return std::tie(of.distance, of.cell); });
    return near;
}

/// The best simplex of these cells, which are sorted; nothing where they span none. `halvings`: of the smallest volume.
template <int Dim>
std::optional<FaceStencil<Dim>> spanned_by(const mesh::Mesh<Dim>& mesh, std::int32_t face,
                                           std::vector<typename NearestCells<Dim>::Near> near, JoinedCells<Dim>* joined,
                                           int& halvings) {
    const std::int32_t cell = mesh.face_cells[face][0];
    if (joined) keep_joined<Dim>(*joined, cell, near);
    const bool hollow = mesh.is_boundary(face) && !near.empty() && is_hollow<Dim>(mesh, face, near);
    if (hollow) add_neighbours<Dim>(mesh, cell, mesh.face_centroid[face], near);
    double smallest_volume = volume_floor * mesh.cell_measure[cell];
    SimplexSearch<Dim> search(mesh, mesh.face_centroid[face], near);
    for (halvings = 0; halvings <= max_floor_halvings; ++halvings, smallest_volume *= 0.5) {
        if (halvings > 0 && search.all_are_below(smallest_volume)) continue;
        search.set_smallest_volume(smallest_volume);
        if (auto found = hollow ? search.most_exact() : search.best()) return found;
    }
    return std::nullopt;
}

/// The stencil of a face; nothing where the cells near it, or those among them that are `joined`, span no simplex.
template <int Dim>
std::optional<FaceStencil<Dim>> found_stencil(const mesh::Mesh<Dim>& mesh, const NearestCells<Dim>& nearest,
                                              std::int32_t face, JoinedCells<Dim>* joined, std::vector<std::int32_t>& guess,
                                              int& halvings) {
    const std::int32_t body = mesh.cell_body[mesh.face_cells[face][0]];
    // Regular layers may put the nearest centroids all in one plane: then look further.
    for (std::size_t wanted = n_nearest<Dim>; wanted <= 4 * n_nearest<Dim>; wanted *= 2) {
        auto near = nearest.find(body, mesh.face_centroid[face], wanted, guess);
        const bool is_all = near.size() < wanted;
        if (auto found = spanned_by<Dim>(mesh, face, std::move(near), joined, halvings)) return found;
        if (is_all) return std::nullopt;
    }
    return spanned_by<Dim>(mesh, face, within_two_faces<Dim>(mesh, nearest, face, guess), joined, halvings);
}

/// `joined`: null where no cells have left.
template <int Dim>
FaceStencil<Dim> select(const mesh::Mesh<Dim>& mesh, const NearestCells<Dim>& nearest, std::int32_t face,
                        JoinedCells<Dim>* joined, std::vector<std::int32_t>& guess, int& halvings) {
    if (joined)
        if (const auto found = found_stencil(mesh, nearest, face, joined, guess, halvings)) return *found;
    if (const auto found = found_stencil<Dim>(mesh, nearest, face, nullptr, guess, halvings)) return *found;
    const std::int32_t cell = mesh.face_cells[face][0];
    throw BadInput(mesh.name + ": face " + std::to_string(face) + " of cell " +
                       std::to_string(mesh.cell_label[static_cast<std::size_t>(cell)]) +
                       ": the centroids of the cells near it span no simplex, so its displacement cannot be reconstructed. "
                       "The body is one cell thick there: put at least two cells across it.",
                   {.face_1 = face, .cell = cell});
}

}  // namespace

void StencilReport::add(std::int32_t face, double lowest_weight) {
    ++faces;
    if (lowest_weight < -extrapolation_step) ++extrapolated;
    if (lowest_weight >= worst_weight) return;
    worst_weight = lowest_weight;
    worst_face = face;
}

template <int Dim>
std::vector<FaceStencil<Dim>> select_stencils(const mesh::Mesh<Dim>& mesh, std::span<const std::int32_t> faces,
                                              StencilReport& report) {
    const NearestCells<Dim> nearest(mesh);
    std::vector<FaceStencil<Dim>> stencils(faces.size());
    std::vector<int> halvings(faces.size(), 0);
    const std::vector<char> none_is_gone;
    parallel_ranges(static_cast<std::ptrdiff_t>(faces.size()), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        std::vector<std::int32_t> guess;
        std::optional<JoinedCells<Dim>> joined;
        if (mesh.has_lost_cells) joined.emplace(mesh, none_is_gone);
        for (std::ptrdiff_t i = begin; i < end; ++i)
            stencils[i] = select(mesh, nearest, faces[i], joined ? &*joined : nullptr, guess, halvings[i]);
    });
    for (std::size_t i = 0; i < faces.size(); ++i) {
        report.add(faces[i], std::ranges::min(stencils[i].weights));
        if (halvings[i] == 0) continue;
        ++report.lowered_floor;
        report.lowered_faces.push_back(faces[i]);
    }
    return stencils;
}

template std::vector<FaceStencil<2>> select_stencils<2>(const mesh::Mesh<2>&, std::span<const std::int32_t>, StencilReport&);
template std::vector<FaceStencil<3>> select_stencils<3>(const mesh::Mesh<3>&, std::span<const std::int32_t>, StencilReport&);

}  // namespace abut::solid
