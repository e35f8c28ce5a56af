#include "viewer/renderer.h"

#include <fmt/format.h>

#include <osgViewer/Viewer>

#include "viewer/caption.h"
#include "viewer/failure.h"
#include "viewer/offscreen_context.h"
#include "viewer/pixel_reader.h"
#include "viewer/scene_graph.h"

namespace divot::viewer {
namespace {

constexpr int kLeastSize = 16, kLargestSize = 16384;

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
  void update(const Snapshot& snapshot);
  void place_camera(const Snapshot& snapshot);
  void follow(const Snapshot& snapshot);
  void look_through(const Vec3d& origin);

  RenderOptions options;
  OffscreenContext context;
  SceneGraph scene;
  Caption caption;
  osg::ref_ptr<PixelReader> reader = new PixelReader;
  osg::ref_ptr<osgViewer::Viewer> viewer = new osgViewer::Viewer;
  Camera camera;
  std::optional<Vec3d> followed;  // where the followed body was at the last update()
  bool placed = false;
};

Renderer::Impl::Impl(const RenderOptions& asked, OffscreenContext&& gl)
    : options(asked),
      context(std::move(gl)),
      scene({.azimuth_deg = asked.sun_azimuth_deg, .elevation_deg = asked.sun_elevation_deg},
            {.wireframe = asked.wireframe, .color = asked.color, .quality = asked.quality, .effects = asked.effects}),
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

void Renderer::Impl::update(const Snapshot& snapshot) {
  if (!placed) place_camera(snapshot);
  follow(snapshot);
  scene.update(snapshot);
  caption.set_text(fmt::format("t = {:.2f} s", snapshot.time));
}

void Renderer::Impl::place_camera(const Snapshot& snapshot) {
  const double aspect = static_cast<double>(options.width) / options.height;
  const Framing framing = frame(snapshot.surface, snapshot.bodies, snapshot.bombs, aspect);
  camera = options.camera.value_or(framing.camera);
  scene.set_view(snapshot.surface.origin, framing.region, camera);
  look_through(snapshot.surface.origin);
  // Near and far follow from what is drawn.
  viewer->getCamera()->setProjectionMatrixAsPerspective(camera.fov_deg, aspect, 1, 1000);
  placed = true;
}

// Eye and target move as the body did.
void Renderer::Impl::follow(const Snapshot& snapshot) {
  if (!options.follow || options.follow->value >= snapshot.bodies.size()) return;
  const Vec3d now = snapshot.bodies[options.follow->value].position;
  const Vec3d moved = now - followed.value_or(now);
  followed = now;
  camera.eye += moved;
  camera.target += moved;
  look_through(snapshot.surface.origin);
}

void Renderer::Impl::look_through(const Vec3d& origin) {
  const Vec3d eye = camera.eye - origin, target = camera.target - origin;
  viewer->getCamera()->setViewMatrixAsLookAt({eye.x, eye.y, eye.z}, {target.x, target.y, target.z}, {0, 0, 1});
  scene.set_eye({eye.x, eye.y, eye.z});
}

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::create(const RenderOptions& options) {
  return check(options)
      .and_then([&] { return OffscreenContext::create(options.width, options.height, samples_of(options.quality)); })
      .map([&](OffscreenContext&& context) { return Renderer(std::make_unique<Impl>(options, std::move(context))); });
}

void Renderer::update(const SurfaceView& surface, std::span<const DirtyRange> dirty, std::span<const BodyView> bodies,
                      std::span<const BombView> bombs, const std::function<float(std::uint32_t)>& sinkage,
                      double time) {
  impl_->update({.surface = surface,
                 .dirty = {dirty.begin(), dirty.end()},
                 .bodies = {bodies.begin(), bodies.end()},
                 .bombs = {bombs.begin(), bombs.end()},
                 .sinkage = sinkage,
                 .time = time});
}

void Renderer::update(World& world) { impl_->update(take_snapshot(world)); }

Result<Image> Renderer::pixels() {
  return impl_->context.make_current().map([&] {
    impl_->viewer->frame();
    return impl_->reader->image();
  });
}

Result<void> Renderer::write_png(const std::string& path) {
  return pixels().and_then([&](const Image& image) { return viewer::write_png(image, path); });
}

const Camera& Renderer::camera() const { return impl_->camera; }

}  // namespace divot::viewer
