#include "source.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>

namespace rooms {
namespace {

namespace fs = std::filesystem;

bool is_word(char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// Walks through a text and counts its lines.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}

  bool at_end() const { return at_ == text_.size(); }
  int line() const { return line_; }
  char peek() const { return text_[at_]; }
  bool sees(std::string_view what) const { return text_.substr(at_).starts_with(what); }

  /// The next `count` characters, or the rest if it is shorter.
  std::string_view take(std::size_t count) {
    const std::string_view taken = text_.substr(at_, count);
    line_ += static_cast<int>(std::ranges::count(taken, '\n'));
    at_ += taken.size();
    return taken;
  }

  template <typename Predicate>
  std::string_view take_while(Predicate predicate) {
    std::size_t count = 0;
    while (at_ + count < text_.size() && predicate(text_[at_ + count])) ++count;
    return take(count);
  }

  /// Takes everything up to and including the next `end`; returns it without `end`.
  std::string_view take_past(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    const std::string_view taken = take(found == std::string_view::npos ? found : found - at_);
    take(end.size());
    return taken;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

void skip_line(Cursor& cursor) {
  cursor.take_while([](char c) { return c != '\n'; });
}

/// Skips "..." or '...'; an unclosed literal ends with its line.
void skip_literal(Cursor& cursor) {
  const char quote = cursor.take(1).front();
  while (!cursor.at_end() && cursor.peek() != '\n') {
    const char c = cursor.take(1).front();
    if (c == quote) return;
    if (c == '\\') cursor.take(1);
  }
}

/// Skips R"x(...)x"; its prefix is already taken.
void skip_raw_literal(Cursor& cursor) {
  cursor.take(1);
  const std::string delimiter(cursor.take_past("("));
  cursor.take_past(")" + delimiter + "\"");
}

bool skip_comment(Cursor& cursor) {
  if (cursor.sees("//")) {
    skip_line(cursor);
  } else if (cursor.sees("/*")) {
    cursor.take(2);
    cursor.take_past("*/");
  } else {
    return false;
  }
  return true;
}

/// Takes the text after `#include`.
Include take_include(Cursor& cursor) {
  cursor.take_while([](char c) { return c == ' ' || c == '\t'; });
  Include include{.line = cursor.line(), .name = {}};
  if (cursor.at_end() || (cursor.peek() != '"' && cursor.peek() != '<')) return include;
  include.quoted = cursor.take(1) == "\"";
  include.name = cursor.take_past(include.quoted ? "\"" : ">");
  return include;
}

bool after_hash(const Source& source, int line) {
  return !source.tokens.empty() && source.tokens.back().text == "#" && source.tokens.back().line == line;
}

void take_word(Cursor& cursor, Source& source) {
  const int line = cursor.line();
  const std::string word(cursor.take_while(is_word));
  if (word == "include" && after_hash(source, line)) {
    source.tokens.pop_back();
    source.includes.push_back(take_include(cursor));
  } else if (word.ends_with('R') && word.size() <= 3 && cursor.sees("\"")) {
    skip_raw_literal(cursor);
  } else {
    source.tokens.push_back({line, word});
  }
}

/// Takes a number with its digit separators, which would otherwise look like character literals.
void take_number(Cursor& cursor, Source& source) {
  const int line = cursor.line();
  const auto digits = cursor.take_while([](char c) { return is_word(c) || c == '\'' || c == '.'; });
  source.tokens.push_back({line, std::string(digits)});
}

bool is_cpp(const fs::path& path) {
  static constexpr std::array<std::string_view, 8> extensions = {".cpp", ".cc", ".cxx", ".c",
                                                                 ".hpp", ".hh", ".hxx", ".h"};
  return std::ranges::find(extensions, path.extension().string()) != extensions.end();
}

std::string read_text(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The files below the folders `tops` of `root` for which `wanted` is true, in the order of their paths.
template <typename Predicate>
std::vector<TextFile> read_files(const fs::path& root, std::initializer_list<const char*> tops,
                                 Predicate wanted) {
  std::vector<TextFile> files;
  for (const char* top : tops) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (!entry.is_regular_file() || !wanted(entry.path())) continue;
      files.push_back({entry.path().lexically_relative(root).generic_string(), read_text(entry.path())});
    }
  }
  std::ranges::sort(files, {}, &TextFile::path);
  return files;
}

/// The output of `git ls-files`; empty if git or its history is missing.
std::vector<std::string> tracked_paths(const std::string& root) {
  std::string quoted = "'";
  for (const char c : root) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  quoted += "'";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(
      popen(("git -C " + quoted + " ls-files -z 2>&-").c_str(), "r"), pclose);
  std::vector<std::string> paths;
  if (!pipe) return paths;
  std::string path;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) {
    if (c != '\0') {
      path += static_cast<char>(c);
    } else {
      paths.push_back(std::exchange(path, {}));
    }
  }
  return paths;
}

}  // namespace

Source parse_source(const TextFile& file) {
  Source source{file.path, {}, {}};
  Cursor cursor(file.text);
  while (!cursor.at_end()) {
    const char c = cursor.peek();
    if (skip_comment(cursor)) continue;
    if (is_space(c)) {
      cursor.take(1);
    } else if (is_digit(c)) {
      take_number(cursor, source);
    } else if (is_word(c)) {
      take_word(cursor, source);
    } else if (c == '"' || c == '\'') {
      skip_literal(cursor);
    } else {
      source.tokens.push_back({cursor.line(), std::string(cursor.take(1))});
    }
  }
  return source;
}

std::vector<Command> parse_cmake(std::string_view text) {
  std::vector<Command> commands;
  Cursor cursor(text);
  int depth = 0;
  while (!cursor.at_end()) {
    const char c = cursor.peek();
    if (c == '#') {
      skip_line(cursor);
    } else if (c == '(' || c == ')') {
      depth += c == '(' ? 1 : -1;
      cursor.take(1);
    } else if (is_space(c)) {
      cursor.take(1);
    } else {
      const int line = cursor.line();
      std::string word(cursor.take_while([](char w) { return !is_space(w) && w != '(' && w != ')'; }));
      if (depth > 0 && !commands.empty()) {
        commands.back().arguments.push_back(std::move(word));
      } else {
        std::ranges::transform(word, word.begin(),
                               [](unsigned char w) { return static_cast<char>(std::tolower(w)); });
        commands.push_back({line, std::move(word), {}});
      }
    }
  }
  return commands;
}

std::vector<TextFile> read_sources(const std::string& root) {
  return read_files(root, {"seif", "worlds", "sensors", "sim", "harness", "tests"}, is_cpp);
}

std::vector<TextFile> read_cmake_lists(const std::string& root) {
  return read_files(root, {"seif", "worlds", "sensors", "sim", "harness"},
                    [](const fs::path& path) { return path.filename() == "CMakeLists.txt"; });
}

std::vector<std::string> list_tree(const std::string& root) {
  std::vector<std::string> paths = tracked_paths(root);
  if (!paths.empty()) return paths;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::recursive_directory_iterator();
       ++entry) {
    const std::string path = entry->path().lexically_relative(root).generic_string();
    if (path == "build" || path == "runs" || path == ".git") {
      entry.disable_recursion_pending();
    } else {
      paths.push_back(path);
    }
  }
  std::ranges::sort(paths);
  return paths;
}

}  // namespace rooms
