#include "worlds/gallery.hpp"

#include <system_error>

namespace worlds {

std::filesystem::path find_world(const std::filesystem::path& name) {
  std::error_code error;
  if (name.empty() || name.has_parent_path() || name.has_extension() || std::filesystem::exists(name, error))
    return name;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  for (const std::filesystem::path& folder :
       {program.parent_path().parent_path() / "share/seifbed/worlds", std::filesystem::path(SEIFBED_GALLERY),
        std::filesystem::path(SEIFBED_INSTALLED_GALLERY)}) {
    const std::filesystem::path file = folder / (name.string() + ".yaml");
    if (std::filesystem::exists(file, error)) return file;
  }
  return name;
}

}  // namespace worlds
