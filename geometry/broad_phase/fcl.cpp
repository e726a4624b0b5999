#include <fcl/broadphase/detail/hierarchy_tree.h>

#include <algorithm>

#include "abut/base/eigen.hpp"
#include "abut/geometry/broad_phase/backends.hpp"

namespace abut::geometry::backend {
namespace {

// The tree inside FCL's DynamicAABBTreeCollisionManager, without a collision object for every box (1.8 kB each).
using Tree = fcl::detail::HierarchyTree<fcl::AABB<double>>;
using Node = Tree::NodeType;

// Median splits down to single boxes: a balanced tree whatever the boxes, identical ones included.
constexpr int leaves_joined_bottom_up = 1;

// A leaf points to its box, so a box's index is its distance from the first one.
void build(Boxes boxes, Tree& tree) {
    std::vector<Node*> leaves;
    leaves.reserve(boxes.size());
    for (const Box<3>& box : boxes) {
        Node* leaf = new Node;  // owned by the tree
        leaf->bv = fcl::AABB<double>(as_eigen(box.lower), as_eigen(box.upper));
        leaf->parent = nullptr;
        leaf->children[1] = nullptr;
        leaf->data = const_cast<Box<3>*>(&box);
        leaves.push_back(leaf);
    }
    tree.init(leaves);
}

std::int32_t index_of(const Node* leaf, Boxes boxes) {
    return static_cast<std::int32_t>(static_cast<const Box<3>*>(leaf->data) - boxes.data());
}

struct NodePair {
    const Node* node_1;
    const Node* node_2;
};

bool overlap(const NodePair& pair) { return pair.node_1->bv.overlap(pair.node_2->bv); }

void push_children(const NodePair& pair, std::vector<NodePair>& stack) {
    const bool split_first =
        !pair.node_1->isLeaf() && (pair.node_2->isLeaf() || pair.node_1->bv.size() > pair.node_2->bv.size());
    for (int child = 0; child < 2; ++child) {
        const NodePair next = split_first ? NodePair{pair.node_1->children[child], pair.node_2}
                                          : NodePair{pair.node_1, pair.node_2->children[child]};
        if (overlap(next)) stack.push_back(next);
    }
}

// Within one tree a node meets itself: its children each meet themselves, and one another.
void push_children_of_same(const Node* node, std::vector<NodePair>& stack) {
    if (node->isLeaf()) return;
    const NodePair children{node->children[0], node->children[1]};
    stack.push_back({children.node_1, children.node_1});
    stack.push_back({children.node_2, children.node_2});
    if (overlap(children)) stack.push_back(children);
}

template <class Report>
void for_each_overlap(const NodePair& roots, const FoundPairs::Local& found, const Report& report) {
    std::vector<NodePair> stack;
    if (overlap(roots)) stack.push_back(roots);
    while (!stack.empty() && !found.too_many()) {
        const NodePair pair = stack.back();
        stack.pop_back();
        if (pair.node_1 == pair.node_2)
            push_children_of_same(pair.node_1, stack);
        else if (pair.node_1->isLeaf() && pair.node_2->isLeaf())
            report(pair.node_1, pair.node_2);
        else
            push_children(pair, stack);
    }
}

}  // namespace

const bool has_fcl = true;

void find_by_fcl(Boxes boxes_1, Boxes boxes_2, FoundPairs& found) {
    Tree tree_1(leaves_joined_bottom_up), tree_2(leaves_joined_bottom_up);
    build(boxes_1, tree_1);
    build(boxes_2, tree_2);
    FoundPairs::Local& mine = found.local();
    for_each_overlap({tree_1.getRoot(), tree_2.getRoot()}, mine,
                     [&](const Node* a, const Node* b) { mine.add(index_of(a, boxes_1), index_of(b, boxes_2)); });
}

void find_by_fcl(Boxes boxes, FoundPairs& found) {
    Tree tree(leaves_joined_bottom_up);
    build(boxes, tree);
    FoundPairs::Local& mine = found.local();
    for_each_overlap({tree.getRoot(), tree.getRoot()}, mine, [&](const Node* a, const Node* b) {
        const std::int32_t i = index_of(a, boxes), j = index_of(b, boxes);
        mine.add(std::min(i, j), std::max(i, j));
    });
}

}  // namespace abut::geometry::backend
