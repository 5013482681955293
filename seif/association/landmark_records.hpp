// How often, when and from how far each landmark of the map was seen.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <numbers>

#include "seif/association/sensor_view.hpp"
#include "seif/chunked_array.hpp"
#include "seif/types.hpp"

namespace seif {

class LandmarkRecords {
 public:
  struct Record {
    int seen = 0;      // [-] scans that saw it
    int expected = 0;  // [-] scans that should have
    int last_seen = 0;
    double farthest = 0.0;  // [m] from which it was seen
    bool is_retired = false;
  };

  /// The next name: 0, 1, 2, ..
  LandmarkId add() {
    records_.push_back({});
    return static_cast<LandmarkId>(records_.size()) - 1;
  }
  Record& operator[](LandmarkId id) { return records_[static_cast<std::size_t>(id)]; }
  const Record& operator[](LandmarkId id) const { return records_[static_cast<std::size_t>(id)]; }
  bool is_in_map(LandmarkId id) const {
    return id >= 0 && static_cast<std::size_t>(id) < records_.size() && !(*this)[id].is_retired;
  }

  void note_seen(LandmarkId id, int scan, double range) {
    Record& record = (*this)[id];
    ++record.seen;
    ++record.expected;
    record.last_seen = scan;
    record.farthest = std::max(record.farthest, range);
  }
  /// Its share of the scans that should have seen it, by Laplace's rule of succession. [-]
  double reliability(LandmarkId id) const { return ((*this)[id].seen + 1.0) / ((*this)[id].expected + 2.0); }

  SensorView& view() { return view_; }
  const SensorView& view() const { return view_; }

  /// Whether it is seen from where it lies at p_sensor [m]: it is well within the range and the bearings at which it was.
  bool should_be_seen(LandmarkId id, const Eigen::Vector2d& p_sensor) const {
    return SensorView::is_within(p_sensor, sure_reach * (*this)[id].farthest,
                                 sure_bearing * view_.widest_bearing());
  }
  /// The same of what was seen just before: it may only have come to the edge of the view.
  bool is_in_view(const Eigen::Vector2d& p_sensor) const {
    const double widest = view_.widest_bearing();
    const bool is_all_round = widest > edge * std::numbers::pi;
    return SensorView::is_within(p_sensor, view_.reach(), is_all_round ? std::numbers::pi : edge * widest);
  }

  std::size_t memory_bytes() const { return records_.memory_bytes(); }

 private:
  static constexpr double sure_reach = 0.8, sure_bearing = 0.9, edge = 0.95;  // [-]

  ChunkedArray<Record> records_;  // by name
  SensorView view_;
};

}  // namespace seif
