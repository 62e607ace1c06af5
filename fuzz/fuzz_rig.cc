// Any text as a rig: read or refused, and what was read passes the validator, also once its layers lie on a sheet.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/rig_reader.h"

namespace {

// On a mesh named "m" of material "m" at a node named "n".
void lay(const laterna::Rig& rig) {
  laterna::Scene scene = rig.scene;
  laterna::Mesh mesh;
  mesh.name = "m";
  laterna::Primitive& sheet = mesh.primitives.emplace_back();
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheet.uv[0] = {{0, 0}, {1, 0}, {0, 1}};
  sheet.material = static_cast<int>(scene.materials.size());
  scene.materials.emplace_back().name = "m";
  laterna::Node& node = scene.nodes.emplace_back();
  node.name = "n";
  node.mesh = static_cast<int>(scene.meshes.size());
  scene.meshes.push_back(std::move(mesh));
  std::vector<laterna::Diagnostic> faults;
  for (const laterna::SurfaceOverride& change : rig.surfaces) apply(change, scene, faults);
  if (faults.empty() && !laterna::validate(scene).empty()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto rig = laterna::read_rig(text, "input", "/nonexistent/folder");
  if (!rig) {
    if (rig.error().diagnostics.empty()) std::abort();  // every refusal says why
    return 0;
  }
  if (!laterna::validate(rig->scene).empty()) std::abort();  // a rig's own checks are at least as strict
  lay(*rig);
  return 0;
}
