#include "scene/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace divot::scene {
namespace {

using Points = std::vector<Vec3d>;

tl::unexpected<Errors> wrong(const std::string& path, std::string problem, std::string expected) {
  return fail({path, 0, {}, std::move(problem), std::move(expected)});
}

// Lines `keyword x y z`.
Points points_of_lines(const std::string& text, const std::string& keyword) {
  Points points;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    Vec3d p;
    if (words >> word && word == keyword && words >> p.x >> p.y >> p.z) points.push_back(p);
  }
  return points;
}

template <class Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// 80 bytes of header, a count, then for each triangle a normal, three corners and two bytes.
Result<Points> binary_stl(const std::string& path, const std::string& bytes) {
  constexpr std::size_t kHeader = 84, kTriangle = 50;
  const std::size_t count = bytes.size() < kHeader ? 0 : number_at<std::uint32_t>(bytes, 80);
  if (bytes.size() < kHeader || (bytes.size() - kHeader) / kTriangle < count)
    return wrong(path, "is cut short", "expected a whole STL file");
  Points points;
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = kHeader + kTriangle * t + 12 + 12 * k;
      points.push_back({number_at<float>(bytes, at), number_at<float>(bytes, at + 4), number_at<float>(bytes, at + 8)});
    }
  return points;
}

struct PlyProperty {
  std::string name, type;
  std::size_t size() const {
    if (type == "double" || type == "float64") return 8;
    if (type == "float" || type == "float32" || type == "int" || type == "uint" || type == "int32" || type == "uint32")
      return 4;
    return type == "short" || type == "ushort" || type == "int16" || type == "uint16" ? 2 : 1;
  }
};

// The vertex element must come first, as it does in every file that is written.
Result<Points> ply(const std::string& path, const std::string& bytes) {
  const std::size_t end = bytes.find("end_header");
  if (end == std::string::npos) return wrong(path, "has no end_header", "expected a PLY file");
  const std::size_t body = bytes.find('\n', end) + 1;
  std::istringstream header(bytes.substr(0, end));
  std::string line, format, element;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
  bool first = true;
  while (std::getline(header, line)) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "format") words >> format;
    if (word == "element") {
      if (!element.empty()) first = false;
      words >> element;
      if (first && element == "vertex") words >> count;
    }
    if (word == "property" && first) {
      PlyProperty property;
      words >> property.type >> property.name;
      properties.push_back(property);
    }
  }
  std::size_t stride = 0, at[3] = {0, 0, 0}, place[3] = {0, 0, 0};
  int found = 0;
  for (std::size_t k = 0; k < properties.size(); ++k) {
    for (int axis = 0; axis < 3; ++axis)
      if (properties[k].name == std::string(1, static_cast<char>('x' + axis)))
        at[axis] = stride, place[axis] = k, ++found;
    stride += properties[k].size();
  }
  if (found != 3 || count == 0) return wrong(path, "has no vertices with x, y, z first", "expected a PLY mesh");

  Points points;
  if (format == "ascii") {
    std::istringstream in(bytes.substr(body));
    for (std::size_t v = 0; v < count; ++v) {
      std::vector<double> values(properties.size());
      for (double& value : values) in >> value;
      if (!in) return wrong(path, "is cut short", "expected a whole PLY file");
      points.push_back({values[place[0]], values[place[1]], values[place[2]]});
    }
    return points;
  }
  if (format != "binary_little_endian" || std::endian::native != std::endian::little)
    return wrong(path, fmt::format("is in format {}", format), "expected ascii or binary_little_endian");
  if ((bytes.size() - body) / stride < count) return wrong(path, "is cut short", "expected a whole PLY file");
  for (std::size_t v = 0; v < count; ++v) {
    double value[3];
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t offset = body + v * stride + at[axis];
      value[axis] = properties[place[axis]].size() == 8 ? number_at<double>(bytes, offset)
                                                        : static_cast<double>(number_at<float>(bytes, offset));
    }
    points.push_back({value[0], value[1], value[2]});
  }
  return points;
}

Result<Points> points_of(const std::string& path, const std::string& bytes) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (ending == ".obj") return points_of_lines(bytes, "v");
  if (ending == ".ply") return ply(path, bytes);
  if (ending != ".stl") return wrong(path, fmt::format("ends in \"{}\"", ending), "expected .obj, .stl or .ply");
  // Some binary files begin with "solid" too, but they hold no facets in words.
  const bool text = bytes.rfind("solid", 0) == 0 && bytes.find("vertex") != std::string::npos;
  return text ? points_of_lines(bytes, "vertex") : binary_stl(path, bytes);
}

}  // namespace

Result<std::vector<Vec3d>> read_mesh_points(const std::string& path) {
  std::error_code ignored;
  errno = std::filesystem::is_directory(path, ignored) ? EISDIR : 0;
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (errno == 0 && in && in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  if (errno != 0 || !in.is_open() || in.bad())
    return wrong(path, fmt::format("cannot be read: {}", std::strerror(errno)), "expected an OBJ, STL or PLY file");
  auto points = points_of(path, text.str());
  if (!points) return points;
  if (std::any_of(points->begin(), points->end(), [](const Vec3d& p) { return !is_finite(p) || length(p) > 1e6; }))
    return wrong(path, "holds coordinates that are no places", "expected numbers up to 1e6");
  if (points->size() < 4) return wrong(path, fmt::format("holds {} vertices", points->size()), "expected at least 4");
  return points;
}

}  // namespace divot::scene
