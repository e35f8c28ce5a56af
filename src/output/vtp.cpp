#include "output/vtp.h"

#include <fmt/format.h>

#include "output/packer.h"

namespace divot::output {
namespace {

// An array of the appended block: how XML names it, and where it starts. Each is led by its length as 64 bits.
class Arrays {
 public:
  std::string add(const char* type, const char* name, int components, std::size_t bytes) {
    const std::string text = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        name, components, offset_);
    offset_ += sizeof(std::uint64_t) + bytes;
    return text;
  }

 private:
  std::size_t offset_ = 0;
};

std::string header(const Frame& frame) {
  const std::size_t points = frame.positions.size(), corners = frame.triangles->size();
  Arrays arrays;
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
      "NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n</FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n",
      frame.time, points, corners / 3);
  text += "<Points>\n";
  text += arrays.add("Float64", "Points", 3, points * 24);
  text += "</Points>\n<Polys>\n";
  text += arrays.add("Int64", "connectivity", 1, corners * 8);
  text += arrays.add("Int64", "offsets", 1, corners / 3 * 8);
  text += "</Polys>\n<PointData Scalars=\"sinkage\" Vectors=\"velocity\">\n";
  text += arrays.add("Float32", "sinkage", 1, points * 4);
  text += arrays.add("UInt8", "material", 1, points);
  text += arrays.add("Float32", "velocity", 3, points * 12);
  text += arrays.add("UInt8", "awake", 1, points);
  text += arrays.add("Float32", "pressure", 1, points * 4);
  return text + "</PointData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
}

// [point] what the awake have, `still` elsewhere.
template <class T>
void put_awake(Packer& packer, const Frame& frame, std::span<const T> values, T still) {
  packer.put(static_cast<std::uint64_t>(frame.positions.size() * sizeof(T)));
  std::size_t i = 0;
  for (std::uint32_t v = 0; v < frame.positions.size(); ++v) {
    const bool awake = i < frame.awake.size() && frame.awake[i] == v;
    packer.put(awake ? values[i++] : still);
    packer.end_record();
  }
}

template <class T>
void put_all(Packer& packer, std::span<const T> values) {
  packer.put(static_cast<std::uint64_t>(values.size_bytes()));
  for (const T& value : values) packer.put(value), packer.end_record();
}

void put_mesh(Packer& packer, const Frame& frame) {
  const std::size_t faces = frame.triangles->size() / 3;
  packer.put(static_cast<std::uint64_t>(frame.positions.size() * sizeof(Vec3d)));
  for (const Vec3& p : frame.positions) packer.put(to_double(p) + frame.origin), packer.end_record();
  packer.put(static_cast<std::uint64_t>(faces * 3 * sizeof(std::int64_t)));
  for (const std::uint32_t v : *frame.triangles) packer.put(static_cast<std::int64_t>(v)), packer.end_record();
  packer.put(static_cast<std::uint64_t>(faces * sizeof(std::int64_t)));
  for (std::size_t f = 1; f <= faces; ++f) packer.put(static_cast<std::int64_t>(3 * f)), packer.end_record();
}

}  // namespace

Result<void> write_vtp(const std::string& path, const Frame& frame) {
  auto file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(header(frame));
  {
    Packer packer(*file);
    put_mesh(packer, frame);
    put_all<float>(packer, frame.sinkage);
    put_all<std::uint8_t>(packer, frame.materials);
    put_awake<Vec3>(packer, frame, frame.velocity, Vec3{});
    const std::vector<std::uint8_t> ones(frame.awake.size(), 1);
    put_awake<std::uint8_t>(packer, frame, ones, 0);
    put_awake<float>(packer, frame, frame.pressure, 0);
  }
  file->write("\n</AppendedData>\n</VTKFile>\n");
  return file->commit();
}

Result<void> write_pvd(const std::string& path, std::span<const SeriesEntry> frames) {
  auto file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n");
  for (const SeriesEntry& frame : frames)
    file->write(fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", frame.time, frame.file));
  file->write("</Collection>\n</VTKFile>\n");
  return file->commit();
}

}  // namespace divot::output
