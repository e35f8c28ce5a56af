#include "scene/describe.h"

#include "output/formats.h"
#include "scene/bounds.h"

namespace divot::scene {
namespace {

// Ids count to 2^32 and a vertex has six half-edges.
constexpr double kMostVertices = 7e8;
// Address space is set aside for all that refinement may add.
constexpr double kMostAdded = 2e7;

constexpr const char* kCohesions[] = {"lennard_jones", "mass_spring"};
constexpr const char* kBlasts[] = {"scaled", "paper"};
constexpr const char* kIntegrators[] = {"auto", "euler", "rk4"};
constexpr const char* kNeighbours[] = {"grid", "kd_tree"};

void describe_grid(Visitor& v, GridTerrain& grid) {
  v.table({.name = "grid", .example = "grid = { columns = 37, rows = 40, spacing = 10.9 }"}, [&] {
    v.whole({.name = "columns", .range = between(2, 1e6), .meaning = "vertices along x", .required = true},
            grid.columns);
    v.whole({.name = "rows", .range = between(2, 1e6), .meaning = "vertices along y", .required = true}, grid.rows);
    v.number({.name = "spacing",
              .unit = "m",
              .range = above(0, kLong),
              .meaning = "distance between neighbouring vertices",
              .required = true},
             grid.spacing);
  });
}

void describe_window(Visitor& v, PixelWindow& window) {
  constexpr double kMost = 2e9;
  v.table({.name = "window", .example = "window = { column = 0, row = 0, columns = 512, rows = 512 }"}, [&] {
    v.whole({.name = "column",
             .range = between(0, kMost),
             .meaning = "first pixel of the part that is read, from the west"},
            window.column);
    v.whole({.name = "row", .range = between(0, kMost), .meaning = "likewise, from the north"}, window.row);
    v.whole({.name = "columns", .range = between(0, kMost), .meaning = "pixels that are read; 0: to the end"},
            window.columns);
    v.whole({.name = "rows", .range = between(0, kMost), .meaning = "likewise"}, window.rows);
  });
}

void describe_box(Visitor& v, MapBox& box) {
  v.table({.name = "box", .example = "box = { west = 14.1, south = 50.0, east = 14.3, north = 50.2 }"}, [&] {
    const auto side = [&](const char* name, const char* meaning, double& value) {
      v.number({.name = name, .range = between(-kFar, kFar), .meaning = meaning, .default_text = "no box"}, value);
    };
    side("west", "border of the part that is read, in the file's own coordinates", box.west);
    side("south", "likewise", box.south);
    side("east", "likewise", box.east);
    side("north", "likewise", box.north);
  });
}

void describe_dem(Visitor& v, DemTerrain& dem) {
  v.text({.name = "dem",
          .meaning = "elevation model in a raster format GDAL reads; a relative path starts at the scene's folder",
          .default_text = "none"},
         dem.path);
  v.text({.name = "crs",
          .meaning = "coordinate system of a `dem` that cannot say it itself, as `EPSG:4326`",
          .default_text = "what the file says"},
         dem.crs);
  v.number({.name = "spacing",
            .unit = "m",
            .range = between(0, kLong),
            .meaning = "the `dem` is resampled to this distance between vertices; 0: as fine as the file"},
           dem.spacing);
  v.whole({.name = "band", .range = between(1, 65535), .meaning = "band of the `dem` that holds heights"}, dem.band);
  v.number({.name = "pixel",
            .unit = "m",
            .range = between(0, kLong),
            .meaning = "size of a pixel, for a `dem` that does not say it: it lies round the origin; 0: the file says"},
           dem.pixel);
  v.whole({.name = "raw_columns",
           .range = between(0, 1e6),
           .meaning =
               "of a headerless `dem` of unsigned 16-bit numbers, low byte first (`.raw`, `.r16`); 0: as many as rows"},
          dem.raw_columns);
  v.number({.name = "height_scale",
            .unit = "m",
            .range = between(-kLong, kLong),
            .meaning = "for each step of the file's numbers, on top of a scale that the file has itself; not 0"},
           dem.height_scale);
  v.number({.name = "height_offset", .unit = "m", .range = between(-kLong, kLong), .meaning = "height of number 0"},
           dem.height_offset);
  static constexpr const char* kNodata[] = {"holes", "fill"};
  v.choice({.name = "nodata", .meaning = "places without data stay holes or are filled from what is around them"},
           kNodata, dem.nodata);
  describe_window(v, dem.window);
  describe_box(v, dem.box);
}

void describe_mesh(Visitor& v, MeshTerrain& mesh) {
  static constexpr const char* kUp[] = {"z", "y"};
  v.text({.name = "mesh",
          .meaning = "triangle mesh, closed or open, which may overhang: OBJ, PLY, STL or glTF; a relative path starts "
                     "at the scene's folder",
          .default_text = "none"},
         mesh.path);
  v.choice({.name = "up", .meaning = "axis of the `mesh` that points up; glTF knows its own"}, kUp, mesh.up);
  v.number({.name = "scale", .unit = "m", .range = above(0, kLong), .meaning = "in one unit of the `mesh`"},
           mesh.scale);
}

void describe_map(Visitor& v, MaterialMap& map) {
  v.table({.name = "material_map",
           .example = "material_map = { image = \"road.png\", legend = { 0 = \"field\", 255 = \"asphalt\" } }"},
          [&] {
            v.text({.name = "image",
                    .meaning = "image or raster in a format GDAL reads; a relative path starts at the scene's folder",
                    .required = true},
                   map.image);
            v.text({.name = "crs",
                    .meaning = "coordinate system of an `image` that cannot say it itself, as `EPSG:4326`",
                    .default_text = "what the image says, else `terrain.crs`"},
                   map.crs);
            v.legend({.name = "legend",
                      .meaning = "material of each value that the image holds: of its first band, or `\"#rrggbb\"`",
                      .required = true},
                     map.legend);
          });
}

void describe_refine(Visitor& v, Refinement& refine) {
  v.table({.name = "refine", .example = "refine = { min_edge = 0.05 }"}, [&] {
    v.number({.name = "min_edge",
              .unit = "m",
              .range = between(0, kLong),
              .meaning = "new triangles where the ground deforms, with no edge shorter than this; 0: none",
              .required = true},
             refine.min_edge);
    v.whole(
        {.name = "max_level", .range = between(0, 16), .meaning = "times that an edge of the terrain may be halved"},
        refine.max_level);
    v.number({.name = "curvature",
              .unit = "rad",
              .range = above(0, 1),
              .meaning = "by which a crater may turn from one triangle to the next"},
             refine.curvature);
    v.number(
        {.name = "error",
         .range = above(0, 1),
         .meaning = "share of its sinkage, if more than `tolerance`, by which the ground may keep off a round body "
                    "between vertices"},
        refine.error);
    v.whole({.name = "budget",
             .range = between(0, kMostAdded),
             .meaning = "most vertices beyond those that the terrain starts with"},
            refine.budget);
    v.number({.name = "tolerance",
              .unit = "m",
              .range = between(0, kLong),
              .meaning = "by which the surface may move where triangles are joined again; or 1 % of how far it was "
                         "deformed there"},
             refine.tolerance);
  });
}

void describe_terrain(Visitor& v, TerrainSource& terrain) {
  static constexpr const char* kDemOnly[] = {"crs",          "spacing",       "band",   "pixel",  "raw_columns",
                                             "height_scale", "height_offset", "nodata", "window", "box"};
  static constexpr const char* kMeshOnly[] = {"up", "scale"};
  static constexpr Branch kShapes[] = {{"grid", {}, "grid = { columns = 37, rows = 40, spacing = 10.9 }"},
                                       {"dem", kDemOnly, "dem = \"file.tif\""},
                                       {"mesh", kMeshOnly, "mesh = \"file.obj\""}};
  for (const std::size_t shape : v.branches(kShapes, terrain.shape.index())) {
    if (shape == 0) describe_grid(v, as<GridTerrain>(terrain.shape));
    if (shape == 1) describe_dem(v, as<DemTerrain>(terrain.shape));
    if (shape == 2) describe_mesh(v, as<MeshTerrain>(terrain.shape));
  }
  v.text({.name = "material", .meaning = "what the ground is made of: a preset or a material of the file"},
         terrain.material);
  describe_map(v, terrain.material_map);
  v.whole({.name = "max_vertices",
           .range = between(4, kMostVertices),
           .meaning = "a larger terrain is refused before memory is taken"},
          terrain.max_vertices);
  describe_refine(v, terrain.refine);
}

void describe_materials(Visitor& v, std::vector<Material>& materials) {
  v.table({.name = "materials"}, [&] {
    const std::vector<std::string> names = v.material_names(materials);
    materials.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      v.table({.name = names[i].c_str()}, [&] {
        materials[i].name = names[i];
        v.base({.name = "base",
                .meaning = "preset or material of the file that gives every key not written here",
                .default_text = "the preset of that name, else `paper`"},
               materials[i], std::span(materials).first(i));
        describe(v, materials[i]);
      });
    }
  });
}

void describe_solver(Visitor& v, Settings& solver) {
  v.choice({.name = "cohesion", .meaning = "force between surface particles: eq. 6 or eq. 1"}, kCohesions,
           solver.cohesion);
  v.choice({.name = "blast", .meaning = "what a bomb does: held against measured craters, or eq. 8-14 to the letter"},
           kBlasts, solver.blast);
  v.choice({.name = "integrator", .meaning = "`auto`: rk4 while a blast acts, euler otherwise"}, kIntegrators,
           solver.integrator);
  v.choice({.name = "neighbours", .meaning = "search structure; both give the same rows"}, kNeighbours,
           solver.neighbours);
  v.policy(
      {.name = "neighbour_update", .meaning = "when neighbour rows are rebuilt; its steps are those of integration"},
      solver.neighbour_update);
  v.policy({.name = "bvh_update", .meaning = "when the bounding volumes are brought up to date"}, solver.bvh_update);
  v.number({.name = "cutoff", .unit = "spacings", .range = between(1.1, 4), .meaning = "range of cohesion"},
           solver.cutoff);
  v.number({.name = "skin",
            .unit = "spacings",
            .range = above(0, 2),
            .meaning = "reach added to neighbour rows so that they last"},
           solver.skin);
}

void describe_output(Visitor& v, OutputSettings& output) {
  v.number({.name = "every",
            .unit = "s",
            .range = between(0, kForever),
            .meaning = "between frames of `formats`; 0: only the final state"},
           output.every);
  v.options({.name = "formats", .meaning = "what a frame is written as"}, output::format_names(), output.formats);
  v.number({.name = "raster_spacing",
            .unit = "m",
            .range = between(0, kLong),
            .meaning = "most between pixels of rasters, the nodes of the terrain's grid among them; 0: these alone"},
           output.raster_spacing);
}

}  // namespace

