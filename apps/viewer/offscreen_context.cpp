#include "viewer/offscreen_context.h"

// Keeps EGL from pulling in the headers of X.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <array>
#include <string_view>

#include "viewer/failure.h"

namespace divot::viewer {

struct OffscreenContext::Handles {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLSurface surface = EGL_NO_SURFACE;
  EGLContext context = EGL_NO_CONTEXT;

  // The display itself stays open: every context of the process shares it.
  ~Handles() {
    if (display == EGL_NO_DISPLAY) return;
    if (context != EGL_NO_CONTEXT && eglGetCurrentContext() == context) {
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
  }
};

namespace {

tl::unexpected<Errors> egl_failure(std::string_view what) {
  return failure(fmt::format("cannot render without a display: {} (EGL error 0x{:04x})", what,
                             static_cast<unsigned>(eglGetError())),
                 "Mesa's software driver, package libegl-mesa0 with libgl1-mesa-dri");
}

// Mesa's display that has no screen. The extension is asked for first: without it the call would be undefined.
EGLDisplay surfaceless_display() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!extensions || std::string_view(extensions).find("EGL_MESA_platform_surfaceless") == std::string_view::npos) {
    return EGL_NO_DISPLAY;
  }
  const auto get_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  return get_display ? get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr) : EGL_NO_DISPLAY;
}

// True when there is a configuration with that many samples a pixel; 0 asks for none. EGL puts those of the deepest
// colours first, which software renderers take much longer to write: the one wanted is like a window's, of 8 bits.
bool choose_config(EGLDisplay display, int samples, EGLConfig& config) {
  const std::array<EGLint, 17> wanted = {EGL_SURFACE_TYPE,
                                         EGL_PBUFFER_BIT,
                                         EGL_RENDERABLE_TYPE,
                                         EGL_OPENGL_BIT,
                                         EGL_RED_SIZE,
                                         8,
                                         EGL_GREEN_SIZE,
                                         8,
                                         EGL_BLUE_SIZE,
                                         8,
                                         EGL_DEPTH_SIZE,
                                         24,
                                         EGL_SAMPLE_BUFFERS,
                                         samples > 0 ? 1 : 0,
                                         EGL_SAMPLES,
                                         samples,
                                         EGL_NONE};
  std::array<EGLConfig, 128> found;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted.data(), found.data(), static_cast<EGLint>(found.size()), &count)) return false;
  for (EGLint i = 0; i < count; ++i) {
    config = found[static_cast<std::size_t>(i)];
    EGLint red = 0;
    if (eglGetConfigAttrib(display, config, EGL_RED_SIZE, &red) && red == 8) return true;
  }
  return count > 0;
}

}  // namespace

OffscreenContext::OffscreenContext(std::unique_ptr<Handles> handles) : handles_(std::move(handles)) {}
OffscreenContext::OffscreenContext(OffscreenContext&&) noexcept = default;
OffscreenContext& OffscreenContext::operator=(OffscreenContext&&) noexcept = default;
OffscreenContext::~OffscreenContext() = default;

Result<OffscreenContext> OffscreenContext::create(int width, int height, int samples) {
  auto handles = std::make_unique<Handles>();
  handles->display = surfaceless_display();
  if (handles->display == EGL_NO_DISPLAY) return egl_failure("EGL has no surfaceless platform");
  if (!eglInitialize(handles->display, nullptr, nullptr)) return egl_failure("no EGL driver could be started");
  if (!eglBindAPI(EGL_OPENGL_API)) return egl_failure("the EGL driver has no desktop OpenGL");

  EGLConfig config = nullptr;
  if (!choose_config(handles->display, samples, config) && !choose_config(handles->display, 0, config)) {
    return egl_failure("the EGL driver has no off-screen buffer with 24 bits of depth");
  }
  const std::array<EGLint, 5> size = {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
  handles->surface = eglCreatePbufferSurface(handles->display, config, size.data());
  if (handles->surface == EGL_NO_SURFACE) return egl_failure(fmt::format("no buffer of {} x {} pixels", width, height));
  handles->context = eglCreateContext(handles->display, config, EGL_NO_CONTEXT, nullptr);
  if (handles->context == EGL_NO_CONTEXT) return egl_failure("no OpenGL context");

  OffscreenContext context(std::move(handles));
  return context.make_current().map([&] { return std::move(context); });
}

Result<void> OffscreenContext::make_current() const {
  // The API is bound per thread, and the thread may be another than the one that created the context.
  eglBindAPI(EGL_OPENGL_API);
  if (eglMakeCurrent(handles_->display, handles_->surface, handles_->surface, handles_->context)) return {};
  return egl_failure("the OpenGL context cannot be made current");
}

}  // namespace divot::viewer
