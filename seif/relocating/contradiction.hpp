// When something contradicts what a filter believes.
#pragma once

namespace seif {

/// [-] Above this v' S^-1 v a position contradicts what the filter believes: 16 times the chi-square quantile of two
/// degrees of freedom at 1 - 1e-6, so also for a filter whose errors are four times as large as it believes.
inline constexpr double contradiction = 16.0 * 27.63;

}  // namespace seif
