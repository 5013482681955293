// The numbers of section 4 of the 2002 report.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace harness {

/// A row of the report's table. Half the width of a 95 % interval follows its value.
struct PublishedRow {
  std::string_view estimator;        // our type for this filter
  int runs = 0;                      // [-]
  double error = 0.0;                // [1e-3, unit not given] "final error"
  double error_half = 0.0;           //
  double links = 0.0;                // [-]
  std::optional<double> links_half;  // [-] empty: not given
  std::string_view update;           // growth of the update's time
};

/// The last row's number of runs is printed as "1,00".
inline constexpr std::array<PublishedRow, 3> published_rows = {{
    {"ekf", 1'000, 5.54, 0.67, 1'275, {}, "O(N^2)"},
    {"seif_exact", 1'000, 4.75, 0.67, 549, 1.60, "O(N^3)"},
    {"seif_report", 1'000, 6.35, 0.67, 549, 1.59, "O(1)"},
}};

}  // namespace harness
