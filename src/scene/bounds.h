#pragma once

namespace divot::scene {

// Bounds that no sensible scene meets. They keep squares and products of lengths, speeds and masses inside float's
// range.
inline constexpr double kFar = 1e8;      // m: beyond every projected coordinate
inline constexpr double kLong = 1e5;     // m: spacings and radii
inline constexpr double kFast = 1e5;     // m/s, and rad/s
inline constexpr double kHeavy = 1e12;   // kg, N/m, Pa and what else belongs to materials
inline constexpr double kForever = 1e9;  // s

}  // namespace divot::scene
