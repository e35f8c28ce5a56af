#include "viewer/window.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "viewer/display.h"
#include "viewer/failure.h"
#include "viewer/hud.h"
#include "viewer/live_view.h"
#include "viewer/offscreen_context.h"
#include "viewer/pixel_reader.h"
#include "viewer/pixel_share.h"
#include "viewer/saves.h"
#include "viewer/screen.h"
#include "viewer/stretched_view.h"
#include "viewer/textures.h"

namespace divot::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kLeastSize = 64, kLargestSize = 16384;
constexpr double kMostPictures = 60;   // a second: displays that wait for their own rate are slower or as fast
constexpr double kLongestWait = 0.25;  // s that one picture can let pass
constexpr double kMessageTime = 4;     // s
constexpr double kMeterShare = 0.06;   // of the newest picture in what is shown
constexpr double kSlowPicture = 0.035, kPatience = 2;  // s; so long of such pictures make the quality fast

double seconds(Clock::duration span) { return std::chrono::duration<double>(span).count(); }

// Milliseconds from one call to the next.
class Lap {
 public:
  double operator()() {
    const auto before = std::exchange(at_, Clock::now());
    return 1e3 * seconds(at_ - before);
  }

 private:
  Clock::time_point at_ = Clock::now();
};

Result<void> check(const WindowOptions& options) {
  const auto is_size = [](int size) { return size >= kLeastSize && size <= kLargestSize; };
  if (const double share = options.fast_share.value_or(1); !(share > 0 && share <= 1)) {
    return failure(fmt::format("a fast picture cannot have {:g} of the pixels each way", share),
                   "more than 0, at most 1", "fast_share");
  }
  if (is_size(options.width) && is_size(options.height)) return {};
  return failure(fmt::format("a window of {} x {} pixels cannot be opened", options.width, options.height),
                 fmt::format("{} to {} pixels each way", kLeastSize, kLargestSize), "size");
}

Result<LiveWorld> open_world(const Scene& scene, std::shared_ptr<const Jobs> jobs) {
  return LiveWorld::create(scene, std::move(jobs)).and_then([](LiveWorld&& live) -> Result<LiveWorld> {
    const World& world = live.world();
    if (const auto read = check_textures(world.materials(), world.scene().folder); !read) {
      return tl::unexpected(read.error());
    }
    return std::move(live);
  });
}

}  // namespace

struct Window::Impl {
  Impl(LiveWorld live, const WindowOptions& asked, Quality first, osg::ref_ptr<osgViewer::Viewer> screen,
       std::optional<OffscreenContext> memory = {});
  ~Impl();

  FrameCost show(double passed);

  double aspect() const { return static_cast<double>(width) / height; }
  void carry_out_commands();
  void window_action(Action action);
  void follow_size();
  bool stretches();
  void follow_quality();
  void place_camera();
  void update_hud();
  void draw();
  void measure(double drawing);
  void learn(const FrameCost& cost);
  void wait();
  void say(const std::string& text);
  void save_picture();
  void save_world();

  WindowOptions options;
  std::optional<OffscreenContext> context;  // where there is no display
  osg::ref_ptr<osgViewer::Viewer> viewer;
  LiveView view;
  StretchedView stretched{view.scene().root()};
  PixelShare affordable{1 / kMostPictures};
  Hud hud;
  osg::ref_ptr<Input> input = new Input;
  osg::ref_ptr<PixelReader> reader = new PixelReader;
  StageMeter stages;
  int width = 0, height = 0;  // pixels
  double share = 1;           // of them each way, that the scene is drawn with
  bool help = false, picture_wanted = false;
  Clock::time_point start = Clock::now(), last = start, message_end = start;
  std::string message;
  double drawing_ms = 0, frame_time = 1 / kMostPictures, slow_time = 0, uploaded = 0;
  std::uint64_t pictures = 0, uploaded_before = 0;
};

Window::Impl::Impl(LiveWorld live, const WindowOptions& asked, Quality first, osg::ref_ptr<osgViewer::Viewer> screen,
                   std::optional<OffscreenContext> memory)
    : options(asked),
      context(std::move(memory)),
      viewer(std::move(screen)),
      view(std::move(live), {.quality = first, .effects = asked.effects},
           static_cast<double>(asked.width) / asked.height) {
  osg::ref_ptr<osg::Group> root = new osg::Group;
  root->addChild(&stretched.root());
  if (options.show_numbers) root->addChild(&hud.root());
  viewer->setSceneData(root);
  viewer->addEventHandler(input);
  if (options.paused) view.carry_out(Action::pause, {}, 1);
}

