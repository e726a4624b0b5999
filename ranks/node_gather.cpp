#include "abut/ranks/node_gather.hpp"

#include <algorithm>
#include <numeric>

#include "abut/ranks/mpi.hpp"

namespace abut::ranks {

void NodeGather::assign(const Communicator& communicator, const SharedNumbers& numbers,
                        std::span<const std::int32_t> nodes) {
    const auto owner_of = [&](std::int32_t node) { return numbers.owner[static_cast<std::size_t>(node)]; };
    counts_.assign(static_cast<std::size_t>(communicator.size()), 0);
    owned_.clear();
    copies_.clear();
    for (const std::int32_t node : nodes) {
        ++counts_[owner_of(node)];
        const std::int32_t own = numbers.own_node[static_cast<std::size_t>(node)];
        if (own >= 0) (owner_of(node) == communicator.rank() ? owned_ : copies_).push_back({own, node});
    }
    std::vector<int> next(counts_.size(), 0);
    std::exclusive_scan(counts_.begin(), counts_.end(), next.begin(), 0);
    order_.resize(nodes.size());
    for (const std::int32_t node : nodes) order_[next[owner_of(node)]++] = node;
}

template <int Dim>
void NodeGather::bring(const Communicator& communicator, std::initializer_list<Points<Dim>> points, Traffic& traffic) {
    if (empty()) return;
    sent_.clear();
    for (const Here& node : owned_)
        for (const Points<Dim>& of : points) {
            const Vector<Dim> value = of.from[node.own];
            sent_.insert(sent_.end(), value.data(), value.data() + Dim);
        }
    const std::size_t width = Dim * points.size();
    received_.resize(order_.size() * width);
    static_cast<void>(as_count(received_.size()));
    value_counts_.resize(counts_.size());
    value_offsets_.resize(counts_.size());
    for (std::size_t rank = 0; rank < counts_.size(); ++rank) value_counts_[rank] = counts_[rank] * static_cast<int>(width);
    std::exclusive_scan(value_counts_.begin(), value_counts_.end(), value_offsets_.begin(), 0);
    require(MPI_Allgatherv(sent_.data(), as_count(sent_.size()), MPI_DOUBLE, received_.data(), value_counts_.data(),
                           value_offsets_.data(), MPI_DOUBLE, handle(communicator)),
            "MPI_Allgatherv");
    const double* at = received_.data();
    for (const std::int32_t node : order_)
        for (const Points<Dim>& of : points) {
            of.to[static_cast<std::size_t>(node)] = Vector<Dim>(at);
            at += Dim;
        }
    ++traffic.gathers;
    traffic.gathered_bytes += static_cast<std::int64_t>((received_.size() - sent_.size()) * sizeof(double));
}

template void NodeGather::bring<1>(const Communicator&, std::initializer_list<Points<1>>, Traffic&);
template void NodeGather::bring<2>(const Communicator&, std::initializer_list<Points<2>>, Traffic&);
template void NodeGather::bring<3>(const Communicator&, std::initializer_list<Points<3>>, Traffic&);

}  // namespace abut::ranks
