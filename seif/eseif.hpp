// The exactly sparse extended information filter.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "seif/information_filter.hpp"

namespace seif {

struct EseifOptions {
  int theta_x = 10;              // [-] links of the robot above which it is marginalised out and relocated
  int relocation_landmarks = 4;  // [-] observations kept for the relocation; at least two
};

/// Walter, Eustice, Leonard, "Exactly sparse extended information filters for feature-based SLAM", IJRR 2007.
/// This filter cuts no link. When the robot would get too many links, the scan is split: the filter takes in
/// the first part, marginalises the robot out, and puts it back (relocates it) from the second part alone. This
/// is exact, but forgets the odometry up to that moment. The mean is recovered exactly, so an update does not
/// take constant time.
class Eseif final : public InformationFilter {
 public:
  Eseif(const EstimatorSetup& setup, const EseifOptions& options);

  void measurement_update(const Scan& scan, const StageDone& done) override;
  Counts counts() const override;
  /// theta_x.
  bool change_option(std::string_view option, double value) override;

 private:
  bool overflows(const Scan& scan) const;
  void hold_back(const Scan& scan);
  void solve(double t);

  EseifOptions options_;
  std::int64_t relocations_ = 0;
  std::vector<Observation> known_;      // observations of landmarks in the map, sorted by bearing
  std::vector<Observation> now_;        // taken in before the robot is marginalised out
  std::vector<Observation> held_back_;  // the robot is relocated from these
};

}  // namespace seif
