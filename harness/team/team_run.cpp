#include "harness/team/team_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <vector>

#include "harness/files/file_lock.hpp"
#include "harness/files/output_file.hpp"
#include "harness/recording/unfinished.hpp"
#include "harness/run/recorded_run.hpp"
#include "harness/team/team_exchange.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/progress.hpp"

namespace harness {

namespace {

/// The runs of all robots, step by step.
class TeamLoop {
 public:
  explicit TeamLoop(Team& team) : team_(team), exchange_(team) {
    for (TeamMember& member : team.members)
      runs_.emplace_back(*member.run.stream, *member.run.log, *member.run.believers, member.run.plan,
                         nullptr);
  }

  /// Gives each robot its events, and moves the world by one step of its physics. False at the end, and after an error.
  bool advance() {
    bool goes_on = true;
    const std::int64_t before = events_;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (!runs_[i].attempt([&] { goes_on = advance(i) && goes_on; })) return false;
    }
    if (events_ > before) exchange_.exchange(t());
    return goes_on;
  }

  std::vector<ExchangeSummary> exchanged(std::size_t robot) const { return exchange_.of_robot(robot); }

  double t() { return runs_.front().loop().counts().t; }  // [s]

  void end_exchange() { exchange_.close(); }
  RunResult finish(std::size_t robot, bool interrupted) { return runs_[robot].finish(interrupted); }

 private:
  bool advance(std::size_t robot) {
    SimulatedStream& stream = *team_.members[robot].stream;
    SimulatedStream::Advance done = stream.advance(event_);
    for (; done == SimulatedStream::Advance::event; done = stream.advance(event_)) {
      runs_[robot].loop().take(event_);
      ++events_;
    }
    return done != SimulatedStream::Advance::end;
  }

  Team& team_;
  std::deque<RecordedRun> runs_;
  TeamExchange exchange_;
  Event event_;
  std::int64_t events_ = 0;  // [-] of all robots
};

/// True if the user has ended it.
bool run_loop(TeamLoop& loop, bool quiet, std::optional<double> end_t) {
  const InterruptGuard guard;
  Progress progress(quiet, 0.0, end_t);
  while (!InterruptGuard::flag()) {
    if (!loop.advance()) return false;
    progress.show(loop.t());
  }
  return true;
}

}  // namespace

TeamResult execute(Team& team, const std::filesystem::path& folder, bool quiet) {
  using Clock = std::chrono::steady_clock;
  OutputFile(folder / unfinished_mark).close();
  const FileLock alive(folder / unfinished_mark);
  TeamLoop loop(team);
  const Clock::time_point begin = Clock::now();
  TeamResult result{.world = team.world, .seed = team.seed};
  result.interrupted = run_loop(loop, quiet, team.members.front().run.plan.end_t);
  const double elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
  loop.end_exchange();
  for (std::size_t i = 0; i < team.members.size(); ++i)
    result.robots.push_back({team.members[i].name, loop.finish(i, result.interrupted), loop.exchanged(i)});
  result.realtime_factor = result.robots.front().run.summary.duration / elapsed;
  write_whole_file(folder / "summary.json", to_json(result));
  std::filesystem::remove(folder / unfinished_mark);
  return result;
}

int exit_code(const TeamResult& result) {
  int code = 0;
  for (const int worse : {130, 1, 2}) {
    if (std::ranges::any_of(result.robots, [&](const auto& robot) { return exit_code(robot.run) == worse; }))
      code = worse;
  }
  return code;
}

}  // namespace harness
