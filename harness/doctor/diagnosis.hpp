// The findings of `seifbed doctor`: whether everything works on this machine.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace harness {

struct Finding {
  std::string name;  // what was examined
  bool is_good = true;
  std::string says;  // a version or a figure; or the problem, and what to install
};

struct Diagnosis {
  std::vector<Finding> libraries;
  std::vector<Finding> machine;
  std::vector<Finding> self_test;
};

/// Calls `look`. Its result is the text of a good finding; the message of a std::exception is the text of a
/// bad one.
Finding finding(const std::string& name, const std::function<std::string()>& look);

bool is_well(const Diagnosis& diagnosis);

/// One line for each finding, and a last line with the overall result.
std::string diagnosis_board(const Diagnosis& diagnosis);
std::string to_json(const Diagnosis& diagnosis);

}  // namespace harness
