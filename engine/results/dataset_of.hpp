/// A dataset of a member of a record, from the member itself.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "drillstrand/result_layout.hpp"

namespace drillstrand {

/// How a value of type T appears in a dataset.
template <class T>
struct Stored {
    static_assert(std::is_same_v<T, double> || std::is_same_v<T, std::int64_t> ||
                  std::is_enum_v<T>);
    static constexpr std::size_t components = 1;
    static constexpr bool integer = !std::is_same_v<T, double>;
    static void append(const T& value, std::vector<double>& out) {
        out.push_back(static_cast<double>(value));
    }
    static void assign(T& value, const double* in) {
        using Number = std::conditional_t<integer, std::int64_t, double>;
        value = static_cast<T>(static_cast<Number>(*in));
    }
};

template <int size>
struct Stored<Eigen::Matrix<double, size, 1>> {
    using Vector = Eigen::Matrix<double, size, 1>;
    static constexpr std::size_t components = size;
    static constexpr bool integer = false;
    static void append(const Vector& value, std::vector<double>& out) {
        out.insert(out.end(), value.begin(), value.end());
    }
    static void assign(Vector& value, const double* in) { value = Eigen::Map<const Vector>(in); }
};

/// Dataset of the member reached through the chain of member pointers, one value per record.
template <class Record, auto... members>
RecordDataset<Record> value(const std::string& path, const char* units, const char* description) {
    using Value = std::remove_cvref_t<decltype((std::declval<Record&>().*....*members))>;
    return {path,
            Rows::one,
            Stored<Value>::components,
            Stored<Value>::integer,
            units,
            description,
            [](const Record& record, std::vector<double>& out) {
                Stored<Value>::append((record.*....*members), out);
            },
            [](Record& record, const double* in, std::size_t) {
                Stored<Value>::assign((record.*....*members), in);
            }};
}

/// Dataset of a member that is a vector with one value per node or segment.
template <class Record, auto member>
RecordDataset<Record> values(const char* path, Rows rows, const char* units,
                             const char* description) {
    using Value =
        typename std::remove_cvref_t<decltype(std::declval<Record&>().*member)>::value_type;
    return {path,
            rows,
            Stored<Value>::components,
            Stored<Value>::integer,
            units,
            description,
            [](const Record& record, std::vector<double>& out) {
                for (const Value& row : record.*member)
                    Stored<Value>::append(row, out);
            },
            [](Record& record, const double* in, std::size_t count) {
                (record.*member).resize(count);
                for (Value& row : record.*member) {
                    Stored<Value>::assign(row, in);
                    in += Stored<Value>::components;
                }
            }};
}

}  // namespace drillstrand
