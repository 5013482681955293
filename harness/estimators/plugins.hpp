// Estimators in shared libraries, which are loaded while the program runs. How to write one: docs/plugins.md.
#pragma once

#include <filesystem>
#include <string>

#include "seif/plugin.hpp"
#include "seif/registry.hpp"
#include "worlds/world.hpp"

namespace harness {

/// The environment variable with the plug-ins that every command loads: paths with ':' between them.
inline constexpr const char* plugins_variable = "SEIFBED_PLUGINS";

/// What keeps this program from using a plug-in that was built like this; empty: nothing.
std::string mismatch(const seif::PluginBuild& build);

/// The estimators of a library. It is loaded once and stays loaded. Throws BadInput if it cannot be loaded, is no
/// plug-in, was built for another program, or fails while it adds its estimators.
const seif::Registry& plugin_estimators(const std::filesystem::path& library);

/// Adds the estimators of a library. Throws BadInput as plugin_estimators() does, and for a name that is taken.
void add_plugin(const std::filesystem::path& library, seif::Registry& registry);

/// Adds the plug-ins that the environment names.
void add_plugins_of_environment(seif::Registry& registry);

/// Adds a plug-in to the environment, so that the processes that this one starts load it, too. False if it is
/// there already.
bool pass_on_plugin(const std::filesystem::path& library);

/// The type of an estimator, from its library or from the registry. Throws BadInput if there is none.
const seif::EstimatorType& type_of(const seif::Registry& registry, const worlds::EstimatorChoice& choice);

}  // namespace harness
