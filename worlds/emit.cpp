#include <algorithm>
#include <string>
#include <string_view>

#include "worlds/document.hpp"

namespace worlds {
namespace {

bool is_plain(std::string_view text) {
  const auto is_safe = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || c == '-' || c == '+' || c == '/';
  };
  const bool is_null = text == "null" || text == "Null" || text == "NULL";  // would be read as null
  return !text.empty() && !is_null && text != "-" && text.find("---") != 0 && text.find("...") != 0 &&
         std::all_of(text.begin(), text.end(), is_safe);
}

std::string quote(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (c == '\r') {
      out += "\\r";
    } else {
      out += c;
    }
  }
  return out + '"';
}

bool is_leaf(const Node& node) { return node.items.empty() && node.entries.empty(); }

/// Small things are written in one line: values, points, and maps and lists that hold only values.
bool fits_a_line(const Node& node) {
  constexpr std::size_t longest = 8;
  const bool plain_items = std::all_of(node.items.begin(), node.items.end(), is_leaf);
  const bool plain_entries = std::all_of(node.entries.begin(), node.entries.end(),
                                         [](const Node::Entry& entry) { return is_leaf(entry.value); });
  return plain_items && plain_entries && node.items.size() + node.entries.size() <= longest;
}

void emit_inline(const Node& node, std::string& out) {
  const auto separate = [&](const auto& list, const auto& element) {
    out += &element == &list.front() ? "" : ", ";
  };
  switch (node.kind) {
    case Node::Kind::null:
      out += "null";
      break;
    case Node::Kind::scalar:
      out += !node.quoted && is_plain(node.text) ? node.text : quote(node.text);
      break;
    case Node::Kind::sequence:
      out += '[';
      for (const Node& item : node.items) {
        separate(node.items, item);
        emit_inline(item, out);
      }
      out += ']';
      break;
    case Node::Kind::map:
      out += '{';
      for (const Node::Entry& entry : node.entries) {
        separate(node.entries, entry);
        out += (is_plain(entry.key) ? entry.key : quote(entry.key)) + ": ";
        emit_inline(entry.value, out);
      }
      out += '}';
      break;
  }
}

void emit_block(const Node& node, std::size_t indent, std::string& out) {
  const std::string margin(indent, ' ');
  for (const auto& [key, where, value] : node.entries) {
    out += margin + (is_plain(key) ? key : quote(key)) + ':';
    if (is_leaf(value) || (value.kind == Node::Kind::sequence && fits_a_line(value))) {
      out += ' ';
      emit_inline(value, out);
      out += '\n';
    } else {
      out += '\n';
      emit_block(value, indent + 2, out);
    }
  }
  for (const Node& item : node.items) {
    out += margin + "- ";
    if (fits_a_line(item)) {
      emit_inline(item, out);
      out += '\n';
    } else {
      std::string block;
      emit_block(item, indent + 2, block);
      out += std::string_view(block).substr(indent + 2);  // its first line follows the dash
    }
  }
}

}  // namespace

std::string emit(const Node& root) {
  std::string out;
  if (is_leaf(root)) {
    emit_inline(root, out);
    out += '\n';
  } else {
    emit_block(root, 0, out);
  }
  return out;
}

}  // namespace worlds
