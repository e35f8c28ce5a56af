#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "divot/output.h"
#include "divot/version.h"
#include "laws/blast.h"
#include "math/aabb.h"
#include "output/atomic_file.h"
#include "output/body_mesh.h"
#include "output/report_assets.h"
#include "output/report_data.h"
#include "output/summary.h"

namespace divot {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostVertices = 400'000;
constexpr std::size_t kMostBytes = std::size_t{9} << 20;  // of meshes and frames; a third more in base64

// A line over ground zero: to the east or to the north, so far to both sides as craters and their lips reach.
struct Line {
  const char* name;
  Vec3d direction;
};
constexpr Line kLines[] = {{"west to east", {1, 0, 0}}, {"south to north", {0, 1, 0}}};
constexpr int kHalfPoints = 100;

double half_length(double yield) { return 1.5 * laws::crater_width(yield); }

std::vector<double> heights_along(const World& world, const BombView& bomb, const Line& line) {
  std::vector<double> heights;
  for (int k = -kHalfPoints; k <= kHalfPoints; ++k) {
    const Vec3d p = bomb.position + (half_length(bomb.yield) * k / kHalfPoints) * line.direction;
    heights.push_back(world.ground_height(p.x, p.y));
  }
  return heights;
}

Json numbers(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double v : values) out.push_back(std::isfinite(v) ? Json(v) : Json());
  return out;
}

// A bomb and the ground it will meet.
struct Target {
  BombView bomb;
  std::vector<std::vector<double>> start;  // m, along each of kLines
};

// Something the page unpacks, with what it must know to do so.
struct Packed {
  Json facts;
  std::string bytes;
};

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

Json body_facts(const BodyView& b, const Vec3d& origin) {
  const Vec3d p = b.position - origin;
  Json out = Json::array();
  for (const double v : {p.x, p.y, p.z, b.orientation.x, b.orientation.y, b.orientation.z, b.orientation.w,
                         length(b.velocity), b.sinkage})
    out.push_back(rounded(v));
  return out;
}

Json mesh_facts(const BodyView& body) {
  const output::BodyMesh mesh = output::body_mesh(*body.shape);
  Json vertices = Json::array();
  for (const Vec3d& p : mesh.vertices)
    for (const double v : {p.x, p.y, p.z}) vertices.push_back(rounded(v));
  const Shape& shape = *body.shape;
  const bool rolls = std::holds_alternative<Sphere>(shape) || std::holds_alternative<Cylinder>(shape) ||
                     std::holds_alternative<Capsule>(shape);
  return {{"name", body.name}, {"vertices", vertices}, {"triangles", mesh.triangles}, {"rolls", rolls}};
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

// JSON that may stand in a page: `<` occurs in texts alone, where it has another spelling.
std::string in_page(const Json& json) {
  std::string out;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
    out += c == '<' ? "\\u003c" : std::string(1, c);
  return out;
}

}  // namespace

struct Report::Impl {
  std::string scene_text;
  std::vector<Target> targets;
  std::vector<std::uint32_t> triangles;  // of the newest mesh
  std::vector<Packed> meshes, times;
  std::vector<StageTime> stages;       // at the last time kept
  std::uint64_t steps = 0;             // likewise
  std::uint64_t calls = 0, every = 1;  // one call of `every` is kept
  std::uint32_t stride = 1;
  math::Aabb focus, terrain;

  void keep(const World& world);
  void see_bombs(const World& world);
  void see_action(const World& world, const output::ShownGround& ground);
  void keep_mesh(const output::ShownGround& ground);
  Json stage_times(const World& world);
  void thin_out();
  bool mesh_is_used(std::size_t mesh) const;
  std::size_t bytes() const;
  Json facts(const World& world, const RunTotals& totals) const;
  Json crater_facts(const World& world) const;
  std::string join(Json& facts) const;
};

