#include "integrators/work_share.hpp"

#include <algorithm>

namespace drillstrand {

namespace {

/// Neighbouring spans that one thread takes, and what they cost in a step: a fine stretch is in one
/// group.
struct SpanGroup {
    std::size_t first_span;
    std::size_t end_span;  ///< one past the last
    double work;
};

std::vector<SpanGroup> span_groups(const DirectorString& string) {
    std::vector<SpanGroup> groups;
    std::size_t stretch = 0;
    const Substeps& substeps = string.substeps;
    for (std::size_t i = 0; i < string.spans.size(); ++i) {
        const std::size_t first_node = string.spans[i].begin * block_size;
        const std::size_t end_node = string.spans[i].end * block_size;
        const bool goes_on = stretch > 0 && substeps.last_node(stretch - 1) >= first_node;
        if (!goes_on) groups.push_back({i, i, 0});
        groups.back().end_span = i + 1;
        groups.back().work += static_cast<double>(string.spans[i].entries());
        for (; stretch < substeps.count() && substeps.first_node(stretch) < end_node; ++stretch)
            groups.back().work += substeps.plan().stretches[stretch].work();
    }
    return groups;
}

WorkShare share_of(const DirectorString& string, std::size_t first_span, std::size_t end_span) {
    WorkShare share;
    share.first_span = first_span;
    share.end_span = end_span;
    share.begin = string.spans[first_span].begin;
    share.end = string.spans[end_span - 1].end;
    const Substeps& substeps = string.substeps;
    for (std::size_t i = 0; i < substeps.count(); ++i) {
        const std::size_t first = substeps.first_node(i);
        if (first < share.begin * block_size || first >= share.end * block_size) continue;
        share.stretches.push_back(i);
        for (std::size_t span = share.first_span; span < share.end_span; ++span) {
            const BlockSpan blocks = string.spans[span];
            // from the segment before the first node on, as far as it is in the share
            if (blocks.end * block_size + 1 > first &&
                blocks.begin * block_size <= substeps.last_node(i) &&
                (share.early.empty() || share.early.back() < span))
                share.early.push_back(span);
        }
    }
    return share;
}

}  // namespace

std::vector<WorkShare> shares_of(const DirectorString& string, std::size_t threads) {
    const std::vector<SpanGroup> groups = span_groups(string);
    double all = 0;
    for (const SpanGroup& group : groups)
        all += group.work;
    const auto begin_of = [&](std::size_t thread) {
        const double before = all * static_cast<double>(thread) / static_cast<double>(threads);
        double sum = 0;
        std::size_t group = 0;
        while (group < groups.size() && sum + 0.5 * groups[group].work < before)
            sum += groups[group++].work;
        return std::clamp(group, thread, groups.size() - (threads - thread));
    };
    std::vector<WorkShare> shares;
    for (std::size_t thread = 0; thread < threads; ++thread)
        shares.push_back(share_of(string, groups[begin_of(thread)].first_span,
                                  groups[begin_of(thread + 1) - 1].end_span));
    return shares;
}

std::size_t most_shares(const DirectorString& string) {
    return span_groups(string).size();
}

}  // namespace drillstrand
