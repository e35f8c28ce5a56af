#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/scene_input.h"
#include "cli/series.h"
#include "cli/stills.h"
#include "output/atomic_file.h"
#include "viewer/textures.h"

namespace divot::cli {
namespace {

Result<std::optional<BodyId>> followed(const std::string& name, const World& world) {
  if (name.empty()) return std::optional<BodyId>();
  std::vector<std::string> names;
  for (const BodyView& body : world.bodies()) names.push_back(body.name);
  for (std::uint32_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return BodyId{i};
  return fail({.file = "--follow",
               .problem = fmt::format("no body is called \"{}\"", name),
               .expected = names.empty() ? "the scene has none" : fmt::format("expected {}", fmt::join(names, ", "))});
}

// Lines are drawn in ink.
Result<void> check_color(const RenderOptions& options) {
  if (!options.wireframe || options.color == viewer::ColorBy::natural) return {};
  return fail({.file = "--color",
               .problem = "lines have no colours",
               .expected = "expected --wireframe-at with some of the times, or no --wireframe"});
}

// All that is asked of the pictures, before anything is drawn.
struct Plan {
  std::string folder;
  std::optional<BodyId> follow;
  Series series;
  std::vector<Shot> shots;
};

Result<Plan> plan(const RenderOptions& options, const World& world) {
  Plan plan{.folder = results_folder(options.out, world.scene())};
  return check_color(options)
      .and_then([&] { return followed(options.follow, world); })
      .and_then([&](std::optional<BodyId> body) {
        plan.follow = body;
        return plan_series(options, world.scene(), plan.folder);
      })
      .and_then([&](const Series& series) {
        plan.series = series;
        return plan_stills(options, world.scene());
      })
      .map([&](const std::vector<Shot>& shots) {
        plan.shots = shots;
        return plan;
      });
}

Result<viewer::Renderer> renderer_for(const RenderOptions& options, const Plan& plan) {
  return viewer::Renderer::create({.width = options.width,
                                   .height = options.height,
                                   .wireframe = options.wireframe,
                                   .color = options.color,
                                   .show_time = options.sheet,
                                   .show_legend = true,
                                   .camera = options.camera,
                                   .follow = plan.follow});
}

// What an option asked for and cannot be had is named by the option; a machine that cannot draw is no fault of the
// command line.
int refuse(Errors errors) {
  int status = kFailed;
  for (Error& error : errors) {
    if (error.key != "size" && error.key != "camera") continue;
    error.file = "--" + std::exchange(error.key, {});
    status = kBadInput;
  }
  return report(errors, status);
}

// The folder that relative paths start at is the scene's.
Result<void> check_looks(const RenderOptions& options, const World& world) {
  auto read = viewer::check_textures(world.materials(), world.scene().folder);
  if (!read)
    for (Error& error : read.error()) error.file = options.scene.path;
  return read;
}

}  // namespace

int render(const RenderOptions& options) {
  auto world = open_world(options.scene);
  if (!world) return report(world.error(), kBadInput);
  catch_interrupts();
  if (const auto read = check_looks(options, *world); !read) return report(read.error(), kBadInput);
  const auto asked = plan(options, *world);
  if (!asked) return report(asked.error(), kBadInput);
  auto renderer = renderer_for(options, *asked);
  if (!renderer) return refuse(renderer.error());
  if (const auto made = output::make_folder(asked->folder); !made) return report(made.error(), kFailed);

  Filming filming(*world, *renderer);
  const auto drawn = asked->series.count > 0
                         ? draw_series(filming, asked->series, options.wireframe, asked->folder)
                         : draw_stills(filming, asked->shots, options.sheet, asked->folder, world->scene().name);
  if (interrupted()) {
    fmt::print(stderr, "interrupted at {:.2f} s\n", world->time());
    return kFailed;
  }
  return drawn ? kDone : report(drawn.error(), kFailed);
}

}  // namespace divot::cli
