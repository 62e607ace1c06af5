// LATERNA_projector and LATERNA_lighting on the lights of a glTF file. docs/LATERNA_projector.md, docs/LATERNA_lighting.md
#pragma once

#include <filesystem>
#include <string_view>

#include "laterna/scene.h"
#include "scene/gltf_textures.h"
#include "scene/rig_lights.h"

namespace laterna::gltf {

inline constexpr std::string_view kProjectorExtension = "LATERNA_projector";
inline constexpr std::string_view kLightingExtension = "LATERNA_lighting";

class LightExtensions {
 public:
  /// Slides are pictures of `textures`; films are looked for in `folder`.
  LightExtensions(const JsonDocument& json, Textures& textures, std::filesystem::path folder,
                  FaultList& faults);

  /// What the extensions of a light of KHR_lights_punctual, or of a node's EXT_lights_ies, say beyond what `light` holds.
  [[nodiscard]] Light extend(const JsonValue& value, Light light);

 private:
  // glTF names files by URIs, relative to its own.
  class Files final : public LightFiles {
   public:
    Files(Textures& textures, std::filesystem::path folder)
        : textures_(textures), folder_(std::move(folder)) {}

    tl::expected<std::filesystem::path, std::string> find(std::string_view name) override;
    std::optional<std::filesystem::path> pattern(std::string_view name) override;
    int read_picture(JsonObject& light, std::string_view key) override;
    int add(Picture picture) override { return textures_.add(std::move(picture)); }
    [[nodiscard]] const Picture& at(int picture) const override { return textures_.at(picture); }

   private:
    Textures& textures_;
    std::filesystem::path folder_;
  };

  const JsonDocument& json_;
  Files files_;
  FaultList& faults_;
};

}  // namespace laterna::gltf
