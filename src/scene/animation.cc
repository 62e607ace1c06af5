#include "laterna/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "laterna/scene.h"
#include "scene/spelling.h"

namespace laterna {

glm::dmat4 to_matrix(const Transform& transform) {
  const double x = transform.rotation.x, y = transform.rotation.y, z = transform.rotation.z,
               w = transform.rotation.w;
  const glm::dvec3 right(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w));
  const glm::dvec3 up(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w));
  const glm::dvec3 backward(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y));
  const glm::dvec3 s = transform.scale;
  return {glm::dvec4(right * s.x, 0), glm::dvec4(up * s.y, 0), glm::dvec4(backward * s.z, 0),
          glm::dvec4(transform.translation, 1)};
}

double duration(const Clip& clip) {
  double last = 0;
  for (const KeyFrames& keys : clip.keys) {
    if (!keys.times.empty()) last = std::max(last, keys.times.back());
  }
  return last;
}

int component_count(AnimatedProperty property) {
  switch (property) {
    case AnimatedProperty::weights:
      return 0;
    case AnimatedProperty::look_at:
      return 9;
    case AnimatedProperty::rotation:
    case AnimatedProperty::base_color:
      return 4;
    case AnimatedProperty::translation:
    case AnimatedProperty::scale:
    case AnimatedProperty::light_color:
    case AnimatedProperty::emissive:
    case AnimatedProperty::specular_color:
    case AnimatedProperty::sheen_color:
    case AnimatedProperty::attenuation_color:
      return 3;
    case AnimatedProperty::texture_offset:
    case AnimatedProperty::texture_scale:
      return 2;
    default:
      return 1;
  }
}

Result<void> choose_clip(Scene& scene, const std::string& name) {
  std::vector<std::string_view> names;
  bool is_there = name == "all" || name == "none";
  for (const Clip& clip : scene.clips) {
    if (clip.is_path) continue;
    names.push_back(clip.name);
    is_there |= clip.name == name;
  }
  if (!is_there) {
    std::string list;
    for (const std::string_view known : names) list += (list.empty() ? "" : ", ") + in_quotes(known);
    return tl::unexpected(
        Error(Failure::bad_input,
              Diagnostic{{},
                         {},
                         fmt::format("the scene has no clip {}{}: it has {}", in_quotes(name),
                                     did_you_mean(name, names), list.empty() ? "none" : list)}));
  }
  for (Clip& clip : scene.clips) {
    if (!clip.is_path) clip.plays = name == "all" || clip.name == name;
  }
  return {};
}

}  // namespace laterna
