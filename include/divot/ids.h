#pragma once

#include <cstdint>

namespace divot {

/// No vertex, face, half-edge, column or body.
inline constexpr std::uint32_t kNone = 0xffffffffu;

/// A body of a world. Ids count up from 0 in order of creation and are never reused.
struct BodyId {
  std::uint32_t value = kNone;                                     ///< index into World::bodies()
  friend bool operator==(const BodyId&, const BodyId&) = default;  ///< the same body?
};

}  // namespace divot
