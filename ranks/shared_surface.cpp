#include "abut/ranks/shared_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "abut/base/messages.hpp"
#include "abut/ranks/mpi.hpp"
#include "abut/ranks/same_values.hpp"

namespace abut::ranks {
namespace {

constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

template <int Dim>
constexpr int most_corners = Dim == 2 ? 2 : 4;

template <int Dim>
struct Node {
    std::int32_t number;
    int rank;
    Vector<Dim> rest;
};

template <int Dim>
struct GatheredFace {
    std::int32_t number;
    int rank;
    std::int32_t local;  // index on that rank
    std::int32_t body;
    std::array<std::int32_t, most_corners<Dim>> corners;  // node numbers; -1: none
    double depth, stiffness;
    double shear_stiffness;  // NaN: the rank has given none
};

[[nodiscard]] std::string at_rank(int rank) { return " on rank " + std::to_string(rank); }

template <int Dim>
[[nodiscard]] std::string text(const Vector<Dim>& x) {
    std::string text = "(";
    for (int i = 0; i < Dim; ++i) text += (i > 0 ? ", " : "") + exact_number(x[i]);
    return text + ") m";
}

void check_not_negative(std::span<const std::int32_t> numbers, const std::string& what, int rank) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (numbers[i] < 0)
            throw BadInput("shared surface: " + what + " " + std::to_string(i) + at_rank(rank) + " has the number " +
                               std::to_string(numbers[i]) + ". Give numbers from 0 on.",
                           {.value = static_cast<double>(numbers[i]), .allowed = 0.0});
}

template <int Dim>
void check_numbers(const NodalPart<Dim>& part, int rank) {
    const std::size_t n_faces = part.faces.body.size();
    if (part.node_number.size() != static_cast<std::size_t>(part.rest.size()))
        throw BadInput("shared surface: " + std::to_string(part.rest.size()) + " nodes are given" + at_rank(rank) +
                       " with " + std::to_string(part.node_number.size()) + " numbers. Give one per node.");
    if (!part.face_number.empty() && part.face_number.size() != n_faces)
        throw BadInput("shared surface: " + std::to_string(n_faces) + " faces are given" + at_rank(rank) + " with " +
                       std::to_string(part.face_number.size()) + " numbers. Give one per face, or none on all ranks.");
    check_not_negative(part.node_number, "node", rank);
    check_not_negative(part.face_number, "face", rank);
    std::vector<std::int32_t> sorted(part.node_number.begin(), part.node_number.end());
    std::ranges::sort(sorted);
    if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
        throw BadInput("shared surface: two nodes" + at_rank(rank) + " have the number " + std::to_string(*twice) +
                           ". Give each node of a rank once.",
                       {.value = static_cast<double>(*twice)});
}

/// The error of two positions of one node.
template <int Dim>
[[noreturn]] void refuse_positions(std::int32_t number, int rank_1, const Vector<Dim>& rest_1, int rank_2,
                                   const Vector<Dim>& rest_2) {
    throw BadInput(
        "shared surface: node " + std::to_string(number) + " is at " + text<Dim>(rest_1) + at_rank(rank_1) + " and at " +
            text<Dim>(rest_2) + at_rank(rank_2) +
            ". Copies of a node have the same position at rest, to the last digit; give other nodes other numbers.",
        {.value = (rest_2 - rest_1).norm(), .allowed = 0.0});
}

/// The nodes of the faces of all ranks, by number and then rank.
template <int Dim>
std::vector<Node<Dim>> gather_nodes(const Communicator& communicator, const NodalPart<Dim>& part,
                                    std::span<const std::int32_t> of_faces) {
    std::vector<std::int32_t> numbers;
    std::vector<double> positions;
    for (const std::int32_t node : of_faces) {
        const Vector<Dim> rest = part.rest[node];
        numbers.push_back(part.node_number[static_cast<std::size_t>(node)]);
        positions.insert(positions.end(), rest.data(), rest.data() + Dim);
    }
    const auto all_numbers = gather_to_all<std::int32_t>(communicator, numbers);
    const auto all_positions = gather_to_all<double>(communicator, positions);
    std::vector<Node<Dim>> nodes;
    for (int rank = 0; rank < communicator.size(); ++rank) {
        const auto rest = as_vectors<Dim>(all_positions.from(rank));
        for (std::size_t i = 0; i < rest.size(); ++i) nodes.push_back({all_numbers.from(rank)[i], rank, rest[i]});
    }
    std::ranges::stable_sort(nodes, {}, &Node<Dim>::number);
    return nodes;
}

/// Each node once, with its owner. The same on all ranks, errors included.
template <int Dim>
std::vector<Vector<Dim>> number_nodes(std::span<const Node<Dim>> nodes, SharedNumbers& numbers) {
    std::vector<Vector<Dim>> rest;
    for (const Node<Dim>& node : nodes) {
        if (!numbers.node.empty() && numbers.node.back() == node.number) {
            if (node.rest != rest.back())
                refuse_positions<Dim>(node.number, numbers.owner.back(), rest.back(), node.rank, node.rest);
            continue;
        }
        numbers.node.push_back(node.number);
        numbers.owner.push_back(node.rank);
        rest.push_back(node.rest);
    }
    return rest;
}

[[nodiscard]] std::int32_t index_of(std::span<const std::int32_t> increasing, std::int32_t number) {
    const auto at = std::ranges::lower_bound(increasing, number);
    return at == increasing.end() || *at != number ? -1 : static_cast<std::int32_t>(at - increasing.begin());
}

/// Finds the nodes of this rank among those of the surface, also where it has none of their faces.
template <int Dim>
void find_own_nodes(const NodalPart<Dim>& part, std::span<const Vector<Dim>> rest, int rank, SharedNumbers& numbers) {
    numbers.n_own = part.rest.size();
    numbers.own_node.assign(numbers.node.size(), -1);
    for (std::int32_t i = 0; i < numbers.n_own; ++i) {
        const std::int32_t number = part.node_number[static_cast<std::size_t>(i)], node = index_of(numbers.node, number);
        if (node < 0) continue;
        const auto at = static_cast<std::size_t>(node);
        if (part.rest[i] != rest[at]) refuse_positions<Dim>(number, numbers.owner[at], rest[at], rank, part.rest[i]);
        numbers.own_node[at] = i;
    }
}

/// All ranks give face numbers, or none.
void check_kind_of_numbers(const Communicator& communicator, std::size_t n_faces, bool has_numbers) {
    const double rank = communicator.rank();
    std::array<double, 2> last{n_faces > 0 && has_numbers ? rank : -1.0, n_faces > 0 && !has_numbers ? rank : -1.0};
    take_largest(communicator, last);
    if (last[0] >= 0.0 && last[1] >= 0.0)
        throw BadInput("shared surface: the faces" + at_rank(static_cast<int>(last[0])) + " have numbers, those" +
                       at_rank(static_cast<int>(last[1])) + " have none. Give `face_number` on all ranks or on none.");
}

/// This rank's faces as they are sent: integers, then values.
template <int Dim>
struct PackedFaces {
    static constexpr int n_integers = 2 + most_corners<Dim>, n_values = 3;
    std::vector<std::int32_t> integers;
    std::vector<double> values;

