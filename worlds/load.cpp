#include "worlds/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <system_error>
#include <utility>

#include "worlds/check.hpp"
#include "worlds/commands.hpp"
#include "worlds/describe.hpp"
#include "worlds/gallery.hpp"
#include "worlds/limits.hpp"
#include "worlds/merge.hpp"
#include "worlds/path.hpp"

namespace worlds {
namespace {

Node text_node(std::string text, const Location& where) {
  Node node;
  node.kind = Node::Kind::scalar;
  node.quoted = true;
  node.where = where;
  node.text = std::move(text);
  return node;
}

/// A path as the file means it that names it: relative to its folder. In an override, `file` stands for that file.
std::string full_path(const std::filesystem::path& file, const Node& node) {
  const bool is_in_a_file = node.where.line > 0;
  const std::filesystem::path named_in = is_in_a_file ? std::filesystem::path(*node.where.source) : file;
  const std::filesystem::path relative = named_in.parent_path() / node.text;
  std::error_code error;
  const std::filesystem::path full = std::filesystem::weakly_canonical(relative, error);
  return error ? relative.string() : full.string();
}

/// Writes the full path of a file into the document, which may move to another folder, and returns it.
std::string resolve_file(const std::filesystem::path& world, const std::string& key, Node& document) {
  Node* node = find_path(document, key);
  std::string path = full_path(world, *node);
  *node = text_node(path, node->where);
  return path;
}

template <class Read>
auto read_named_file(const std::string& key, const std::string& path, const Read& read, const Node& document,
                     std::vector<Problem>& problems) {
  std::vector<Problem> found;
  auto rows = read(path, found);
  if (!found.empty() && found.front().where.line == 0) {  // not at one line: say where the file was named
    refuse_value(document, key, to_string(found.front()), problems);
  } else {
    problems.insert(problems.end(), found.begin(), found.end());
  }
  return rows;
}

/// Of the drive at `key`: lays out its path, or reads its files.
void prepare_drive(const std::filesystem::path& file, const std::string& key, Drive& drive,
                   const SerpentineArea& area, Node& document, std::vector<Problem>& problems) {
  if (!is_sound(problems, {key})) return;
  if (drive.mode == DriveMode::serpentine) drive.path = serpentine(area.min, area.max, area.lane);
  if (drive.mode == DriveMode::commands) {
    const std::string file_key = key + ".file";
    drive.commands_file = resolve_file(file, file_key, document);
    drive.commands = read_named_file(file_key, drive.commands_file, read_commands, document, problems);
  }
  if (!drive.takeover_file.empty()) {
    const std::string file_key = key + ".takeover_file";
    drive.takeover_file = resolve_file(file, file_key, document);
    drive.takeover = read_named_file(file_key, drive.takeover_file, read_takeover, document, problems);
  }
}

/// The drives of the world and of all its robots.
void prepare_drives(const std::filesystem::path& file, WorldFile& world_file, Node& document,
                    std::vector<Problem>& problems) {
  World& world = world_file.world;
  prepare_drive(file, "drive", world.drive, world_file.area, document, problems);
  const std::size_t robots =
      std::min(world_file.robots.size(), most_robots_of_team);  // more are a problem already
  for (std::size_t i = 0; i < robots; ++i) {
    TeamRobotFile& member = world_file.robots[i];
    prepare_drive(file, fmt::format("robots.{}.drive", i), member.robot.drive, member.area, document,
                  problems);
    world.robots.push_back(std::move(member.robot));
  }
}

void generate_landmarks(const Node& document, WorldFile& world_file, std::vector<Problem>& problems) {
  const double most = limits().landmarks;
  constexpr std::size_t enough = 20;  // [-] problems after which no further generator runs
  World& world = world_file.world;
  for (std::size_t i = 0; i < world_file.generators.size() && problems.size() < enough; ++i) {
    const Generator& generator = world_file.generators[i];
    const std::string path = fmt::format("landmarks.generators.{}", i);
    const double wanted = wanted_landmarks(generator, world);
    if (wanted < 1 || wanted + static_cast<double>(world.landmarks.size()) > most) {
      const bool lacks_path =
          generator.pattern == Pattern::corridor && generator.points.empty() && world.drive.path.empty();
      refuse_value(document, path,
                   lacks_path
                       ? "the corridor needs 'points_m', because the drive has no path"
                       : fmt::format("the generator is to place {} landmarks: at least 1 and at most {}; "
                                     "seifbed --limits 4 COMMAND allows more",
                                     wanted, most),
                   problems);
      continue;
    }
    std::mt19937_64 random = generator_stream(world.seed, static_cast<std::uint32_t>(i));
    const Placed result = generate(generator, world, random);
    if (result.placed < result.wanted) {
      refuse_value(
          document, path,
          fmt::format("only {} of {} landmarks found a free place (max_tries is {}): there is too little "
                      "room for this many with these clear distances",
                      result.placed, result.wanted, generator.max_tries),
          problems);
    }
  }
}

std::optional<Node> read_document_with_overrides(const std::filesystem::path& file,
                                                 const std::vector<std::string>& overrides,
                                                 std::vector<Problem>& problems) {
  std::optional<Node> document = read_extended_document(file, problems);
  if (!document) return std::nullopt;
  if (document->kind == Node::Kind::map) {
    for (const std::string& assignment : overrides) apply_override(*document, assignment, problems);
  }
  return document;
}

/// A run writes the resolved world to its folder, and reads it again for scores and replays.
void check_resolved(const Node& document, const std::string& resolved, std::vector<Problem>& problems) {
  std::vector<Problem> found;
  if (resolved.size() <= limits().bytes / 2) return;  // too small to meet a limit that the file has not met
  if (parse_document(resolved, "resolved", found)) return;
  problems.push_back({document.where,
                      fmt::format("with all defaults written out, as a run's folder holds it, this world has "
                                  "{}",
                                  found.front().message),
                      ""});
}

void set_version(Node& document, std::string_view version) {
  if (version.empty()) return;
  if (document.find("seifbed_version") == nullptr) {
    document.entries.insert(document.entries.begin(), {"seifbed_version", document.where, {}});
  }
  *document.find("seifbed_version") = text_node(std::string(version), document.where);
}

}  // namespace

void find_libraries(const std::filesystem::path& file, Node& document) {
  const auto find_in = [&](Node* estimators) {
    if (estimators == nullptr) return;
    for (Node::Entry& entry : estimators->entries) {
      Node* library = entry.value.find("library");
      if (library != nullptr && library->kind == Node::Kind::scalar && !library->text.empty())
        *library = text_node(full_path(file, *library), library->where);
    }
  };
  find_in(document.find("estimators"));
  Node* robots = document.find("robots");
  if (robots == nullptr) return;
  for (Node& robot : robots->items) find_in(robot.find("estimators"));
}

LoadResult load_world(const std::filesystem::path& name, const std::vector<std::string>& overrides,
                      const EstimatorSchemas& estimators, std::string_view version,
                      const FurtherCheck& check) {
  const std::filesystem::path file = find_world(name);
  LoadResult result;
  std::vector<Problem>& problems = result.problems;
  std::optional<Node> document = read_document_with_overrides(file, overrides, problems);
  if (document && document->kind == Node::Kind::map) {
    WorldFile world_file;
    world_file.world.name = file.stem().string();
    find_libraries(file, *document);
    read_fields(
        *document, [&](Fields& fields) { describe_world(fields, world_file, estimators); }, problems);
    prepare_drives(file, world_file, *document, problems);
    check_world(*document, world_file.world, problems);
    if (check &&
        is_sound(problems, {"name", "seed", "robot", "robots", "sensors", "start_estimate", "estimators"}))
      check(*document, world_file.world, problems);
    if (is_sound(problems, {"ground", "robot", "robots", "obstacles", "landmarks", "drive", "seed"})) {
      generate_landmarks(*document, world_file, problems);
    }
    if (problems.empty()) {
      set_version(*document, version);
      result.resolved = emit(*document);
      check_resolved(*document, result.resolved, problems);
    }
    if (problems.empty()) {
      result.world = std::move(world_file.world);
    } else {
      result.resolved.clear();
    }
  } else if (document) {
    problems.push_back({document->where, "a world file must be a map of sections", ""});
  }
  sort_by_place(problems);
  return result;
}

}  // namespace worlds
