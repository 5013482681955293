// Times of an update, by filter and size of map. `docs/benchmarks.md` has a table and the command.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include "ring_drive.hpp"
#include "seif/dense/ekf.hpp"
#include "seif/dense/symmetric_downdate.hpp"
#include "seif/plain_seif.hpp"
#include "seif/seif.hpp"

namespace seif {
namespace {

using test::RingDrive;

/// One motion update and one measurement update with a full map: the robot has driven a whole round before.
template <class Filter, class... Options>
void update(benchmark::State& state, const Options&... options) {
  RingDrive drive(static_cast<int>(state.range(0)), 1);
  Filter filter(drive.setup(), options...);
  for (int k = 0; k < drive.steps_for_a_round(); ++k) drive.step(filter);
  std::vector<std::int64_t> blocks;  // of each update
  std::int64_t observations = 0;
  for (auto _ : state) {
    const std::int64_t before = filter.counts().blocks_touched;
    drive.advance();
    observations += static_cast<std::int64_t>(drive.scan().observations.size());
    const auto begin = std::chrono::steady_clock::now();
    filter.motion_update(drive.odometry());
    filter.measurement_update(drive.scan(), test::ignore);
    state.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    blocks.push_back(filter.counts().blocks_touched - before);
  }
  const auto updates = static_cast<double>(state.iterations());
  state.counters["observations"] = static_cast<double>(observations) / updates;
  std::ranges::sort(blocks);
  state.counters["blocks"] = std::accumulate(blocks.begin(), blocks.end(), 0.0) / updates;
  state.counters["blocks_p50"] = static_cast<double>(blocks[blocks.size() / 2]);
  state.counters["blocks_p99"] = static_cast<double>(blocks[blocks.size() * 99 / 100]);
  state.counters["blocks_max"] = static_cast<double>(blocks.back());
  state.counters["bytes"] = static_cast<double>(filter.memory_bytes());
}

void ekf_update(benchmark::State& state) { update<Ekf>(state); }
BENCHMARK(ekf_update)
    ->Arg(50)
    ->Arg(200)
    ->Arg(1000)
    ->Arg(2000)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

void seif_report_update(benchmark::State& state) { update<PlainSeif>(state, PlainSeifOptions{}); }
BENCHMARK(seif_report_update)
    ->Arg(50)
    ->Arg(1000)
    ->Arg(10'000)
    ->Arg(100'000)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

void seif_update(benchmark::State& state) { update<Seif>(state, SeifOptions{}); }
BENCHMARK(seif_update)
    ->Arg(50)
    ->Arg(200)
    ->Arg(1000)
    ->Arg(10'000)
    ->Arg(100'000)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

void seif_by_groups_update(benchmark::State& state) {
  update<Seif>(state, SeifOptions{.mean_recovery = MeanRecovery::multilevel});
}
BENCHMARK(seif_by_groups_update)
    ->Arg(50)
    ->Arg(200)
    ->Arg(1000)
    ->Arg(10'000)
    ->Arg(100'000)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

/// One step of seif's update; everything else is as in update().
void seif_step(benchmark::State& state, Stage step) {
  using Clock = std::chrono::steady_clock;
  RingDrive drive(static_cast<int>(state.range(0)), 1);
  Seif filter(drive.setup(), {});
  for (int k = 0; k < drive.steps_for_a_round(); ++k) drive.step(filter);
  Clock::time_point begin;
  std::chrono::duration<double> time{};
  const StageDone done = [&](Stage stage) {
    const Clock::time_point now = Clock::now();
    if (stage == step) time = now - begin;
    begin = now;
  };
  for (auto _ : state) {
    drive.advance();
    begin = Clock::now();
    filter.motion_update(drive.odometry());
    done(Stage::motion);
    filter.measurement_update(drive.scan(), done);
    state.SetIterationTime(time.count());
  }
}

void seif_motion(benchmark::State& state) { seif_step(state, Stage::motion); }
void seif_measurement(benchmark::State& state) { seif_step(state, Stage::measurement); }
void seif_sparsification(benchmark::State& state) { seif_step(state, Stage::sparsification); }
void seif_mean_recovery(benchmark::State& state) { seif_step(state, Stage::mean_recovery); }
BENCHMARK(seif_motion)
    ->Arg(1000)
    ->Arg(10'000)
    ->Iterations(10'000)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(seif_measurement)
    ->Arg(1000)
    ->Arg(10'000)
    ->Iterations(10'000)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(seif_sparsification)
    ->Arg(1000)
    ->Arg(10'000)
    ->Iterations(10'000)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(seif_mean_recovery)
    ->Arg(1000)
    ->Arg(10'000)
    ->Iterations(10'000)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

/// A matrix W with 16 columns, as eight observations give it.
Eigen::MatrixXd thin_matrix(Eigen::Index rows) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1e-4, 1e-4);
  return Eigen::MatrixXd::NullaryExpr(rows, 16, [&] { return uniform(random); });
}

void symmetric_downdate(benchmark::State& state) {
  const Eigen::Index n = state.range(0);
  const Eigen::MatrixXd W = thin_matrix(n);
  Eigen::MatrixXd Sigma = Eigen::MatrixXd::Zero((n + 7) / 8 * 8, (n + 7) / 8 * 8);
  SymmetricDowndate downdate;
  for (auto _ : state) downdate(Sigma, W);
}
BENCHMARK(symmetric_downdate)->Arg(2003)->Unit(benchmark::kMicrosecond);

void eigen_rank_update(benchmark::State& state) {
  const Eigen::Index n = state.range(0);
  const Eigen::MatrixXd W = thin_matrix(n);
  Eigen::MatrixXd Sigma = Eigen::MatrixXd::Zero(n, n);
  for (auto _ : state) Sigma.selfadjointView<Eigen::Lower>().rankUpdate(W, -1.0);
}
BENCHMARK(eigen_rank_update)->Arg(2003)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace seif

BENCHMARK_MAIN();
