#include "scene/photograph_check.h"

#include <fmt/format.h>

#include "scene/scene_check.h"

namespace laterna {
namespace {

// Of a photograph: beyond, it is no exposure.
constexpr float kMostGain = 1e6F;

class PhotographCheck : SceneCheck {
 public:
  PhotographCheck(const Scene& scene, FaultList& faults) : SceneCheck(scene, faults) {}

  void run() {
    check_cameras();
    check_photographs();
  }

 private:
  void check_cameras();
  void check_photographs();
  void check_photograph(const Photograph& photograph, const std::string& place);
};

void PhotographCheck::check_cameras() {
  check_names(scene_.cameras, "cameras");
  for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
    if (std::string message = find_fault(scene_.cameras[i].projection); !message.empty()) {
      fault(item("cameras", i) + ".projection", std::move(message));
    }
  }
}

void PhotographCheck::check_photographs() {
  check_names(scene_.photographs, "photographs");
  for (std::size_t i = 0; i < scene_.photographs.size(); ++i)
    check_photograph(scene_.photographs[i], item("photographs", i));
  const PhotographSettings& settings = scene_.photograph_settings;
  const std::string place = "photograph_settings";
  if (settings.visibility != ShadowTechnique::exact && settings.visibility != ShadowTechnique::map &&
      settings.visibility != ShadowTechnique::raytraced) {
    fault(place + ".visibility", "expected exact, map or raytraced");
  }
  check_enumerator(place + ".blend", settings.blend, PhotographBlend::view);
  check_number(place + ".feather", settings.feather, 0, 0.5);
  check_color(place + ".unseen", settings.unseen, kMaxRadiance);
}

void PhotographCheck::check_photograph(const Photograph& photograph, const std::string& place) {
  if (photograph.picture < 0 || static_cast<std::size_t>(photograph.picture) >= scene_.pictures.size()) {
    fault(place + ".picture",
          fmt::format("{} is no index into the {} pictures", photograph.picture, scene_.pictures.size()));
  } else if (scene_.pictures[static_cast<std::size_t>(photograph.picture)].film) {
    fault(place + ".picture", "is a film: only slides may change with time");
  }
  if (std::string message = find_fault(photograph.projection); !message.empty()) {
    fault(place + ".projection", std::move(message));
  } else if (photograph.projection.is_orthographic) {
    fault(place + ".projection", "a photograph's projection must be perspective");
  }
  if (std::string message = find_fault(photograph.pose); !message.empty())
    fault(place + ".pose", std::move(message));
  for (int i = 0; i < 3; ++i) {
    const float gain = photograph.gain[i];
    if (gain > 0 && gain <= kMostGain) continue;
    fault(item(place + ".gain", static_cast<std::size_t>(i)),
          fmt::format("expected a number above 0 and up to {}, got {}", kMostGain, gain));
  }
}

}  // namespace

void check_cameras(const Scene& scene, FaultList& faults) { PhotographCheck(scene, faults).run(); }

}  // namespace laterna
