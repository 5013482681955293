// Small logs made by hand, one in each format.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/readers/open_log.hpp"

namespace harness::test {

/// File names and the contents of the files.
using Files = std::map<std::string, std::string>;

/// Robot 2 drives ahead for a second, stands, and turns on the spot. It sees landmarks 6 and 7, robot 1, and a
/// barcode that belongs to nothing.
Files mrclam_files();

/// Three motions of a metre. Landmark 10 is seen from poses 0 and 2, landmark 11 from pose 5.
Files isam_files();

/// The same log in the format of g2o.
Files g2o_files();

/// The same log without noise: the truth of isam_files().
Files true_isam_files();

/// Two steps; three valid observations and one with a negative value.
Files freiburg_files();

/// A car that drives straight and then to the left; five trees in two scans.
Files victoria_park_files();

void write_files(const std::filesystem::path& folder, const Files& files);

std::vector<Event> read_all(RecordedLog& log);

const OdometryEvent& odometry(const Event& event);
const ScanEvent& scan(const Event& event);

}  // namespace harness::test
