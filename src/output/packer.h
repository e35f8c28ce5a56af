#pragma once

#include <bit>
#include <cstring>
#include <vector>

#include "output/atomic_file.h"

namespace divot::output {

static_assert(std::endian::native == std::endian::little, "numbers go to files as they lie in memory");

/// Collects records of mixed types, without padding, and hands them to a file in large pieces.
class Packer {
 public:
  explicit Packer(AtomicFile& file) : file_(file) { bytes_.reserve(kFull + kLargestRecord); }
  ~Packer() { file_.write(bytes_.data(), bytes_.size()); }
  Packer(const Packer&) = delete;
  Packer& operator=(const Packer&) = delete;

  template <class T>
  void put(T value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  void end_record() {
    if (bytes_.size() < kFull) return;
    file_.write(bytes_.data(), bytes_.size());
    bytes_.clear();
  }

 private:
  static constexpr std::size_t kFull = 1 << 20, kLargestRecord = 64;
  AtomicFile& file_;
  std::vector<char> bytes_;
};

}  // namespace divot::output
