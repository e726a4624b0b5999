#include "abut/ranks/exchange.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <numeric>

#include "abut/ranks/mpi.hpp"

namespace abut::ranks {
namespace {

/// Positions by the rank that they go to or come from; ranks without any are left out.
struct Side {
    std::vector<int> ranks;
    std::vector<std::vector<int>> positions;

    void add(int rank, std::vector<int> of_rank) {
        if (of_rank.empty()) return;
        ranks.push_back(rank);
        positions.push_back(std::move(of_rank));
    }
    [[nodiscard]] std::int64_t size() const {
        return std::accumulate(positions.begin(), positions.end(), std::int64_t{0},
                               [](std::int64_t sum, const auto& list) { return sum + std::ssize(list); });
    }
};

/// The entries of all neighbours of one side, for one width.
struct Types {
    std::vector<MPI_Datatype> types;

    Types(const Side& side, int width) {
        MPI_Datatype entry = MPI_DATATYPE_NULL;
        MPI_Type_contiguous(width, MPI_DOUBLE, &entry);
        for (const std::vector<int>& list : side.positions) {
            MPI_Datatype& type = types.emplace_back(MPI_DATATYPE_NULL);
            require(MPI_Type_create_indexed_block(as_count(list.size()), 1, list.data(), entry, &type),
                    "MPI_Type_create_indexed_block");
            MPI_Type_commit(&type);
        }
        MPI_Type_free(&entry);
    }
    ~Types() {
        int finalised = 0;
        MPI_Finalized(&finalised);
        if (finalised) return;
        for (MPI_Datatype& type : types) MPI_Type_free(&type);
    }
    Types(const Types&) = delete;
    Types& operator=(const Types&) = delete;
};

struct TypesOfWidth {
    Types to, from;
    TypesOfWidth(const Side& to_side, const Side& from_side, int width) : to(to_side, width), from(from_side, width) {}
};

void check(const Received<std::int32_t>& asked, std::size_t n_entries) {
    for (const std::int32_t position : asked.values)
        if (position < 0 || static_cast<std::size_t>(position) >= n_entries)
            throw BadInput("exchange: entry " + std::to_string(position) + " is wanted of a rank that has " +
                               std::to_string(n_entries) + ", counted from 0. Give positions in the array of the owner.",
                           {.value = static_cast<double>(position), .allowed = static_cast<double>(n_entries)});
}

/// Each copy has a place of its own.
void check_wanted(std::size_t n_entries, std::span<const std::int32_t> wanted, std::span<const int> owner,
                  std::span<const std::int32_t> number) {
    if (owner.size() != wanted.size() || number.size() != wanted.size())
        throw BadInput("exchange: " + std::to_string(wanted.size()) + " copies are wanted, with " +
                       std::to_string(owner.size()) + " owners and " + std::to_string(number.size()) +
                       " numbers. Give one of each per copy.");
    std::vector<bool> taken(n_entries, false);
    for (const std::int32_t position : wanted) {
        if (position < 0 || static_cast<std::size_t>(position) >= n_entries)
            throw BadInput("exchange: a copy is wanted at entry " + std::to_string(position) + " of an array of " +
                               std::to_string(n_entries) + ", counted from 0.",
                           {.value = static_cast<double>(position), .allowed = static_cast<double>(n_entries)});
        if (taken[static_cast<std::size_t>(position)])
            throw BadInput("exchange: two copies are wanted at entry " + std::to_string(position) + ".",
                           {.value = static_cast<double>(position)});
        taken[static_cast<std::size_t>(position)] = true;
    }
}

}  // namespace

struct Exchange::Impl {
    std::size_t n_entries = 0;
    MPI_Comm graph = MPI_COMM_NULL;  // of the ranks that have neighbours
    Side to, from;
    ExchangeCounts counts;
    std::map<int, TypesOfWidth> types;

