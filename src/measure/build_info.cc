#include "laterna/build_info.h"

#include <OpenEXR/OpenEXRConfig.h>
#include <assimp/version.h>
#include <draco/core/draco_version.h>
#include <embree3/rtcore_config.h>
#include <fmt/core.h>
#include <hwy/highway.h>
#include <isa-l.h>
#include <libdeflate.h>
#include <meshoptimizer.h>
#include <png.h>
#include <tbb/version.h>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace laterna {

std::string version() { return LATERNA_VERSION; }

std::vector<Component> components() {
  return {
      {"Highway", fmt::format("{}.{}.{}", HWY_MAJOR, HWY_MINOR, HWY_PATCH)},
      {"oneTBB", TBB_VERSION_STRING},
      {"GLM", fmt::format("{}.{}.{}.{}", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH,
                          GLM_VERSION_REVISION)},
      {"Embree", RTC_VERSION_STRING},
      {"Assimp", fmt::format("{}.{}.{}", aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch())},
      {"Draco", draco::kDracoVersion},
      {"meshoptimizer",
       fmt::format("{}.{}", MESHOPTIMIZER_VERSION / 1000, MESHOPTIMIZER_VERSION % 1000 / 10)},
      {"libpng", PNG_LIBPNG_VER_STRING},
      {"libdeflate", LIBDEFLATE_VERSION_STRING},
      {"ISA-L", fmt::format("{}.{}.{}", ISAL_MAJOR_VERSION, ISAL_MINOR_VERSION, ISAL_PATCH_VERSION)},
      {"OpenEXR", OPENEXR_VERSION_STRING},
      {"JSON for Modern C++", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                                          NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
  };
}

}  // namespace laterna
