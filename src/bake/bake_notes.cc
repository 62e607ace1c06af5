#include "bake/bake_notes.h"

#include <fmt/format.h>

#include "laterna/relief.h"

namespace laterna::bake {

void warn_of_what_is_not_baked(Scene& scene) {
  const auto warn = [&scene](const Material& material, const char* message) {
    scene.warnings.push_back({{}, fmt::format("material \"{}\"", material.name), message});
  };
  for (const Material& material : scene.materials) {
    if (material.unlit) continue;
    if (material.metallic == 1 && !material.metallic_roughness_texture.is_set())
      warn(material,
           "is metal, which scatters no light: only the model papers shows its light map");
    if (material.relief != nullptr && material.relief->depth > 0)
      warn(material, "its relief is not baked: the light is that of the flat surface");
  }
}

}  // namespace laterna::bake
