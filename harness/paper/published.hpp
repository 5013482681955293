// The figures of section 4 of the 2002 report.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace harness {

/// A row of its table. Half the width of a 95 % interval follows the value that it belongs to.
struct PublishedRow {
  std::string_view estimator;        // the type that is ours
  int runs = 0;                      // [-]
  double error = 0.0;                // [1e-3, unit not said] "final error"
  double error_half = 0.0;           //
  double links = 0.0;                // [-]
  std::optional<double> links_half;  // [-] nothing: none is given
  std::string_view update;           // how its time grows
};

/// The report prints the number of runs of the last row as "1,00".
inline constexpr std::array<PublishedRow, 3> published_rows = {{
    {"ekf", 1'000, 5.54, 0.67, 1'275, {}, "O(N^2)"},
    {"seif_exact", 1'000, 4.75, 0.67, 549, 1.60, "O(N^3)"},
    {"seif_report", 1'000, 6.35, 0.67, 549, 1.59, "O(1)"},
}};

}  // namespace harness
