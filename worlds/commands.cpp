#include "worlds/commands.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "worlds/input_file.hpp"

namespace worlds {
namespace {

constexpr double largest_value = 1e6;  // in any column; no run needs larger values
constexpr std::array<const char*, 3> columns = {"t", "v", "omega"};

/// What a row says, or nothing and a message.
std::optional<Takeover> parse_row(std::string_view row, bool may_release, std::string& message) {
  std::array<std::string_view, columns.size()> cells;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool last = i + 1 == columns.size();
    const std::size_t comma = last ? row.size() : row.find(',');
    if (comma == std::string_view::npos) {
      message = "expected three numbers: t,v,omega";
      return std::nullopt;
    }
    cells[i] = row.substr(0, comma);
    row.remove_prefix(last ? comma : comma + 1);
  }
  std::array<double, columns.size()> values{};
  const bool releases = may_release && cells[1].empty() && cells[2].empty();
  for (std::size_t i = 0; i < (releases ? 1 : columns.size()); ++i) {
    const auto [end, error] = std::from_chars(cells[i].data(), cells[i].data() + cells[i].size(), values[i]);
    if (error != std::errc() || end != cells[i].data() + cells[i].size() ||
        !(std::abs(values[i]) <= largest_value)) {
      message =
          fmt::format("'{}' must be a number of at most {}, not '{}'", columns[i], largest_value, cells[i]);
      return std::nullopt;
    }
  }
  return Takeover{values[0], releases, values[1], values[2]};
}

/// Reads the rows; `key` is that of the file's name.
std::vector<Takeover> read_rows(const std::filesystem::path& file, const std::string& key, bool may_release,
                                std::vector<Problem>& problems) {
  const auto source = std::make_shared<const std::string>(file.string());
  int line = 0;
  const auto refuse = [&](std::string message) {
    problems.push_back({{source, line, line > 0 ? 1 : 0}, std::move(message), key});
  };
  std::vector<Takeover> commands;
  if (const std::string why = why_no_input(file); !why.empty()) {
    refuse("the file of commands cannot be read: " + why);
    return commands;
  }
  std::ifstream stream(file);
  if (!stream) refuse("the file of commands cannot be read");
  for (std::string row; std::getline(stream, row);) {
    ++line;
    if (row.ends_with('\r')) row.pop_back();
    if (line == 1) {
      if (row.starts_with("\xEF\xBB\xBF")) row.erase(0, 3);  // some editors begin UTF-8 files with it
      if (row == "t,v,omega") continue;
      refuse(
          "the first line must be the head t,v,omega");  // no more: another file's rows are not to be quoted
      return commands;
    }
    std::string message;
    const std::optional<Takeover> command = parse_row(row, may_release, message);
    if (!command) {
      refuse(message);
    } else if (command->t < 0 || (!commands.empty() && command->t <= commands.back().t)) {
      refuse(fmt::format("the time must be at least 0 and more than in the row before, not {}", command->t));
    } else {
      commands.push_back(*command);
    }
  }
  if (line < 2) refuse("there are no commands in the file");
  return commands;
}

}  // namespace

std::vector<VelocityCommand> read_commands(const std::filesystem::path& file,
                                           std::vector<Problem>& problems) {
  std::vector<VelocityCommand> commands;
  for (const Takeover& row : read_rows(file, "drive.file", false, problems))
    commands.push_back({row.t, row.v, row.omega});
  return commands;
}

std::vector<Takeover> read_takeover(const std::filesystem::path& file, std::vector<Problem>& problems) {
  return read_rows(file, "drive.takeover_file", true, problems);
}

}  // namespace worlds
