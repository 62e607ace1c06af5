#include "scene/gltf_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scene/gltf_extension.h"
#include "scene/spelling.h"
#include "scene/texture_transform.h"
#include "scene/uri.h"

namespace laterna::gltf {
namespace {

constexpr double kMaxRotation = 1e5;  // radians; what sine() accepts

Wrap parse_wrap(JsonObject& sampler, std::string_view name) {
  const std::uint64_t code = sampler.whole(name).value_or(10497);
  switch (code) {
    case 10497:
      return Wrap::repeat;
    case 33648:
      return Wrap::mirror;
    case 33071:
      return Wrap::clamp;
    default:
      break;
  }
  sampler.error(name, fmt::format("expected 10497, 33071 or 33648, got {}", code));
  return Wrap::repeat;
}

}  // namespace

Textures::Textures(const JsonDocument& json, Buffers& buffers, std::filesystem::path folder,
                   FaultList& faults)
    : json_(json), buffers_(buffers), folder_(std::move(folder)), faults_(faults) {
  JsonObject root(json, json.root(), faults);
  if (const JsonValue* list = root.array("samplers")) {
    for (const JsonValue& value : list->children) samplers_.push_back(parse_sampler(value));
  }
  if (const JsonValue* list = root.array("images")) {
    for (const JsonValue& value : list->children) images_.push_back(&value);
  }
  picture_of_image_.assign(images_.size(), kNotYetRead);
  if (const JsonValue* list = root.array("textures")) {
    for (const JsonValue& value : list->children) textures_.push_back(parse_texture(value));
  }
}

Sampler Textures::parse_sampler(const JsonValue& value) {
  JsonObject object(json_, value, faults_);
  Sampler sampler;
  sampler.wrap_u = parse_wrap(object, "wrapS");
  sampler.wrap_v = parse_wrap(object, "wrapT");
  const std::uint64_t magnify = object.whole("magFilter").value_or(9729);
  if (magnify != 9728 && magnify != 9729) {
    object.error("magFilter", fmt::format("expected 9728 or 9729, got {}", magnify));
  }
  sampler.magnify = magnify == 9728 ? Filter::nearest : Filter::linear;
  const std::uint64_t minify = object.whole("minFilter").value_or(9987);
  switch (minify) {
    case 9728:
    case 9729:
      sampler.mip = MipFilter::none;
      break;
    case 9984:
    case 9985:
      sampler.mip = MipFilter::nearest;
      break;
    case 9986:
    case 9987:
      sampler.mip = MipFilter::linear;
      break;
    default:
      object.error("minFilter", fmt::format("expected 9728, 9729 or 9984 to 9987, got {}", minify));
  }
  sampler.minify = minify % 2 == 0 ? Filter::nearest : Filter::linear;
  return sampler;
}

Textures::Source Textures::parse_texture(const JsonValue& value) {
  JsonObject object(json_, value, faults_);
  Source source;
  source.image = object.index("source", images_.size(), "images");
  const int sampler = object.index("sampler", samplers_.size(), "samplers");
  if (sampler >= 0) source.sampler = samplers_[static_cast<std::size_t>(sampler)];
  return source;
}

Texture Textures::read(JsonObject& owner, std::string_view name, const std::string& material) {
  const JsonValue* value = owner.object(name);
  if (value == nullptr) return {};
  JsonObject info(json_, *value, faults_);
  info.require("index");
  const int index = info.index("index", textures_.size(), "textures");
  std::uint64_t uv_set = info.whole("texCoord").value_or(0);
  Texture texture;
  if (const JsonValue* transform = find_extension(*value, "KHR_texture_transform")) {
    apply_transform(*transform, texture, uv_set);
  }
  if (index < 0) return {};
  const Source& source = textures_[static_cast<std::size_t>(index)];
  if (source.image < 0) {
    info.warning({}, fmt::format("textures[{}] has no PNG or JPEG source: left out", index));
    return {};
  }
  if (uv_set > 1) {
    info.warning({}, fmt::format("uses TEXCOORD_{}, but only two sets are read: left out", uv_set));
    return {};
  }
  texture.uv_set = static_cast<int>(uv_set);
  texture.sampler = source.sampler;
  const std::string used_by =
      json_.path(*value) + (material.empty() ? std::string() : fmt::format(" ({})", in_quotes(material)));
  texture.picture = picture_of(source.image, used_by);
  return texture.is_set() ? texture : Texture{};
}

int Textures::read_picture(JsonObject& owner, std::string_view name) {
  const JsonValue* value = owner.object(name);
  if (value == nullptr) return -1;
  if (value->find("index") == nullptr) return make_picture(*value, {});
  JsonObject info(json_, *value, faults_);
  for (const std::string_view elsewhere : {"uri", "bufferView"}) {
    if (info.has(elsewhere))
      info.error(elsewhere, "expected either the index of a texture or an image, not both");
  }
  const int index = info.index("index", textures_.size(), "textures");
  if (index < 0) return -1;
  const int image = textures_[static_cast<std::size_t>(index)].image;
  if (image >= 0) return picture_of(image, json_.path(*value));
  info.error("index", fmt::format("textures[{}] has no PNG or JPEG source", index));
  return -1;
}

void Textures::apply_transform(const JsonValue& extension, Texture& texture, std::uint64_t& uv_set) {
  JsonObject object(json_, extension, faults_);
  const auto offset = object.numbers<2>("offset").value_or(std::array<double, 2>{0, 0});
  const auto scale = object.numbers<2>("scale").value_or(std::array<double, 2>{1, 1});
  const double rotation = object.number("rotation", {-kMaxRotation, kMaxRotation}).value_or(0);
  uv_set = object.whole("texCoord").value_or(uv_set);
  texture.uv_from_mesh_uv = composed({{offset[0], offset[1]}, rotation, {scale[0], scale[1]}});
}

int Textures::picture_of(int image, const std::string& used_by) {
  int& picture = picture_of_image_[static_cast<std::size_t>(image)];
  if (picture == kNotYetRead) picture = make_picture(*images_[static_cast<std::size_t>(image)], used_by);
  return picture;
}

int Textures::keep(Picture picture) {
  pictures_.push_back(std::move(picture));
  return static_cast<int>(pictures_.size()) - 1;
}

int Textures::make_picture(const JsonValue& value, const std::string& used_by) {
  JsonObject image(json_, value, faults_);
  if (image.has("uri") == image.has("bufferView")) {
    image.error({}, "expected either a uri or a bufferView");
    return -1;
  }
  return image.has("uri") ? picture_from_uri(image, used_by) : picture_from_view(image);
}

int Textures::picture_from_view(JsonObject& image) {
  const int view = image.index("bufferView", buffers_.view_count(), "bufferViews");
  if (view < 0) return -1;
  const auto [known, is_new] = picture_of_view_.try_emplace(view, -1);
  if (!is_new) return known->second;
  std::optional<OwnedSpan> bytes = buffers_.read(view);
  if (!bytes) return -1;
  Picture picture;
  picture.name = fmt::format("{}: {}", faults_.file(), json_.path(image.value()));
  picture.encoded_owner = std::move(bytes->owner);
  picture.encoded = bytes->bytes;
  known->second = keep(std::move(picture));
  return known->second;
}

int Textures::picture_from_uri(JsonObject& image, const std::string& used_by) {
  const std::optional<std::string> uri = image.string("uri");
  if (!uri) return -1;
  const std::string for_whom = used_by.empty() ? std::string() : "; used by " + used_by;
  Picture picture;
  if (!is_data_uri(*uri)) {
    auto path = resolve_file(folder_, *uri);
    if (!path) {
      image.error("uri", path.error() + for_whom);
      return -1;
    }
    picture.file = std::move(*path);
    picture.name = picture.file.string();
    return keep(std::move(picture));
  }
  auto decoded = decode_data_uri(*uri);
  if (!decoded) {
    image.error("uri", decoded.error() + for_whom);
    return -1;
  }
  if (decoded->empty()) {
    image.error("uri", "the data URI is empty" + for_whom);
    return -1;
  }
  picture.name = fmt::format("{}: {}", faults_.file(), json_.path(image.value()));
  picture.encoded_owner = std::make_shared<const std::vector<std::byte>>(std::move(*decoded));
  picture.encoded = *picture.encoded_owner;
  return keep(std::move(picture));
}

}  // namespace laterna::gltf
