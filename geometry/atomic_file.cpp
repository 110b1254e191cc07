#include "geometry/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "geometry/input_error.h"
#include "geometry/output_error.h"

namespace parity {
namespace {

/// An open file, closed when it goes.
class FileDescriptor {
 public:
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  bool is_open() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }

  /// False: a write that was put off has failed.
  bool close() {
    const int descriptor = descriptor_;
    descriptor_ = -1;
    return ::close(descriptor) == 0;
  }

 private:
  int descriptor_;
};

std::string reason() { return std::strerror(errno); }

bool write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(std::size_t(written));
  }
  return true;
}

void write_in_place(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  FileDescriptor file{::open(path.c_str(), O_WRONLY | O_CLOEXEC)};
  if (!file.is_open() || !write_all(file.get(), bytes) || !file.close())
    throw OutputError(path.string(), "cannot be written: " + reason());
}

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  static std::atomic<unsigned> count{0};
  std::filesystem::path name = path;
  name.replace_filename("." + path.filename().string() + "." + std::to_string(::getpid()) + "." +
                        std::to_string(count++) + ".part");
  return name;
}

void write_and_rename(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::filesystem::path temporary = temporary_name(path);
  FileDescriptor file{::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)};
  if (!file.is_open()) throw OutputError(path.string(), "cannot be written: " + reason());
  if (write_all(file.get(), bytes) && file.close() &&
      ::rename(temporary.c_str(), path.c_str()) == 0)
    return;
  const std::string why = reason();
  ::unlink(temporary.c_str());
  throw OutputError(path.string(), "cannot be written: " + why);
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::error_code error;
  const bool is_link = std::filesystem::is_symlink(path, error);
  const std::filesystem::path target =
      is_link ? std::filesystem::weakly_canonical(path, error) : path;
  if (target.empty()) throw OutputError(path.string(), "cannot be written: " + error.message());
  const std::filesystem::file_status status = std::filesystem::status(target, error);
  if (std::filesystem::is_directory(status))
    throw OutputError(path.string(), "is a folder, expected the name of a file");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    write_in_place(target, bytes);
  else
    write_and_rename(target, bytes);
}

void write_file_atomically(const std::filesystem::path& path, std::string_view text) {
  write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

std::vector<std::byte> read_file(const std::filesystem::path& path, std::size_t max_bytes) {
  const FileDescriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (!file.is_open()) throw InputError(path.string(), "cannot be read: " + reason());
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) throw InputError(path.string(), reason());
  if (S_ISDIR(status.st_mode)) throw InputError(path.string(), "is a folder, expected a file");
  if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode))
    throw InputError(path.string(), "is a device, expected a file");
  std::vector<std::byte> bytes;
  std::size_t size = 0;
  // One byte more than the file says it has: its end is then seen without growing.
  if (S_ISREG(status.st_mode)) bytes.resize(std::min(std::size_t(status.st_size), max_bytes) + 1);
  for (;;) {
    if (size > max_bytes)
      throw InputError(path.string(), "has more than " + std::to_string(max_bytes) +
                                          " bytes, the most that is read");
    if (size == bytes.size())
      bytes.resize(std::min(max_bytes + 1, std::max<std::size_t>(65536, 2 * size)));
    const ssize_t got = ::read(file.get(), bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw InputError(path.string(), "cannot be read: " + reason());
    if (got == 0) break;
    size += std::size_t(got);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace parity
