// The packets that an estimator has heard from other robots, in the folder of its run: so the run can be replayed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/files/csv_writer.hpp"
#include "harness/run/live_loop.hpp"
#include "harness/stream/stream.hpp"
#include "seif/team/team_member.hpp"

namespace harness {

/// The file of an estimator: `t,robot,robots,more,packet`. The bytes are written in base 16; a packet goes on in the next
/// row if `more` is 1.
std::filesystem::path heard_file(const std::filesystem::path& folder, const std::string& estimator);

/// Passes everything on to a member of a team, and writes down what it hears: at once, so that a run that is killed can be
/// replayed as far as its other tables reach.
class HeardPackets final : public seif::TeamMember {
 public:
  /// Keeps a reference to the member.
  HeardPackets(seif::TeamMember& member, const std::filesystem::path& file);

  void enter_team(std::size_t robot, std::size_t robots) override;
  bool speak(double t, std::vector<std::byte>& packet) override { return member_.speak(t, packet); }
  void hear(double t, std::span<const std::byte> packet) override;
  seif::TeamCounts team_counts() const override { return member_.team_counts(); }
  void close() { writer_.close(); }

 private:
  seif::TeamMember& member_;
  CsvWriter writer_;
  std::size_t robot_ = 0, robots_ = 0;
};

/// The stream of a log, in which the estimators hear at each time what they have heard then. `log` itself if nothing was
/// heard. Keeps a reference to the estimators. Throws BadInput for a file that is not right, also later.
std::unique_ptr<Stream> with_heard_packets(std::unique_ptr<Stream> log, const std::filesystem::path& folder,
                                           Believers& believers);

}  // namespace harness