// What lives on the graphics card can only be given back while the context is current.
Window::Impl::~Impl() {
  if (context && context->make_current()) viewer = nullptr;
}

void Window::Impl::carry_out_commands() {
  for (const Command& command : input->take()) {
    view.carry_out(command, input->mouse(), aspect());
    if (const auto* action = std::get_if<Action>(&command)) window_action(*action);
  }
  if (const std::string text = view.take_message(); !text.empty()) say(text);
}

void Window::Impl::window_action(Action action) {
  if (action == Action::quit) viewer->setDone(true);
  if (action == Action::help) help = !help;
  if (action == Action::screenshot) picture_wanted = true;
  if (action == Action::save_state) save_world();
}

void Window::Impl::say(const std::string& text) {
  message = text;
  message_end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(kMessageTime));
}

void Window::Impl::save_picture() {
  picture_wanted = false;
  const std::string& name = view.live().world().scene().name;
  const std::string path = free_path(options.folder, name.empty() ? "divot" : name, ".png");
  const auto written = write_png(reader->image(), path);
  say(written ? "saved " + path : written.error().front().text());
}

void Window::Impl::save_world() {
  const auto saved = viewer::save_state(view.live().world(), options.folder, seconds(Clock::now() - start));
  say(saved ? "saved " + *saved : saved.error().front().text());
}

// The window's size is the viewport's, which follows every resize.
void Window::Impl::follow_size() {
  const osg::Viewport& viewport = *viewer->getCamera()->getViewport();
  const int now_wide = std::max(static_cast<int>(viewport.width()), 1);
  const int now_high = std::max(static_cast<int>(viewport.height()), 1);
  if (now_wide == width && now_high == height) return;
  width = now_wide;
  height = now_high;
  hud.resize(width, height);
}

// Lines would blur, and cost little.
bool Window::Impl::stretches() {
  const Look& look = view.scene().look();
  return look.quality == Quality::fast && !look.wireframe;
}

// What is drawn covers every pixel: where it is stretched there is nothing to clear, otherwise only depth.
void Window::Impl::follow_quality() {
  share = stretches() ? options.fast_share.value_or(affordable.share()) : 1;
  stretched.set_size(width, height, share);
  viewer->getCamera()->setClearMask(share < 1 ? 0 : GL_DEPTH_BUFFER_BIT);
}

void Window::Impl::place_camera() {
  const Camera camera = view.camera();
  const Vec3d origin = view.live().world().surface().origin, eye = camera.eye - origin, target = camera.target - origin;
  viewer->getCamera()->setViewMatrixAsLookAt({eye.x, eye.y, eye.z}, {target.x, target.y, target.z}, {0, 0, 1});
  // Near and far follow from what is drawn.
  viewer->getCamera()->setProjectionMatrixAsPerspective(camera.fov_deg, static_cast<double>(width) / height, 1, 1000);
}

void Window::Impl::update_hud() {
  const LiveWorld& live = view.live();
  const World& world = live.world();
  stages.update(world.stages());
  const std::uint64_t sent = view.scene().terrain().uploaded_bytes();
  uploaded += kMeterShare * (static_cast<double>(sent - uploaded_before) - uploaded);
  uploaded_before = sent;
  const auto now = Clock::now();
  if (now > message_end) message.clear();
  hud.update({.time = world.time(),
              .real_time_factor = live.real_time_factor(),
              .speed = live.speed(),
              .paused = live.paused(),
              .lagging = live.lagging(),
              .pictures_per_second = 1 / frame_time,
              .awake = world.particles().vertices.size(),
              .uploaded = uploaded,
              .stages = stages.rows(),
              .drawing_ms = drawing_ms,
              .yield = view.toolbox().yield(),
              .body = view.toolbox().body_text(),
              .followed = view.followed(),
              .message = message,
              .scale = &view.scene().scale(),
              .height_offset = world.surface().origin.z,
              .help = help},
             seconds(now - start));
}

FrameCost Window::Impl::show(double passed) {
  FrameCost cost;
  Lap lap;
  follow_size();
  carry_out_commands();
  follow_quality();
  view.advance(std::min(passed, kLongestWait));
  cost.step_ms = lap();
  view.update();
  place_camera();
  cost.update_ms = lap();
  if (options.show_numbers) update_hud();
  cost.hud_ms = lap();
  draw();
  cost.draw_ms = lap();
  cost.share = share;
  return cost;
}

void Window::Impl::draw() {
  const auto begin = Clock::now();
  viewer->getCamera()->setFinalDrawCallback(picture_wanted ? reader : nullptr);
  viewer->updateTraversal();
  viewer->renderingTraversals();
  ++pictures;
  measure(seconds(Clock::now() - begin));
  if (picture_wanted) save_picture();
}

