#include "scene/gltf_environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "scene/gltf_extension.h"
#include "scene/json_object.h"
#include "scene/rig_ranges.h"

namespace laterna::gltf {
namespace {

constexpr std::string_view kImageBasedExtension = "EXT_lights_image_based";

class ImageBasedLight {
 public:
  ImageBasedLight(const JsonDocument& json, const JsonValue& value, Textures& textures, FaultList& faults)
      : json_(json), object_(json, value, faults), textures_(textures), faults_(faults) {}

  std::optional<Environment> read() {
    const std::size_t errors_before = faults_.error_count();
    environment_.intensity = object_.number("intensity", kAmountOfLight).value_or(1);
    read_rotation();
    object_.require_all({"irradianceCoefficients", "specularImages", "specularImageSize"});
    (void)object_.whole("specularImageSize", 1, kMaxImageSide);
    read_irradiance();
    read_specular_images();
    if (faults_.error_count() != errors_before || environment_.specular_pictures.empty()) return std::nullopt;
    return environment_;
  }

 private:
  void read_rotation() {
    const auto rotation = object_.numbers<4>("rotation", {-1, 1, false, false});
    if (!rotation) return;
    const glm::dquat q((*rotation)[3], (*rotation)[0], (*rotation)[1], (*rotation)[2]);
    const double length = glm::length(q);
    constexpr double kTolerance = 1e-3;
    if (std::abs(length - 1) > kTolerance)
      return object_.error("rotation",
                           fmt::format("expected a quaternion of length 1, got one of {:.4g}", length));
    environment_.world_from_environment = glm::mat3_cast(q / length);
  }

  // `count` numbers of each of the array's elements, or nothing, which has been reported.
  std::optional<std::vector<std::vector<double>>> read_rows(const JsonValue& list, std::size_t count) {
    std::vector<std::vector<double>> rows;
    for (const JsonValue& row : list.children) {
      const bool is_row = row.is_array() && row.children.size() == count &&
                          std::all_of(row.children.begin(), row.children.end(),
                                      [](const JsonValue& v) { return v.kind == JsonValue::Kind::number; });
      if (!is_row) {
        faults_.error(json_.place(row), fmt::format("expected {} numbers, got {}", count, describe(row)));
        return std::nullopt;
      }
      rows.emplace_back();
      for (const JsonValue& value : row.children) rows.back().push_back(value.number);
    }
    return rows;
  }

  void read_irradiance() {
    const JsonValue* list = object_.array("irradianceCoefficients");
    if (list == nullptr) return;
    if (list->children.size() != 9)
      return object_.error("irradianceCoefficients",
                           fmt::format("expected 9 triples, got {}", list->children.size()));
    const auto rows = read_rows(*list, 3);
    if (!rows) return;
    environment_.irradiance.emplace();
    for (std::size_t i = 0; i < 9; ++i) {
      const std::vector<double>& row = (*rows)[i];
      for (const double value : row) {
        if (std::abs(value) > kMaxRadiance)
          return faults_.error(json_.place(list->children[i]),
                               fmt::format("{} is no amount of light", value));
      }
      (*environment_.irradiance)[i] = {row[0], row[1], row[2]};
    }
  }

  void read_specular_images() {
    const JsonValue* list = object_.array("specularImages");
    if (list == nullptr) return;
    const std::size_t mips = list->children.size();
    if (mips < 1 || mips > kMaxSpecularMips) {
      return object_.error("specularImages",
                           fmt::format("expected 1 to {} mips of 6 images, got {}", kMaxSpecularMips, mips));
    }
    const auto rows = read_rows(*list, 6);
    if (!rows) return;
    for (std::size_t mip = 0; mip < mips; ++mip) {
      std::array<int, 6> faces{};
      for (std::size_t face = 0; face < 6; ++face) {
        const JsonValue& value = list->children[mip].children[face];
        const double image = (*rows)[mip][face];
        if (!(image >= 0) || image >= static_cast<double>(textures_.image_count()) ||
            std::floor(image) != image) {
          faults_.error(json_.place(value),
                        fmt::format("{} is no index into the {} images", image, textures_.image_count()));
          continue;
        }
        faces[face] = textures_.picture_of(static_cast<int>(image), json_.path(value));
        if (faces[face] < 0) faults_.error(json_.place(value), "the image cannot be used");
      }
      environment_.specular_pictures.push_back(faces);
    }
  }

  const JsonDocument& json_;
  JsonObject object_;
  Textures& textures_;
  FaultList& faults_;
  Environment environment_;
};

}  // namespace

std::optional<Environment> read_environment(const JsonDocument& json, Textures& textures, FaultList& faults) {
  const JsonValue* scenes = json.root().find("scenes");
  if (scenes == nullptr || scenes->children.empty()) return std::nullopt;
  // What is wrong with `scene` and `scenes` is said where nodes are read.
  const JsonValue* chosen = json.root().find("scene");
  const double number = chosen == nullptr ? 0 : chosen->number;
  if (!(number >= 0 && number < static_cast<double>(scenes->children.size()))) return std::nullopt;
  const JsonValue* use =
      find_extension(scenes->children[static_cast<std::size_t>(number)], kImageBasedExtension);
  if (use == nullptr) return std::nullopt;
  const JsonValue* extension = find_extension(json.root(), kImageBasedExtension);
  const JsonValue* lights =
      extension == nullptr ? nullptr : JsonObject(json, *extension, faults).array("lights");
  JsonObject reference(json, *use, faults);
  reference.require("light");
  const int light = reference.index("light", lights == nullptr ? 0 : lights->children.size(),
                                    "EXT_lights_image_based.lights");
  if (light < 0) return std::nullopt;
  return ImageBasedLight(json, lights->children[static_cast<std::size_t>(light)], textures, faults).read();
}

}  // namespace laterna::gltf
