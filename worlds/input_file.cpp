#include "worlds/input_file.hpp"

#include <system_error>

namespace worlds {

std::string why_no_input(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) return "there is no such file";
  if (error) return "the file cannot be read: " + error.message();
  if (std::filesystem::is_directory(status)) return "this is a directory, not a file";
  if (!std::filesystem::is_regular_file(status)) return "this is no regular file";
  return "";
}

}  // namespace worlds
