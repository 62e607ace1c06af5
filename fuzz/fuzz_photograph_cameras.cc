// Any text as a file of cameras: read or refused with a reason, and what was read stands upright.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "scene/opencv_yaml.h"
#include "scene/photograph_cameras.h"

namespace {

void check(const std::vector<laterna::PhotographCamera>& cameras, const laterna::FaultList& faults) {
  if (cameras.empty() && !faults.has_errors()) std::abort();
  for (const laterna::PhotographCamera& camera : cameras) {
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 axis = camera.pose.world_from_view_rotation[i];
      if (!(std::abs(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z - 1) < 1e-6)) std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  laterna::FaultList faults("input"), more("input");
  switch (data[0] % 4) {
    case 0:
      check(laterna::read_cam_file(text, "photo", faults), faults);
      break;
    case 1:
      check(laterna::read_opencv_cameras(text, "photo", faults), faults);
      break;
    case 2:
      if (const auto json = laterna::json_from_opencv_yaml(text, faults)) {
        check(laterna::read_opencv_cameras(*json, "photo", faults), faults);
      } else if (!faults.has_errors()) {
        std::abort();
      }
      break;
    default: {
      const auto cameras = laterna::read_colmap_cameras("1 PINHOLE 64 48 50 50 32 24\n", text, faults, more);
      if (cameras.empty() && !more.has_errors()) std::abort();
      laterna::read_colmap_cameras(text, "1 1 0 0 0 0 0 0 1 a.png\n", faults, more);
    }
  }
  return 0;
}