// Bombs are planned before they go off: the ground under them is still what it was.
void Report::Impl::see_bombs(const World& world) {
  for (const BombView& bomb : world.bombs()) {
    if (bomb.exploded || std::ranges::any_of(targets, [&](const Target& t) {
          return t.bomb.time == bomb.time && t.bomb.position == bomb.position && t.bomb.yield == bomb.yield;
        }))
      continue;
    Target target{bomb, {}};
    for (const Line& line : kLines) target.start.push_back(heights_along(world, bomb, line));
    targets.push_back(std::move(target));
  }
}

void Report::Impl::see_action(const World& world, const output::ShownGround& ground) {
  const Vec3d origin = world.surface().origin;
  for (std::size_t v = 0; v < ground.start.size(); ++v)
    if (ground.offset[v] != Vec3{}) focus.include(ground.start[v] + ground.offset[v]);
  for (const BodyView& b : world.bodies()) {
    if (b.off_terrain) continue;
    const auto r = static_cast<float>(b.radius);
    const Vec3 p = to_float(b.position - origin), corner{r, r, r};
    focus.include(p - corner), focus.include(p + corner);
  }
  for (const BombView& b : world.bombs()) focus.include(to_float(b.position - origin));
}

void Report::Impl::keep_mesh(const output::ShownGround& ground) {
  if (!meshes.empty() && triangles == ground.triangles) return;
  triangles = ground.triangles;
  stride = ground.stride;
  for (const Vec3& p : ground.start) terrain.include(p);
  meshes.push_back({{{"vertices", ground.start.size()}, {"faces", triangles.size() / 3}}, packed_mesh(ground)});
}

// Milliseconds a step since the last time kept.
Json Report::Impl::stage_times(const World& world) {
  const std::vector<StageTime> now = world.stages();
  const double passed = static_cast<double>(std::max<std::uint64_t>(world.steps() - steps, 1));
  Json out = Json::array();
  for (std::size_t k = 0; k < now.size(); ++k)
    out.push_back(rounded((now[k].ms - (stages.empty() ? 0 : stages[k].ms)) / passed));
  stages = now;
  steps = world.steps();
  return out;
}

void Report::Impl::keep(const World& world) {
  see_bombs(world);
  const output::ShownGround ground = output::shown_ground(world, kMostVertices);
  keep_mesh(ground);
  see_action(world, ground);
  output::PackedFrame frame = output::packed_frame(ground);
  const Energy energy = world.energy();
  const SoilVolume soil = world.soil_volume();
  Json bodies = Json::array();
  for (const BodyView& b : world.bodies()) bodies.push_back(body_facts(b, world.surface().origin));
  times.push_back({{{"time", world.time()},
                    {"mesh", meshes.size() - 1},
                    {"moved", frame.moved},
                    {"step", frame.step},
                    {"particles", world.particles().vertices.size()},
                    {"energy", {energy.bodies_kinetic, energy.bodies_potential, energy.ground_kinetic}},
                    {"soil", {soil.displaced, soil.compacted, soil.deposited}},
                    {"stage_ms", stage_times(world)},
                    {"bodies", std::move(bodies)}},
                   std::move(frame.bytes)});
  while (bytes() > kMostBytes && times.size() > 2) thin_out();
}

// Every other time goes, but never the first.
void Report::Impl::thin_out() {
  std::vector<Packed> left;
  for (std::size_t k = 0; k < times.size(); k += 2) left.push_back(std::move(times[k]));
  times = std::move(left);
  every *= 2;
  for (std::size_t k = 0; k < meshes.size(); ++k)
    if (!mesh_is_used(k)) meshes[k].bytes.clear();
}

bool Report::Impl::mesh_is_used(std::size_t mesh) const {
  return mesh + 1 == meshes.size() ||
         std::ranges::any_of(times, [&](const Packed& t) { return t.facts["mesh"] == mesh; });
}

std::size_t Report::Impl::bytes() const {
  std::size_t sum = 0;
  for (const auto* parts : {&meshes, &times})
    for (const Packed& p : *parts)
      sum += p.bytes.size() + 16 * p.facts.size() + (p.facts.contains("bodies") ? 90 * p.facts["bodies"].size() : 0);
  return sum;
}

