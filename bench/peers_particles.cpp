#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <string>

#include "bench/peers.h"
#include "forces/evaluate.h"
#include "geometry/column_grid.h"
#include "geometry/kd_tree.h"
#include "laws/medium.h"
#include "neighbours/neighbours.h"
#include "state/particles.h"
#include "state/soil.h"
#include "terrain/grid.h"

namespace divot::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 316;
constexpr float kCutoff = 1.6f, kSkin = 0.3f;  // spacings

// A sheet of particles one apart, each moved a little, as terrain of the paper's medium.
struct Sheet {
  state::Soil soil;
  state::Particles particles;
  std::vector<laws::Medium> media;
};

Result<Sheet> make_sheet() {
  auto surface = terrain::load_grid({.columns = kSide, .rows = kSide, .spacing = 1}, 1'000'000);
  if (!surface) return tl::unexpected(surface.error());
  Sheet s;
  s.media.push_back(laws::make_medium(Material{}));
  state::Particles& p = s.particles;
  const std::size_t count = surface->position.size();
  p.for_each_array([&](auto& array) { array.resize(count); });
  std::mt19937 random(1);
  const auto jitter = [&] { return 0.02f * (static_cast<float>(random() % 1000) / 500 - 1); };
  for (std::uint32_t v = 0; v < count; ++v) {
    p.vertex[v] = v;
    p.column[v] = state::touch_column(*surface, s.soil, v);
    const Vec3 place = surface->position[v];
    p.set_position(v, place + Vec3{jitter(), jitter(), jitter()});
    p.mass[v] = 1;
    p.hold[v] = Hold::free;
  }
  return s;
}

// CPU seconds of the processes that have been waited for.
double children_s() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// One layer of a square lattice with the same distances; half of each pair is stored.
std::string lammps_input(const char* pair, int steps) {
  return fmt::format(
      "units lj\natom_style atomic\nboundary p p f\nlattice sc 1.0\nregion box block 0 {0} 0 {0} -5 5\n"
      "create_box 1 box\nregion sheet block 0 {0} 0 {0} -0.1 0.1\ncreate_atoms 1 region sheet\nmass 1 1.0\n"
      "displace_atoms all random 0.02 0.02 0.02 1\n{1}\nneighbor 0.3 bin\nneigh_modify delay 0 every 1 check yes\n"
      "fix 1 all nve\nfix 2 all viscous 2.0\nthermo 1000000\ntimestep 0.001\nrun {2}\n",
      kSide, pair, steps);
}

// CPU seconds of a run; nothing when it fails.
std::optional<double> run_lammps(const fs::path& folder, const char* pair, int steps) {
  std::ofstream(folder / "in.sheet") << lammps_input(pair, steps);
  const std::string command = fmt::format(
      "cd '{}' && OMP_NUM_THREADS=1 lmp -in in.sheet -log none -screen none >/dev/null 2>&1", folder.string());
  const double before = children_s();
  if (std::system(command.c_str()) != 0) return std::nullopt;
  return children_s() - before;
}

PeerTime lammps(const fs::path& folder, const char* name, const char* pair) {
  constexpr int kFew = 20, kMany = 220;
  PeerTime t{.task = "forces", .who = name, .count = std::size_t{kSide} * kSide, .each = "particles and steps"};
  const auto few = run_lammps(folder, pair, kFew), many = run_lammps(folder, pair, kMany);
  if (few && many && *many > *few)
    t.ns = 1e9 * (*many - *few) / (kMany - kFew) / static_cast<double>(t.count);
  else
    t.missing = "no program `lmp` that knows this pair style (Debian: lammps)";
  return t;
}

}  // namespace

Result<void> compare_forces(std::vector<PeerTime>& times) {
  auto sheet = make_sheet();
  if (!sheet) return tl::unexpected(sheet.error());
  state::Particles& p = sheet->particles;
  state::Bonds bonds;
  neighbours::Index index;
  const Jobs jobs(1);
  neighbours::update(p, bonds, index, {kCutoff, kSkin, Neighbours::grid, {}}, true, jobs);
  forces::Scratch scratch;
  const forces::Field field{sheet->soil, sheet->media, {}, Cohesion::lennard_jones, kCutoff, {1e18f}};
  const state::MotionView motion{p.x, p.y, p.z, p.vx, p.vy, p.vz};
  const auto evaluate = [&](forces::Renew renew) {
    forces::evaluate(p, bonds, motion, 0, field, renew, scratch, jobs);
  };
  evaluate(forces::Renew::yes);
  const double all = cpu_ns([&] { evaluate(forces::Renew::no); });
  const auto count = static_cast<double>(p.size());
  times.push_back({"forces", "divot", all / count, p.size(), "particles and evaluations, float32, with ground", {}});

  std::string pattern = (fs::temp_directory_path() / "divot-peers-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) return {};
  const fs::path folder = pattern;
  // Both at rest at a distance of one: r0 = 2^(1/6) sigma, and sqrt(2) sigma for exponents 4 and 2.
  times.push_back(
      lammps(folder, "LAMMPS lj/cut/opt, float64", "pair_style lj/cut/opt 1.6\npair_coeff 1 1 1.0 0.8908987"));
  times.push_back(
      lammps(folder, "LAMMPS mie/cut 4-2, float64", "pair_style mie/cut 1.6\npair_coeff 1 1 1.0 0.7071068 4 2"));
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  return {};
}

Result<void> compare_neighbours(std::vector<PeerTime>& times) {
  auto sheet = make_sheet();
  if (!sheet) return tl::unexpected(sheet.error());
  const state::Particles& p = sheet->particles;
  const Jobs jobs(1);
  geometry::ColumnGrid grid;
  geometry::KdTree tree;
  geometry::Rows rows;
  const auto with = [&](auto& structure) {
    return cpu_ns([&] {
             structure.build(p.x, p.y, p.z);
             structure.rows(kCutoff, rows, jobs);
           }) /
           static_cast<double>(p.size());
  };
  times.push_back({"neighbours", "divot", with(grid), p.size(), "particles: build and sorted rows", {}});
  times.push_back({"neighbours", "nanoflann", with(tree), p.size(), "particles: build and sorted rows", {}});
  return {};
}

}  // namespace divot::bench
