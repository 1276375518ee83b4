#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner_rows.h"

namespace dstylize {

/// Prints rows and keeps them for the file.
class Report {
  public:
    explicit Report(double mega);

    void add(const Row& row, const Measured& measured);
    void add_stippling(const Times& times, std::size_t points, const Bars& bars);
    /// All ratios of our own times, and the second thread on totals, unless its bar is 0. After the last row.
    void finish(double bar_of_two_threads);

    void write(const std::string& path) const;
    bool is_empty() const { return json_["rows"].empty(); }
    bool ok() const { return ok_; }

  private:
    void add(const std::string& name, nlohmann::ordered_json record, const Times& t, const Bars& bars);
    bool can_judge_two_ = true, ok_ = true;
    double total_ = 0, total_by_two_ = 0;  ///< nanoseconds of a node in each row of `sum` on a square lattice
    std::vector<OwnRatio> ratios_;
    nlohmann::ordered_json json_;
};

}  // namespace dstylize
