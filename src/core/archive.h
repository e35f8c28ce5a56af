#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "divot/vec.h"

// Values as bytes and back. A type says once what it consists of, for both ways:
//   template <class Archive, core::Is<Blast> T>
//   void archive(Archive& a, T& blast) { a(blast.yield, blast.column); }
// with T being const where bytes are made. Bytes may come from anywhere: reading checks every length against what is
// there before it takes memory, refuses what is not a number, and says in ok() whether all went well.
namespace divot::core {

static_assert(std::endian::native == std::endian::little, "bytes are as little-endian machines keep them");

/// T or const T.
template <class T, class What>
concept Is = std::same_as<std::remove_const_t<T>, What>;

/// What is kept as it lies in memory: nothing but numbers, without gaps.
template <class T>
inline constexpr bool kPlain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <>
inline constexpr bool kPlain<Vec3> = true;
template <>
inline constexpr bool kPlain<Vec3d> = true;
template <>
inline constexpr bool kPlain<Quat> = true;
template <class T, std::size_t kCount>
inline constexpr bool kPlain<std::array<T, kCount>> = kPlain<T>;

/// Makes bytes.
class ByteWriter {
 public:
  static constexpr bool kReads = false;

  template <class... Ts>
  void operator()(const Ts&... values) {
    (put(values), ...);
  }
  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::move(bytes_); }

 private:
  void put_raw(const void* data, std::size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(data), size);  // there need be no memory otherwise
  }
  void put_size(std::size_t size) { put(static_cast<std::uint64_t>(size)); }

  template <class T>
  void put(const T& value) {
    if constexpr (kPlain<T>)
      put_raw(&value, sizeof value);
    else
      archive(*this, value);
  }
  template <class T>
  void put(const std::vector<T>& list) {
    put_size(list.size());
    if constexpr (kPlain<T>)
      put_raw(list.data(), list.size() * sizeof(T));
    else
      for (const T& item : list) put(item);
  }
  void put(const std::string& text) { put_size(text.size()), put_raw(text.data(), text.size()); }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class A, class B>
  void put(const std::pair<A, B>& both) {
    put(both.first), put(both.second);
  }
  template <class... Ts>
  void put(const std::variant<Ts...>& value) {
    put(static_cast<std::uint8_t>(value.index()));
    std::visit([this](const auto& held) { this->put(held); }, value);
  }

  std::string bytes_;
};

/// Reads what a ByteWriter made, or anything else. After the first thing that cannot be right nothing more is read.
class ByteReader {
 public:
  static constexpr bool kReads = true;

  /// `bytes` must outlive the reader.
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  template <class... Ts>
  void operator()(Ts&... values) {
    (get(values), ...);
  }
  /// An enumeration whose values are below `end`.
  template <class Enum>
  void choice(Enum& value, std::size_t end) {
    get(value);
    if (static_cast<std::size_t>(value) >= end) fail(), value = Enum{};
  }

  bool ok() const { return ok_; }
  bool at_end() const { return left_.empty(); }
  void fail() { ok_ = false, left_ = {}; }

 private:
  bool get_raw(void* data, std::size_t size) {
    if (size > left_.size()) return fail(), false;
    if (size == 0) return true;  // there need be no memory
    std::memcpy(data, left_.data(), size);
    left_.remove_prefix(size);
    return true;
  }
  // Of a list whose items take at least `item` bytes each.
  std::size_t get_size(std::size_t item) {
    std::uint64_t size = 0;
    get(size);
    if (size > left_.size() / item) return fail(), 0;
    return static_cast<std::size_t>(size);
  }
  template <class T>
  static bool is_number(const T& value) {
    if constexpr (std::is_floating_point_v<T>)
      return !std::isnan(value);
    else if constexpr (std::is_same_v<T, Vec3> || std::is_same_v<T, Vec3d>)
      return is_number(value.x) && is_number(value.y) && is_number(value.z);
    else if constexpr (std::is_same_v<T, Quat>)
      return is_number(value.x) && is_number(value.y) && is_number(value.z) && is_number(value.w);
    else
      return true;
  }
  template <class T, std::size_t kCount>
  static bool is_number(const std::array<T, kCount>& values) {
    for (const T& value : values)
      if (!is_number(value)) return false;
    return true;
  }

  template <class T>
  void get(T& value) {
    if constexpr (kPlain<T>) {
      if (!get_raw(&value, sizeof value)) return;
      if (!is_number(value)) fail(), value = T{};
    } else {
      archive(*this, value);
    }
  }
  void get(bool& value) {
    std::uint8_t byte = 0;
    get(byte);
    if (byte > 1) fail();
    value = byte == 1;
  }
  template <class T>
  void get(std::vector<T>& list) {
    list.clear();
    if constexpr (kPlain<T>) {
      list.resize(get_size(sizeof(T)));
      get_raw(list.data(), list.size() * sizeof(T));
      for (const T& value : list)
        if (!is_number(value)) return fail(), list.clear();
    } else {
      // One by one: an item in memory can be larger than its bytes are.
      for (std::size_t left = get_size(1); left > 0 && ok_; --left) get(list.emplace_back());
    }
  }
  void get(std::string& text) {
    text.resize(get_size(1));
    get_raw(text.data(), text.size());
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool there = false;
    get(there);
    value.reset();
    if (there) get(value.emplace());
  }
  template <class A, class B>
  void get(std::pair<A, B>& both) {
    get(both.first), get(both.second);
  }
  template <class... Ts>
  void get(std::variant<Ts...>& value) {
    std::uint8_t index = 0;
    get(index);
    std::size_t at = 0;
    const bool found = ((at++ == index ? (get(value.template emplace<Ts>()), true) : false) || ...);
    if (!found) fail();
  }

  std::string_view left_;
  bool ok_ = true;
};

}  // namespace divot::core
