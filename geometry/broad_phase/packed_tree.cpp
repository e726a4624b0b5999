#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>
#include <vector>

#include "abut/base/parallel.hpp"
#include "abut/geometry/broad_phase/backends.hpp"
#include "abut/geometry/broad_phase/spatial_order.hpp"

namespace abut::geometry::backend {
namespace {

constexpr int width = 8;

using Mask = std::uint32_t;  // bit k: lane k of a block

// Eight boxes side by side. A lane without a box is empty, and overlaps nothing.
struct alignas(64) Block {
    double lower[3][width];
    double upper[3][width];

    void set(int lane, const Box<3>& box) {
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis][lane] = box.lower[axis];
            upper[axis][lane] = box.upper[axis];
        }
    }
    [[nodiscard]] Box<3> box(int lane) const {
        return {{lower[0][lane], lower[1][lane], lower[2][lane]}, {upper[0][lane], upper[1][lane], upper[2][lane]}};
    }
    [[nodiscard]] Box<3> bounds() const {
        Box<3> all;
        for (int axis = 0; axis < 3; ++axis) {
            all.lower[axis] = *std::min_element(lower[axis], lower[axis] + width);
            all.upper[axis] = *std::max_element(upper[axis], upper[axis] + width);
        }
        return all;
    }
    // No branches: the loop becomes a handful of vector instructions, as long as it is not unrolled into what surrounds it.
    [[nodiscard, gnu::noinline]] Mask overlapping(const Box<3>& box) const {
        Mask mask = 0;
        for (int k = 0; k < width; ++k) {
            const bool hit = (lower[0][k] <= box.upper[0]) & (upper[0][k] >= box.lower[0]) & (lower[1][k] <= box.upper[1]) &
                             (upper[1][k] >= box.lower[1]) & (lower[2][k] <= box.upper[2]) & (upper[2][k] >= box.lower[2]);
            mask |= static_cast<Mask>(hit) << k;
        }
        return mask;
    }
};

template <class Use>
void for_each_lane(Mask mask, const Use& use) {
    for (; mask != 0; mask &= mask - 1) use(std::countr_zero(mask));
}

template <class Body>
void for_each_parallel(std::size_t n, const Body& body) {
    parallel_parts(n, 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    });
}

// A block of one of the levels; level 0 holds the boxes.
struct Node {
    int level;
    std::size_t block;
    friend bool operator==(const Node&, const Node&) = default;
};

// Boxes in spatial order, eight to a block; the bounds of blocks, eight to a block; and so on to a single one. Nothing is
// searched for, all is written once from one end to the other.
class PackedTree {
public:
    /// The boxes are freed as soon as they are packed.
    PackedTree(std::vector<Box<3>> boxes, bool in_spatial_order) : order_(order(boxes, in_spatial_order)) {
        pack(boxes.size(), [&](std::size_t i) { return boxes[static_cast<std::size_t>(order_[i])]; });
        std::vector<Box<3>>().swap(boxes);
        while (levels_.back().size() > 1) {
            const std::vector<Block>& below = levels_.back();
            pack(below.size(), [&](std::size_t i) { return below[i].bounds(); });
        }
    }

    [[nodiscard]] Node root() const { return {static_cast<int>(levels_.size()) - 1, 0}; }
    [[nodiscard]] const Block& operator[](Node node) const {
        return levels_[static_cast<std::size_t>(node.level)][node.block];
    }
    [[nodiscard]] static Node child(Node node, int lane) {
        return {node.level - 1, node.block * width + static_cast<std::size_t>(lane)};
    }
    [[nodiscard]] Box<3> bounds(Node node) const {
        if (node == root()) return (*this)[node].bounds();
        return levels_[static_cast<std::size_t>(node.level) + 1][node.block / width].box(
            static_cast<int>(node.block % width));
    }
    /// Index in the list of boxes.
    [[nodiscard]] std::int32_t box(Node leaf, int lane) const {
        return order_[leaf.block * width + static_cast<std::size_t>(lane)];
    }

private:
    static std::vector<std::int32_t> order(Boxes boxes, bool in_spatial_order) {
        if (in_spatial_order) {
            std::vector<std::int32_t> as_given(boxes.size());
            std::iota(as_given.begin(), as_given.end(), 0);
            return as_given;
        }
        std::vector<Vector<3>> centres(boxes.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) centres[i] = 0.5 * boxes[i].lower + 0.5 * boxes[i].upper;
        return spatial_order<3>(centres);
    }

    template <class BoxOf>
    void pack(std::size_t n, const BoxOf& box_of) {
        std::vector<Block> blocks((n + width - 1) / width);
        for_each_parallel(blocks.size(), [&](std::size_t b) {
            for (int k = 0; k < width; ++k) {
                const std::size_t i = b * width + static_cast<std::size_t>(k);
                blocks[b].set(k, i < n ? box_of(i) : Box<3>());
            }
        });
        levels_.push_back(std::move(blocks));
    }