    explicit PackedFaces(const NodalPart<Dim>& part) {
        const contact::NodalFaces<Dim>& faces = part.faces;
        for (std::size_t face = 0; face < faces.body.size(); ++face) {
            const auto body = static_cast<std::size_t>(faces.body[face]);
            integers.push_back(part.face_number.empty() ? -1 : part.face_number[face]);
            integers.push_back(faces.body[face]);
            const std::size_t begin = faces.offsets.empty() ? Dim * face : static_cast<std::size_t>(faces.offsets[face]);
            const std::size_t end =
                faces.offsets.empty() ? Dim * (face + 1) : static_cast<std::size_t>(faces.offsets[face + 1]);
            for (std::size_t v = 0; v < most_corners<Dim>; ++v)
                integers.push_back(begin + v < end ? part.node_number[static_cast<std::size_t>(faces.nodes[begin + v])]
                                                   : -1);
            values.push_back(faces.depth[face]);
            values.push_back(faces.face_stiffness.empty() ? faces.stiffness[body] : faces.face_stiffness[face]);
            values.push_back(!faces.face_shear_stiffness.empty() ? faces.face_shear_stiffness[face]
                             : !faces.shear_stiffness.empty() && faces.face_stiffness.empty() ? faces.shear_stiffness[body]
                                                                                              : not_given);
        }
    }
};

/// The faces of all ranks by number. The same on all ranks, errors included.
template <int Dim>
std::vector<GatheredFace<Dim>> gather_faces(const Communicator& communicator, const NodalPart<Dim>& part) {
    const PackedFaces<Dim> own(part);
    const auto integers = gather_to_all<std::int32_t>(communicator, own.integers);
    const auto values = gather_to_all<double>(communicator, own.values);
    std::vector<GatheredFace<Dim>> faces;
    for (int rank = 0; rank < communicator.size(); ++rank) {
        const auto of_rank = integers.from(rank);
        const auto of_faces = values.from(rank);
        for (std::size_t i = 0; i * own.n_integers < of_rank.size(); ++i) {
            const auto packed = of_rank.subspan(i * own.n_integers, own.n_integers);
            const auto numbers = of_faces.subspan(i * own.n_values, own.n_values);
            const auto next = static_cast<std::int32_t>(faces.size());
            GatheredFace<Dim>& face = faces.emplace_back(GatheredFace<Dim>{.number = packed[0] < 0 ? next : packed[0],
                                                                           .rank = rank,
                                                                           .local = static_cast<std::int32_t>(i),
                                                                           .body = packed[1],
                                                                           .depth = numbers[0],
                                                                           .stiffness = numbers[1],
                                                                           .shear_stiffness = numbers[2]});
            std::ranges::copy(packed.subspan(2), face.corners.begin());
        }
    }
    std::ranges::stable_sort(faces, {}, &GatheredFace<Dim>::number);
    if (const auto twice = std::ranges::adjacent_find(faces, {}, &GatheredFace<Dim>::number); twice != faces.end()) {
        const auto given_by = [](const GatheredFace<Dim>& face) {
            return "as face " + std::to_string(face.local) + at_rank(face.rank);
        };
        throw BadInput("shared surface: face " + std::to_string(twice->number) + " is given twice, " + given_by(twice[0]) +
                           " and " + given_by(twice[1]) + ". Each face is given by one rank.",
                       {.face_1 = twice->number});
    }
    return faces;
}

template <int Dim>
contact::NodalSurface<Dim> make_surface(std::span<const Vector<Dim>> rest, std::span<const GatheredFace<Dim>> faces,
                                        std::span<const double> stiffness, SharedNumbers& numbers) {
    std::vector<std::int32_t> nodes, offsets{0}, body;
    std::vector<double> depth, face_stiffness, face_shear_stiffness;
    for (const GatheredFace<Dim>& face : faces) {
        for (const std::int32_t corner : face.corners)
            if (corner >= 0) nodes.push_back(index_of(numbers.node, corner));
        offsets.push_back(static_cast<std::int32_t>(nodes.size()));
        body.push_back(face.body);
        depth.push_back(face.depth);
        face_stiffness.push_back(face.stiffness);
        face_shear_stiffness.push_back(face.shear_stiffness);
        numbers.face.push_back(face.number);
    }
    if (std::ranges::any_of(face_shear_stiffness, [](double k) { return std::isnan(k); })) face_shear_stiffness.clear();
    return {rest,
            {.nodes = nodes,
             .offsets = offsets,
             .body = body,
             .depth = depth,
             .stiffness = stiffness,
             .face_stiffness = face_stiffness,
             .face_shear_stiffness = face_shear_stiffness}};
}

std::vector<NamedValue> named_stiffnesses(std::span<const double> stiffness) {
    std::vector<NamedValue> values{{"the number of bodies in `stiffness`", static_cast<double>(stiffness.size())}};
    for (std::size_t body = 0; body < stiffness.size(); ++body)
        values.push_back({"the stiffness of body " + std::to_string(body), stiffness[body]});
    return values;
}

}  // namespace

template <int Dim>
SharedSurface<Dim> share_surface(const Communicator& communicator, const NodalPart<Dim>& part) {
    std::optional<contact::NodalSurface<Dim>> own;  // to be checked, and for its nodes
    agreed(communicator, [&] {
        check_numbers(part, communicator.rank());
        own.emplace(part.rest, part.faces);
    });
    require_same(communicator, named_stiffnesses(part.faces.stiffness));
    check_kind_of_numbers(communicator, part.faces.body.size(), !part.face_number.empty());

    SharedNumbers numbers;
    const auto rest = number_nodes<Dim>(gather_nodes(communicator, part, own->nodes()), numbers);
    agreed(communicator, [&] { find_own_nodes<Dim>(part, rest, communicator.rank(), numbers); });
    const auto faces = gather_faces(communicator, part);
    auto surface = make_surface<Dim>(rest, faces, part.faces.stiffness, numbers);
    return {std::move(numbers), std::move(surface)};
}

template SharedSurface<2> share_surface(const Communicator&, const NodalPart<2>&);
template SharedSurface<3> share_surface(const Communicator&, const NodalPart<3>&);

}  // namespace abut::ranks
