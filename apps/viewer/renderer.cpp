#include "viewer/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <osgViewer/Viewer>

#include "viewer/caption.h"
#include "viewer/failure.h"
#include "viewer/offscreen_context.h"
#include "viewer/scene_graph.h"

namespace divot::viewer {
namespace {

constexpr int kLeastSize = 16, kLargestSize = 16384;

// Fetches the finished frame. OpenGL's first row is the lowest.
struct PixelReader : osg::Camera::DrawCallback {
  mutable Image image;

  void operator()(osg::RenderInfo& info) const override {
    const osg::Viewport& view = *info.getCurrentCamera()->getViewport();
    image.width = static_cast<int>(view.width());
    image.height = static_cast<int>(view.height());
    const std::size_t stride = 3 * static_cast<std::size_t>(image.width);
    image.rgb.resize(stride * static_cast<std::size_t>(image.height));
    glReadBuffer(GL_BACK);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, image.width, image.height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
    auto top = image.rgb.begin(), bottom = image.rgb.end() - static_cast<std::ptrdiff_t>(stride);
    for (; top < bottom; top += static_cast<std::ptrdiff_t>(stride), bottom -= static_cast<std::ptrdiff_t>(stride)) {
      std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(stride), bottom);
    }
  }
};

Result<void> check(const RenderOptions& options) {
  const auto is_size = [](int size) { return size >= kLeastSize && size <= kLargestSize; };
  if (!is_size(options.width) || !is_size(options.height)) {
    return failure(fmt::format("a picture of {} x {} pixels cannot be drawn", options.width, options.height),
                   fmt::format("{} to {} pixels each way", kLeastSize, kLargestSize), "size");
  }
  if (!(options.sun_elevation_deg > 0 && options.sun_elevation_deg <= 90)) {
    return failure("the sun is below the ground", "above 0 to 90", "sun_elevation_deg");
  }
  return {};
}

}  // namespace

struct Renderer::Impl {
  Impl(const RenderOptions& asked, OffscreenContext&& gl);
  ~Impl();
  void place_camera(const SurfaceView& surface, std::span<const BodyView> bodies, std::span<const BombView> bombs);

  RenderOptions options;
  OffscreenContext context;
  SceneGraph scene;
  Caption caption;
  osg::ref_ptr<PixelReader> reader = new PixelReader;
  osg::ref_ptr<osgViewer::Viewer> viewer = new osgViewer::Viewer;
  Camera camera;
  bool placed = false;
};

Renderer::Impl::Impl(const RenderOptions& asked, OffscreenContext&& gl)
    : options(asked),
      context(std::move(gl)),
      scene({.azimuth_deg = asked.sun_azimuth_deg, .elevation_deg = asked.sun_elevation_deg}, asked.wireframe),
      caption(asked.width, asked.height, asked.wireframe) {
  viewer->setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  viewer->setUpViewerAsEmbeddedInWindow(0, 0, options.width, options.height);
  viewer->setLightingMode(osg::View::NO_LIGHT);
  osg::Camera* view = viewer->getCamera();
  view->setDrawBuffer(GL_BACK);
  view->setReadBuffer(GL_BACK);
  view->setViewport(0, 0, options.width, options.height);
  view->setFinalDrawCallback(reader);
  osg::ref_ptr<osg::Group> root = new osg::Group;
  root->addChild(&scene.root());
  if (options.show_time) root->addChild(&caption.root());
  viewer->setSceneData(root);
}

// What lives on the graphics card can only be given back while the context is current.
Renderer::Impl::~Impl() {
  if (context.make_current()) viewer = nullptr;
}

void Renderer::Impl::place_camera(const SurfaceView& surface, std::span<const BodyView> bodies,
                                  std::span<const BombView> bombs) {
  const double aspect = static_cast<double>(options.width) / options.height;
  const Framing framing = frame(surface, bodies, bombs, aspect);
  camera = options.camera.value_or(framing.camera);
  scene.set_view(surface.origin, framing.region, camera);
  const Vec3d eye = camera.eye - surface.origin, target = camera.target - surface.origin;
  viewer->getCamera()->setViewMatrixAsLookAt({eye.x, eye.y, eye.z}, {target.x, target.y, target.z}, {0, 0, 1});
  // Near and far follow from what is drawn.
  viewer->getCamera()->setProjectionMatrixAsPerspective(camera.fov_deg, aspect, 1, 1000);
  placed = true;
}

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::create(const RenderOptions& options) {
  return check(options)
      .and_then([&] { return OffscreenContext::create(options.width, options.height); })
      .map([&](OffscreenContext&& context) { return Renderer(std::make_unique<Impl>(options, std::move(context))); });
}

void Renderer::update(const SurfaceView& surface, std::span<const DirtyRange> dirty, std::span<const BodyView> bodies,
                      std::span<const BombView> bombs, const std::function<float(std::uint32_t)>& sinkage,
                      double time) {
  if (!impl_->placed) impl_->place_camera(surface, bodies, bombs);
  impl_->scene.update(surface, dirty, bodies, bombs, sinkage);
  impl_->caption.set_text(fmt::format("t = {:.2f} s", time));
}

Result<Image> Renderer::pixels() {
  return impl_->context.make_current().map([&] {
    impl_->viewer->frame();
    return impl_->reader->image;
  });
}

Result<void> Renderer::write_png(const std::string& path) {
  return pixels().and_then([&](const Image& image) { return viewer::write_png(image, path); });
}

const Camera& Renderer::camera() const { return impl_->camera; }

}  // namespace divot::viewer