Json Report::Impl::crater_facts(const World& world) const {
  Json out = output::summary(world, {})["craters"];
  const std::vector<BombView> bombs = world.bombs();
  for (Json& crater : out) {
    crater["lines"] = Json::array();
    const auto target = std::ranges::find_if(targets, [&](const Target& t) {
      return t.bomb.yield == crater["yield_t"] && std::abs(t.bomb.position.x - crater["x"].get<double>()) < 1e-3 &&
             std::abs(t.bomb.position.y - crater["y"].get<double>()) < 1e-3;
    });
    if (target == targets.end()) continue;
    std::vector<double> at;
    for (int k = -kHalfPoints; k <= kHalfPoints; ++k) at.push_back(half_length(target->bomb.yield) * k / kHalfPoints);
    for (std::size_t k = 0; k < std::size(kLines); ++k)
      crater["lines"].push_back({{"name", kLines[k].name},
                                 {"at", at},
                                 {"start", numbers(target->start[k])},
                                 {"end", numbers(heights_along(world, target->bomb, kLines[k]))}});
  }
  return out;
}

Json Report::Impl::facts(const World& world, const RunTotals& totals) const {
  const Json summary = output::summary(world, totals);
  const Vec3d origin = world.surface().origin;
  const math::Aabb& box = focus.low.x <= focus.high.x ? focus : terrain;
  Json out = {{"version", version()},
              {"scene", world.scene().name},
              {"scene_text", scene_text},
              {"origin", {origin.x, origin.y, origin.z}},
              {"focus", {{box.low.x, box.low.y, box.low.z}, {box.high.x, box.high.y, box.high.z}}},
              {"vertices", summary["terrain"]["vertices"]},
              {"triangles", summary["terrain"]["triangles"]},
              {"thinned", stride > 1 ? stride : 0},
              {"soil_error", summary["volume"]["relative_error"]},
              {"craters", crater_facts(world)},
              {"bodies", Json::array()},
              {"stages", Json::array()}};
  for (const char* key : {"simulated_s", "steps", "wall_s", "real_time_factor", "state_hash"}) out[key] = summary[key];
  for (const BodyView& body : world.bodies()) out["bodies"].push_back(mesh_facts(body));
  for (const StageTime& s : world.stages())
    out["stages"].push_back({{"name", s.name}, {"ms", s.ms}, {"calls", s.calls}});
  return out;
}

// All bytes in one piece; the facts learn where theirs are.
std::string Report::Impl::join(Json& facts) const {
  std::string all;
  const auto add = [&](const char* list, const std::vector<Packed>& parts) {
    facts[list] = Json::array();
    for (const Packed& part : parts) {
      Json one = part.facts;
      one["at"] = all.size();
      one["bytes"] = part.bytes.size();
      facts[list].push_back(std::move(one));
      all += part.bytes;
    }
  };
  add("meshes", meshes);
  add("frames", times);
  return all;
}

Report::Report(std::string scene_text) : impl_(std::make_unique<Impl>()) { impl_->scene_text = std::move(scene_text); }
Report::Report(Report&&) noexcept = default;
Report& Report::operator=(Report&&) noexcept = default;
Report::~Report() = default;

void Report::add(const World& world) {
  if (impl_->calls++ % impl_->every == 0) impl_->keep(world);
}

Result<void> Report::write(const std::string& path, const World& world, const RunTotals& totals) {
  const output::ReportAssets assets = output::report_assets();
  if (assets.three.empty())
    return fail({.file = path,
                 .problem = "cannot be written: divot was built without three.js",
                 .expected = "install libjs-three and build it again"});
  if (impl_->times.empty() || impl_->times.back().facts["time"] != world.time()) impl_->keep(world);
  Json facts = impl_->facts(world, totals);
  const std::string blob = output::base64(impl_->join(facts));
  auto file = output::AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(output::filled_in(assets.page, {{"title", escaped(world.scene().name + ": divot")},
                                              {"style", assets.style},
                                              {"data", in_page(facts)},
                                              {"blob", blob},
                                              {"three", assets.three},
                                              {"code", assets.code}}));
  return file->commit();
}

}  // namespace divot
