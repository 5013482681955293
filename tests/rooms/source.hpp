// C++ and CMake text, parsed as far as the rules of the rooms need it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rooms {

/// A file of the tree.
struct TextFile {
  std::string path;  // from the root of the tree, with '/'
  std::string text;
};

/// One `#include`. The name is empty where the directive names no file (`#include MACRO`).
struct Include {
  int line = 0;  // from 1
  std::string name;
  bool quoted = false;  // "name", not in angle brackets
};

/// An identifier, a number or a single punctuation character. Comments and literals give no tokens.
struct Token {
  int line = 0;  // from 1
  std::string text;
};

/// A C++ source: its includes, and the tokens of its code.
struct Source {
  std::string path;
  std::vector<Include> includes;
  std::vector<Token> tokens;
};

Source parse_source(const TextFile& file);

/// A CMake command; its name in lower case.
struct Command {
  int line = 0;  // from 1
  std::string name;
  std::vector<std::string> arguments;
};

std::vector<Command> parse_cmake(std::string_view text);

/// The C++ sources of the rooms and of their tests, and the CMakeLists.txt of the rooms, in the order of
/// their paths.
std::vector<TextFile> read_sources(const std::string& root);
std::vector<TextFile> read_cmake_lists(const std::string& root);

/// The paths that git tracks. Without git's history: all paths except those of build and run folders.
std::vector<std::string> list_tree(const std::string& root);

}  // namespace rooms
