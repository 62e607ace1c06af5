// Lights of a glTF file in the making: KHR_lights_punctual, EXT_lights_ies, and what they leave unsaid in LATERNA_projector and
// LATERNA_lighting.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "laterna/lamps.h"
#include "laterna/scene.h"
#include "scene/gltf_document.h"
#include "scene/gltf_picture_writer.h"

namespace laterna::gltf {

class LightWriter {
 public:
  LightWriter(const Scene& scene, PictureWriter& pictures, Surroundings& surroundings, Document& document)
      : scene_(scene), pictures_(pictures), surroundings_(surroundings), document_(document) {}

  /// Every light that is no measured lamp, in the scene's order.
  Result<void> write();
  /// Hangs the light on the node that shows it.
  Result<void> hang(int light, const std::string& node_name, Json& node);

  /// Of each light, in the list of KHR_lights_punctual; −1: a measured lamp, which hangs on its node.
  [[nodiscard]] const std::vector<int>& indices() const { return index_of_; }

 private:
  // What programs see that know nothing of our extensions.
  struct Plain {
    Light light;
    Json json;
  };

  [[nodiscard]] Plain plain(const Light& light) const;
  [[nodiscard]] double candela_of(const Light& light) const;
  [[nodiscard]] Projection thrown(const Light& projector) const;
  Result<Json> extension(const Light& light, const Light& plain, const std::string& place);
  Result<void> set_projector(Json& json, const Light& light);
  Result<void> set_slide(Json& json, const Light& light);
  Result<int> lamp_file(const Light& light);
  Result<int> profile(const Light& light, const std::string& node_name);

  const Scene& scene_;
  PictureWriter& pictures_;
  Surroundings& surroundings_;
  Document& document_;
  std::vector<int> index_of_;
  // Measured lamps: where their bytes are, by lamp and by text; and EXT_lights_ies.lights by file and name.
  std::vector<Json> lamp_files_;
  std::map<const LightDistribution*, int> file_of_lamp_;
  std::map<std::string, int> file_of_text_;
  std::map<std::pair<int, std::string>, int> profiles_;
};

}  // namespace laterna::gltf
