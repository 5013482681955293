// The tables of a finished sweep.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/files/csv_writer.hpp"
#include "harness/sweep/sweep.hpp"

namespace harness {

namespace {

using ColumnNames = std::vector<std::string>;

void add_columns(const std::vector<NamedValue>& values, ColumnNames& columns) {
  for (const NamedValue& value : values) {
    if (std::ranges::find(columns, value.name) == columns.end()) columns.push_back(value.name);
  }
}

/// A table with a row for each run and estimator, in the order of the cells.
class RunsTable {
 public:
  RunsTable(const std::filesystem::path& path, const SweepPlan& plan, ColumnNames columns)
      : file_(path), plan_(plan), columns_(std::move(columns)) {
    std::string header = "cell";
    for (const SweepAxis& axis : plan.axes) header += ',' + csv_cell(axis.path);
    header += ",seed,estimator,failure";
    for (const std::string& column : columns_) header += ',' + csv_cell(column);
    file_.append(header + '\n');
  }

  void add(std::size_t index, const std::string& estimator, const std::string& failure,
           const std::vector<NamedValue>& values) {
    const SweepCell cell = cell_at(plan_, index);
    std::string row = fmt::format("{}", index);
    for (const std::string& value : values_of(plan_, cell.setting)) row += ',' + csv_cell(value);
    row += fmt::format(",{},{},{}", cell.seed, csv_cell(estimator), csv_cell(failure));
    for (const std::string& column : columns_) {
      const auto value = std::ranges::find(values, column, &NamedValue::name);
      row += ',';
      if (value != values.end()) row += csv_cell(value->text);
    }
    file_.append(row + '\n');
  }

  void commit() { file_.commit(); }

 private:
  DurableFile file_;
  const SweepPlan& plan_;
  ColumnNames columns_;
};

std::vector<EstimatorRow> read_cell(const SweepFolder& sweep, std::size_t index) {
  return rows_of(sweep.cells().result(index), describe_cell(sweep.plan, index));
}

/// The result of a first pass over all cells.
struct Gathered {
  Aggregate aggregate;
  ColumnNames scores;
  ColumnNames times;
};

Gathered gather(const SweepFolder& sweep, const std::vector<CellState>& states) {
  const SweepPlan& plan = sweep.plan;
  Gathered gathered;
  gathered.aggregate.plan = plan;
  for (std::size_t setting = 0; setting < setting_count(plan); ++setting) {
    std::vector<std::vector<EstimatorRow>> runs;
    std::size_t failed = 0;
    for (std::size_t i = setting * plan.seeds.size(); i < (setting + 1) * plan.seeds.size(); ++i) {
      if (states[i] == CellState::failed) {
        gathered.aggregate.failed.push_back({i, sweep.cells().failure(i)});
        ++failed;
        continue;
      }
      runs.push_back(read_cell(sweep, i));
      for (const EstimatorRow& row : runs.back()) {
        add_columns(row.scores, gathered.scores);
        add_columns(row.times, gathered.times);
      }
    }
    gathered.aggregate.settings.push_back(
        {values_of(plan, setting), aggregate_runs(runs, failed, plan.baseline)});
  }
  return gathered;
}

}  // namespace

Aggregate read_aggregate(const SweepFolder& sweep) { return gather(sweep, sweep.states()).aggregate; }

Aggregate write_tables(const SweepFolder& sweep) {
  const std::vector<CellState> states = sweep.states();
  Gathered gathered = gather(sweep, states);
  RunsTable runs(sweep.path / "runs.csv", sweep.plan, gathered.scores);
  RunsTable times(sweep.path / "times.csv", sweep.plan, gathered.times);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] == CellState::failed) {
      for (RunsTable* table : {&runs, &times}) table->add(i, "", sweep.cells().failure(i), {});
      continue;
    }
    for (const EstimatorRow& row : read_cell(sweep, i)) {
      runs.add(i, row.estimator, row.failure, row.scores);
      times.add(i, row.estimator, row.failure, row.times);
    }
  }
  runs.commit();
  times.commit();
  write_durable_file(sweep.path / "aggregate.csv", to_csv(gathered.aggregate));
  write_durable_file(sweep.path / "aggregate.json", to_json(gathered.aggregate));
  return std::move(gathered.aggregate);
}

}  // namespace harness
