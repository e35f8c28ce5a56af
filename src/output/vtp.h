#pragma once

#include <span>
#include <string>

#include "output/formats.h"

namespace divot::output {

/// Writes the ground as VTK XML PolyData, raw appended: points as doubles in the terrain's coordinates, m; of each
/// point sinkage (m), material, velocity (m/s), awake (0 or 1) and pressure (Pa). Fails with the system's reason.
/// [O(vertices + faces)]
Result<void> write_vtp(const std::string& path, const Frame& frame);

/// Writes ParaView's list of a series: each file with its time.
Result<void> write_pvd(const std::string& path, std::span<const SeriesEntry> frames);

}  // namespace divot::output
