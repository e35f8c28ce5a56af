#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>

#include "meshfile/mesh_file.h"
#include "meshfile/text.h"

namespace divot::meshfile {
namespace {

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };
constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
struct TypeName {
  const char *old_name, *new_name;
};
constexpr TypeName kTypeNames[] = {{"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
                                   {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};

std::optional<Type> type_of(std::string_view name) {
  for (std::size_t k = 0; k < std::size(kTypeNames); ++k)
    if (name == kTypeNames[k].old_name || name == kTypeNames[k].new_name) return static_cast<Type>(k);
  return std::nullopt;
}

struct Property {
  std::string name;
  Type type{};
  std::optional<Type> count;  // of a list: the type of its length
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  bool text = false, swapped = false;
  std::vector<Element> elements;
};

Result<Header> read_header(const std::string& path, Lines& lines) {
  const auto wrong = [&](std::string problem, std::string expected) {
    return refuse(path, lines.number(), std::move(problem), std::move(expected));
  };
  Header header;
  if (!lines.next() || lines.word() != "ply") return wrong("does not begin with \"ply\"", "expected a PLY file");
  while (lines.next()) {
    const std::string_view kind = lines.word();
    if (kind == "end_header") return header;
    if (kind == "format") {
      const std::string_view format = lines.word();
      header.text = format == "ascii";
      const bool big = format == "binary_big_endian";
      if (!header.text && !big && format != "binary_little_endian")
        return wrong(fmt::format("the format is \"{}\"", format),
                     "expected ascii, binary_little_endian or binary_big_endian");
      header.swapped = big != (std::endian::native == std::endian::big);
    } else if (kind == "element") {
      Element element{std::string(lines.word()), 0, {}};
      if (!parse(lines.word(), element.count)) return wrong("an element has no count", "expected element NAME COUNT");
      header.elements.push_back(std::move(element));
    } else if (kind == "property") {
      Property property;
      std::string_view word = lines.word();
      if (word == "list") {
        property.count = type_of(lines.word());
        if (!property.count || *property.count >= Type::f32)
          return wrong("a list has no type of its length", "expected property list uchar int NAME");
        word = lines.word();
      }
      const std::optional<Type> type = type_of(word);
      property.name = lines.word();
      if (!type || property.name.empty() || header.elements.empty())
        return wrong("a property has no type, name or element", "expected property TYPE NAME below an element");
      property.type = *type;
      header.elements.back().properties.push_back(std::move(property));
    }
  }
  return wrong("has no end_header", "expected a whole PLY file");
}

// Takes values off the body, as text or as bytes; each as a double, which holds every type.
class Body {
 public:
  Body(const Header& header, Lines lines) : text_(header.text), swapped_(header.swapped), lines_(lines) {
    bytes_ = lines.rest();
  }
  /// A new record: a line of text.
  bool begin() { return !text_ || next_line(); }
  bool take(Type type, double& value) {
    if (text_) return parse(lines_.word(), value);
    std::array<char, 8> raw{};
    const std::size_t size = kSizes[static_cast<std::size_t>(type)];
    if (bytes_.size() < size) return false;
    std::copy_n(bytes_.begin(), size, raw.begin());
    if (swapped_) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
    bytes_.remove_prefix(size);
    value = number(type, raw.data());
    return true;
  }
  /// Records that what is left can hold at most: for sizes that a header claims.
  std::size_t left() const { return text_ ? lines_.left() : bytes_.size(); }
  int line() const { return text_ ? lines_.number() : 0; }

 private:
  template <class T>
  static double as(const char* raw) {
    T value;
    std::memcpy(&value, raw, sizeof value);
    return static_cast<double>(value);
  }
  static double number(Type type, const char* raw) {
    switch (type) {
      case Type::i8:
        return as<std::int8_t>(raw);
      case Type::u8:
        return as<std::uint8_t>(raw);
      case Type::i16:
        return as<std::int16_t>(raw);
      case Type::u16:
        return as<std::uint16_t>(raw);
      case Type::i32:
        return as<std::int32_t>(raw);
      case Type::u32:
        return as<std::uint32_t>(raw);
      case Type::f32:
        return as<float>(raw);
      case Type::f64:
        return as<double>(raw);
    }
    return 0;
  }
  bool next_line() { return lines_.next(); }

  bool text_, swapped_;
  Lines lines_;
  std::string_view bytes_;
};

// Adds what one record holds of the mesh. False where the file ends or a value is no number.
bool read_record(const Element& element, Body& body, TriangleMesh& mesh, std::vector<double>& list) {
  const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
  Vec3d p;
  if (!body.begin()) return false;
  for (const Property& property : element.properties) {
    double length = 1;
    if (property.count && !body.take(*property.count, length)) return false;
    if (!(length >= 0) || length > static_cast<double>(body.left()) + 1) return false;
    list.resize(static_cast<std::size_t>(length));
    for (double& value : list)
      if (!body.take(property.type, value)) return false;
    if (is_vertex && !property.count) {
      if (property.name == "x") p.x = list[0];
      if (property.name == "y") p.y = list[0];
      if (property.name == "z") p.z = list[0];
    }
    if (!is_face || !property.count || (property.name != "vertex_indices" && property.name != "vertex_index")) continue;
    for (const double index : list)
      if (!(index >= 0 && index < static_cast<double>(mesh.vertices.size()))) return false;
    for (std::size_t k = 2; k < list.size(); ++k)
      for (const std::size_t corner : {std::size_t{0}, k - 1, k})
        mesh.triangles.push_back(static_cast<std::uint32_t>(list[corner]));
  }
  if (is_vertex) mesh.vertices.push_back(p);
  return true;
}

}  // namespace

Result<TriangleMesh> read_ply(const std::string& path, std::string_view bytes) {
  Lines lines(bytes);
  const auto header = read_header(path, lines);
  if (!header) return tl::unexpected(header.error());
  TriangleMesh mesh;
  Body body(*header, lines);
  std::vector<double> list;
  for (const Element& element : header->elements) {
    // Elements without properties take no byte: any number of them would be claimed for free.
    if (element.properties.empty()) continue;
    for (std::uint64_t k = 0; k < element.count; ++k)
      if (!read_record(element, body, mesh, list))
        return refuse(path, body.line(),
                      fmt::format("{} {} of {} is cut short or wrong", element.name, k, element.count),
                      "expected its numbers, and faces of vertices above them");
  }
  if (mesh.vertices.empty()) return refuse(path, 0, "has no vertices", "expected element vertex with x, y, z");
  return mesh;
}

}  // namespace divot::meshfile
