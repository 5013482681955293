#include "harness/film/film_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <utility>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/files/csv_reader.hpp"
#include "harness/run/replay_settings.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/progress.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

/// The recorded update times of one estimator.
class RecordedTimes {
 public:
  explicit RecordedTimes(const std::filesystem::path& file) {
    const Columns columns{{"t", "update", "motion", "measurement", "sparsification", "mean_recovery"}, {}};
    if (std::filesystem::exists(file)) rows_.emplace(file, columns);
  }

  /// The time of the update at `t` [s]; NaN if there is none. Calls must come in the order of `t`. [us]
  double at(double t) {
    while (rows_ && row_t_ < t) {
      if (!rows_->next()) {
        rows_.reset();
        break;
      }
      row_t_ = rows_->number(0);
    }
    return rows_ && row_t_ == t ? rows_->number(1) : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  std::optional<CsvReader> rows_;
  double row_t_ = -std::numeric_limits<double>::infinity();  // [s]
};

/// Passes a replay's records on to the film, with the update times of the recorded run. The replay's own
/// times would include disturbances from drawing, and would differ at each replay.
class WithRecordedTimes final : public RunListener {
 public:
  WithRecordedTimes(Film& film, const std::filesystem::path& log, const Believers& believers) : film_(film) {
    for (const LiveEstimator& estimator : believers.estimators)
      times_.emplace_back(log / (estimator.name + "_times.csv"));
  }

  void odometry(const OdometryEvent& event) override { film_.odometry(event); }
  void scan(const ScanEvent& event) override { film_.scan(event); }
  void dead_reckoning(double t, const seif::Pose2& pose) override { film_.dead_reckoning(t, pose); }
  void update(std::size_t estimator, const UpdateRecord& record) override {
    UpdateRecord recorded = record;
    recorded.times.update = times_[estimator].at(record.t);
    film_.update(estimator, recorded);
  }

 private:
  Film& film_;
  std::vector<RecordedTimes> times_;
};

/// The time of the last odometry row. [s]
double end_of(const std::filesystem::path& log, double start) {
  CsvReader rows(
      log / "odometry.csv",
      {{"t", "dx", "dy", "dtheta", "cov_xx", "cov_xy", "cov_xt", "cov_yy", "cov_yt", "cov_tt"}, {}});
  double end = start;
  while (rows.next()) end = rows.number(0);
  return end;
}

/// A run folder has its world file. A log from elsewhere has settings only.
worlds::LoadResult load_settings(const std::filesystem::path& folder,
                                 const std::vector<std::string>& overrides, const seif::Registry& registry) {
  if (std::filesystem::exists(folder / "world.yaml"))
    return worlds::load_world((folder / "world.yaml").string(), overrides, estimator_schemas(registry),
                              program_version());
  return load_replay_settings(folder, {{}, overrides, ""}, registry);
}

void check_override(const std::string& assignment) {
  if (!assignment.starts_with("film."))
    throw BadInput(fmt::format(
        "--set {}: a film can set its own section, film.key=value; the rest is recorded", assignment));
}

}  // namespace

std::optional<FilmableFolder> prepare_film(const std::filesystem::path& folder,
                                           const std::vector<std::string>& overrides,
                                           const seif::Registry& registry,
                                           std::vector<worlds::Problem>& problems) {
  for (const std::string& assignment : overrides) check_override(assignment);
  const worlds::LoadResult settings = load_settings(folder, overrides, registry);
  problems.insert(problems.end(), settings.problems.begin(), settings.problems.end());
  if (!settings.world) return std::nullopt;
  FilmableFolder result;
  result.plan.world = *settings.world;
  const std::vector<std::string> names = filmed_estimators(result.plan.world);
  worlds::World replayed = result.plan.world;
  std::erase_if(replayed.estimators, [&](const worlds::EstimatorChoice& choice) {
    return std::ranges::find(names, choice.name) == names.end();
  });
  replayed.scoring.interval = std::numeric_limits<double>::infinity();  // scored already
  result.replay = prepare_replay(folder, replayed, registry);
  leave_out_missing(result.plan.world, *result.replay.believers);
  result.plan.knows_world = std::filesystem::exists(folder / "world.yaml");
  result.plan.name = result.replay.plan.name;
  result.plan.seed = result.plan.world.seed;
  result.plan.start = result.replay.log->start_t;
  result.plan.end = end_of(folder, result.plan.start);
  return result;
}

std::optional<Area> path_area(const std::filesystem::path& log, double from, double to) {
  if (!std::filesystem::exists(log / "truth.csv")) return std::nullopt;
  CsvReader rows(log / "truth.csv", {{"t", "x", "y", "theta"}, {"left_wheel", "right_wheel"}});
  std::optional<Area> area;
  while (rows.next() && rows.number(0) <= to) {
    const Eigen::Vector2d position(rows.number(1), rows.number(2));
    if (!area || rows.number(0) < from) area = Area{position, position};
    area->min = area->min.cwiseMin(position);
    area->max = area->max.cwiseMax(position);
  }
  return area;
}

FilmResult film_folder(FilmableFolder& folder, const std::filesystem::path& log,
                       std::unique_ptr<FrameSink> sink, bool quiet) {
  PreparedRun& replay = folder.replay;
  const InterruptGuard guard;
  CountProgress progress(quiet, static_cast<std::size_t>(folder.plan.clock.frames()), "frames");
  replay.believers->dead_reckoning = replay.log->start.mean;
  Film film(folder.plan, *replay.log, *replay.believers, std::move(sink));
  WithRecordedTimes listener(film, log, *replay.believers);
  LiveLoop loop(*replay.stream, *replay.believers, {&listener}, *replay.log, replay.plan.scoring);
  std::atomic<bool> stop = false;
  film.after_each_frame([&] {
    progress.show(static_cast<std::size_t>(film.frames_drawn()));
    return !InterruptGuard::flag();
  });
  loop.run(stop, [&](const LoopCounts&) { stop = film.is_over() || InterruptGuard::flag(); });
  const bool interrupted = InterruptGuard::flag();
  film.finish(!interrupted);
  return {film.frames_drawn(), interrupted};
}

}  // namespace harness
