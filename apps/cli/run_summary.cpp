#include "cli/run_summary.h"

#include <fmt/format.h>

#include "cli/progress.h"
#include "output/heading.h"

namespace divot::cli {
namespace {

std::string line(const std::string& what, const std::string& text) { return fmt::format("  {:<10} {}\n", what, text); }

std::string crater_line(const Crater& crater) {
  const std::string where =
      fmt::format("{:g} t at ({:.6g}, {:.6g})", crater.yield, crater.position.x, crater.position.y);
  if (crater.width == 0) return line("crater", where + ": none to measure");
  return line("crater", fmt::format("{}: {:.4g} m wide ({:.4g} m by eq. 10), {:.3g} m deep, lip {:.3g} m", where,
                                    crater.width, crater.paper_width, crater.depth, crater.lip_height));
}

std::string body_line(const BodyView& body, const Vec3d& start_velocity) {
  const Vec3d& p = body.position;
  std::string text =
      fmt::format("at ({:.2f}, {:.2f}, {:.2f}), heading changed by {:.1f} deg, sank {:.3g} m at most", p.x, p.y, p.z,
                  output::heading_change_deg(start_velocity, body.velocity), body.max_sinkage);
  if (body.off_terrain) text += ", off the terrain";
  return line(body.name, text);
}

std::string flag_lines(const World& world, const RunTotals& totals) {
  std::string text;
  if (totals.substeps_limited > 0)
    text += line("note", fmt::format("in {} of {} steps the ground was softened to what the step can follow; a smaller "
                                     "dt avoids it",
                                     totals.substeps_limited, world.steps()));
  if (const RefinementCounts counts = world.refinement(); counts.short_steps > 0)
    text +=
        line("note", fmt::format("in {} of {} steps the budget of {} new vertices left ground coarser than it should "
                                 "be; raise terrain.refine.budget or min_edge",
                                 counts.short_steps, world.steps(), counts.budget));
  if (totals.not_finite > 0)
    text +=
        line("note", fmt::format("in {} of {} steps a value left the range of numbers and what it belonged to was put "
                                 "to rest; do not trust these results",
                                 totals.not_finite, world.steps()));
  return text;
}

}  // namespace

std::string run_summary(const World& world, const RunTotals& totals, const std::string& folder) {
  std::string text = fmt::format("{}: {:.4g} s simulated in {:.3g} s, {} x real time\n", world.scene().name,
                                 world.time(), totals.wall_s, factor_text(world.time() / totals.wall_s));
  text += line("terrain", fmt::format("{} triangles", world.surface().triangles.size() / 3));
  if (const RefinementCounts counts = world.refinement(); counts.on)
    text += line("refined", fmt::format("to {:.3g} m, {} new vertices at most, {} at the end", counts.edge, counts.most,
                                        counts.vertices));
  text += line("particles", fmt::format("{} awake at most", world.peak_particles()));
  for (const Crater& crater : world.craters()) text += crater_line(crater);
  const std::vector<BodyView> bodies = world.bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) text += body_line(bodies[i], world.scene().bodies[i].velocity);
  return text + flag_lines(world, totals) + line("results", folder);
}

}  // namespace divot::cli
