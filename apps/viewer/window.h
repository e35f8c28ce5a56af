#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "divot/errors.h"
#include "divot/jobs.h"
#include "divot/scene.h"
#include "divot/world.h"
#include "viewer/camera.h"
#include "viewer/image.h"
#include "viewer/look.h"

namespace divot::viewer {

/// How a window begins.
struct WindowOptions {
  int width = 1280, height = 720;       ///< pixels, [64, 16384]
  std::optional<Quality> quality = {};  ///< empty: fine on a graphics card as long as it keeps up, else fast
  /// (0, 1], of the pixels each way that a fast picture is drawn with. Empty: as many as keep up with 60 pictures a
  /// second, at least 0.5.
  std::optional<double> fast_share = {};
  bool paused = false;
  bool show_numbers = true;  ///< the heads-up display
  bool effects = true;       ///< flash and dust of explosions
  std::string folder = ".";  ///< for pictures and states that are saved from it
};

/// What a window has done.
struct WindowReport {
  std::uint64_t pictures = 0;
  double seconds = 0;  ///< since the first picture
  std::uint64_t uploaded_bytes = 0;
};

/// What one picture of a window took.
struct FrameCost {
  double step_ms = 0;    ///< the world's steps
  double update_ms = 0;  ///< what changed is copied, normals made anew
  double hud_ms = 0;     ///< numbers over the picture
  double draw_ms = 0;    ///< sent and drawn, until the driver says that it is done
  double share = 1;      ///< of the pixels each way that it was drawn with
  double all_ms() const { return step_ms + update_ms + hud_ms + draw_ms; }
};

/// A world that runs in a window with the clock on the wall, and what mouse and keys do to it.
class Window {
 public:
  /// Opens it. Fails like World::create, when options are out of range (keys `size`, `fast_share`), or when there is no
  /// display that a window could be opened on (key `display`).
  static Result<Window> create(const Scene& scene, std::shared_ptr<const Jobs> jobs, const WindowOptions& options = {});

  /// The same without a display: pictures stay in memory, and nothing but frame_after() draws one. Without a quality in
  /// `options` it is fast. Fails where OffscreenContext::create does.
  static Result<Window> create_offscreen(const Scene& scene, std::shared_ptr<const Jobs> jobs,
                                         const WindowOptions& options = {});

  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window();

  /// Takes events, lets time pass and draws one picture. False when the window was closed: nothing was drawn.
  bool frame();

  /// Lets `seconds` pass whatever the clock on the wall says, and draws one picture to its end.
  FrameCost frame_after(double seconds);

  /// Does what a click with the left button does: a bomb on the ground there, -1 to 1 from left to right and from
  /// bottom to top.
  void click(double x, double y);

  /// From the scene's start again.
  void restart();

  /// Draws pictures until the window is closed.
  WindowReport run();

  /// The picture that is shown.
  Image capture();

  Camera camera() const;

  /// What runs in it: another one after a restart.
  const World& world() const;

 private:
  struct Impl;
  explicit Window(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace divot::viewer
