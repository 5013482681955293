// What a description cannot say: whether the parts of a world fit together.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "worlds/describe.hpp"
#include "worlds/document.hpp"

namespace worlds {

/// Whether none of the problems is with one of the sections, such as "drive" or "robot.start", or within it.
bool is_sound(const std::vector<Problem>& problems, const std::vector<std::string_view>& sections);

/// Adds a problem at the place of the value at a path of the document, or at what holds it.
void refuse_value(const Node& document, std::string_view path, std::string message,
                  std::vector<Problem>& problems);

/// Checks rates, start, obstacles, path and the landmarks placed by hand against each other. What depends on
/// a section with a problem is not checked. The path of the drive must be laid out, its commands read.
void check_world(const Node& document, const World& world, std::vector<Problem>& problems);

/// Checks that the estimators to be filmed are among those that run; check_world does so too. For a replay,
/// whose world is not checked otherwise.
void check_film(const Node& document, const World& world, std::vector<Problem>& problems);

}  // namespace worlds
