#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "divot/errors.h"
#include "divot/joint.h"
#include "divot/material.h"
#include "divot/settings.h"
#include "divot/shape.h"
#include "divot/vec.h"

namespace divot {

/// A regular grid of vertices, centred on the origin.
struct GridTerrain {
  int columns = 37;       ///< vertices along x, >= 2
  int rows = 40;          ///< vertices along y, >= 2
  double spacing = 10.9;  ///< m, > 0
  /// Height in metres at x, y in metres; flat where it is empty. Only the C++ interface can set it.
  std::function<double(double x, double y)> height = {};
};

/// A part of a raster in pixels from its first, the north-western one as a rule.
struct PixelWindow {
  int column = 0;                                                            ///< of its first pixel, >= 0
  int row = 0;                                                               ///< likewise
  int columns = 0;                                                           ///< its size; 0: to the end
  int rows = 0;                                                              ///< likewise
  friend bool operator==(const PixelWindow&, const PixelWindow&) = default;  ///< member by member
};

/// A part of a raster in the file's own coordinates (degrees, where those are degrees).
struct MapBox {
  double west = 0;                                                 ///< least x; all four 0: no box
  double south = 0;                                                ///< least y
  double east = 0;                                                 ///< greatest x, > west
  double north = 0;                                                ///< greatest y, > south
  friend bool operator==(const MapBox&, const MapBox&) = default;  ///< member by member
};

/// What becomes of places without data.
enum class Nodata : std::uint8_t {
  holes,  ///< the terrain has holes there
  fill,   ///< they are filled from what is around them
};

/// A digital elevation model in any raster format that GDAL reads.
struct DemTerrain {
  std::string path = {};  ///< relative paths start at the scene file's folder
  std::string crs =
      {};  ///< what the file's coordinates are (`EPSG:4326`), for formats that cannot say; empty: what the file says
  double spacing = 0;  ///< m, resampled to this; 0: as fine as the file
  int band = 1;        ///< >= 1
  double pixel = 0;  ///< m, size of a pixel, for files that do not say it: they lie round the origin; 0: the file says
  int raw_columns = 0;            ///< of a headerless file of 16-bit numbers (.raw, .r16); 0: as many as rows
  double height_scale = 1;        ///< m for each step of the file's numbers, on top of a scale of the file's own, not 0
  double height_offset = 0;       ///< m, height of number 0
  PixelWindow window = {};        ///< the part to read
  MapBox box = {};                ///< the part to read; not together with window
  Nodata nodata = Nodata::holes;  ///< what becomes of places without data
};

/// Which axis of a mesh file points up.
enum class UpAxis : std::uint8_t { z, y };

/// A triangle mesh: in memory, as other programs have it (only the C++ interface can set that), or from a file.
struct MeshTerrain {
  std::vector<Vec3d> vertices = {};  ///< m, in the terrain's coordinates; vertices without a triangle are no ground
  /// [3 * triangle] indices of vertices, counter-clockwise from above. Neighbours share vertices: equal positions are
  /// not joined. What faces up is ground; what stands upright (within 6 degrees) or faces down is rigid. Ground above
  /// ground needs an underside: bridges, caves and closed blocks are fine, loose sheets above each other are not.
  std::vector<std::uint32_t> triangles = {};
  /// [vertex] index into Scene::materials; empty: TerrainSource::material everywhere.
  std::vector<std::uint8_t> materials = {};
  /// OBJ, PLY, STL or glTF; relative paths start at the scene's folder. Empty: the mesh in memory.
  std::string path = {};
  UpAxis up = UpAxis::z;  ///< of OBJ, PLY and STL; glTF knows it
  double scale = 1;       ///< m in a unit of the file, > 0
};

/// What some pixels of a material map stand for.
struct LegendEntry {
  bool color = false;         ///< the pixel is a colour, 0xrrggbb, else the value of the first band
  std::int64_t pixel = 0;     ///< the value, or the colour
  std::string material = {};  ///< a name in Scene::materials or of a preset

