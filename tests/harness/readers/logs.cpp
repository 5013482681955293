#include "logs.hpp"

#include "harness/fixtures.hpp"

namespace harness::test {

Files mrclam_files() {
  return {
      {"Barcodes.dat", "# Subject #    Barcode #\n 1 \t 5\n 2 \t 14\n 6 \t 63\n 7 \t 81\n"},
      {"Landmark_Groundtruth.dat",
       "# x y\n 6 \t 3.0 \t 1.0 \t 0.001 \t 0.001\n 7  3.0  -1.0  0.001  0.001\n"},
      {"Robot2_Odometry.dat",
       "# Time v omega\n1000.000 \t 1.0 \t 0.0\n1000.500  1.0  0.0\n1001.000  0.0  0.0\n1001.400  0.0  "
       "0.5\n1002.400  0.0  0.0\n"},
      {"Robot2_Measurement.dat",
       "# Time barcode range bearing\n999.9  63  3.1  0.3\n1000.250  63  2.9  0.35\n1000.250  81  2.9  "
       "-0.35\n1000.250  5  1.0  0.0\n1000.250  99  1.0  0.0\n1001.900  81  2.2  -0.7\n1003.0  81  2.2  "
       "-0.9\n"},
      {"Robot2_Groundtruth.dat",
       "# Time x y theta\n999.900 -0.1 0 0\n1000.000 0 0 0\n1000.100 0.1 0 0\n1000.400 0.4 0 0\n1001.000 1 0 "
       "0\n1001.400 1 0 0\n1001.700 1 0 0.15\n1002.100 1 0 0.35\n1002.400 1 0 0.5\n"}};
}

Files isam_files() {
  return {{"graph.txt",
           "LANDMARK 0 10 2 2 10 0 10\n"
           "ODOMETRY 0 1 1.01 0 0.01 50 0 0 50 0 100\n"
           "ODOMETRY 1 2 0.99 0.02 0 50 1 0 50 0 100\n"
           "LANDMARK 2 10 0.1 2 10 0 10\n"
           "ODOMETRY 2 5 1 0 0 50 0 0 50 0 100\n"
           "LANDMARK 5 11 1 -1 10 2 5\n"}};
}

Files g2o_files() {
  return {{"graph.g2o",
           "VERTEX_SE2 0 0 0 0\nFIX 0\nVERTEX_SE2 1 1 0 0\nVERTEX_XY 10 2 2\n"
           "EDGE_SE2 0 1 1.01 0 0.01 2500 0 0 2500 0 10000\n"
           "EDGE_SE2 1 2 0.99 0.02 0 2500 50 0 2501 0 10000\n"
           "EDGE_SE2 2 5 1 0 0 2500 0 0 2500 0 10000\n"
           "EDGE_SE2_XY 0 10 2 2 100 0 100\n"
           "EDGE_SE2_XY 2 10 0.1 2 100 0 100\n"
           "EDGE_SE2_XY 5 11 1 -1 100 20 29\n"}};
}

Files true_isam_files() {
  return {{"truth.txt",
           "LANDMARK 0 10 2 2 10 0 10\n"
           "ODOMETRY 0 1 1 0 0 50 0 0 50 0 100\n"
           "ODOMETRY 1 2 1 0 0 50 0 0 50 0 100\n"
           "LANDMARK 2 10 0 2 10 0 10\n"
           "ODOMETRY 2 5 1 0 0 50 0 0 50 0 100\n"
           "LANDMARK 5 11 1 -1 10 0 10\n"}};
}

Files freiburg_files() {
  return {{"sensor_data.dat",
           "ODOMETRY 0.1 1.0 -0.1\nSENSOR 1 2.0 0.5\nSENSOR 2 3.0 -0.5\nODOMETRY 0 0.5 0.2\nSENSOR 1 -0.01 "
           "0\nSENSOR 2 2.5 -0.8\n"},
          {"world.dat", "1 2 1\n2 4 -1\n"}};
}

Files victoria_park_files() {
  return {{"derived_odometry.txt", "# t speed steering\n10.0 2 0\n10.5 2 0\n11.0 2 0.3\n11.5 0 0.3\n"},
          {"derived_tree_detections.txt",
           "# scan t range bearing diameter\n0 10.25 5 0.5 0.3\n0 10.25 6 -0.5 0.2\n1 11.0 4 0.9 0.3\n1 11.0 "
           "5.4 -0.7 0.2\n1 11.0 9 0 0.4\n"}};
}

void write_files(const std::filesystem::path& folder, const Files& files) {
  std::filesystem::create_directories(folder);
  for (const auto& [name, text] : files) write_file(folder / name, text);
}

std::vector<Event> read_all(RecordedLog& log) {
  std::vector<Event> events;
  for (Event event; log.next(event);) events.push_back(event);
  return events;
}

const OdometryEvent& odometry(const Event& event) { return std::get<OdometryEvent>(event); }
const ScanEvent& scan(const Event& event) { return std::get<ScanEvent>(event); }

}  // namespace harness::test
