#include "bake/bake_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>

#include "bake/light_map_layout.h"
#include "laterna/bake.h"
#include "laterna/material_lobes.h"
#include "laterna/mirrors.h"
#include "laterna/relief.h"
#include "scene/scene_pose.h"

namespace laterna::bake {
namespace {

constexpr std::size_t kNamesTold = 4;

// "a", "b" and 7 more.
class Names {
 public:
  void add(const std::string& name) {
    if (count_++ < kNamesTold) told_ += fmt::format("{}\"{}\"", told_.empty() ? "" : ", ", name);
  }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] std::string text() const {
    return count_ <= kNamesTold ? told_ : fmt::format("{} and {} more", told_, count_ - kNamesTold);
  }

 private:
  std::string told_;
  std::size_t count_ = 0;
};

bool is_of_light(const ClipChannel& channel) {
  switch (channel.property) {
    case AnimatedProperty::light_color:
    case AnimatedProperty::intensity:
    case AnimatedProperty::lumens:
    case AnimatedProperty::range:
    case AnimatedProperty::inner_cone:
    case AnimatedProperty::outer_cone:
      return true;
    default:
      return channel.of_light;
  }
}

// By light: whether it stands elsewhere or shines otherwise at another time.
std::vector<bool> moving_lights(const Scene& scene) {
  std::vector<bool> moves(scene.lights.size(), false);
  const std::vector<bool> nodes = moving_nodes(scene);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i] && scene.nodes[i].light >= 0) moves[static_cast<std::size_t>(scene.nodes[i].light)] = true;
  }
  for (const Clip& clip : scene.clips) {
    for (const ClipChannel& channel : clip.channels) {
      if (clip.plays && is_of_light(channel)) moves[static_cast<std::size_t>(channel.target)] = true;
    }
  }
  return moves;
}

// "1400" of 1391.
std::string text_of_two_digits(double number) {
  const double unit = std::pow(10.0, std::floor(std::log10(number)) - 1);
  return fmt::format("{:g}", std::round(number / unit) * unit);
}

}  // namespace

void note_what_is_lost(Scene& scene, const std::vector<bool>& is_baked, const BakeSettings& settings) {
  std::vector<Diagnostic> notes;
  const auto note = [&](std::string_view kind, const Names& names, std::string message) {
    if (!names.empty()) notes.push_back({{}, fmt::format("{} {}", kind, names.text()), std::move(message)});
  };
  Names moving, films, reliefs, glass, mirrors, metals, photographs;
  const std::vector<bool> moves = moving_lights(scene);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    if (!is_baked[i]) continue;
    if (moves[i]) moving.add(light.name);
    if (light.slide >= 0 && scene.pictures[static_cast<std::size_t>(light.slide)].film) films.add(light.name);
  }
  for (const Material& material : scene.materials) {
    if (material.relief != nullptr && material.relief->depth > 0) reliefs.add(material.name);
    if (material.mirror != nullptr) mirrors.add(material.name);
    if (material.lobes != nullptr && material.lobes->transmission.factor > 0) {
      glass.add(material.name);
    } else if (material.metallic >= 1 && !material.metallic_roughness_texture.is_set() && !material.unlit) {
      metals.add(material.name);
    }
  }
  if (settings.into == BakeInto::emissive) {
    for (const Photograph& photograph : scene.photographs) photographs.add(photograph.name);
  }
  note("photographs", photographs,
       "are painted on surfaces by where these are looked at from: what is baked is without them");
  note("lights", moving,
       fmt::format("move or change: baked as they are at {:g} s, and as still as that",
                   settings.options.time));
  note("lights", films, fmt::format("throw films: baked with the frame of {:g} s", settings.options.time));
  note("materials", reliefs,
       "have a relief: light maps hold what falls on the flat surface, without the shadows in the relief");
  note("materials", glass,
       "are glass, which shows what lies behind: they get no light map. Light that comes through them is "
       "baked, tinted but not bent");
  note("materials", mirrors,
       "are mirrors: they mirror the baked scene as before; light that they would throw on others is not "
       "baked");
  note(
      "materials", metals,
      "are all metal, which glTF's are unless they say otherwise: they reflect nothing diffusely, so that in "
      "the shading models phong and pbr nothing is seen of their light maps");
  std::ranges::move(notes, std::back_inserter(scene.warnings));
}

void note_small_scene(Scene& scene, double used, const frame::Bounds& bounds, double density) {
  constexpr double kLeastUsed = 0.05, kFine = 1024;  // luxels across
  const double across = glm::length(glm::dvec3(bounds.high) - glm::dvec3(bounds.low));
  if (!(across > 0)) return;
  const double finer = std::min(kFine / across, kMostLuxelDensity);
  if (used >= kLeastUsed || finer <= 2 * density) return;
  scene.warnings.push_back(
      {{},
       "density",
       fmt::format("the scene is {:.3g} m across, and luxels {:.3g} m: about {} in a metre would show how "
                   "light falls in it",
                   across, 1 / density, text_of_two_digits(finer))});
}

}  // namespace laterna::bake
