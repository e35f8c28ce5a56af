// Any bytes as a mesh file of the format DIVOT_FUZZ_READ reads: triangles of vertices that are there, or a reason.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "meshfile/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto mesh = divot::meshfile::DIVOT_FUZZ_READ("fuzz", {reinterpret_cast<const char*>(data), size});
  if (!mesh) return mesh.error().front().problem.empty() ? std::abort(), 0 : 0;
  for (const std::uint32_t v : mesh->triangles)
    if (v >= mesh->vertices.size()) std::abort();
  return 0;
}
