/// Saving a state, and taking it up again: loops over what state/rows.hpp lists as kept.
///
/// A state names its parts in one function,
///     template <class Self, class Visit> static void parts(Self& self, Visit&& visit)
/// which calls visit(name, part) for each table and record that it is made of.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "drillstrand/saved_state.hpp"
#include "state/fields.hpp"
#include "state/table.hpp"

namespace drillstrand {

namespace detail {

/// Lines of a table that are kept, padding after the last entry included: kernels compute there
/// too.
template <class Row, class TableOfRow, class Line>
void for_each_kept_line(TableOfRow& table, const Line& line) {
    for (const RowInfo<Row>& info : row_list<Row>) {
        if (info.keep != Keep::kept) continue;
        for (std::size_t i = 0; i < info.width; ++i)
            line(info, i, table.row(info.row, i));
    }
}

template <class Row>
std::size_t kept_entries(const Table<Row>& table) {
    return table.blocks() == 0 ? 0 : (table.blocks() + 1) * block_size;
}

class Saver {
  public:
    explicit Saver(SavedState& saved) : saved_(saved) {}

    template <class Row>
    void operator()(const std::string& part, const Table<Row>& table) const {
        const std::size_t entries = kept_entries(table);
        if (entries == 0) return;
        for_each_kept_line<Row>(table, [&](const RowInfo<Row>& info, std::size_t component,
                                           const double* line) {
            if (component == 0)
                saved_.push_back({part + '/' + std::string(info.name), std::string(info.unit), {}});
            std::vector<double>& values = saved_.back().values;
            values.insert(values.end(), line, line + entries);
        });
    }

    template <class Record>
    void operator()(const std::string& part, const Record& record) const {
        for (const Field<Record>& field : field_list<Record>) {
            saved_.push_back({part + '/' + std::string(field.name), std::string(field.unit), {}});
            std::vector<double>& values = saved_.back().values;
            std::visit([&](auto member) { add(values, record.*member); }, field.member);
        }
    }

  private:
    static void add(std::vector<double>& values, double value) { values.push_back(value); }
    static void add(std::vector<double>& values, std::int64_t value) {
        values.push_back(static_cast<double>(value));
    }
    static void add(std::vector<double>& values, const std::vector<double>& list) { values = list; }
    template <int size>
    static void add(std::vector<double>& values, const Eigen::Matrix<double, size, 1>& vector) {
        values.assign(vector.data(), vector.data() + size);
    }

    SavedState& saved_;
};

class Restorer {
  public:
    explicit Restorer(const SavedState& saved) {
        for (const SavedRow& row : saved)
            left_.emplace(row.name, &row.values);
    }

    template <class Row>
    void operator()(const std::string& part, Table<Row>& table) {
        const std::size_t entries = kept_entries(table);
        if (entries == 0) return;
        const double* from = nullptr;
        for_each_kept_line<Row>(
            table, [&](const RowInfo<Row>& info, std::size_t component, double* line) {
                if (component == 0)
                    from = take(part + '/' + std::string(info.name), info.width * entries).data();
                std::copy_n(from + component * entries, entries, line);
            });
    }

    template <class Record>
    void operator()(const std::string& part, Record& record) {
        for (const Field<Record>& field : field_list<Record>) {
            std::visit(
                [&](auto member) { get(part + '/' + std::string(field.name), record.*member); },
                field.member);
        }
    }

    void finish() const {
        if (!left_.empty())
            throw std::invalid_argument("the saved state has an unknown row " +
                                        left_.begin()->first);
    }

  private:
    const std::vector<double>& take(const std::string& name, std::size_t size) {
        const auto found = left_.find(name);
        if (found == left_.end()) throw std::invalid_argument("the saved state has no row " + name);
        const std::vector<double>& values = *found->second;
        left_.erase(found);
        if (values.size() != size)
            throw std::invalid_argument("the saved row " + name + " has another length");
        return values;
    }

    void get(const std::string& name, double& value) { value = take(name, 1).front(); }
    void get(const std::string& name, std::int64_t& value) {
        const double saved = take(name, 1).front();
        if (!(std::abs(saved) <= largest_whole_number) || saved != std::floor(saved))
            throw std::invalid_argument("the saved row " + name + " is not a whole number");
        value = static_cast<std::int64_t>(saved);
    }
    void get(const std::string& name, std::vector<double>& list) { list = take(name, list.size()); }
    template <int size>
    void get(const std::string& name, Eigen::Matrix<double, size, 1>& vector) {
        vector = Eigen::Map<const Eigen::Matrix<double, size, 1>>(take(name, size).data());
    }

    std::map<std::string, const std::vector<double>*> left_;
};

}  // namespace detail

template <class State>
SavedState save(const State& state) {
    SavedState saved;
    State::parts(state, detail::Saver(saved));
    return saved;
}

/// Throws std::invalid_argument where rows are missing, unknown, or of another length; `state` then
/// is of no use.
template <class State>
void restore(State& state, const SavedState& saved) {
    detail::Restorer restorer(saved);
    State::parts(state, restorer);
    restorer.finish();
}

}  // namespace drillstrand
