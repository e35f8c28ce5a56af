// The Python module: divot._divot. What scenes are made of comes as TOML text, so that keys, checks and messages are
// those of scene files; divot/__init__.py turns dicts into it.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <optional>

#include "divot/divot.h"
#include "divot/output.h"
#include "divot/version.h"

namespace py = pybind11;
using namespace divot;

namespace {

// divot.Error, made in Python, carries the list of Errors.
[[noreturn]] void raise(const Errors& errors) {
  const py::object type = py::module_::import("divot._error").attr("Error");
  PyErr_SetObject(type.ptr(), type(errors).ptr());
  throw py::error_already_set();
}

template <class T>
T value_of(Result<T> result) {
  if (!result) raise(result.error());
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

// Text that was made of a dict has lines that nobody wrote.
Errors without_lines(Errors errors) {
  for (Error& error : errors) error.file.clear(), error.line = 0;
  return errors;
}

// A read-only array over memory of `owner`, which it keeps alive.
template <class T>
py::array view(std::span<const T> values, py::handle owner) {
  py::array_t<T> array({values.size()}, {sizeof(T)}, values.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array view(std::span<const Vec3> values, py::handle owner) {
  static_assert(sizeof(Vec3) == 3 * sizeof(float));
  py::array_t<float> array({values.size(), std::size_t{3}}, {sizeof(Vec3), sizeof(float)},
                           values.empty() ? nullptr : &values.front().x, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::tuple tuple_of(const Vec3d& v) { return py::make_tuple(v.x, v.y, v.z); }

// What only memory can hold of a terrain: a function of x and y, or a mesh.
void set_height(Scene& scene, std::function<double(double, double)> height) {
  std::get<GridTerrain>(scene.terrain.shape).height = std::move(height);
}

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;

void set_mesh(Scene& scene, const Doubles& vertices, const Indices& triangles) {
  if (vertices.ndim() != 2 || vertices.shape(1) != 3 || triangles.ndim() != 2 || triangles.shape(1) != 3)
    raise({{.key = "terrain.mesh",
            .problem = "vertices and triangles are no lists of three",
            .expected = "expected arrays of shape (n, 3)"}});
  MeshTerrain mesh;
  const auto v = vertices.unchecked<2>();
  for (py::ssize_t i = 0; i < v.shape(0); ++i) mesh.vertices.push_back({v(i, 0), v(i, 1), v(i, 2)});
  mesh.triangles.assign(triangles.data(), triangles.data() + triangles.size());
  scene.terrain.shape = std::move(mesh);
}

py::object raster_of(const World& world, double spacing) {
  const std::optional<RasterView> raster = world.raster(spacing);
  if (!raster) return py::none();
  const std::vector<std::size_t> shape{raster->rows, raster->columns};
  const auto grid = [&](const std::vector<float>& values) {
    py::array_t<float> out(shape);
    for (std::size_t k = 0; k < values.size(); ++k) out.mutable_data()[k] = raster->holes[k] ? NAN : values[k];
    return out;
  };
  py::dict out;
  out["height"] = grid(raster->heights);
  out["change"] = grid(raster->change);
  out["sinkage"] = grid(raster->sinkage);
  // As GDAL counts: from the outer corner of the first pixel, the north-western one.
  out["transform"] =
      py::make_tuple(raster->x0 - raster->dx / 2, raster->dx, 0.0, raster->y0 + raster->dy / 2, 0.0, -raster->dy);
  out["extent"] = py::make_tuple(raster->x0 - raster->dx / 2, raster->x0 + raster->dx * (raster->columns - 0.5),
                                 raster->y0 - raster->dy * (raster->rows - 0.5), raster->y0 + raster->dy / 2);
  out["crs"] = raster->crs;
  out["file_crs"] = raster->file_crs;
  return out;
}

template <class T, class F>
py::array_t<T> of_each_vertex(const World& world, F value) {
  py::array_t<T> out(static_cast<py::ssize_t>(world.surface().positions.size()));
  T* const to = out.mutable_data();
  for (std::uint32_t v = 0; v < world.surface().positions.size(); ++v) to[v] = value(v);
  return out;
}

py::array_t<std::uint32_t> array_of(const std::vector<DirtyRange>& ranges) {
  py::array_t<std::uint32_t> out({ranges.size(), std::size_t{2}});
  auto to = out.mutable_unchecked<2>();
  for (py::ssize_t k = 0; k < to.shape(0); ++k) to(k, 0) = ranges[k].first, to(k, 1) = ranges[k].second;
  return out;
}

py::dict topology_of(World& world) {
  const Topology topology = world.take_topology();
  const auto ids = [](const std::vector<std::uint32_t>& list) {
    return py::array_t<std::uint32_t>(static_cast<py::ssize_t>(list.size()), list.data());
  };
  return py::dict(py::arg("triangles") = array_of(topology.triangles), py::arg("added") = ids(topology.added),
                  py::arg("removed") = ids(topology.removed));
}

py::dict refinement_of(const World& world) {
  const RefinementCounts r = world.refinement();
  return py::dict(py::arg("on") = r.on, py::arg("edge") = r.edge, py::arg("base_vertices") = r.base_vertices,
                  py::arg("vertices") = r.vertices, py::arg("most") = r.most, py::arg("budget") = r.budget,
                  py::arg("halved") = r.halved, py::arg("joined") = r.joined, py::arg("short_steps") = r.short_steps);
}

JointId joint_id(const World& world, std::uint32_t index) {
  if (index >= world.joints().size()) throw py::index_error("no joint " + std::to_string(index));
  return {index};
}

StepReport step(World& world, std::uint64_t count) {
  StepReport sum{.substeps = 0};
  for (std::uint64_t k = 0; k < count; ++k) {
    const StepReport one = world.step();
    sum.substeps += one.substeps;
    sum.substeps_limited |= one.substeps_limited;
    sum.refinement_limited |= one.refinement_limited;
    sum.not_finite |= one.not_finite;
  }
  return sum;
}

void bind_results(py::module_& m) {
  py::class_<StepReport>(m, "StepReport")
      .def_readonly("substeps", &StepReport::substeps)
      .def_readonly("substeps_limited", &StepReport::substeps_limited)
      .def_readonly("refinement_limited", &StepReport::refinement_limited)
      .def_readonly("not_finite", &StepReport::not_finite);
  py::class_<Crater>(m, "Crater")
      .def_property_readonly("position", [](const Crater& c) { return tuple_of(c.position); })
      .def_readonly("yield_t", &Crater::yield)
      .def_readonly("width", &Crater::width)
      .def_readonly("depth", &Crater::depth)
      .def_readonly("lip_height", &Crater::lip_height)
      .def_readonly("volume", &Crater::volume)
      .def_readonly("paper_width", &Crater::paper_width);
  py::class_<SoilVolume>(m, "SoilVolume")
      .def_readonly("displaced", &SoilVolume::displaced)
      .def_readonly("compacted", &SoilVolume::compacted)
      .def_readonly("deposited", &SoilVolume::deposited)
      .def_property_readonly("relative_error", &SoilVolume::relative_error);
  py::class_<Energy>(m, "Energy")
      .def_readonly("bodies_kinetic", &Energy::bodies_kinetic)
      .def_readonly("bodies_potential", &Energy::bodies_potential)
      .def_readonly("ground_kinetic", &Energy::ground_kinetic);
  py::class_<BodyView>(m, "Body")
      .def_readonly("name", &BodyView::name)
      .def_readonly("radius", &BodyView::radius)
      .def_readonly("mass", &BodyView::mass)
      .def_property_readonly("position", [](const BodyView& b) { return tuple_of(b.position); })
      .def_property_readonly("velocity", [](const BodyView& b) { return tuple_of(b.velocity); })
      .def_property_readonly("angular_velocity", [](const BodyView& b) { return tuple_of(b.angular_velocity); })
      .def_property_readonly("orientation",
                             [](const BodyView& b) {
                               return py::make_tuple(b.orientation.x, b.orientation.y, b.orientation.z,
                                                     b.orientation.w);
                             })
      .def_readonly("sinkage", &BodyView::sinkage)
      .def_readonly("max_sinkage", &BodyView::max_sinkage)
      .def_readonly("touching", &BodyView::touching)
      .def_readonly("off_terrain", &BodyView::off_terrain);
  py::class_<JointView>(m, "Joint")
      .def_readonly("name", &JointView::name)
      .def_readonly("position", &JointView::position)
      .def_readonly("speed", &JointView::speed)
      .def_readonly("motor_force", &JointView::motor_force);
}

// Arrays of the particles that are awake, by name. Each views the world's memory until its next step.
py::dict particles_of(py::object self) {
  const ParticleView p = self.cast<const World&>().particles();
  py::dict out;
  out["vertices"] = view(p.vertices, self);
  for (const auto& [name, values] :
       {std::pair{"x", p.x}, {"y", p.y}, {"z", p.z}, {"vx", p.vx}, {"vy", p.vy}, {"vz", p.vz}, {"mass", p.mass}})
    out[name] = view(values, self);
  out["hold"] = view(std::span(reinterpret_cast<const std::uint8_t*>(p.hold.data()), p.hold.size()), self);
  return out;
}

void bind_world(py::module_& m) {
  py::class_<World>(m, "World")
      .def(py::init([](const Scene& scene, int threads, const std::optional<py::bytes>& state) {
             auto jobs = std::make_shared<const Jobs>(threads);
             return value_of(state ? World::restore(std::string(*state), scene, jobs) : World::create(scene, jobs));
           }),
           py::arg("scene"), py::arg("threads") = 1, py::arg("state") = py::none())
      .def("save", [](const World& w) { return py::bytes(w.save()); })
      .def("step", &step, py::arg("count") = 1, py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("time", &World::time)
      .def_property_readonly("steps", &World::steps)
      .def_property_readonly("dt", [](const World& w) { return w.scene().dt; })
      .def_property_readonly("duration", [](const World& w) { return w.scene().duration; })
      .def_property_readonly("name", [](const World& w) { return w.scene().name; })
      .def_property_readonly("origin", [](const World& w) { return tuple_of(w.surface().origin); })
      .def_property_readonly("spacing", [](const World& w) { return w.surface().spacing; })
      .def_property_readonly("positions",
                             [](py::object self) { return view(self.cast<const World&>().surface().positions, self); })
      .def_property_readonly("triangles",
                             [](py::object self) {
                               return view(self.cast<const World&>().surface().triangles, self).attr("reshape")(-1, 3);
                             })
      .def_property_readonly("materials",
                             [](py::object self) { return view(self.cast<const World&>().surface().materials, self); })
      .def_property_readonly("material_names",
                             [](const World& w) {
                               std::vector<std::string> names;
                               for (const Material& material : w.materials()) names.push_back(material.name);
                               return names;
                             })
      .def_property_readonly("particles", &particles_of)
      .def_property_readonly("bodies", &World::bodies)
      .def_property_readonly("joints", &World::joints)
      .def_property_readonly("craters", &World::craters)
      .def_property_readonly("soil_volume", &World::soil_volume)
      .def_property_readonly("energy", &World::energy)
      .def_property_readonly("stages",
                             [](const World& w) {
                               py::dict out;
                               for (const StageTime& s : w.stages())
                                 out[s.name] = py::dict(py::arg("ms") = s.ms, py::arg("calls") = s.calls);
                               return out;
                             })
      .def_property_readonly("refinement", &refinement_of)
      .def_property_readonly("state_hash", &World::state_hash)
      .def("sinkage",
           [](const World& w) { return of_each_vertex<float>(w, [&](std::uint32_t v) { return w.sinkage(v); }); })
      .def("pressure",
           [](const World& w) { return of_each_vertex<float>(w, [&](std::uint32_t v) { return w.pressure(v); }); })
      .def("ground_height", py::vectorize([](const World* w, double x, double y) { return w->ground_height(x, y); }),
           py::arg("x"), py::arg("y"))
      .def("raster", &raster_of, py::arg("spacing") = 0.0)
      .def("take_dirty", [](World& w) { return array_of(w.take_dirty()); })
      .def("take_topology", &topology_of)
      .def(
          "set_motor",
          [](World& w, std::uint32_t joint, double speed, double force) {
            w.set_motor(joint_id(w, joint), speed, force);
          },
          py::arg("joint"), py::arg("speed"), py::arg("force"))
      .def(
          "set_steering",
          [](World& w, std::uint32_t joint, double angle_deg) { w.set_steering(joint_id(w, joint), angle_deg); },
          py::arg("joint"), py::arg("angle_deg"))
      .def("_spawn",
           [](World& w, const Scene& alone) {
             std::vector<std::uint32_t> ids;
             for (const BodySettings& body : alone.bodies) ids.push_back(value_of(w.spawn(body)).value);
             return ids;
           })
      .def("_add_bombs", [](World& w, const Scene& alone) {
        for (const Bomb& bomb : alone.bombs) value_of(w.add_bomb(bomb));
      });
}

void bind_files(py::module_& m) {
  py::class_<Recorder>(m, "Recorder")
      .def(py::init([](const std::string& folder) { return value_of(Recorder::create(folder)); }), py::arg("folder"))
      .def("add_bodies", &Recorder::add_bodies, py::arg("world"))
      .def(
          "write_frame", [](Recorder& r, const World& world) { value_of(r.write_frame(world)); }, py::arg("world"))
      .def(
          "finish",
          [](Recorder& r, const World& world, double wall_s) { value_of(r.finish(world, {.wall_s = wall_s})); },
          py::arg("world"), py::arg("wall_s") = 0.0);
  py::class_<Report>(m, "Report")
      .def(py::init<std::string>(), py::arg("scene_text") = "")
      .def("add", &Report::add, py::arg("world"))
      .def(
          "write",
          [](Report& r, const std::string& path, const World& world, double wall_s) {
            value_of(r.write(path, world, {.wall_s = wall_s}));
          },
          py::arg("path"), py::arg("world"), py::arg("wall_s") = 0.0);
}

}  // namespace

PYBIND11_MODULE(_divot, m) {
  m.attr("__version__") = version();
  py::class_<Error>(m, "Problem")
      .def_readonly("file", &Error::file)
      .def_readonly("line", &Error::line)
      .def_readonly("key", &Error::key)
      .def_readonly("problem", &Error::problem)
      .def_readonly("expected", &Error::expected)
      .def("__str__", &Error::text);
  py::class_<Scene>(m, "Scene")
      .def_readwrite("name", &Scene::name)
      .def_readonly("duration", &Scene::duration)
      .def_readonly("dt", &Scene::dt)
      .def("_set_height", &set_height)
      .def("_set_mesh", &set_mesh);
  m.def("_load_scene", [](const std::string& path, const std::vector<std::pair<std::string, std::string>>& changes) {
    std::vector<Override> overrides;
    for (const auto& [key, value] : changes) overrides.push_back({key, value});
    return value_of(load_scene(path, overrides));
  });
  m.def("_parse_scene", [](const std::string& text, const std::string& folder) {
    auto scene = parse_scene(text, folder + "/scene");
    if (!scene) raise(without_lines(scene.error()));
    return *scene;
  });
  m.def(
      "check", [](const Scene& scene) { return check(scene); }, py::arg("scene"));
  bind_results(m);
  bind_world(m);
  bind_files(m);
}
