#include "worlds/document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include "worlds/input_file.hpp"
#include "worlds/limits.hpp"

namespace worlds {
namespace {

using Source = std::shared_ptr<const std::string>;

/// Thrown to end the parsing of a document that would not fit in memory or on the stack.
struct GivenUp {
  YAML::Mark mark;
  std::string message;
};

std::size_t count_nodes(const Node& node) {
  std::size_t count = 1;
  for (const Node& item : node.items) count += count_nodes(item);
  for (const Node::Entry& entry : node.entries) count += count_nodes(entry.value);
  return count;
}

/// Builds the tree from yaml-cpp's events. yaml-cpp's own tree accepts duplicate keys, and does not keep the
/// quotes.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(Source source, std::vector<Problem>& problems)
      : source_(std::move(source)), problems_(problems) {}

  Node take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add(mark, anchor, make(mark, Node::Kind::null));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) throw GivenUp{mark, "an alias cannot stand inside of what it stands for"};
    count(mark, found->second.size);
    add(mark, YAML::NullAnchor, found->second.node);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_tag(mark, tag);
    Node node = make(mark, Node::Kind::scalar);
    node.text = value;
    node.quoted = tag == "!";
    add(mark, anchor, std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, Node::Kind::sequence);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, Node::Kind::map);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Frame {  // a map or list that is not yet complete
    Node node;
    YAML::Mark mark;
    YAML::anchor_t anchor = YAML::NullAnchor;
    std::set<std::string> keys;
    std::optional<Node::Entry> pending;  // maps: a key that waits for its value
  };
  struct Anchored {
    Node node;
    std::size_t size = 0;
  };

  Location location(const YAML::Mark& mark) const { return {source_, mark.line + 1, mark.column + 1}; }

  Node make(const YAML::Mark& mark, Node::Kind kind) const {
    Node node;
    node.kind = kind;
    node.where = location(mark);
    return node;
  }

  void problem(const YAML::Mark& mark, std::string message) {
    problems_.push_back({location(mark), std::move(message), ""});
  }

  void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    if (!tag.empty() && tag != "?" && tag != "!") {
      problem(mark, fmt::format("the tag '{}' is not supported: write the plain value", tag));
    }
  }

  void count(const YAML::Mark& mark, std::size_t more) {
    nodes_ += more;
    if (nodes_ > limits().values)
      throw GivenUp{
          mark, fmt::format("more than {} values, aliases included; seifbed --limits 4 COMMAND allows more",
                            limits().values)};
  }

  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, Node::Kind kind) {
    refuse_tag(mark, tag);
    if (frames_.size() >= static_cast<std::size_t>(max_depth)) {
      throw GivenUp{mark, fmt::format("maps and lists are nested more than {} deep", max_depth)};
    }
    frames_.push_back({make(mark, kind), mark, anchor, {}, std::nullopt});
  }

  void close() {
    Frame frame = std::move(frames_.back());
    frames_.pop_back();
    add(frame.mark, frame.anchor, std::move(frame.node));
  }

  /// Adds a complete value to the map or list that holds it.
  void add(const YAML::Mark& mark, YAML::anchor_t anchor, Node node) {
    count(mark, 1);
    if (anchor != YAML::NullAnchor) {
      const std::size_t size = count_nodes(node);
      count(mark, size);  // the copy that is kept for the aliases
      anchors_[anchor] = {node, size};
    }
    if (frames_.empty()) {
      root_ = std::move(node);
    } else if (Frame& frame = frames_.back(); frame.node.kind == Node::Kind::sequence) {
      frame.node.items.push_back(std::move(node));
    } else if (!frame.pending) {
      begin_entry(frame, mark, std::move(node));
    } else {
      frame.pending->value = std::move(node);
      if (frame.keys.insert(frame.pending->key).second)
        frame.node.entries.push_back(*std::move(frame.pending));
      frame.pending.reset();
    }
  }

  void begin_entry(Frame& frame, const YAML::Mark& mark, Node key) {
    if (key.kind != Node::Kind::scalar) {
      problem(mark, "a key must be a plain word");
    } else if (frame.keys.count(key.text) > 0) {
      const auto first = std::find_if(frame.node.entries.begin(), frame.node.entries.end(),
                                      [&](const Node::Entry& entry) { return entry.key == key.text; });
      problem(mark,
              fmt::format("the key '{}' stands here twice: first in line {}", key.text, first->where.line));
    }
    frame.pending = Node::Entry{std::move(key.text), location(mark), {}};
  }

  Source source_;
  std::vector<Problem>& problems_;
  Node root_;
  std::vector<Frame> frames_;
  std::map<YAML::anchor_t, Anchored> anchors_;
  std::size_t nodes_ = 0;
};

/// The number of bytes of the well-formed UTF-8 character (Unicode 15, table 3-7) that begins at `at`; 0 if
/// there is none.
std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t offset) {
    return at + offset < text.size() ? static_cast<unsigned char>(text[at + offset]) : 0U;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  unsigned lowest =
      0x80;  // of the second byte: excludes overlong forms, surrogates, and characters beyond U+10FFFF
  unsigned highest = 0xBF;
  if (lead == 0xE0) lowest = 0xA0;
  if (lead == 0xED) highest = 0x9F;
  if (lead == 0xF0) lowest = 0x90;
  if (lead == 0xF4) highest = 0x8F;
  if (byte(1) < lowest || byte(1) > highest) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
  }
  return length;
}

