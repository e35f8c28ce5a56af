#include <embree3/rtcore.h>

#include <cstring>

#include "bench/peers.h"
#include "bench/peers_surface.h"

namespace divot::bench {

void compare_embree(const SurfaceTask& task, std::vector<PeerTime>& times) {
  RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  RTCScene scene = rtcNewScene(device);
  // Only scenes of low quality keep a hierarchy for each geometry and refit it; others build all of it anew.
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
  const std::size_t faces = task.triangles.size() / 3, vertices = task.before.size();
  void* const positions =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), vertices);
  void* const indices =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), faces);
  std::memcpy(positions, task.before.data(), vertices * sizeof(Vec3));
  std::memcpy(indices, task.triangles.data(), 3 * faces * sizeof(std::uint32_t));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcCommitScene(scene);

  bool there = false;
  const double whole = cpu_ns([&] {
    there = !there;
    std::memcpy(positions, (there ? task.after : task.before).data(), vertices * sizeof(Vec3));
    rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(geometry);
    rtcCommitScene(scene);
  });
  times.push_back({"refit", "Embree, whole", whole / static_cast<double>(faces), faces, "triangles", {}});

  std::size_t found = 0;
  const RTCPointQueryFunction count = [](RTCPointQueryFunctionArguments* arguments) {
    ++*static_cast<std::size_t*>(arguments->userPtr);
    return false;
  };
  const double asked = cpu_ns([&] {
    for (const Vec3& ball : task.balls) {
      RTCPointQuery query{ball.x, ball.y, ball.z, 0, task.radius};
      RTCPointQueryContext context;
      rtcInitPointQueryContext(&context);
      rtcPointQuery(scene, &query, &context, count, &found);
    }
  });
  times.push_back(
      {"ball queries", "Embree", asked / static_cast<double>(task.balls.size()), task.balls.size(), "balls", {}});
  rtcReleaseGeometry(geometry);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}

}  // namespace divot::bench
