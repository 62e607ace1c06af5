// The rules that every scene must meet before it is rendered, whether it was read or built in code.
#include "laterna/scene.h"
#include "scene/animation_check.h"
#include "scene/environment_check.h"
#include "scene/fault_list.h"
#include "scene/light_check.h"
#include "scene/material_check.h"
#include "scene/mesh_check.h"
#include "scene/node_check.h"
#include "scene/photograph_check.h"

namespace laterna {

std::vector<Diagnostic> validate(const Scene& scene) {
  FaultList faults{std::string()};
  check_materials(scene, faults);
  check_meshes(scene, faults);
  check_cameras(scene, faults);
  check_lights(scene, faults);
  check_surroundings(scene, faults);
  check_animation(scene, faults);
  check_nodes(scene, faults);
  return faults.errors();
}

}  // namespace laterna