void describe(Visitor& v, Bomb& bomb) {
  v.number({.name = "time", .unit = "s", .range = between(0, kForever), .meaning = "when it goes off"}, bomb.time);
  v.place({.name = "position",
           .unit = "m",
           .range = between(-kFar, kFar),
           .meaning = "of the charge; two numbers put it on the ground at x, y; below the ground it is buried",
           .required = true},
          {.name = "above_ground",
           .meaning = "position's z is the height of burst above the ground there",
           .default_text = "`false`; `true` with two numbers"},
          bomb.position, bomb.above_ground);
  v.number({.name = "depth",
            .unit = "m",
            .range = between(0, kLong),
            .meaning = "of burial: the charge lies so far below `position`"},
           bomb.depth);
  v.number({.name = "yield",
            .unit = "t of TNT",
            .range = above(0, 1e8),
            .meaning = "of the charge, in metric tons",
            .required = true},
           bomb.yield);
}

void describe(Visitor& v, Scene& scene) {
  v.number({.name = "duration", .unit = "s", .range = above(0, kForever), .meaning = "simulated time"}, scene.duration);
  v.number({.name = "dt", .unit = "s", .range = above(0, 1), .meaning = "time step; at most `duration`"}, scene.dt);
  v.vector({.name = "gravity", .unit = "m/s^2", .range = between(-1000, 1000), .meaning = "z is up"}, scene.gravity);
  v.whole({.name = "seed", .range = {.low = 0}, .meaning = "of random numbers"}, scene.seed);
  v.table({.name = "terrain",
           .required = true,
           .example = "[terrain] with grid = { ... }, dem = \"file.tif\" or mesh = \"file.obj\""},
          [&] { describe_terrain(v, scene.terrain); });
  describe_materials(v, scene.materials);
  v.list({.name = "bodies"}, scene.bodies, [&](BodySettings& body) { describe(v, body); });
  v.list({.name = "joints"}, scene.joints, [&](Joint& joint) { describe(v, joint); });
  v.list({.name = "bombs"}, scene.bombs, [&](Bomb& bomb) { describe(v, bomb); });
  v.table({.name = "solver"}, [&] { describe_solver(v, scene.solver); });
  v.table({.name = "output"}, [&] { describe_output(v, scene.output); });
}

}  // namespace divot::scene
