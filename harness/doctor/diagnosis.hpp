// What the doctor finds: whether everything that this program can do, it can do here.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace harness {

struct Finding {
  std::string name;  // of what was looked at
  bool is_good = true;
  std::string says;  // a version or a figure; or what is wrong, and what to install
};

struct Diagnosis {
  std::vector<Finding> libraries;
  std::vector<Finding> machine;
  std::vector<Finding> self_test;
};

/// What `look` returns is what a good finding says, and what it throws (std::exception) is what is wrong.
Finding finding(const std::string& name, const std::function<std::string()>& look);

bool is_well(const Diagnosis& diagnosis);

/// One line for each finding, and a last one that says how it stands altogether.
std::string diagnosis_board(const Diagnosis& diagnosis);
std::string to_json(const Diagnosis& diagnosis);

}  // namespace harness
