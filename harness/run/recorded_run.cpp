#include "harness/run/recorded_run.hpp"

#include <exception>
#include <filesystem>
#include <system_error>

#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/recording/unfinished.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

std::vector<std::string> names_of(const Believers& believers) {
  std::vector<std::string> names;
  for (const LiveEstimator& estimator : believers.estimators) names.push_back(estimator.name);
  return names;
}

std::filesystem::path marked_unfinished(const std::filesystem::path& folder) {
  OutputFile(folder / unfinished_mark).close();
  return folder / unfinished_mark;
}

std::vector<RunListener*> both(RunListener& recorder, RunListener* follower) {
  std::vector<RunListener*> listeners = {&recorder};
  if (follower != nullptr) listeners.push_back(follower);
  return listeners;
}

}  // namespace

RecordedRun::RecordedRun(Stream& stream, const LogDescription& log, Believers& believers, const RunPlan& plan,
                         RunListener* follower)
    : stream_(stream),
      log_(log),
      believers_(believers),
      plan_(plan),
      names_(names_of(believers)),
      alive_(marked_unfinished(plan.folder)),
      recorder_(plan.folder, log, names_),
      loop_(stream, believers, both(recorder_, follower), log, plan.scoring) {
  believers.dead_reckoning = log.start.mean;
  for (const OptionChange& change : plan.option_changes) loop_.change(change);
  begin_ = Clock::now();
}

bool RecordedRun::attempt(const std::function<void()>& step) {
  try {
    step();
    return true;
  } catch (const std::system_error&) {
    throw;
  } catch (const BadInput& error) {
    result_.error = error.what();
    result_.bad_input = true;
  } catch (const std::exception& error) {
    result_.error = error.what();
  }
  return false;
}

void RecordedRun::fill(Summary& summary, bool interrupted, double elapsed) {
  summary.world = plan_.name;
  summary.seed = plan_.seed;
  summary.version = program_version();
  summary.duration = loop_.counts().t - log_.start_t;
  summary.updates = loop_.counts().updates;
  summary.interrupted = interrupted;
  summary.error = result_.error;
  summary.trajectory_hash = trajectory_hash(plan_.folder);
  summary.realtime_factor = summary.duration / elapsed;
  summary.notes = plan_.notes;
  summary.rpe_interval = plan_.scoring.rpe_interval;
  for (const auto& [name, count] : named(stream_.counts())) summary.log_counts.emplace_back(name, count);
  for (const auto& [name, count] : loop_.screening().named()) summary.left_out.emplace_back(name, count);
  summary.left_out_t = loop_.screening().first_t();
  summary.score = score_folder(plan_.folder, names_, plan_.scoring.rpe_interval);
  for (const LiveEstimator& estimator : believers_.estimators) summary.failures.push_back(estimator.failure);
}

RunResult RecordedRun::finish(bool interrupted) {
  const double elapsed = std::chrono::duration<double>(Clock::now() - begin_).count();
  loop_.finish();
  recorder_.close();
  result_.is_void = result_.bad_input && loop_.counts().updates == 0;
  fill(result_.summary, interrupted, elapsed);
  Summary written = result_.summary;
  written.interrupted = interrupted || result_.bad_input;  // the folder holds a part of the log
  write_whole_file(plan_.folder / "summary.json", to_json(written));
  std::filesystem::remove(plan_.folder / unfinished_mark);
  return result_;
}

}  // namespace harness