/// yaml-cpp would guess other encodings; here only UTF-8 is allowed.
bool check_encoding(std::string_view text, const Source& source, std::vector<Problem>& problems) {
  Location here{source, 1, 1};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    const auto code = static_cast<unsigned char>(text[at]);
    if (length == 0 || (code < 0x20 && code != '\t' && code != '\n' && code != '\r') || code == 0x7F) {
      problems.push_back(
          {here, fmt::format("the byte 0x{:02x} does not belong in a UTF-8 text file", code), ""});
      return false;
    }
    here.line += code == '\n' ? 1 : 0;
    here.column = code == '\n' ? 1 : here.column + 1;
    at += length;
  }
  return true;
}

constexpr const char* unclosed = "a quote, a list or a map is not closed before the end";

/// Adds an end-of-document marker to the text. yaml-cpp takes a quote that is never closed as closed at the end
/// of the text. The marker cannot stand inside a quote, so such a quote becomes an error.
std::string with_end(std::string_view text) {
  const bool is_line = text.empty() || text.back() == '\n';
  return std::string(text) + (is_line ? "...\n" : "\n...\n");
}

/// Whether the text holds only white space and comments.
bool is_void(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first != std::string_view::npos && line[first] != '#') return false;
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
  return true;
}

/// Reads as much of a file as may be parsed, and one byte more if there is more. Nothing if the file cannot be
/// read.
std::optional<std::string> read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(limits().bytes + 1, '\0');
  if (!stream.read(text.data(), static_cast<std::streamsize>(text.size())) && !stream.eof())
    return std::nullopt;
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

}  // namespace

std::string to_string(const Problem& problem) {
  const auto& [source, line, column] = problem.where;
  const std::string name = source ? *source : "";
  std::string message = problem.message;
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  std::replace_if(message.begin(), message.end(), is_control, '?');  // one line, and no escape codes
  return line > 0 ? fmt::format("{}:{}:{}: {}", name, line, column, message)
                  : fmt::format("{}: {}", name, message);
}

void sort_by_place(std::vector<Problem>& problems) {
  static const std::string nowhere;
  const auto place = [](const Problem& problem) {
    const Location& where = problem.where;
    return std::tuple<const std::string&, int, int>(where.source ? *where.source : nowhere, where.line,
                                                    where.column);
  };
  std::stable_sort(problems.begin(), problems.end(),
                   [&](const Problem& a, const Problem& b) { return place(a) < place(b); });
}

const Node* Node::find(std::string_view key) const {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.key == key; });
  return found == entries.end() ? nullptr : &found->value;
}

Node* Node::find(std::string_view key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

const Node* find_path(const Node& root, std::string_view path) {
  const Node* node = &root;
  while (node != nullptr && !path.empty()) {
    const std::string_view step = path.substr(0, path.find('.'));
    path.remove_prefix(std::min(path.size(), step.size() + 1));
    if (node->kind == Node::Kind::sequence) {
      std::size_t index = node->items.size();
      std::from_chars(step.data(), step.data() + step.size(), index);
      node = index < node->items.size() ? &node->items[index] : nullptr;
    } else {
      node = node->find(step);
    }
  }
  return node;
}

Node* find_path(Node& root, std::string_view path) {
  return const_cast<Node*>(find_path(static_cast<const Node&>(root), path));
}

std::optional<Node> parse_document(std::string_view text, const std::string& source,
                                   std::vector<Problem>& problems) {
  const auto name = std::make_shared<const std::string>(source);
  const std::size_t problems_before = problems.size();
  if (!check_encoding(text, name, problems)) return std::nullopt;
  if (text.size() > limits().bytes) {
    problems.push_back(
        {{name, 0, 0},
         fmt::format("more than {} bytes; seifbed --limits 4 COMMAND allows more", limits().bytes),
         ""});
    return std::nullopt;
  }
  TreeBuilder builder(name, problems);
  const auto give_up = [&](const YAML::Mark& mark, const std::string& message) {
    problems.push_back({{name, mark.line + 1, mark.column + 1}, message, ""});
  };
  try {
    std::istringstream stream{with_end(text)};
    YAML::Parser parser(stream);
    if (is_void(text) || !parser.HandleNextDocument(builder)) {
      give_up({}, "the document is empty");
    } else if (TreeBuilder rest(name, problems); parser.HandleNextDocument(rest)) {
      give_up({}, "there must be one document, not several (is there a line '---' too many?)");
    }
  } catch (const GivenUp& reason) {
    give_up(reason.mark, reason.message);
  } catch (const YAML::Exception& error) {
    const bool is_at_our_end = error.mark.pos >= 0 && static_cast<std::size_t>(error.mark.pos) >= text.size();
    give_up(error.mark, is_at_our_end ? unclosed : error.msg);
  }
  if (problems.size() > problems_before) return std::nullopt;
  return builder.take_root();
}

std::optional<Node> read_document(const std::filesystem::path& file, std::vector<Problem>& problems) {
  const auto refuse = [&](const std::string& why) {
    problems.push_back({{std::make_shared<const std::string>(file.string()), 0, 0}, why, ""});
    return std::nullopt;
  };
  if (const std::string why = why_no_input(file); !why.empty()) return refuse(why);
  const std::optional<std::string> text = read_text(file);
  if (!text) return refuse("the file cannot be read");
  return parse_document(*text, file.string(), problems);
}

}  // namespace worlds
