#include "output/atomic_file.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

namespace divot::output {
namespace {

// errno, or "input/output error" from a library that failed without saying why.
int last_reason() { return errno != 0 ? errno : EIO; }

}  // namespace

Error write_error(const std::string& path, int reason) {
  Error error;
  error.file = path;
  error.problem = "cannot be written: " + std::generic_category().message(reason);
  return error;
}

Result<void> make_folder(const std::string& folder) {
  std::error_code reason;
  std::filesystem::create_directories(folder, reason);
  if (reason) return fail(write_error(folder, reason.value()));
  return {};
}

AtomicFile::AtomicFile(std::string path, std::string temporary, std::FILE* stream)
    : path_(std::move(path)), temporary_(std::move(temporary)), stream_(stream) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})),
      stream_(std::move(other.stream_)),
      reason_(other.reason_),
      marked_(other.marked_) {}

AtomicFile AtomicFile::adopt(std::string path, std::string temporary) {
  return AtomicFile(std::move(path), std::move(temporary), nullptr);
}

Result<AtomicFile> AtomicFile::create(const std::string& path) {
  std::string temporary = path + ".part";
  errno = 0;
  std::FILE* stream = std::fopen(temporary.c_str(), "wb");
  if (stream == nullptr) return fail(write_error(path, last_reason()));
  return AtomicFile(path, std::move(temporary), stream);
}

AtomicFile::~AtomicFile() {
  stream_.reset();
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void AtomicFile::write(const void* data, std::size_t size) {
  if (reason_ != 0 || size == 0) return;
  errno = 0;
  if (std::fwrite(data, 1, size, stream_.get()) != size) reason_ = last_reason();
}

void AtomicFile::mark() {
  if (reason_ != 0) return;
  errno = 0;
  if (std::fflush(stream_.get()) != 0) {
    reason_ = last_reason();
    return;
  }
  std::error_code unreadable;
  const std::uintmax_t size = std::filesystem::file_size(temporary_, unreadable);
  if (!unreadable) marked_ = size;
}

Result<std::string> AtomicFile::marked_text() const {
  std::string text(marked_, '\0');
  errno = 0;
  std::ifstream in(temporary_, std::ios::binary);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (reason_ != 0 || !in) return fail(write_error(path_, reason_ != 0 ? reason_ : last_reason()));
  return text;
}

Result<void> AtomicFile::commit_marked() {
  stream_.reset();
  std::error_code reason;
  std::filesystem::resize_file(temporary_, marked_, reason);
  reason_ = reason.value();
  return commit();
}

Result<void> AtomicFile::commit() {
  // Closing writes what is still buffered: a full disk may only show here.
  errno = 0;
  if (stream_ && std::fclose(stream_.release()) != 0 && reason_ == 0) reason_ = last_reason();
  if (reason_ == 0 && std::rename(temporary_.c_str(), path_.c_str()) != 0) reason_ = last_reason();
  if (reason_ != 0) std::remove(temporary_.c_str());
  temporary_.clear();
  if (reason_ != 0) return fail(write_error(path_, reason_));
  return {};
}

}  // namespace divot::output
