#include "harness/run/heard_packets.hpp"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "harness/files/csv_reader.hpp"
#include "seif/team/news_book.hpp"

namespace harness {

namespace {

constexpr const char* header = "t,robot,robots,more,packet";
constexpr std::size_t most_in_row = 1500;  // [byte]
constexpr std::string_view digits = "0123456789abcdef";

std::string in_base_16(std::span<const std::byte> bytes) {
  std::string text;
  for (const std::byte byte : bytes) {
    const auto value = std::to_integer<std::size_t>(byte);
    text += digits[value >> 4U];
    text += digits[value & 15U];
  }
  return text;
}

/// Nothing if it is no text of bytes.
std::optional<std::vector<std::byte>> from_base_16(std::string_view text) {
  if (text.size() % 2 != 0) return std::nullopt;
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i < text.size(); i += 2) {
    const std::size_t high = digits.find(text[i]);
    const std::size_t low = digits.find(text[i + 1]);
    if (high == std::string_view::npos || low == std::string_view::npos) return std::nullopt;
    bytes.push_back(static_cast<std::byte>(high << 4U | low));
  }
  return bytes;
}

double time_of(const Event& event) {
  if (const auto* odometry = std::get_if<OdometryEvent>(&event)) return odometry->odometry.t;
  return std::get<ScanEvent>(event).scan.t;
}

/// One estimator hears what its file has.
class Hearer {
 public:
  Hearer(seif::TeamMember& member, const std::filesystem::path& file)
      : member_(member),
        rows_(file, {.required = {"t", "robot", "robots", "more", "packet"}, .optional = {}}) {
    advance();
    if (is_at_end_) return;
    const std::int64_t robots = rows_.integer(2, 2, static_cast<std::int64_t>(seif::most_robots));
    member_.enter_team(static_cast<std::size_t>(rows_.integer(1, 0, robots - 1)),
                       static_cast<std::size_t>(robots));
  }

  /// All that was heard before time t [s].
  void hear_before(double t) {
    for (; !is_at_end_ && t_ < t; advance()) {
      const std::optional<std::vector<std::byte>> bytes = from_base_16(rows_.text(4));
      if (!bytes) rows_.fail(4, "is no text of bytes in base 16");
      packet_.insert(packet_.end(), bytes->begin(), bytes->end());
      if (rows_.integer(3, 0, 1) == 1) continue;
      member_.hear(t_, packet_);
      packet_.clear();
    }
  }

 private:
  void advance() {
    is_at_end_ = !rows_.next();
    if (!is_at_end_) t_ = rows_.number(0);
  }

  seif::TeamMember& member_;
  CsvReader rows_;
  bool is_at_end_ = false;
  double t_ = 0.0;                 // [s] of the row
  std::vector<std::byte> packet_;  // as far as it was read
};

class HeardStream final : public Stream {
 public:
  HeardStream(std::unique_ptr<Stream> log, std::deque<Hearer> hearers)
      : log_(std::move(log)), hearers_(std::move(hearers)) {}

  bool next(Event& event) override {
    if (!log_->next(event)) return false;
    for (Hearer& hearer : hearers_) hearer.hear_before(time_of(event));
    return true;
  }
  ReadCounts counts() const override { return log_->counts(); }

 private:
  std::unique_ptr<Stream> log_;
  std::deque<Hearer> hearers_;
};

}  // namespace

std::filesystem::path heard_file(const std::filesystem::path& folder, const std::string& estimator) {
  return folder / (estimator + "_heard.csv");
}

HeardPackets::HeardPackets(seif::TeamMember& member, const std::filesystem::path& file)
    : member_(member), writer_(file, header) {}

void HeardPackets::enter_team(std::size_t robot, std::size_t robots) {
  robot_ = robot;
  robots_ = robots;
  member_.enter_team(robot, robots);
}

void HeardPackets::hear(double t, std::span<const std::byte> packet) {
  member_.hear(t, packet);
  for (bool more = true; more;) {
    const std::span<const std::byte> row = packet.first(std::min(packet.size(), most_in_row));
    packet = packet.subspan(row.size());
    more = !packet.empty();
    writer_.value(t).value(static_cast<std::int64_t>(robot_)).value(static_cast<std::int64_t>(robots_));
    writer_.value(std::int64_t{more ? 1 : 0}).text(in_base_16(row)).end_row();
  }
  writer_.flush();
}

std::unique_ptr<Stream> with_heard_packets(std::unique_ptr<Stream> log, const std::filesystem::path& folder,
                                           Believers& believers) {
  std::deque<Hearer> hearers;
  for (LiveEstimator& estimator : believers.estimators) {
    const std::filesystem::path file = heard_file(folder, estimator.name);
    if (estimator.filter->team_member() != nullptr && std::filesystem::exists(file))
      hearers.emplace_back(*estimator.filter->team_member(), file);
  }
  if (hearers.empty()) return log;
  return std::make_unique<HeardStream>(std::move(log), std::move(hearers));
}

}  // namespace harness
