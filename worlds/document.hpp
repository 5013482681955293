// YAML as a tree of our own. Every value knows where it was written, and keeps its original text.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace worlds {

/// Where something was written.
struct Location {
  std::shared_ptr<const std::string> source;  // the file's path, or the whole `--set key=value`
  int line = 0;                               // 1-based; 0: the source has no lines
  int column = 0;                             // 1-based
};

/// Something that is wrong with a document.
struct Problem {
  Location where;
  std::string message;
  std::string path;  // of the value, as in `drive.waypoints_m.0`; empty: the whole document
};

/// `file:line:column: message`, or `source: message` where there are no lines.
std::string to_string(const Problem& problem);

/// Sorts by source, line and column.
void sort_by_place(std::vector<Problem>& problems);

/// A YAML value. Exactly one of `text`, `items` and `entries` is in use.
struct Node {
  enum class Kind { null, scalar, sequence, map };
  struct Entry;

  Kind kind = Kind::null;
  bool quoted = false;  // scalars: quoted text is never a number or a boolean
  Location where;
  std::string text;            // scalars: as written, without quotes
  std::vector<Node> items;     // sequences
  std::vector<Entry> entries;  // maps: in the order of the file, keys distinct

  /// The value of a key; null if there is no such key, or if this is not a map.
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
};

struct Node::Entry {
  std::string key;
  Location where;
  Node value;
};

/// The value at a path of keys and list indices, joined with dots; null if there is no such value.
const Node* find_path(const Node& root, std::string_view path);
Node* find_path(Node& root, std::string_view path);

/// How deep maps and lists may be nested. [-]
inline constexpr int max_depth = 64;

/// Parses a text that holds one YAML document. Returns nothing if there is a problem; adds all problems found
/// to `problems`. Problems are: syntax errors, text that is not UTF-8, an empty text, a second document,
/// duplicate keys, keys that are not plain words, tags, nesting deeper than max_depth, and anything beyond
/// limits().
std::optional<Node> parse_document(std::string_view text, const std::string& source,
                                   std::vector<Problem>& problems);

/// Parses one file, as parse_document does. A file that cannot be read, or is not a regular file, is a problem
/// too.
std::optional<Node> read_document(const std::filesystem::path& file, std::vector<Problem>& problems);

/// Writes YAML text that parses to the same tree.
std::string emit(const Node& root);

}  // namespace worlds