    void connect(const Communicator& communicator);
    ~Impl() {
        int finalised = 0;
        MPI_Finalized(&finalised);
        if (graph != MPI_COMM_NULL && !finalised) MPI_Comm_free(&graph);
    }
};

void Exchange::Impl::connect(const Communicator& communicator) {
    const bool takes_part = !to.ranks.empty() || !from.ranks.empty();
    MPI_Comm part = MPI_COMM_NULL;
    require(MPI_Comm_split(handle(communicator), takes_part ? 0 : MPI_UNDEFINED, communicator.rank(), &part),
            "MPI_Comm_split");
    if (!takes_part) return;
    // Numbers of the ranks in the smaller communicator.
    MPI_Group all = MPI_GROUP_NULL, few = MPI_GROUP_NULL;
    MPI_Comm_group(handle(communicator), &all);
    MPI_Comm_group(part, &few);
    const auto renumbered = [&](const std::vector<int>& ranks) {
        std::vector<int> result(ranks.size());
        MPI_Group_translate_ranks(all, as_count(ranks.size()), ranks.data(), few, result.data());
        return result;
    };
    const std::vector<int> sources = renumbered(from.ranks), destinations = renumbered(to.ranks);
    MPI_Group_free(&all);
    MPI_Group_free(&few);
    require(MPI_Dist_graph_create_adjacent(part, as_count(sources.size()), sources.data(), MPI_UNWEIGHTED,
                                           as_count(destinations.size()), destinations.data(), MPI_UNWEIGHTED, MPI_INFO_NULL,
                                           0, &graph),
            "MPI_Dist_graph_create_adjacent");
    MPI_Comm_free(&part);
}

Exchange::Exchange(const Communicator& communicator, std::size_t n_entries, std::span<const std::int32_t> wanted,
                   std::span<const int> owner, std::span<const std::int32_t> number)
    : impl_(std::make_unique<Impl>()) {
    const int size = communicator.size();
    std::vector<std::vector<int>> from(size);
    std::vector<std::vector<std::int32_t>> asked(size);
    agreed(communicator, [&] {
        check_wanted(n_entries, wanted, owner, number);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            if (owner[i] < 0 || owner[i] >= size)
                throw BadInput("exchange: an entry is wanted of rank " + std::to_string(owner[i]) + ", but there are " +
                                   std::to_string(size) + " ranks, counted from 0.",
                               {.value = static_cast<double>(owner[i]), .allowed = static_cast<double>(size - 1)});
            from[owner[i]].push_back(wanted[i]);
            asked[owner[i]].push_back(number[i]);
        }
    });

    std::vector<int> counts;
    std::vector<std::int32_t> requests;
    for (const auto& of_rank : asked) {
        counts.push_back(as_count(of_rank.size()));
        requests.insert(requests.end(), of_rank.begin(), of_rank.end());
    }
    const auto asked_of_me = exchange<std::int32_t>(communicator, requests, counts);
    agreed(communicator, [&] { check(asked_of_me, n_entries); });

    for (int rank = 0; rank < size; ++rank) {
        const auto of_rank = asked_of_me.from(rank);
        impl_->to.add(rank, std::vector<int>(of_rank.begin(), of_rank.end()));
        impl_->from.add(rank, std::move(from[rank]));
    }
    impl_->n_entries = n_entries;
    impl_->counts = {std::ssize(impl_->to.ranks), std::ssize(impl_->from.ranks), impl_->to.size(), impl_->from.size()};
    impl_->connect(communicator);
}

Exchange::~Exchange() = default;
Exchange::Exchange(Exchange&&) noexcept = default;
Exchange& Exchange::operator=(Exchange&&) noexcept = default;

void Exchange::fill(std::span<double> values, int width) const {
    assert(values.size() == impl_->n_entries * static_cast<std::size_t>(width));
    if (impl_->graph == MPI_COMM_NULL) return;
    const TypesOfWidth& types = impl_->types.try_emplace(width, impl_->to, impl_->from, width).first->second;
    const auto& [to, from] = types;
    const std::vector<int> ones(std::max(to.types.size(), from.types.size()), 1);
    const std::vector<MPI_Aint> zeros(ones.size(), 0);
    require(MPI_Neighbor_alltoallw(values.data(), ones.data(), zeros.data(), to.types.data(), values.data(), ones.data(),
                                   zeros.data(), from.types.data(), impl_->graph),
            "MPI_Neighbor_alltoallw");
}

const ExchangeCounts& Exchange::counts() const { return impl_->counts; }

}  // namespace abut::ranks