void Window::Impl::measure(double drawing) {
  drawing_ms += kMeterShare * (1e3 * drawing - drawing_ms);
  slow_time = drawing > kSlowPicture ? slow_time + drawing : 0;
  if (options.quality || view.scene().look().quality == Quality::fast || slow_time < kPatience) return;
  view.set_quality(Quality::fast);
}

// Fewer pixels do not help where steps are what takes long: they count for half of a picture's time at most.
void Window::Impl::learn(const FrameCost& cost) {
  if (!stretches()) return;
  affordable.see(1e-3 * cost.draw_ms + std::min(1e-3 * (cost.all_ms() - cost.draw_ms), 0.5 / kMostPictures));
}

// Sleeps where the display does not wait itself.
void Window::Impl::wait() {
  const auto due = last + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / kMostPictures));
  std::this_thread::sleep_until(due);
}

Window::Window(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

Result<Window> Window::create(const Scene& scene, std::shared_ptr<const Jobs> jobs, const WindowOptions& options) {
  if (const auto checked = check(options); !checked) return tl::unexpected(checked.error());
  const auto display = open_display();
  if (!display) return tl::unexpected(display.error());
  const Quality quality = options.quality.value_or(display->accelerated ? Quality::fine : Quality::fast);
  auto live = open_world(scene, std::move(jobs));
  if (!live) return tl::unexpected(live.error());
  const std::string title = scene.name.empty() ? "divot" : "divot: " + scene.name;
  auto screen = open_screen(options.width, options.height, samples_of(quality), title);
  if (!screen) return tl::unexpected(screen.error());
  return Window(std::make_unique<Impl>(std::move(*live), options, quality, *screen));
}

Result<Window> Window::create_offscreen(const Scene& scene, std::shared_ptr<const Jobs> jobs,
                                        const WindowOptions& options) {
  if (const auto checked = check(options); !checked) return tl::unexpected(checked.error());
  const Quality quality = options.quality.value_or(Quality::fast);
  auto live = open_world(scene, std::move(jobs));
  if (!live) return tl::unexpected(live.error());
  auto context = OffscreenContext::create(options.width, options.height, samples_of(quality));
  if (!context) return tl::unexpected(context.error());
  osg::ref_ptr<osgViewer::Viewer> memory = new osgViewer::Viewer;
  memory->setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  memory->setUpViewerAsEmbeddedInWindow(0, 0, options.width, options.height);
  memory->setLightingMode(osg::View::NO_LIGHT);
  memory->getCamera()->setDrawBuffer(GL_BACK);
  memory->getCamera()->setReadBuffer(GL_BACK);
  memory->getCamera()->setViewport(0, 0, options.width, options.height);
  return Window(std::make_unique<Impl>(std::move(*live), options, quality, memory, std::move(*context)));
}

bool Window::frame() {
  Impl& w = *impl_;
  if (w.viewer->done() || !w.viewer->isRealized()) return false;
  w.wait();
  const auto now = Clock::now();
  const double passed = seconds(now - w.last);
  w.last = now;
  w.frame_time += kMeterShare * (passed - w.frame_time);
  w.viewer->advance();
  w.viewer->eventTraversal();
  if (w.viewer->done() || !w.viewer->isRealized()) return false;
  w.learn(w.show(passed));
  return true;
}

FrameCost Window::frame_after(double seconds) {
  Impl& w = *impl_;
  if (w.context && !w.context->make_current()) return {};
  w.viewer->advance();
  w.viewer->eventTraversal();
  Lap lap;
  FrameCost cost = w.show(seconds);
  glFinish();
  cost.draw_ms = lap() - cost.step_ms - cost.update_ms - cost.hud_ms;
  w.learn(cost);
  return cost;
}

void Window::click(double x, double y) { impl_->view.carry_out(BombCommand{{x, y}}, {}, impl_->aspect()); }

void Window::restart() { impl_->view.carry_out(Action::restart, {}, 1); }

WindowReport Window::run() {
  while (frame()) {
  }
  return {.pictures = impl_->pictures,
          .seconds = seconds(Clock::now() - impl_->start),
          .uploaded_bytes = impl_->view.scene().terrain().uploaded_bytes()};
}

Image Window::capture() {
  if (impl_->context && !impl_->context->make_current()) return {};
  impl_->viewer->getCamera()->setFinalDrawCallback(impl_->reader);
  impl_->viewer->renderingTraversals();
  return impl_->reader->image();
}

Camera Window::camera() const { return impl_->view.camera(); }

const World& Window::world() const { return impl_->view.live().world(); }

}  // namespace divot::viewer
