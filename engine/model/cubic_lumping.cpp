#include "model/cubic_lumping.hpp"

#include <algorithm>

namespace drillstrand {

namespace {

/// Integrals, from its start to the fraction x of its length, of the cubics on a segment that have
/// the value 1 or the slope 1 (per length of the segment) at one of its ends and are 0 otherwise.
struct CubicIntegrals {
    double first, first_slope;
    double last, last_slope;

    explicit CubicIntegrals(double x)
        : first(x - x * x * x * (1 - x / 2)),
          first_slope(x * x * (0.5 - x * (2.0 / 3 - x / 4))),
          last(x * x * x * (1 - x / 2)),
          last_slope(x * x * x * (x / 4 - 1.0 / 3)) {}
    CubicIntegrals(double from, double to) : CubicIntegrals(to) {
        const CubicIntegrals before(from);
        first -= before.first;
        first_slope -= before.first_slope;
        last -= before.last;
        last_slope -= before.last_slope;
    }
};

/// What of a load that a couple moves may be taken: of what its node has, and of either neighbour.
/// A node keeps a part of its own: a mass that vanished would be too fast for any step.
constexpr double most_of_own = 1.0 / 8;
constexpr double most_of_neighbour = 3.0 / 8;

}  // namespace

CubicLumping::CubicLumping(const std::vector<double>& length, bool head_is_free)
    : length_(length), node_(length.size() + 1), head_is_free_(head_is_free) {}

void CubicLumping::Node::add(const SectionProperties& part, double share) {
    weight += share;
    for (const auto property : lumped_properties)
        add_to_mean(mean.*property, part.*property, share / weight);
}

void CubicLumping::Node::add_couple(const SectionProperties& part, double share) {
    if (!reference) reference = &part;
    for (const auto property : lumped_properties)
        couple.*property += share * (part.*property - reference->*property);
}

void CubicLumping::add(std::size_t segment, const SectionProperties& part, double from, double to) {
    const CubicIntegrals weight(from, to);
    const double h = length_[segment];
    const bool first_is_end = segment == 0;
    const bool last_is_end = segment + 2 == node_.size();
    double turned = 0;  // load that slopes at an end move from the first to the last node
    if (first_is_end && head_is_free_) turned += weight.first_slope;
    if (last_is_end) turned += weight.last_slope;
    node_[segment].add(part, h * (weight.first - turned));
    node_[segment + 1].add(part, h * (weight.last + turned));
    if (!first_is_end) node_[segment].add_couple(part, h * h * weight.first_slope);
    if (!last_is_end) node_[segment + 1].add_couple(part, h * h * weight.last_slope);
}

CubicLumping::Shares CubicLumping::shares(std::size_t node) const {
    const double above = length_[node - 1];
    const double below = length_[node];
    const double both = above + below;
    return {-below / (above * both), (below - above) / (above * below), above / (below * both)};
}

/// How much of a couple is moved, of nodes that have such loads.
double CubicLumping::moved_part(std::size_t node, double couple, double before, double own,
                                double after) const {
    const Shares share = shares(node);
    double part = 1;
    const auto limit = [&](double moved, double most) {
        if (-moved > most) part = std::min(part, most / -moved);
    };
    limit(share.before * couple, most_of_neighbour * before);
    limit(share.own * couple, most_of_own * own);
    limit(share.after * couple, most_of_neighbour * after);
    return part;
}

void CubicLumping::lump(std::vector<double>& cells, std::vector<SectionProperties>& nodes) const {
    const std::size_t last = node_.size() - 1;
    const auto even_couple = [&](std::size_t k) {
        return (length_[k] * length_[k] - length_[k - 1] * length_[k - 1]) / 12;
    };
    const auto half_lengths = [&](std::size_t k) {
        return 0.5 * ((k > 0 ? length_[k - 1] : 0) + (k < last ? length_[k] : 0));
    };
    // of a uniform load
    std::vector<double> own(last + 1);
    for (std::size_t k = 0; k <= last; ++k)
        own[k] = half_lengths(k);
    const auto share_end = [&](std::size_t end, std::size_t neighbour, double h) {
        own[end] -= h / 12;
        own[neighbour] += h / 12;
    };
    share_end(last, last - 1, length_.back());
    if (head_is_free_) share_end(0, 1, length_.front());
    std::vector<double> even_part(last + 1, 0.0);
    cells = own;
    for (std::size_t k = 1; k < last; ++k) {
        even_part[k] = moved_part(k, even_couple(k), own[k - 1], own[k], own[k + 1]);
        const double couple = even_part[k] * even_couple(k);
        const Shares share = shares(k);
        cells[k - 1] += share.before * couple;
        cells[k] += share.own * couple;
        cells[k + 1] += share.after * couple;
    }

    for (const auto property : lumped_properties) {
        const auto load = [&](std::size_t k) { return node_[k].weight * node_[k].mean.*property; };
        for (std::size_t k = 0; k <= last; ++k)
            nodes[k].*property = node_[k].mean.*property;
        for (std::size_t k = 1; k < last; ++k) {
            const double even = even_couple(k);
            const double differing = node_[k].couple.*property;
            const double reference = node_[k].reference->*property;
            const double part =
                moved_part(k, differing + reference * even, load(k - 1), load(k), load(k + 1));
            // couple of the property less that of the cells, times what a node has
            const auto move = [&](std::size_t to, double share) {
                const double mean = node_[to].mean.*property;
                const double excess =
                    part * differing + (part * reference - even_part[k] * mean) * even;
                nodes[to].*property += share * excess / cells[to];
            };
            const Shares share = shares(k);
            move(k - 1, share.before);
            move(k, share.own);
            move(k + 1, share.after);
        }
    }
}

}  // namespace drillstrand
