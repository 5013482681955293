#include "harness/run/repetition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "harness/files/output_file.hpp"
#include "harness/recording/unfinished.hpp"

namespace harness {

namespace {

namespace fs = std::filesystem;

constexpr const char* workshop_name = ".resumed";

bool is_repeated(const fs::path& file) {
  const std::string name = file.filename().string();
  return name == "truth.csv" || name == "odometry.csv" || name == "observations.csv" ||
         file.extension() == ".tum";
}

/// The new files must begin with the recorded ones. A last line without an end is ignored.
void check_repeats(const fs::path& run, const fs::path& again) {
  for (const fs::directory_entry& entry : fs::directory_iterator(run)) {
    const fs::path file = again / entry.path().filename();
    if (entry.is_directory() && entry.path().filename() != workshop_name && fs::is_directory(file))
      check_repeats(entry.path(), file);
    if (!entry.is_regular_file() || !is_repeated(entry.path())) continue;
    std::string recorded = read_whole_file(entry.path());
    recorded.resize(recorded.rfind('\n') + 1);  // npos + 1 is 0
    if (!fs::exists(file) || !read_whole_file(file).starts_with(recorded))
      throw std::runtime_error(
          fmt::format("{}: did not come again as it was recorded (another build of the program?); the run "
                      "stays as it was",
                      entry.path().string()));
  }
}

/// summary.json comes last: it marks the run as complete.
void move_files(const fs::path& again, const fs::path& run) {
  write_whole_file(run / unfinished_mark, "");
  std::vector<fs::path> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(again))
    names.push_back(entry.path().filename());
  std::ranges::partition(names, [](const fs::path& name) { return name != "summary.json"; });
  for (const fs::path& name : names) {
    if (fs::is_directory(again / name)) {
      fs::create_directory(run / name);
      move_files(again / name, run / name);
      continue;
    }
    fs::rename(again / name, run / name);
    fs::remove(unfinished_name(run / name));  // from a kill while the file was written
  }
  fs::remove(run / unfinished_mark);
}

}  // namespace

Workshop::Workshop(const fs::path& run) : folder_(run / workshop_name) {
  fs::remove_all(folder_);  // left by an earlier resumption that was cut off
  fs::create_directory(folder_);
}

Workshop::~Workshop() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void take_place(const fs::path& again, const fs::path& run) {
  check_repeats(run, again);
  move_files(again, run);
}

}  // namespace harness
