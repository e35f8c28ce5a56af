#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace divot::core {

/// FNV-1a over 64-bit words: short, the same on every machine, and good enough to tell two states apart.
class Hash {
 public:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001b3ull;
    value_ ^= value_ >> 29;
  }
  void add(float number) {
    std::uint32_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    add(static_cast<std::uint64_t>(bits));
  }
  void add(double number) {
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    add(bits);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

}  // namespace divot::core
