#include "viewer/renderer.h"

#include <fmt/format.h>

#include <cmath>
#include <osgViewer/Viewer>

#include "viewer/caption.h"
#include "viewer/failure.h"
#include "viewer/legend.h"
#include "viewer/offscreen_context.h"
#include "viewer/pixel_reader.h"
#include "viewer/scene_graph.h"

namespace divot::viewer {
namespace {

constexpr int kLeastSize = 16, kLargestSize = 16384;
constexpr double kWidestView = 120;  // degrees
constexpr double kRoom = 2.5;        // around a followed body, in radii
constexpr double kSteepest = 1e-6;   // horizontal over whole distance, below which a view goes straight up or down

Result<void> check(const std::optional<Camera>& camera) {
  if (!camera) return {};
  if (!(camera->fov_deg > 0 && camera->fov_deg <= kWidestView)) {
    return failure(fmt::format("a field of view of {:g} degrees", camera->fov_deg),
                   fmt::format("expected above 0 to {:g}", kWidestView), "camera");
  }
  const double distance = length(camera->target - camera->eye);
  if (!(distance > 0 && std::isfinite(distance))) {
    return failure("the eye does not look anywhere", "expected a target that is not where the eye is", "camera");
  }
  return {};
}

Result<void> check(const RenderOptions& options) {
  const auto is_size = [](int size) { return size >= kLeastSize && size <= kLargestSize; };
  if (!is_size(options.width) || !is_size(options.height)) {
    return failure(fmt::format("a picture of {} x {} pixels cannot be drawn", options.width, options.height),
                   fmt::format("{} to {} pixels each way", kLeastSize, kLargestSize), "size");
  }
  if (!(options.sun_elevation_deg > 0 && options.sun_elevation_deg <= 90)) {
    return failure("the sun is below the ground", "above 0 to 90", "sun_elevation_deg");
  }
  return check(options.camera);
}

}  // namespace

struct Renderer::Impl {
  Impl(const RenderOptions& asked, OffscreenContext&& gl);
  ~Impl();
  void update(const Snapshot& snapshot);
  double aspect() const { return static_cast<double>(options.width) / options.height; }
  void place_camera(const Snapshot& snapshot);
  Framing framing(const Snapshot& snapshot) const;
  bool has_followed(const Snapshot& snapshot) const;
  void follow(const Snapshot& snapshot);
  void show_texts(const Snapshot& snapshot);
  void look_through(const Vec3d& origin);

  RenderOptions options;
  OffscreenContext context;
  SceneGraph scene;
  Caption light_caption, dark_caption;
  Legend legend;
  osg::ref_ptr<PixelReader> reader = new PixelReader;
  osg::ref_ptr<osgViewer::Viewer> viewer = new osgViewer::Viewer;
  Camera camera;
  Region region;                  // that shadows cover
  std::optional<Vec3d> followed;  // where the followed body was at the last update()
  bool placed = false;
};

Renderer::Impl::Impl(const RenderOptions& asked, OffscreenContext&& gl)
    : options(asked),
      context(std::move(gl)),
      scene({.azimuth_deg = asked.sun_azimuth_deg, .elevation_deg = asked.sun_elevation_deg},
            {.wireframe = asked.wireframe, .color = asked.color, .quality = asked.quality, .effects = asked.effects}),
      light_caption(asked.width, asked.height, false),
      dark_caption(asked.width, asked.height, true),
      legend(asked.width, asked.height) {
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
  if (options.show_time) {
    root->addChild(&light_caption.root());
    root->addChild(&dark_caption.root());
  }
  if (options.show_legend) root->addChild(&legend.root());
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
  show_texts(snapshot);
}

void Renderer::Impl::place_camera(const Snapshot& snapshot) {
  const Framing framed = framing(snapshot);
  region = framed.region;
  camera = options.camera.value_or(framed.camera);
  scene.set_view(snapshot.surface.origin, region, camera);
  look_through(snapshot.surface.origin);
  // Near and far follow from what is drawn.
  viewer->getCamera()->setProjectionMatrixAsPerspective(camera.fov_deg, aspect(), 1, 1000);
  placed = true;
}

// What is followed comes to the middle, with room for what it does to the ground.
Framing Renderer::Impl::framing(const Snapshot& snapshot) const {
  if (options.camera || !has_followed(snapshot)) {
    return frame(snapshot.surface, snapshot.bodies, snapshot.bombs, aspect());
  }
  BodyView body = snapshot.bodies[options.follow->value];
  body.radius *= kRoom;
  Framing framed = frame(snapshot.surface, {&body, 1}, {}, aspect());
  const Vec3d moved = body.position - framed.camera.target;
  framed.camera.eye += moved;
  framed.camera.target += moved;
  return framed;
}

bool Renderer::Impl::has_followed(const Snapshot& snapshot) const {
  return options.follow && options.follow->value < snapshot.bodies.size();
}

// Eye, target and shadows move as the body did.
void Renderer::Impl::follow(const Snapshot& snapshot) {
  if (!has_followed(snapshot)) return;
  const Vec3d now = snapshot.bodies[options.follow->value].position;
  const Vec3d moved = now - followed.value_or(now);
  followed = now;
  camera.eye += moved;
  camera.target += moved;
  region.min += moved;
  region.max += moved;
  scene.set_focus(snapshot.surface.origin, region, camera);
  look_through(snapshot.surface.origin);
}

void Renderer::Impl::look_through(const Vec3d& origin) {
  const Vec3d eye = camera.eye - origin, target = camera.target - origin, view = target - eye;
  // Seen from straight above, north is on top.
  const bool vertical = std::hypot(view.x, view.y) < kSteepest * length(view);
  const osg::Vec3d up = vertical ? osg::Vec3d(0, 1, 0) : osg::Vec3d(0, 0, 1);
  viewer->getCamera()->setViewMatrixAsLookAt({eye.x, eye.y, eye.z}, {target.x, target.y, target.z}, up);
  scene.set_eye({eye.x, eye.y, eye.z});
}

// Dark letters on paper, light ones on ground; lines have no colours to explain.
void Renderer::Impl::show_texts(const Snapshot& snapshot) {
  const bool wireframe = scene.look().wireframe;
  light_caption.root().setNodeMask(wireframe ? 0u : ~0u);
  dark_caption.root().setNodeMask(wireframe ? ~0u : 0u);
  (wireframe ? dark_caption : light_caption).set_text(fmt::format("t = {:.2f} s", snapshot.time));
  const double offset = scene.look().color == ColorBy::height ? snapshot.surface.origin.z : 0;
  legend.show(wireframe ? ColorScale() : scene.scale(), offset);
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

void Renderer::set_wireframe(bool wireframe) {
  Look look = impl_->scene.look();
  look.wireframe = wireframe;
  impl_->scene.set_look(look);
}

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
