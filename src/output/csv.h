#pragma once

#include <span>
#include <string>
#include <string_view>

#include "divot/errors.h"
#include "divot/views.h"
#include "output/atomic_file.h"

namespace divot::output {

/// `bodies.csv`: one row for each body and time. Numbers are printed so that reading them gives the same bits. It grows
/// beside its name while a run lasts and takes the name at the end.
class BodiesCsv {
 public:
  /// Starts with the header, or goes on after `text`, of text(). Fails with the system's reason.
  static Result<BodiesCsv> create(const std::string& path, std::string_view text = kHeader);

  /// Header and rows so far. Fails with the system's reason.
  Result<std::string> text() const { return file_.marked_text(); }

  /// One row for each body, which are safe then. Failures are reported by commit().
  void append(double time, std::span<const BodyView> bodies);

  /// Puts the file in its place; nothing may be appended any more. Fails with the system's reason.
  Result<void> commit() { return file_.commit(); }

  /// In place of commit() for a run that fails: the file ends with the last rows that were written whole.
  Result<void> salvage() { return file_.commit_marked(); }

 private:
  static constexpr std::string_view kHeader = "time,name,x,y,z,vx,vy,vz,qx,qy,qz,qw,sinkage\n";
  explicit BodiesCsv(AtomicFile file) : file_(std::move(file)) {}

  AtomicFile file_;
};

/// Writes the ground as CSV, one row for each vertex in the order of ids: x, y, z (m, in the terrain's coordinates),
/// sinkage (m) and material. `sinkage`: [vertex] m. Fails with the system's reason. [O(vertices)]
Result<void> write_surface_csv(const std::string& path, const SurfaceView& surface, std::span<const float> sinkage);

}  // namespace divot::output
