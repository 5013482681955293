// A run that is made again, beside its folder, to take the place of what was cut off.
#pragma once

#include <filesystem>

namespace harness {

/// A folder for the repetition, inside the run folder, so on the same disk. It is deleted with the object.
class Workshop {
 public:
  explicit Workshop(const std::filesystem::path& run);
  ~Workshop();
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// Lets the repetition `again` take the place of the run, with the folders of its robots if it has any. Throws
/// std::runtime_error if what is recorded does not come again; then the run stays as it was.
void take_place(const std::filesystem::path& again, const std::filesystem::path& run);

}  // namespace harness