  std::string text() const;  ///< the pixel as a scene file writes it
};

/// Which material is where: an image or any raster that GDAL reads. The nearest pixel decides, so that borders are
/// sharp. One that says where it lies is placed there; others are stretched over the terrain, first row to the north.
struct MaterialMap {
  std::string image = {};  ///< relative paths start at the scene file's folder
  std::string crs = {};    ///< what its coordinates are, where it cannot say; empty: what it says, or the `dem`'s
  std::vector<LegendEntry> legend = {};  ///< every value that the image holds, and no other; empty: no map
};

/// New triangles where the ground deforms: as fine as bodies and craters need them, and joined again where the ground
/// is flat. Triangles are halved along their longest sides, those of a grid into ones of the same shape.
struct Refinement {
  double min_edge = 0;     ///< m, no edge of a grid gets shorter; 0: the terrain keeps the triangles it starts with
  int max_level = 10;      ///< times that an edge may be halved, [0, 16]
  double curvature = 0.1;  ///< rad, by which a crater may turn from one triangle to the next, > 0
  double error = 0.04;     ///< share of its sinkage by which ground may keep off a round body, (0, 1]; or `tolerance`
  std::uint64_t budget = 200'000;  ///< most vertices beyond those that the terrain starts with
  double tolerance = 1e-3;         ///< m, by which the surface may move where triangles are joined again, >= 0
};

/// Where the ground comes from and what it is made of.
struct TerrainSource {
  std::variant<GridTerrain, DemTerrain, MeshTerrain> shape = GridTerrain{};  ///< where its heights come from
  std::string material = "paper";           ///< a name in Scene::materials or of a preset
  MaterialMap material_map = {};            ///< where the ground is made of something else
  Refinement refine = {};                   ///< new triangles where the ground deforms
  std::uint64_t max_vertices = 20'000'000;  ///< a larger terrain is refused before memory is taken
};

/// A moving rigid object.
struct BodySettings {
  std::string name = {};      ///< names it in results; empty: it is told apart by its id
  Shape shape = Sphere{};     ///< what it looks like
  double mass = 1;            ///< kg, > 0
  Vec3d position = {};        ///< of its origin, m, in the terrain's coordinates (docs/scene-format.md, "Coordinates")
  bool above_ground = false;  ///< true: position.z is the height of its lowest point above the ground there
  /// Bodies of one assembly that are `above_ground` keep their places to each other: position.z are heights within the
  /// assembly, which is put down where its first body touches. Empty: for itself.
  std::string assembly = {};
  Vec3d rotation_deg = {};                   ///< about the fixed axes x, then y, then z, degrees
  Vec3d velocity = {};                       ///< of its centre of mass, m/s
  Vec3d angular_velocity = {};               ///< rad/s
  std::optional<Vec3d> center_of_mass = {};  ///< in its own axes, m; default: of the shape, uniformly filled
  std::optional<Vec3d> inertia = {};  ///< about its own axes through the centre of mass, kg m^2; default: likewise
  double restitution = 0.5;           ///< multiplied by the material's, [0, 1]
  double friction = 0.8;              ///< Coulomb's, between body and soil and between bodies, >= 0
};

/// A charge.
struct Bomb {
  double time = 0;            ///< s, when it goes off, >= 0
  Vec3d position = {};        ///< m, in the terrain's coordinates; below the ground it is a buried charge
  bool above_ground = false;  ///< true: position.z is the height of burst above the ground there
  double depth = 0;           ///< of burial below `position`, m, >= 0
  double yield = 1;           ///< metric tons of TNT, > 0
};

/// What a run writes.
struct OutputSettings {
  double every = 0;                       ///< s between frames of `formats`; 0: only the final state
  std::vector<std::string> formats = {};  ///< names of docs/scene-format.md, "Formats"
  double raster_spacing = 0;              ///< m, most between pixels of rasters; 0: the terrain's own grid
};

/// Everything that makes a run: what a scene file holds.
struct Scene {
  std::string name = {};                  ///< the file's name without folder and ending
  std::string folder = {};                ///< relative paths in the scene start here
  double duration = 10;                   ///< s, > 0
  double dt = 1.0 / 60;                   ///< s, > 0, at most `duration`
  Vec3d gravity = {0, 0, -9.81};          ///< m/s^2
  std::uint64_t seed = 1;                 ///< of random numbers
  TerrainSource terrain = {};             ///< the ground
  std::vector<Material> materials = {};   ///< those the scene defines; presets need not be listed
  std::vector<BodySettings> bodies = {};  ///< what moves over it
  std::vector<Joint> joints = {};         ///< what holds bodies together
  std::vector<Bomb> bombs = {};           ///< charges, in any order
  Settings solver = {};                   ///< how it is solved
  OutputSettings output = {};             ///< what a run writes
};

/// One `--set key=value`.
struct Override {
  std::string key = {};    ///< dotted path, as `solver.blast` or `bodies.0.mass`
  std::string value = {};  ///< TOML; text that is not TOML is taken as a string
};

/// Reads and checks a scene file. Every problem is reported, not only the first.
Result<Scene> load_scene(const std::string& path, const std::vector<Override>& overrides = {});

/// The same from text; `file` is what errors call it, and relative paths start at its folder.
Result<Scene> parse_scene(std::string_view text, const std::string& file, const std::vector<Override>& overrides = {});

/// The material of that name: one of the scene's own, else a preset, else nullptr.
const Material* find_material(const Scene& scene, std::string_view name);

/// What is out of range or contradictory in a scene made in code; empty when it can run.
Errors check(const Scene& scene);

}  // namespace divot
