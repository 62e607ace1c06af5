#include "unserved_lights.h"

#include <fmt/format.h>

#include <cstdio>

#include "laterna/technique_choice.h"
#include "technique_names.h"

namespace laterna::app {
namespace {

bool is_unserved(const Light& light, ShadowTechnique technique) {
  return light.enabled && !light.shadow.technique && !find_fault(technique, light).empty();
}

}  // namespace

std::vector<std::string> unserved_lights(const Scene& scene, ShadowTechnique technique) {
  std::vector<std::string> names;
  for (const Light& light : scene.lights) {
    if (is_unserved(light, technique)) names.push_back(light.name);
  }
  return names;
}

void tell_unserved_lights(const Scene& scene, ShadowTechnique technique) {
  for (const Light& light : scene.lights) {
    if (!is_unserved(light, technique)) continue;
    fmt::print(stderr, "laterna: note: light \"{}\" keeps shadow technique \"{}\": {}\n", light.name,
               name_of(technique_for(light, technique)), find_fault(technique, light));
  }
}

}  // namespace laterna::app
