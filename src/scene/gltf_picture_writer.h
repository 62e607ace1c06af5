// images[], textures[] and samplers[] of a glTF file in the making, and the slides of lights.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "laterna/image.h"
#include "laterna/scene.h"
#include "scene/gltf_document.h"

namespace laterna::gltf {

/// A file that is written beside the scene.
struct BesideFile {
  std::filesystem::path path;
  std::vector<std::byte> bytes;
};

/// Where a glTF file will lie, and what may lie beside it.
class Surroundings {
 public:
  /// `embeds`: nothing may.
  Surroundings(const std::filesystem::path& file, bool embeds);

  [[nodiscard]] bool embeds() const { return embeds_; }
  /// The URI of another file, as seen from the scene's folder.
  [[nodiscard]] std::string uri_of(const std::filesystem::path& file) const;
  /// Whether it lies in the scene's folder, or below.
  [[nodiscard]] bool holds(const std::filesystem::path& file) const;
  /// A new file beside the scene, named after it: "stage.lake.png". Gives its URI.
  std::string add(const std::string& name, std::vector<std::byte> bytes);
  std::vector<BesideFile> take_files() { return std::move(files_); }

 private:
  std::filesystem::path folder_;  // absolute
  std::string stem_;
  bool embeds_;
  std::set<std::string> names_;
  std::vector<BesideFile> files_;
};

class PictureWriter {
 public:
  PictureWriter(const Scene& scene, Surroundings& surroundings, Document& document)
      : scene_(scene), surroundings_(surroundings), document_(document) {}

  /// The index in textures[] of a set texture.
  Result<int> texture(const Texture& texture);
  /// What a light's member holds that shows a picture: a textureInfo, or, of floats, which PNG and JPEG do not hold, an image.
  Result<Json> slide(int picture);
  /// The URI of a film.
  [[nodiscard]] std::string film(int picture) const;
  /// The index in images[] of a picture.
  Result<int> image(int picture);
  /// Pixels; one where the picture cannot be read.
  struct Size {
    int width = 1, height = 1;
  };
  [[nodiscard]] Size size(int picture) const;
  /// Width over height.
  [[nodiscard]] double aspect(int picture) const;

 private:
  struct Encoded {
    std::vector<std::byte> owned;
    std::span<const std::byte> bytes;
    std::string format;  // "PNG", "JPEG", …
    PixelType type = PixelType::u8;
  };

  [[nodiscard]] const Picture& at(int picture) const {
    return scene_.pictures[static_cast<std::size_t>(picture)];
  }
  [[nodiscard]] std::string place(int picture) const;
  [[nodiscard]] bool is_color(int picture) const;
  // The file's own bytes; pixels become the format that keeps them all.
  [[nodiscard]] Result<Encoded> encoded(int picture) const;
  Result<Encoded> as_png(int picture, Encoded file);
  Json image_json(int picture, Encoded file);
  int texture_of(int image, std::optional<int> sampler);
  int sampler(const Sampler& sampler);

  const Scene& scene_;
  Surroundings& surroundings_;
  Document& document_;
  std::map<int, int> image_of_picture_;
  std::map<int, Json> slide_of_picture_;
  std::map<std::pair<int, int>, int> texture_of_;  // image and sampler, −1: none
  std::vector<Sampler> samplers_;
};

}  // namespace laterna::gltf
