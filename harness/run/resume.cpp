#include "harness/run/resume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/recording/unfinished.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/run/runnable_world.hpp"

namespace harness {

namespace {

namespace fs = std::filesystem;

/// A folder inside the run folder, so on the same disk. It is deleted with the object.
class Workshop {
 public:
  explicit Workshop(fs::path folder) : folder_(std::move(folder)) {
    fs::remove_all(folder_);  // left by an earlier resumption that was cut off
    fs::create_directory(folder_);
  }
  ~Workshop() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  const fs::path& path() const { return folder_; }

 private:
  fs::path folder_;
};

bool is_repeated(const fs::path& file) {
  const std::string name = file.filename().string();
  return name == "truth.csv" || name == "odometry.csv" || name == "observations.csv" ||
         file.extension() == ".tum";
}

/// The new files must begin with the recorded ones. A last line without an end is ignored.
void check_repeats(const fs::path& run, const fs::path& again) {
  for (const fs::directory_entry& entry : fs::directory_iterator(run)) {
    if (!is_repeated(entry.path())) continue;
    std::string recorded = read_whole_file(entry.path());
    recorded.resize(recorded.rfind('\n') + 1);  // npos + 1 is 0
    const fs::path file = again / entry.path().filename();
    if (!fs::exists(file) || !read_whole_file(file).starts_with(recorded))
      throw std::runtime_error(
          fmt::format("{}: did not come again as it was recorded (another build of the program?); the run "
                      "stays as it was",
                      entry.path().string()));
  }
}

/// Moves the new files into the run folder. summary.json comes last: it marks the run as complete.
void take_place(const fs::path& again, const fs::path& run) {
  write_whole_file(run / unfinished_mark, "");
  std::vector<fs::path> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(again))
    names.push_back(entry.path().filename());
  std::ranges::partition(names, [](const fs::path& name) { return name != "summary.json"; });
  for (const fs::path& name : names) {
    fs::rename(again / name, run / name);
    fs::remove(unfinished_name(run / name));  // from a kill while the file was written
  }
  fs::remove(run / unfinished_mark);
}

}  // namespace

bool is_incomplete(const fs::path& run) {
  if (!fs::exists(run / "world.yaml"))
    throw BadInput(fmt::format("{}: is no folder of a run: it has no world.yaml", run.string()));
  if (is_going_on(run))
    throw BadInput(fmt::format("{}: is still going on: there is nothing to resume", run.string()));
  return is_unfinished(run) || read_summary(run / "summary.json").interrupted;
}

RunResult resume(const fs::path& run, const seif::Registry& registry, bool quiet) {
  const worlds::LoadResult loaded = load_runnable_world(run / "world.yaml", {}, registry);
  if (!loaded.world) throw BadInput(worlds::to_string(loaded.problems.front()));
  const Workshop workshop(run / ".resumed");
  PreparedRun again = prepare_run(*loaded.world, registry);
  again.plan.folder = workshop.path();
  again.plan.quiet = quiet;
  RunResult result = execute(again);
  if (!result.error.empty() || result.summary.interrupted) return result;
  check_repeats(run, workshop.path());
  take_place(workshop.path(), run);
  return result;
}

}  // namespace harness
