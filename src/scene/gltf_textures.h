// samplers[], images[] and textures[] of a glTF file. Pictures are referred to, not decoded, and only those
// in use.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "laterna/scene.h"
#include "scene/gltf_buffers.h"

namespace laterna::gltf {

class Textures {
 public:
  Textures(const JsonDocument& json, Buffers& buffers, std::filesystem::path folder, FaultList& faults);

  /// The textureInfo `name` of `owner`, with KHR_texture_transform. Not set when absent or faulty. `material`
  /// is the material's name, for the message about a missing file.
  Texture read(JsonObject& owner, std::string_view name, const std::string& material);

  /// The picture that a light's member `name` shows: a textureInfo; or an image of its own, of whatever format is read, by
  /// `uri` or by `bufferView` and `mimeType`. −1 when absent or faulty.
  int read_picture(JsonObject& owner, std::string_view name);

  /// A picture that no image of the file holds.
  int add(Picture picture) { return keep(std::move(picture)); }
  [[nodiscard]] const Picture& at(int picture) const { return pictures_[static_cast<std::size_t>(picture)]; }

  /// The picture of images[image], for what is no texture; −1 when it is faulty. `used_by`: for the message about a missing
  /// file. 0 ≤ image < image_count().
  int picture_of(int image, const std::string& used_by);
  [[nodiscard]] std::size_t image_count() const { return images_.size(); }

  /// The pictures in use, in the order of first use; Texture::picture counts into them.
  std::vector<Picture> take_pictures() { return std::move(pictures_); }

 private:
  struct Source {
    int image = -1;
    Sampler sampler;
  };

  Sampler parse_sampler(const JsonValue& value);
  Source parse_texture(const JsonValue& value);
  int make_picture(const JsonValue& image, const std::string& used_by);
  int picture_from_view(JsonObject& image);
  int picture_from_uri(JsonObject& image, const std::string& used_by);
  int keep(Picture picture);
  void apply_transform(const JsonValue& extension, Texture& texture, std::uint64_t& uv_set);

  static constexpr int kNotYetRead = -2;

  const JsonDocument& json_;
  Buffers& buffers_;
  std::filesystem::path folder_;
  FaultList& faults_;
  std::vector<Sampler> samplers_;
  std::vector<const JsonValue*> images_;
  std::vector<int> picture_of_image_;   // kNotYetRead, −1 (faulty) or an index into pictures_
  std::map<int, int> picture_of_view_;  // images that share a buffer view share its picture
  std::vector<Source> textures_;
  std::vector<Picture> pictures_;
};

}  // namespace laterna::gltf
