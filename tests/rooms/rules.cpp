#include "rules.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <map>
#include <set>
#include <string_view>

namespace rooms {
namespace {

using Names = std::vector<std::string_view>;

struct Room {
  std::string_view folder;
  Names may_include;     // files, or folders with a trailing '/'
  bool pure = false;     // only Eigen and the standard library; no clock, no file, no output
  Names links_publicly;  // libraries that its users get with it
  Names links_privately;
};

/// Inner folders come before outer ones.
const std::vector<Room>& all_rooms() {
  static const std::vector<Room> rooms = {
      {"seif", {"seif/"}, true, {"Eigen3::Eigen"}, {"$<BUILD_INTERFACE:seifbed_flags>"}},
      {"worlds",
       {"worlds/"},
       false,
       {"Eigen3::Eigen"},
       {"yaml-cpp", "fmt::fmt", "nlohmann_json::nlohmann_json", "seifbed_flags"}},
      {"sensors", {"sensors/", "seif/types.hpp"}, true, {"seif", "Eigen3::Eigen"}, {"seifbed_flags"}},
      {"sim/render",
       {"sim/render/"},
       false,
       {"Eigen3::Eigen"},
       {"OSMesa::headers", "Freetype::Freetype", "PNG::PNG", "${CMAKE_DL_LIBS}", "seifbed_flags"}},
      {"sim",
       {"sim/", "worlds/"},
       false,
       {"worlds", "Eigen3::Eigen"},
       {"PkgConfig::bullet", "fmt::fmt", "render", "seifbed_flags"}},
      {"harness/peers/mrpt_filter",
       {"harness/peers/mrpt_filter/"},
       false,
       {},
       {"mrpt::slam", "seifbed_portable_flags"}},
      {"harness/peers", {"harness/peers/", "seif/"}, false, {}, {"seif", "mrpt_filter", "seifbed_flags"}},
      {"harness",
       {"harness/", "sim/", "sensors/", "seif/", "worlds/"},
       false,
       {"seif", "worlds", "sensors", "sim", "render", "harness", "Eigen3::Eigen"},
       {"Boost::headers", "Ceres::ceres", "fmt::fmt", "nlohmann_json::nlohmann_json", "CLI11::CLI11",
        "${CMAKE_DL_LIBS}", "seifbed_flags"}},
      {"python",
       {"python/", "harness/", "sim/", "sensors/", "seif/", "worlds/"},
       false,
       {},
       {"harness", "fmt::fmt", "nlohmann_json::nlohmann_json", "pybind11::module", "seifbed_flags"}},
  };
  return rooms;
}

bool is_header(std::string_view path) {
  return path.ends_with(".hpp") || path.ends_with(".h") || path.ends_with(".hh") || path.ends_with(".hxx");
}

bool is_inside(std::string_view path, std::string_view folder) {
  return path.size() > folder.size() && path.starts_with(folder) && path[folder.size()] == '/';
}

bool contains(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// A library that only some rooms may use.
struct Library {
  std::string_view name;
  bool (*owns_include)(std::string_view include);
  bool (*owns_word)(std::string_view word);
  bool (*allowed)(std::string_view path);
};

bool is_upper(std::string_view word, std::size_t at) {
  return at < word.size() && std::isupper(static_cast<unsigned char>(word[at])) != 0;
}

const std::array<Library, 11>& libraries() {
  using View = std::string_view;
  constexpr auto in_render = [](View path) { return is_inside(path, "sim/render"); };
  static constexpr std::array<Library, 11> all = {{
      {"Bullet",
       [](View include) {
         return include.starts_with("bt") || include.starts_with("Bullet") ||
                include.starts_with("bullet/") || include.starts_with("LinearMath/");
       },
       [](View word) { return word.starts_with("bt") && is_upper(word, 2); },
       [](View path) {
         return is_inside(path, "sim") && !is_inside(path, "sim/render") && path != "sim/simulator.hpp" &&
                !path.starts_with("sim/kinematic_simulator.");
       }},
      {"OSMesa", [](View include) { return include.starts_with("GL/") || include.starts_with("EGL/"); },
       [](View word) { return word.starts_with("OSMesa") || word.starts_with("GL_"); }, in_render},
      {"FreeType", [](View include) { return include == "ft2build.h" || include.starts_with("freetype/"); },
       [](View word) { return word.starts_with("FT_"); }, in_render},
      {"libpng", [](View include) { return include == "png.h" || include.starts_with("libpng"); },
       [](View word) { return word.starts_with("png_"); }, in_render},
      {"yaml-cpp", [](View include) { return include.starts_with("yaml-cpp/"); },
       [](View word) { return word == "YAML"; },
       [](View path) { return is_inside(path, "worlds") && !is_header(path); }},
      {"nlohmann-json", [](View include) { return include.starts_with("nlohmann/"); },
       [](View word) { return word == "nlohmann"; },
       [](View path) { return !is_header(path) || is_inside(path, "tests"); }},
      {"Boost", [](View include) { return include.starts_with("boost/"); },
       [](View word) { return word == "boost"; },
       [](View path) {
         return (is_inside(path, "harness") || is_inside(path, "tests/harness")) && !is_header(path);
       }},
      {"Ceres", [](View include) { return include.starts_with("ceres/"); },
       [](View word) { return word == "ceres"; },
       [](View path) { return is_inside(path, "harness") && !is_header(path); }},
      {"MRPT", [](View include) { return include.starts_with("mrpt/"); },
       [](View word) { return word == "mrpt"; },
       [](View path) { return is_inside(path, "harness/peers/mrpt_filter") && !is_header(path); }},
      {"pybind11", [](View include) { return include.starts_with("pybind11/") || include == "Python.h"; },
       [](View word) { return word == "pybind11"; }, [](View path) { return is_inside(path, "python"); }},
      {"CLI11", [](View include) { return include.starts_with("CLI/"); },
       [](View word) { return word == "CLI"; },
       [](View path) {
         return is_inside(path, "harness") || is_inside(path, "tests/harness") ||
                is_inside(path, "tests/soak");
       }},
  }};
  return all;
}

std::string at(std::string_view path, int line, const std::string& what) {
  return std::string(path) + ":" + std::to_string(line) + ": " + what;
}

/// A room's target, and the folder of its tests.
std::string_view name_of(const Room& room) { return room.folder.substr(room.folder.rfind('/') + 1); }

const Room* room_named(std::string_view folder) {
  const auto found = std::ranges::find(all_rooms(), folder, &Room::folder);
  return found == all_rooms().end() ? nullptr : &*found;
}

/// The room of a file, or of the file that a test is about; null if there is none.
const Room* room_of(std::string_view path) {
  for (const std::string_view whole : {"tests/fuzz", "tests/soak"}) {  // tests of all rooms together
    if (is_inside(path, whole)) return room_named("harness");
  }
  const bool test = is_inside(path, "tests");
  if (test) path.remove_prefix(std::string_view("tests/").size());
  const auto found = std::ranges::find_if(
      all_rooms(), [&](const Room& room) { return is_inside(path, test ? name_of(room) : room.folder); });
  return found == all_rooms().end() ? nullptr : &*found;
}

/// Whether the include names a file of this tree. In angle brackets it would escape the checks.
bool is_ours(const Include& include) {
  return include.quoted || std::ranges::any_of(all_rooms(), [&](const Room& room) {
           return is_inside(include.name, room.folder);
         });
}

bool follows_arrows(std::string_view path, std::string_view include) {
  // A test may include the files beside it by their bare names.
  if (include.find('/') == std::string_view::npos) return is_inside(path, "tests");
  if (include.find("..") != std::string_view::npos) return false;
  const Room* room = room_of(path);
  return room != nullptr && std::ranges::any_of(room->may_include, [&](std::string_view target) {
           return target.ends_with('/') ? include.starts_with(target) : include == target;
         });
}

Findings check_arrows(const Source& source) {
  Findings findings;
  for (const Include& include : source.includes) {
    if (include.name.empty()) {
      findings.push_back(at(source.path, include.line, "an include that names no file"));
    } else if (is_ours(include) && !follows_arrows(source.path, include.name)) {
      findings.push_back(at(source.path, include.line, "may not include " + include.name));
    }
  }
  return findings;
}

Findings check_libraries(const Source& source) {
  Findings findings;
  for (const Library& library : libraries()) {
    if (library.allowed(source.path)) continue;
    const std::string what = std::string(library.name) + " does not belong here: ";
    for (const Include& include : source.includes) {
      if (library.owns_include(include.name))
        findings.push_back(at(source.path, include.line, what + include.name));
    }
    for (const Token& token : source.tokens) {
      if (library.owns_word(token.text)) findings.push_back(at(source.path, token.line, what + token.text));
    }
  }
  return findings;
}

/// The filters and the sensors may use only Eigen and the standard library, without the parts that read a clock
/// or a file, or print.
Findings check_purity(const Source& source) {
  static const Names impure_headers = {"chrono",  "ctime",  "iostream", "fstream", "thread",
                                       "cstdio",  "future", "print",    "ostream", "filesystem",
                                       "iomanip", "mutex",  "atomic",   "csignal", "syncstream"};
  static const Names impure_words = {"chrono", "clock", "clock_gettime", "cout",
                                     "cerr",   "clog",  "printf",        "fprintf"};
  Findings findings;
  const Room* room = room_of(source.path);
  if (room == nullptr || !room->pure || is_inside(source.path, "tests")) return findings;
  for (const Include& include : source.includes) {
    if (is_ours(include) || include.name.starts_with("Eigen/")) continue;
    const bool standard = include.name.find_first_of("./") == std::string::npos;
    if (!standard || contains(impure_headers, include.name)) {
      findings.push_back(at(source.path, include.line, "may not include <" + include.name + ">"));
    }
  }
  for (const Token& token : source.tokens) {
    if (contains(impure_words, token.text)) {
      findings.push_back(at(source.path, token.line, "no clock and no output here: " + token.text));
    }
  }
  return findings;
}

/// Random numbers and times that are not passed in: with them a run would not follow from its seed alone.
Findings check_determinism(const Source& source) {
  static const std::vector<Names> forbidden = {{"random_device"},
                                               {"srand"},
                                               {"rand", "("},
                                               {"time", "(", "nullptr", ")"},
                                               {"time", "(", "NULL", ")"},
                                               {"time", "(", "0", ")"}};
  Findings findings;
  for (const Names& words : forbidden) {
    auto from = source.tokens.begin();
    const auto same = [](const Token& token, std::string_view word) { return token.text == word; };
    while ((from = std::search(from, source.tokens.end(), words.begin(), words.end(), same)) !=
           source.tokens.end()) {
      findings.push_back(at(source.path, from->line, std::string(words.front()) + " breaks determinism"));
      ++from;
    }
  }
  return findings;
}

Findings check_guard(const Source& source) {
  static constexpr std::array<std::string_view, 3> guard = {"#", "pragma", "once"};
  const auto same = [](const Token& token, std::string_view word) { return token.text == word; };
  const auto found =
      std::search(source.tokens.begin(), source.tokens.end(), guard.begin(), guard.end(), same);
  if (!is_header(source.path) || found != source.tokens.end()) return {};
  return {at(source.path, 1, "a header without #pragma once")};
}

void append(Findings& all, const Findings& more) { all.insert(all.end(), more.begin(), more.end()); }

using SourcesByPath = std::map<std::string, const Source*, std::less<>>;

/// The path of the file that an include of `source` names. A bare name is a file beside it.
std::string resolved(const Source& source, const Include& include) {
  if (include.name.find('/') != std::string::npos) return include.name;
  return source.path.substr(0, source.path.rfind('/') + 1) + include.name;
}

/// Every file of the tree that `start` includes, directly or through others.
std::set<std::string> reach_of(const Source& start, const SourcesByPath& sources) {
  std::set<std::string> reached;
  std::vector<const Source*> open = {&start};
  while (!open.empty()) {
    const Source* source = open.back();
    open.pop_back();
    for (const Include& include : source->includes) {
      const auto found = sources.find(resolved(*source, include));
      if (found != sources.end() && reached.insert(found->first).second) open.push_back(found->second);
    }
  }
  return reached;
}

bool includes_library(const Source& source, const Library& library) {
  return std::ranges::any_of(source.includes,
                             [&](const Include& include) { return library.owns_include(include.name); });
}

/// Whether the file belongs to the scorer, which takes trajectories, maps, covariances and counts,
/// whoever made them.
bool is_scorer(std::string_view path) { return path.starts_with("harness/score/"); }

/// Finds the items of one target_link_libraries that its room may not link in this way.
Findings check_link_line(const Command& command, const Room& room, std::string_view path) {
  Findings findings;
  bool is_private = false;
  for (std::size_t i = 1; i < command.arguments.size(); ++i) {
    const std::string& item = command.arguments[i];
    if (item == "PUBLIC" || item == "INTERFACE" || item == "PRIVATE") {
      is_private = item == "PRIVATE";
    } else if (!contains(room.links_publicly, item) &&
               !(is_private && contains(room.links_privately, item))) {
      const std::string how = is_private ? "privately" : "publicly";
      findings.push_back(at(path, command.line, "may not link " + item + " " + how));
    }
  }
  return findings;
}

}  // namespace

Findings check_source(const Source& source) {
  Findings findings;
  append(findings, check_arrows(source));
  append(findings, check_libraries(source));
  append(findings, check_purity(source));
  append(findings, check_determinism(source));
  append(findings, check_guard(source));
  return findings;
}

Findings check_reach(const std::vector<Source>& sources) {
  SourcesByPath by_path;
  for (const Source& source : sources) by_path.emplace(source.path, &source);
  Findings findings;
  for (const Source& source : sources) {
    for (const std::string& header : reach_of(source, by_path)) {
      for (const Library& library : libraries()) {
        if (library.allowed(source.path) || !includes_library(*by_path.at(header), library)) continue;
        findings.push_back(at(source.path, 1, "gets " + std::string(library.name) + " from " + header));
      }
      if (is_scorer(source.path) && !is_inside(header, "harness") && header != "seif/types.hpp" &&
          header != "seif/counts.hpp") {
        findings.push_back(at(source.path, 1, "the scorer may not know " + header));
      }
    }
  }
  return findings;
}

Findings check_cmake_lists(const TextFile& file) {
  // Commands that bypass the link line.
  static const Names detours = {"link_libraries", "link_directories", "include_directories",
                                "target_include_directories"};
  const Room* room = room_of(file.path);
  if (room == nullptr) return {at(file.path, 1, "is in no room")};
  const std::string_view target = name_of(*room);
  Findings findings;
  int libraries_made = 0;
  for (const Command& command : parse_cmake(file.text)) {
    if (command.name == "add_library") {
      ++libraries_made;
      if (command.arguments.empty() || command.arguments.front() != target) {
        findings.push_back(at(file.path, command.line, "the target of this room is " + std::string(target)));
      }
    } else if (command.name == "target_link_libraries") {
      append(findings, check_link_line(command, *room, file.path));
    } else if (contains(detours, command.name)) {
      findings.push_back(at(file.path, command.line, command.name + " goes round the link line"));
    }
  }
  if (libraries_made != 1) findings.push_back(at(file.path, 1, "a room makes one library"));
  return findings;
}

Findings check_paths(const std::vector<std::string>& paths) {
  static const Names top = {"sim",          "seif",       "worlds",    "sensors",         "tests",
                            "harness",      "docs",       "README.md", "CMakeLists.txt",  "CMakePresets.json",
                            "LICENSE",      "seifbed",    "test",      "CONTRIBUTING.md", "CHANGELOG.md",
                            "CITATION.cff", "Dockerfile", "cmake",     "python",          "pyproject.toml"};
  static const Names shapeless = {"common", "utils", "util", "helpers", "misc"};
  std::set<std::string> findings;
  for (std::string_view path : paths) {
    const std::string_view entry = path.substr(0, path.find('/'));
    if (!entry.starts_with('.') && !contains(top, entry))
      findings.insert(std::string(entry) + ": not at the top");
    for (std::string_view rest = path; !rest.empty();) {
      const std::string_view name = rest.substr(0, rest.find('/'));
      if (contains(shapeless, name.substr(0, name.find('.')))) {
        findings.insert(std::string(path) + ": '" + std::string(name) + "' does not say what it is for");
      }
      rest.remove_prefix(std::min(rest.size(), name.size() + 1));
    }
  }
  return {findings.begin(), findings.end()};
}

}  // namespace rooms
