#include "viewer/display.h"

#include <GL/glx.h>
#include <X11/Xlib.h>
#include <fmt/format.h>

#include <cstdlib>
#include <memory>
#include <string_view>

#include "viewer/failure.h"

namespace divot::viewer {
namespace {

constexpr char kAdvice[] = "start it on a desktop, or over ssh -X; pictures need no display: divot render SCENE";

struct CloseDisplay {
  void operator()(::Display* display) const { XCloseDisplay(display); }
};

// Mesa tells without a context; other drivers that do not are of graphics cards.
bool is_accelerated(::Display* display) {
  const std::string_view extensions = glXQueryExtensionsString(display, DefaultScreen(display));
  if (extensions.find("GLX_MESA_query_renderer") == std::string_view::npos) return true;
  const auto query = reinterpret_cast<PFNGLXQUERYRENDERERINTEGERMESAPROC>(
      glXGetProcAddress(reinterpret_cast<const GLubyte*>("glXQueryRendererIntegerMESA")));
  unsigned value = 1;
  return !query || !query(display, DefaultScreen(display), 0, GLX_RENDERER_ACCELERATED_MESA, &value) || value != 0;
}

}  // namespace

Result<Display> open_display() {
  const char* name = std::getenv("DISPLAY");
  if (!name || !*name) return failure("no display for a window: DISPLAY is not set", kAdvice, "display");
  const std::unique_ptr<::Display, CloseDisplay> display(XOpenDisplay(nullptr));
  if (!display) {
    return failure(fmt::format("no display for a window: {} cannot be opened", name), kAdvice, "display");
  }
  int error_base = 0, event_base = 0;
  if (!glXQueryExtension(display.get(), &error_base, &event_base)) {
    return failure(fmt::format("no window: the display {} has no OpenGL (GLX)", name), kAdvice, "display");
  }
  return Display{.accelerated = is_accelerated(display.get())};
}

}  // namespace divot::viewer
