// Checks what a description of single values cannot: whether the parts of a world fit together.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "worlds/describe.hpp"
#include "worlds/document.hpp"

namespace worlds {

/// True if no problem lies in one of the sections, such as "drive" or "robot.start".
bool is_sound(const std::vector<Problem>& problems, const std::vector<std::string_view>& sections);

/// Adds a problem at the value with this path in the document, or, if there is none, at the map or list that
/// should hold it.
void refuse_value(const Node& document, std::string_view path, std::string message,
                  std::vector<Problem>& problems);

/// Checks rates, start, obstacles, path and the landmarks placed by hand against each other. Leaves out checks
/// that depend on a section with a problem. Before the call, the path of the drive must be laid out and its
/// commands read.
void check_world(const Node& document, const World& world, std::vector<Problem>& problems);

/// Checks that the estimators to be filmed are among those that run. check_world does this too; this function
/// is for a replay, whose world is not checked otherwise.
void check_film(const Node& document, const World& world, std::vector<Problem>& problems);

}  // namespace worlds
