#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "divot/errors.h"

namespace divot::output {

/// A file that appears under its name when it is complete, or not at all: written beside it as `NAME.part` and renamed
/// by commit(). Without commit() the part is removed and a file that had the name before stays as it was.
class AtomicFile {
 public:
  /// Opens `path`.part. Fails with the system's reason when the folder cannot be written to.
  static Result<AtomicFile> create(const std::string& path);

  /// For a library that writes `temporary` by itself.
  static AtomicFile adopt(std::string path, std::string temporary);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  /// Where the data goes until commit(). A library that writes by name may use it in place of write().
  const std::string& temporary() const { return temporary_; }

  /// Adds bytes at the end. What fails is remembered and reported by commit().
  void write(const void* data, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// Hands what was written so far to the system and remembers that the file is whole up to here.
  void mark();

  /// What was written before the last mark. Fails with the system's reason.
  Result<std::string> marked_text() const;

  /// Puts the file in its place as it was when it was last marked, whatever failed after that.
  Result<void> commit_marked();

  /// Puts the file in its place. Fails with the system's reason (disk full, for one) and then leaves nothing behind.
  Result<void> commit();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  AtomicFile(std::string path, std::string temporary, std::FILE* stream);

  std::string path_;
  std::string temporary_;  // empty once it is gone
  std::unique_ptr<std::FILE, Close> stream_;
  int reason_ = 0;            // errno of the first write that failed
  std::uint64_t marked_ = 0;  // bytes up to the last mark
};

/// Makes the folder of a run, with those above it. Fails with the system's reason.
Result<void> make_folder(const std::string& folder);

/// The error of a file that could not be written, with the system's words for `reason` (an errno).
Error write_error(const std::string& path, int reason);

}  // namespace divot::output
