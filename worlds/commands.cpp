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

/// The row's numbers, or nothing and a message.
std::optional<VelocityCommand> parse_row(std::string_view row, std::string& message) {
  std::array<double, columns.size()> values{};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool last = i + 1 == columns.size();
    const std::size_t comma = last ? row.size() : row.find(',');
    if (comma == std::string_view::npos) {
      message = "expected three numbers: t,v,omega";
      return std::nullopt;
    }
    const std::string_view cell = row.substr(0, comma);
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), values[i]);
    if (error != std::errc() || end != cell.data() + cell.size() || !(std::abs(values[i]) <= largest_value)) {
      message = fmt::format("'{}' must be a number of at most {}, not '{}'", columns[i], largest_value, cell);
      return std::nullopt;
    }
    row.remove_prefix(last ? comma : comma + 1);
  }
  return VelocityCommand{values[0], values[1], values[2]};
}

}  // namespace

std::vector<VelocityCommand> read_commands(const std::filesystem::path& file,
                                           std::vector<Problem>& problems) {
  const auto source = std::make_shared<const std::string>(file.string());
  int line = 0;
  const auto refuse = [&](std::string message) {
    problems.push_back({{source, line, line > 0 ? 1 : 0}, std::move(message), "drive.file"});
  };
  std::vector<VelocityCommand> commands;
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
    const std::optional<VelocityCommand> command = parse_row(row, message);
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

}  // namespace worlds