    std::vector<std::int32_t> order_;
    std::vector<std::vector<Block>> levels_;
};

// Two blocks whose boxes, or what is below them, are to be tested against each other; within one tree a block also meets
// itself.
struct Meeting {
    Node node_1;
    Node node_2;
};

class Search {
public:
    Search(const PackedTree& tree_1, const PackedTree& tree_2) : tree_1_(tree_1), tree_2_(tree_2) {}

    void find(FoundPairs& found) const {
        const std::vector<Meeting> meetings = split_into_tasks();
        parallel_tasks(meetings.size(), [&](std::size_t i) {
            FoundPairs::Local& mine = found.local();
            visit(meetings[i], mine);
        });
    }

private:
    [[nodiscard]] bool is_within() const { return &tree_1_ == &tree_2_; }
    [[nodiscard]] bool meets_itself(const Meeting& meeting) const { return is_within() && meeting.node_1 == meeting.node_2; }
    static bool is_last(const Meeting& meeting) { return meeting.node_1.level == 0 && meeting.node_2.level == 0; }

    std::vector<Meeting> split_into_tasks() const {
        constexpr std::size_t enough = 256;
        std::vector<Meeting> meetings{{tree_1_.root(), tree_2_.root()}}, finer;
        while (meetings.size() < enough && !std::ranges::all_of(meetings, is_last)) {
            finer.clear();
            for (const Meeting& meeting : meetings)
                if (is_last(meeting))
                    finer.push_back(meeting);
                else
                    for_each_below(meeting, [&](const Meeting& below) { finer.push_back(below); });
            meetings.swap(finer);
        }
        return meetings;
    }

    void visit(const Meeting& meeting, FoundPairs::Local& found) const {
        if (found.too_many()) return;
        if (!is_last(meeting)) {
            for_each_below(meeting, [&](const Meeting& below) { visit(below, found); });
            return;
        }
        for_each_lane_pair(meeting, [&](int lane_1, int lane_2) {
            std::int32_t i = tree_1_.box(meeting.node_1, lane_1), j = tree_2_.box(meeting.node_2, lane_2);
            if (is_within() && j < i) std::swap(i, j);
            found.add(i, j);
        });
    }

    // The overlapping boxes of two blocks, and those of one, each pair once.
    template <class Use>
    void for_each_lane_pair(const Meeting& meeting, const Use& use) const {
        const Block &block_1 = tree_1_[meeting.node_1], &block_2 = tree_2_[meeting.node_2];
        const bool itself = meets_itself(meeting);
        for_each_lane(block_1.overlapping(tree_2_.bounds(meeting.node_2)), [&](int lane_1) {
            const Mask later = itself ? ~Mask{0} << (lane_1 + 1) : ~Mask{0};
            for_each_lane(block_2.overlapping(block_1.box(lane_1)) & later, [&](int lane_2) { use(lane_1, lane_2); });
        });
    }

    // The block of the higher level is taken apart, or both.
    template <class Use>
    void for_each_below(const Meeting& meeting, const Use& use) const {
        const auto &node_1 = meeting.node_1, &node_2 = meeting.node_2;  // no binding, which clang 14 cannot capture
        if (node_1.level > node_2.level) {
            for_each_lane(tree_1_[node_1].overlapping(tree_2_.bounds(node_2)), [&](int lane) {
                use(Meeting{PackedTree::child(node_1, lane), node_2});
            });
        } else if (node_1.level < node_2.level) {
            for_each_lane(tree_2_[node_2].overlapping(tree_1_.bounds(node_1)), [&](int lane) {
                use(Meeting{node_1, PackedTree::child(node_2, lane)});
            });
        } else {
            if (meets_itself(meeting))
                for_each_lane(tree_1_[node_1].overlapping(tree_1_.bounds(node_1)), [&](int lane) {
                    use(Meeting{PackedTree::child(node_1, lane), PackedTree::child(node_1, lane)});
                });
            for_each_lane_pair(meeting, [&](int lane_1, int lane_2) {
                use(Meeting{PackedTree::child(node_1, lane_1), PackedTree::child(node_2, lane_2)});
            });
        }
    }

    const PackedTree& tree_1_;
    const PackedTree& tree_2_;
};

}  // namespace

void find_by_packed_tree(std::vector<Box<3>> boxes_1, std::vector<Box<3>> boxes_2, bool in_spatial_order,
                         FoundPairs& found) {
    const PackedTree tree_1(std::move(boxes_1), in_spatial_order), tree_2(std::move(boxes_2), in_spatial_order);
    Search(tree_1, tree_2).find(found);
}

void find_by_packed_tree(std::vector<Box<3>> boxes, bool in_spatial_order, FoundPairs& found) {
    const PackedTree tree(std::move(boxes), in_spatial_order);
    Search(tree, tree).find(found);
}

}  // namespace abut::geometry::backend
