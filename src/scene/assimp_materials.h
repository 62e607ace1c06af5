// Assimp's materials as ours.
#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "laterna/scene.h"
#include "scene/fault_list.h"

namespace laterna {

/// Colours are sRGB. Ns becomes roughness √(√(2 / (Ns + 2))), Blinn's exponent as microfacets; surfaces
/// without a specular colour are fully rough; nothing is metal.
class AssimpMaterials {
 public:
  AssimpMaterials(const aiScene& scene, std::filesystem::path file, bool library_is_missing,
                  FaultList& faults);

  /// The scene's index of one of Assimp's materials.
  int use(unsigned material);
  [[nodiscard]] const Material& operator[](int index) const {
    return materials_[static_cast<std::size_t>(index)];
  }
  std::vector<Material> take_materials() { return std::move(materials_); }
  std::vector<Picture> take_pictures() { return std::move(pictures_); }

 private:
  Material convert(const aiMaterial& source);
  void read_colors(const aiMaterial& source, Material& material);
  void read_transparency(const aiMaterial& source, Material& material);
  Texture read_texture(const aiMaterial& source, aiTextureType type, const std::string& material);
  int picture_of(const std::string& reference, const std::string& material);
  std::optional<Picture> find_picture(const std::string& reference, const std::string& material);
  std::optional<Picture> embedded_picture(const std::string& reference);
  [[nodiscard]] bool is_md2() const;

  const aiScene& scene_;
  std::filesystem::path file_;
  bool library_is_missing_;
  FaultList& faults_;
  std::vector<int> index_of_;  // −1: not yet read
  std::vector<Material> materials_;
  std::vector<Picture> pictures_;
  std::map<std::string, int> picture_of_reference_;
};

}  // namespace laterna
