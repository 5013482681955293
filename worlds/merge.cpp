#include "worlds/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>
#include <utility>

#include "worlds/input_file.hpp"

namespace worlds {
namespace {

namespace fs = std::filesystem;

/// Merges `over` into `base`; `over` wins.
void merge(Node& base, Node over) {
  if (base.kind != Node::Kind::map || over.kind != Node::Kind::map) {
    base = std::move(over);
    return;
  }
  base.where = over.where;
  for (Node::Entry& entry : over.entries) {
    const auto found = std::find_if(base.entries.begin(), base.entries.end(),
                                    [&](const Node::Entry& old) { return old.key == entry.key; });
    if (found == base.entries.end()) {
      base.entries.push_back(std::move(entry));
    } else if (entry.value.kind == Node::Kind::null) {
      base.entries.erase(found);
    } else {
      found->where = entry.where;
      merge(found->value, std::move(entry.value));
    }
  }
}

fs::path same_name(const fs::path& file) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(file, error);
  return error ? file : canonical;
}

/// Whether the file, or what it is a link to, is named as world files are. Nothing else is read, since messages
/// about a file quote what stands in it.
bool is_named_as_world(const fs::path& file) {
  const fs::path extension = same_name(file).extension();
  return extension == ".yaml" || extension == ".yml";
}

/// Removes `extends` from a map, and returns it. Nothing if there is none.
std::optional<Node> take_extends(Node& node) {
  const auto found = std::find_if(node.entries.begin(), node.entries.end(),
                                  [](const Node::Entry& entry) { return entry.key == "extends"; });
  if (found == node.entries.end()) return std::nullopt;
  Node value = std::move(found->value);
  node.entries.erase(found);
  return value;
}

std::string show_chain(const std::vector<fs::path>& chain, const fs::path& last) {
  std::string text;
  for (const fs::path& file : chain) text += file.string() + " -> ";
  return text + last.string();
}

std::optional<Node> read_chain(const fs::path& file, std::vector<fs::path>& chain,
                               std::vector<Problem>& problems) {
  std::optional<Node> node = read_document(file, problems);
  if (!node) return std::nullopt;
  const std::optional<Node> extends = take_extends(*node);
  if (!extends) return node;
  const auto refuse = [&](std::string message) {
    problems.push_back({extends->where, std::move(message), "extends"});
    return std::nullopt;
  };
  if (extends->kind != Node::Kind::scalar || extends->text.empty()) {
    return refuse("'extends' must name one file");
  }
  const fs::path base_file = (file.parent_path() / extends->text).lexically_normal();
  chain.push_back(file);
  const auto is_base = [&](const fs::path& other) { return same_name(other) == same_name(base_file); };
  if (std::any_of(chain.begin(), chain.end(), is_base)) {
    return refuse("'extends' goes in a circle: " + show_chain(chain, base_file));
  }
  if (const std::string why = why_no_input(base_file); !why.empty())
    return refuse(fmt::format("'extends' names no file that can be read: {}: {}", base_file.string(), why));
  if (!is_named_as_world(base_file))
    return refuse(fmt::format("'extends' names a file that is no world file, which ends in .yaml or .yml: {}",
                              base_file.string()));
  std::optional<Node> base = read_chain(base_file, chain, problems);
  if (!base) return std::nullopt;
  if (base->kind != Node::Kind::map || node->kind != Node::Kind::map) {
    return refuse(fmt::format("'extends' names a file that is no world file, which is a map of sections: {}",
                              base_file.string()));
  }
  merge(*base, *std::move(node));
  return base;
}

/// Sets the location of a whole tree.
void relocate(Node& node, const Location& where) {
  node.where = where;
  for (Node& item : node.items) relocate(item, where);
  for (Node::Entry& entry : node.entries) {
    entry.where = where;
    relocate(entry.value, where);
  }
}

Node empty_map(const Location& where) {
  Node node;
  node.kind = Node::Kind::map;
  node.where = where;
  return node;
}

/// Whether the text consists of the characters that keys, names and indices have. Other bytes would make a
/// document that no file could hold.
bool is_word(std::string_view text) {
  return text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
         std::string_view::npos;
}

/// One step along a path: returns the child, which is made if it is missing in a map. Null and a message if it
/// cannot be made.
Node* step_into(Node& node, std::string_view step, const Location& where, std::string& message) {
  if (node.kind == Node::Kind::sequence) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
    if (error != std::errc() || end != step.data() + step.size() || index >= node.items.size()) {
      message = fmt::format("'{}' is no index of a list of {}: the first item is 0", step, node.items.size());
      return nullptr;
    }
    return &node.items[index];
  }
  if (node.kind != Node::Kind::map) {
    message = fmt::format("there is nothing inside of which '{}' could be set", step);
    return nullptr;
  }
  if (Node* child = node.find(step)) return child;
  node.entries.push_back({std::string(step), where, empty_map(where)});
  return &node.entries.back().value;
}

}  // namespace

std::optional<Node> read_extended_document(const fs::path& file, std::vector<Problem>& problems) {
  std::vector<fs::path> chain;
  return read_chain(file, chain, problems);
}

void apply_override(Node& root, const std::string& assignment, std::vector<Problem>& problems) {
  const std::string source = "--set " + assignment;
  const Location where{std::make_shared<const std::string>(source), 0, 0};
  const auto refuse = [&](std::string message) { problems.push_back({where, std::move(message), ""}); };

  const std::size_t equals = assignment.find('=');
  std::string_view path = std::string_view(assignment).substr(0, equals);
  if (equals == std::string::npos || path.empty()) return refuse("expected path.to.key=value");
  if (path == "extends") return refuse("'extends' can only stand in a file");
  std::vector<Problem> found;
  std::optional<Node> value = parse_document(std::string_view(assignment).substr(equals + 1), source, found);
  if (!value) {
    for (const Problem& problem : found) refuse("the value is no YAML: " + problem.message);
    return;
  }
  relocate(*value, where);

  Node changed = root;  // a path that fails must not leave a part of it in the document
  Node* node = &changed;
  for (bool more = true; more;) {
    const std::size_t dot = path.find('.');
    const std::string_view step = path.substr(0, dot);
    more = dot != std::string_view::npos;
    path.remove_prefix(more ? dot + 1 : path.size());
    std::string message;
    if (step.empty()) return refuse("a part of the path is empty");
    if (!is_word(step)) return refuse("a part of the path is no word of letters, digits, '_' and '-'");
    node = step_into(*node, step, where, message);
    if (node == nullptr) return refuse(message);
  }
  *node = *std::move(value);
  root = std::move(changed);
}

}  // namespace worlds
