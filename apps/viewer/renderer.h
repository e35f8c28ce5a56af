#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "divot/errors.h"
#include "divot/ids.h"
#include "divot/views.h"
#include "viewer/camera.h"
#include "viewer/image.h"
#include "viewer/look.h"

namespace divot {
class World;
}

namespace divot::viewer {

/// What a picture is to look like.
struct RenderOptions {
  int width = 1280, height = 720;    ///< pixels, [16, 16384]
  bool wireframe = false;            ///< hidden-line drawing instead of lit ground
  ColorBy color = ColorBy::natural;  ///< what the ground's colours tell
  Quality quality = Quality::fine;
  bool effects = false;               ///< flash and dust of explosions
  bool show_time = false;             ///< simulated time in the lower left corner
  bool show_legend = false;           ///< what the ground's colours tell, in the upper right corner
  std::optional<Camera> camera = {};  ///< empty: frames what the first update() shows, see frame()
  /// The camera moves along with this body: from where it was asked to be, or else with the body in the middle.
  /// Nothing where there is none such.
  std::optional<BodyId> follow = {};
  double sun_azimuth_deg = 68;    ///< degrees clockwise from north (y)
  double sun_elevation_deg = 29;  ///< degrees above the horizon, (0, 90]
};

/// Draws a world without a display. Several can live side by side; one must not be used by two threads at a time.
class Renderer {
 public:
  /// Fails when options are out of range, or when the machine has no driver that can draw without a display.
  static Result<Renderer> create(const RenderOptions& options);

  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// Takes over the world as it is now; keeps no reference to any argument.
  /// `dirty`: vertices that moved since the last call, ascending and disjoint (World::take_dirty); the first call, and
  /// any with another number of vertices or triangles, takes all. `sinkage`: World::sinkage, or empty; asked only for
  /// vertices drawn anew. `time`: s. [O(faces) where all is taken, else O(chunks + triangles of dirty chunks + bodies +
  /// bombs)]
  void update(const SurfaceView& surface, std::span<const DirtyRange> dirty, std::span<const BodyView> bodies,
              std::span<const BombView> bombs, const std::function<float(std::uint32_t vertex)>& sinkage, double time);

  /// The same for a world, with the particles that ColorBy::awake shows; takes its dirty ranges.
  void update(World& world);

  /// From the next update() on, draws lines or lit ground.
  void set_wireframe(bool wireframe);

  /// Draws the last update(); only background before there was one. Fails when the driver lost its context.
  Result<Image> pixels();

  /// Draws the last update() into a PNG file, see write_png(const Image&, ...).
  Result<void> write_png(const std::string& path);

  /// Where pictures are taken from: as asked for, or as the first update() framed it, moved along with what is
  /// followed.
  const Camera& camera() const;

 private:
  struct Impl;
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace divot::viewer
