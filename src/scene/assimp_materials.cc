#include "scene/assimp_materials.h"

#include <assimp/material.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <system_error>

#include "base/elementary.h"
#include "scene/spelling.h"

namespace laterna {
namespace {

// The files a skin may really be, in order of preference; games used PCX.
constexpr std::array<std::string_view, 6> kPictureEndings = {".png", ".jpg", ".jpeg", ".tga", ".bmp", ".pcx"};

bool is_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

glm::vec3 linear_color(const aiColor4D& srgb) {
  const auto linear = [](float value) {
    return std::isfinite(value) ? static_cast<float>(linear_from_srgb(std::max(0.0F, value))) : 1.0F;
  };
  return {linear(srgb.r), linear(srgb.g), linear(srgb.b)};
}

std::optional<float> number(const aiMaterial& source, const char* key) {
  ai_real value = 0;
  if (source.Get(key, 0, 0, value) != aiReturn_SUCCESS || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<aiColor4D> color(const aiMaterial& source, const char* key) {
  aiColor4D value;
  if (source.Get(key, 0, 0, value) != aiReturn_SUCCESS) return std::nullopt;
  return value;
}

std::string texture_reference(const aiMaterial& source, aiTextureType type) {
  aiString path;
  if (source.GetTexture(type, 0, &path) != aiReturn_SUCCESS) return {};
  return path.C_Str();
}

Wrap wrap_of(aiTextureMapMode mode) {
  switch (mode) {
    case aiTextureMapMode_Clamp:
    case aiTextureMapMode_Decal:
      return Wrap::clamp;
    case aiTextureMapMode_Mirror:
      return Wrap::mirror;
    default:
      return Wrap::repeat;
  }
}

}  // namespace

AssimpMaterials::AssimpMaterials(const aiScene& scene, std::filesystem::path file, bool library_is_missing,
                                 FaultList& faults)
    : scene_(scene),
      file_(std::move(file)),
      library_is_missing_(library_is_missing),
      faults_(faults),
      index_of_(scene.mNumMaterials, -1) {}

int AssimpMaterials::use(unsigned material) {
  if (material >= index_of_.size()) return -1;
  int& index = index_of_[material];
  if (index < 0) {
    Material converted = convert(*scene_.mMaterials[material]);
    index = static_cast<int>(materials_.size());
    materials_.push_back(std::move(converted));
  }
  return index;
}

Material AssimpMaterials::convert(const aiMaterial& source) {
  Material material;
  material.metallic = 0;
  // GetName() only reads, but is not declared so.
  material.name = aiString(const_cast<aiMaterial&>(source).GetName()).C_Str();  // NOLINT(*-const-cast)
  const bool is_placeholder = library_is_missing_ || material.name == AI_DEFAULT_MATERIAL_NAME;
  if (!is_placeholder) read_colors(source, material);
  const bool has_diffuse = source.GetTextureCount(aiTextureType_DIFFUSE) > 0;
  material.base_color_texture =
      read_texture(source, has_diffuse ? aiTextureType_DIFFUSE : aiTextureType_BASE_COLOR, material.name);
  if (material.base_color_texture.is_set() && glm::vec3(material.base_color) == glm::vec3(0)) {
    faults_.warning(fmt::format("material {}", in_quotes(material.name)),
                    "its colour is black under a texture: taken as white");
    material.base_color = glm::vec4(1, 1, 1, material.base_color.a);
  }
  material.normal_texture = read_texture(source, aiTextureType_NORMALS, material.name);
  material.emissive_texture = read_texture(source, aiTextureType_EMISSIVE, material.name);
  if (material.emissive_texture.is_set() && material.emissive == glm::vec3(0))
    material.emissive = glm::vec3(1);
  read_transparency(source, material);
  return material;
}

void AssimpMaterials::read_colors(const aiMaterial& source, Material& material) {
  if (const auto diffuse = color(source, "$clr.diffuse")) {
    material.base_color = glm::vec4(linear_color(*diffuse), 1);
  }
  if (const auto emissive = color(source, "$clr.emissive")) material.emissive = linear_color(*emissive);
  const std::optional<aiColor4D> specular = color(source, "$clr.specular");
  const std::optional<float> exponent = number(source, "$mat.shininess");
  if (specular && exponent && !(*specular == aiColor4D(0, 0, 0, specular->a)) && *exponent > 0) {
    // Blinn's exponent n spreads the highlight like microfacets of α = √(2 / (n + 2)); glTF's roughness is
    // √α.
    material.roughness = std::sqrt(std::sqrt(2.0F / (*exponent + 2)));
  }
  int is_double_sided = 0;
  if (source.Get(AI_MATKEY_TWOSIDED, is_double_sided) == aiReturn_SUCCESS)
    material.double_sided = is_double_sided != 0;
}

void AssimpMaterials::read_transparency(const aiMaterial& source, Material& material) {
  const float opacity = std::clamp(number(source, "$mat.opacity").value_or(1), 0.0F, 1.0F);
  if (opacity < 1) {
    material.base_color.a = opacity;
    material.alpha_mode = AlphaMode::blend;
  }
  const std::string map = texture_reference(source, aiTextureType_OPACITY);
  if (map.empty()) return;
  if (map == texture_reference(source, aiTextureType_DIFFUSE)) {
    // Leaves and fences: the alpha channel of the colour cuts them out.
    if (material.alpha_mode == AlphaMode::opaque) material.alpha_mode = AlphaMode::mask;
    return;
  }
  faults_.warning(fmt::format("material {}", in_quotes(material.name)),
                  fmt::format("the opacity map {} is not the colour map: left out", in_quotes(map)));
}

Texture AssimpMaterials::read_texture(const aiMaterial& source, aiTextureType type,
                                      const std::string& material) {
  aiString path;
  aiTextureMapMode wrap[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
  unsigned uv_set = 0;
  Texture texture;
  if (source.GetTexture(type, 0, &path, nullptr, &uv_set, nullptr, nullptr, wrap) != aiReturn_SUCCESS)
    return texture;
  texture.picture = picture_of(path.C_Str(), material);
  texture.sampler.wrap_u = wrap_of(wrap[0]);
  texture.sampler.wrap_v = wrap_of(wrap[1]);
  texture.uv_set = static_cast<int>(std::min(uv_set, 1U));
  return texture;
}

int AssimpMaterials::picture_of(const std::string& reference, const std::string& material) {
  const auto [known, is_new] = picture_of_reference_.try_emplace(reference, -1);
  if (!is_new) return known->second;
  if (std::optional<Picture> picture = find_picture(reference, material)) {
    known->second = static_cast<int>(pictures_.size());
    pictures_.push_back(std::move(*picture));
  }
  return known->second;
}

bool AssimpMaterials::is_md2() const {
  const std::string ending = file_.extension().string();
  return ending == ".md2" || ending == ".MD2";
}

std::optional<Picture> AssimpMaterials::find_picture(const std::string& reference,
                                                     const std::string& material) {
  if (std::optional<Picture> embedded = embedded_picture(reference)) return embedded;
  const bool is_named = reference != "$texture_dummy.bmp";  // Assimp's word for "none"
  std::string with_slashes = reference;
  std::replace(with_slashes.begin(), with_slashes.end(), '\\', '/');
  const std::filesystem::path folder = file_.parent_path(), named(with_slashes);
  std::vector<std::filesystem::path> candidates;
  if (is_named) {
    if (named.is_relative()) candidates.push_back(folder / named);
    candidates.push_back(folder / named.filename());  // whatever folder it had on its author's machine
  }
  if (is_md2()) {
    for (const std::string_view ending : kPictureEndings) {
      if (is_named) candidates.push_back((folder / named.stem()) += ending);
      candidates.push_back((folder / file_.stem()) += ending);
    }
  }
  for (const std::filesystem::path& candidate : candidates) {
    if (!is_file(candidate)) continue;
    Picture picture;
    picture.file = candidate;
    picture.name = candidate.string();
    return picture;
  }
  if (!is_named) return std::nullopt;
  const std::string place = fmt::format("material {}", in_quotes(material));
  const std::string message = fmt::format("texture {} not found (tried {})", in_quotes(reference),
                                          path_in_quotes(candidates.front().string()));
  is_md2() ? faults_.warning(place, message) : faults_.error(place, message);
  return std::nullopt;
}

std::optional<Picture> AssimpMaterials::embedded_picture(const std::string& reference) {
  const aiTexture* texture = scene_.GetEmbeddedTexture(reference.c_str());
  if (texture == nullptr || texture->pcData == nullptr) return std::nullopt;
  Picture picture;
  picture.name = fmt::format("{}: {}", faults_.file(), reference);
  if (texture->mHeight == 0) {  // an encoded file of mWidth bytes
    const auto* first = reinterpret_cast<const std::byte*>(texture->pcData);
    picture.encoded_owner = std::make_shared<const std::vector<std::byte>>(first, first + texture->mWidth);
    picture.encoded = *picture.encoded_owner;
    return picture;
  }
  if (texture->mWidth > kMaxImageSide || texture->mHeight > kMaxImageSide) return std::nullopt;
  auto pixels = std::make_shared<Image>(static_cast<int>(texture->mWidth), static_cast<int>(texture->mHeight),
                                        4, PixelType::u8, Transfer::srgb);
  const std::span<std::uint8_t> values = pixels->values<std::uint8_t>();
  for (std::size_t i = 0; i < values.size() / 4; ++i) {
    const aiTexel& texel = texture->pcData[i];
    values[i * 4] = texel.r;
    values[i * 4 + 1] = texel.g;
    values[i * 4 + 2] = texel.b;
    values[i * 4 + 3] = texel.a;
  }
  picture.pixels = std::move(pixels);
  return picture;
}

}  // namespace laterna
