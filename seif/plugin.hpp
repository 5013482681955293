// Estimators of your own in a shared library, a plug-in, which the program loads when it starts:
//
//   void add_mine(seif::Registry& registry) { registry.add({.name = "mine", ...}); }
//   SEIF_PLUGIN(add_mine)
//
// docs/plugins.md has a complete one.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>

#include "seif/registry.hpp"

namespace seif {

/// What a plug-in must have in common with the program that loads it, because they hand each other objects.
/// Numbers at fixed places, so that any program can read those of any plug-in.
struct PluginBuild {
  std::uint32_t interface = 2;  // [-] one more with each change of the headers that a plug-in includes
  std::uint32_t eigen = EIGEN_WORLD_VERSION * 10'000 + EIGEN_MAJOR_VERSION * 100 + EIGEN_MINOR_VERSION;
  std::uint32_t eigen_alignment = EIGEN_MAX_ALIGN_BYTES;           // [byte] of members
  std::uint32_t eigen_heap_alignment = EIGEN_DEFAULT_ALIGN_BYTES;  // [byte] of matrices of any size
  std::uint32_t string_bytes = sizeof(std::string);                // these two tell the standard library's
  std::uint32_t map_bytes = sizeof(std::map<char, char>);          // variants apart
};

/// What a plug-in exports.
struct Plugin {
  PluginBuild build;
  void (*add_estimators)(Registry& registry) = nullptr;  // may throw std::exception
};

/// The name of the exported function. It has the type of seif_plugin().
inline constexpr const char* plugin_function = "seif_plugin";

}  // namespace seif

/// Exports the function `add_estimators(seif::Registry&)`. Stands once in a plug-in, outside of all namespaces.
#define SEIF_PLUGIN(add_estimators)                                                     \
  extern "C" __attribute__((visibility("default"))) const seif::Plugin* seif_plugin() { \
    static const seif::Plugin plugin{{}, add_estimators};                               \
    return &plugin;                                                                     \
  }
