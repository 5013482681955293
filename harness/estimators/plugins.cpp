#include "harness/estimators/plugins.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include "harness/files/bad_input.hpp"

namespace harness {

namespace {

#ifdef __SANITIZE_ADDRESS__
/// What is allocated while this object lives does not count as a leak: libraries keep things until the program
/// ends.
struct LeaksAllowed {
  LeaksAllowed() { __lsan_disable(); }
  ~LeaksAllowed() { __lsan_enable(); }
  LeaksAllowed(const LeaksAllowed&) = delete;
  LeaksAllowed& operator=(const LeaksAllowed&) = delete;
};
#else
struct LeaksAllowed {};
#endif

/// The plug-in of a library, which is never unloaded: objects of its classes may live until the program ends.
const seif::Plugin& open_plugin(const std::string& library) {
  if (!std::filesystem::exists(library)) throw BadInput(fmt::format("{}: there is no such file", library));
  void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw BadInput(fmt::format("{}: cannot be loaded: {}", library, dlerror()));
  void* function = dlsym(handle, seif::plugin_function);
  if (function == nullptr)
    throw BadInput(fmt::format(
        "{}: is no plug-in: it does not export {}(); SEIF_PLUGIN(...) of seif/plugin.hpp does that", library,
        seif::plugin_function));
  const seif::Plugin* plugin = reinterpret_cast<const seif::Plugin* (*)()>(function)();
  if (plugin == nullptr)
    throw BadInput(fmt::format("{}: its {}() returns nothing", library, seif::plugin_function));
  return *plugin;
}

/// The type, with a function that makes an estimator or throws a std::exception.
seif::EstimatorType carefully_made(seif::EstimatorType type) {
  type.make = [make = std::move(type.make), name = type.name](const seif::EstimatorSetup& setup,
                                                              const seif::Options& options) {
    std::unique_ptr<seif::Estimator> estimator;
    try {
      estimator = make(setup, options);
    } catch (const std::exception&) {
      throw;
    } catch (...) {
      throw BadInput(fmt::format("{}: its constructor throws something that is no std::exception", name));
    }
    if (estimator == nullptr) throw BadInput(fmt::format("{}: its plug-in makes no estimator", name));
    return estimator;
  };
  return type;
}

seif::Registry estimators_of(const std::string& library) {
  [[maybe_unused]] const LeaksAllowed of_libraries;
  const seif::Plugin& plugin = open_plugin(library);
  const std::string fault = mismatch(plugin.build);
  if (!fault.empty()) throw BadInput(fmt::format("{}: {}", library, fault));
  if (plugin.add_estimators == nullptr)
    throw BadInput(fmt::format("{}: it names no function that adds its estimators", library));
  seif::Registry registry;
  try {
    plugin.add_estimators(registry);
  } catch (const std::exception& error) {
    throw BadInput(fmt::format("{}: cannot add its estimators: {}", library, error.what()));
  } catch (...) {
    throw BadInput(fmt::format("{}: throws something that is no std::exception", library));
  }
  if (registry.types().empty()) throw BadInput(fmt::format("{}: adds no estimator", library));
  seif::Registry careful;
  for (const seif::EstimatorType& type : registry.types()) careful.add(carefully_made(type));
  return careful;
}

std::vector<std::string> plugins_in_environment() {
  const char* value = std::getenv(plugins_variable);
  std::istringstream text(value != nullptr ? value : "");
  std::vector<std::string> paths;
  for (std::string path; std::getline(text, path, ':');) {
    if (!path.empty()) paths.push_back(std::filesystem::weakly_canonical(path).string());
  }
  return paths;
}

}  // namespace

std::string mismatch(const seif::PluginBuild& build) {
  const seif::PluginBuild ours;
  if (build.interface != ours.interface)
    return fmt::format(
        "is for version {} of the interface, and this program has version {}: compile it again with the "
        "headers of this program",
        build.interface, ours.interface);
  if (build.eigen != ours.eigen)
    return fmt::format("was compiled with version {} of Eigen, and this program with {} (3.4.0 is 30400)",
                       build.eigen, ours.eigen);
  if (build.eigen_alignment != ours.eigen_alignment ||
      build.eigen_heap_alignment != ours.eigen_heap_alignment)
    return fmt::format(
        "its Eigen aligns matrices to {} and {} bytes, and that of this program to {} and {}: compile it "
        "with the flags of the CMake target seifbed::seif, such as -march=native",
        build.eigen_alignment, build.eigen_heap_alignment, ours.eigen_alignment, ours.eigen_heap_alignment);
  if (build.string_bytes != ours.string_bytes || build.map_bytes != ours.map_bytes)
    return "was compiled with another standard library, or with another variant of it";
  return {};
}

const seif::Registry& plugin_estimators(const std::filesystem::path& library) {
  static std::mutex mutex;
  static std::map<std::string, seif::Registry> loaded;
  const std::lock_guard lock(mutex);
  const std::string path = std::filesystem::weakly_canonical(library).string();
  const auto found = loaded.find(path);
  return found != loaded.end() ? found->second : loaded.emplace(path, estimators_of(path)).first->second;
}

void add_plugin(const std::filesystem::path& library, seif::Registry& registry) {
  for (const seif::EstimatorType& type : plugin_estimators(library).types()) {
    try {
      registry.add(type);
    } catch (const std::invalid_argument& error) {
      throw BadInput(fmt::format("{}: {}", library.string(), error.what()));
    }
  }
}

void add_plugins_of_environment(seif::Registry& registry) {
  for (const std::string& path : plugins_in_environment()) {
    try {
      add_plugin(path, registry);
    } catch (const BadInput& error) {
      throw BadInput(fmt::format("{}: {}", plugins_variable, error.what()));
    }
  }
}

bool pass_on_plugin(const std::filesystem::path& library) {
  std::vector<std::string> paths = plugins_in_environment();
  const std::string path = std::filesystem::weakly_canonical(library).string();
  if (std::ranges::find(paths, path) != paths.end()) return false;
  paths.push_back(path);
  setenv(plugins_variable, fmt::format("{}", fmt::join(paths, ":")).c_str(), 1);
  return true;
}

const seif::EstimatorType& type_of(const seif::Registry& registry, const worlds::EstimatorChoice& choice) {
  const seif::Registry& types = choice.library.empty() ? registry : plugin_estimators(choice.library);
  const seif::EstimatorType* type = types.find(choice.type);
  if (type == nullptr)
    throw BadInput(fmt::format("there is no estimator of type '{}'{}", choice.type,
                               choice.library.empty() ? "" : " in " + choice.library));
  return *type;
}

}  // namespace harness
