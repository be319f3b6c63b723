/// Records of single numbers, vectors and lists whose fields are told as data, so that saving and
/// restoring them is a loop.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

namespace drillstrand {

template <class Record>
struct Field {
    std::variant<double Record::*, std::int64_t Record::*, Eigen::Vector3d Record::*,
                 Eigen::Vector4d Record::*, std::vector<double> Record::*>
        member;
    std::string_view name;
    std::string_view unit;
    std::string_view meaning;  ///< and who writes it
};

/// Every field of a record: specialised beside it.
template <class Record>
inline constexpr auto field_list = 0;

}  // namespace drillstrand
