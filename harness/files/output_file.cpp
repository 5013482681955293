#include "harness/files/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "harness/files/bad_input.hpp"
#include "harness/files/input_file.hpp"

namespace harness {

namespace {

constexpr std::size_t buffer_limit = std::size_t{1} << 16;  // [byte] written at once to the operating system

}  // namespace

OutputFile::OutputFile(std::filesystem::path path)
    : path_(std::move(path)),
      descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) fail(errno);
  buffer_.reserve(buffer_limit + buffer_limit / 4);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      buffer_(std::move(other.buffer_)),
      size_(other.size_) {}

OutputFile::~OutputFile() {
  try {
    close();
  } catch (const std::system_error&) {
    // A destructor cannot report an error; call close() before to get it.
  }
}

void OutputFile::append(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() >= buffer_limit) flush();
}

void OutputFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      keep_whole_lines(std::string_view(buffer_).substr(0, buffer_.size() - rest.size()));
      fail(error);
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  size_ += static_cast<std::int64_t>(buffer_.size());
  buffer_.clear();
  // Writing to a deleted file succeeds, but the data is lost.
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail(errno);
  if (status.st_nlink == 0) fail(ENOENT);
}

/// `written` is the part of the buffer that reached the file.
void OutputFile::keep_whole_lines(std::string_view written) {
  const std::size_t end = written.rfind('\n');
  size_ += end == std::string_view::npos ? 0 : static_cast<std::int64_t>(end) + 1;
  buffer_.clear();
  static_cast<void>(::ftruncate(descriptor_, size_) == 0);  // the first error is the one to report
}

void OutputFile::sync() {
  flush();
  if (::fsync(descriptor_) != 0) fail(errno);
}

void OutputFile::close() {
  if (descriptor_ < 0) return;
  try {
    flush();
  } catch (const std::system_error&) {
    ::close(std::exchange(descriptor_, -1));
    throw;
  }
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
}

void OutputFile::fail(int error) const {
  throw std::system_error(error, std::generic_category(), fmt::format("cannot write {}", path_.string()));
}

void check_output(const std::filesystem::path& path, Existing existing) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0)
    return;  // the attempt to write tells what is wrong, if anything is
  const std::string name = path.string();
  if (S_ISDIR(status.st_mode)) throw BadInput(fmt::format("{}: is a folder; give the name of a file", name));
  if (S_ISLNK(status.st_mode))
    throw BadInput(fmt::format("{}: is a link, which no output replaces; give the name of a file", name));
  if (!S_ISREG(status.st_mode))
    throw BadInput(fmt::format("{}: is no regular file, and no output replaces it", name));
  if (existing == Existing::keep)
    throw BadInput(fmt::format("{}: is there already; --force replaces it", name));
}

void rename_output(const std::filesystem::path& unfinished, const std::filesystem::path& path,
                   Existing existing) {
  check_output(path, existing);
  if (existing == Existing::keep) {
    // Refuses a file that another program has made meanwhile, where the file system can.
    if (::renameat2(AT_FDCWD, unfinished.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE) == 0) return;
    const int error = errno;
    check_output(path, existing);
    if (error != EINVAL && error != ENOSYS)
      throw std::system_error(error, std::generic_category(), fmt::format("cannot write {}", path.string()));
  }
  std::filesystem::rename(unfinished, path);
}

std::filesystem::path unfinished_name(const std::filesystem::path& path) { return path.string() + ".part"; }

void write_whole_file(const std::filesystem::path& path, std::string_view text, Existing existing) {
  check_output(path, existing);
  const std::filesystem::path unfinished = unfinished_name(path);
  check_output(unfinished, Existing::replace);
  std::filesystem::remove(unfinished);
  try {
    OutputFile file(unfinished);
    file.append(text);
    file.sync();
    file.close();
    rename_output(unfinished, path, existing);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw;
  }
}

std::string read_whole_file(const std::filesystem::path& path) {
  std::ifstream file = open_input(path);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file)
    throw std::system_error(EIO, std::generic_category(), fmt::format("cannot read {}", path.string()));
  return text;
}

}  // namespace harness
