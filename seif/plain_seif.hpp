// The plain sparse extended information filter: motion update, measurement update, sparsification, mean recovery.
#pragma once

#include <random>
#include <string_view>
#include <vector>

#include "seif/information_filter.hpp"
#include "seif/mean_recovery.hpp"
#include "seif/sparsification.hpp"

namespace seif {

/// The defaults are the report's filter, in constant time.
struct PlainSeifOptions {
  int theta_x = 6;    // [-] landmarks that keep their link to the robot after a sparsification
  int theta_max = 0;  // [-] sparsify above this number of links, or above theta_x if that is larger
  SparsificationRule rule = SparsificationRule::report;
  DropOrder drop = DropOrder::weakest_out_of_view;  // which active landmarks lose their link first
  bool keep_in_view = false;  // never drop a landmark of the latest scan, even above the bounds
  MeanRecovery mean_recovery = MeanRecovery::coordinate_descent;  // that or exact
  int random_landmarks = 10;  // [-] K of the coordinate descent: landmarks besides the active ones
};

/// The four steps of Thrun, Koller, Ghahramani, Durrant-Whyte, Ng, "Simultaneous Mapping and Localization With
/// Sparse Extended Information Filters", 2002, with a choice of sparsification rule and mean recovery. With the
/// default options it is the report's filter, without the errors in its equations that motion_update.hpp names.
/// It does not enforce theta_y: the report gives no rule for it. With the report's rule the filter is
/// overconfident; this is a finding, not a bug.
///
/// The report drops the weakest links, and expects them to belong to the landmarks seen longest ago. This is
/// not so where more than theta_x landmarks are in view: there the first landmarks keep the strongest links for
/// ever, and information grows exponentially with the distance from them. So by default landmarks in view are
/// dropped last. DropOrder::weakest_link follows the report to the letter.
class PlainSeif final : public InformationFilter {
 public:
  /// Throws std::invalid_argument if the start covariance is not positive definite, and for a mean recovery
  /// other than coordinate_descent and exact.
  PlainSeif(const EstimatorSetup& setup, const PlainSeifOptions& options);

  void measurement_update(const Scan& scan, const StageDone& done) override;
  Counts counts() const override;
  /// theta_x, theta_max and K.
  bool change_option(std::string_view option, double value) override;

 private:
  PlainSeifOptions options_;
  std::mt19937_64 random_;
  double anchoring_ = 0.0;    // [nat]
  std::vector<int> to_drop_;  // slots; kept so that no update allocates
};

}  // namespace seif
