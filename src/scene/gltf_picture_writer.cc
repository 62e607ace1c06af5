#include "scene/gltf_picture_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "base/file_io.h"
#include "image/encoder.h"
#include "image/layers.h"
#include "laterna/material_lobes.h"
#include "scene/uri.h"

namespace laterna::gltf {
namespace {

std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code fault;
  const std::filesystem::path absolute = std::filesystem::absolute(path, fault);
  std::filesystem::path canonical = std::filesystem::weakly_canonical(absolute, fault);
  return fault ? absolute.lexically_normal() : canonical;
}

bool is_image_of_gltf(const std::string& format) { return format == "PNG" || format == "JPEG"; }

struct Format {
  std::string_view name, ending, mime_type;
};
// Types as registered, or as is usual.
constexpr Format kFormats[] = {
    {"PNG", ".png", "image/png"},
    {"JPEG", ".jpg", "image/jpeg"},
    {"OpenEXR", ".exr", "image/x-exr"},
    {"Radiance HDR", ".hdr", "image/vnd.radiance"},
    {"PFM", ".pfm", "image/x-portable-floatmap"},
};

const Format& format_named(std::string_view name) {
  const auto* found = std::find_if(std::begin(kFormats), std::end(kFormats),
                                   [&](const Format& format) { return format.name == name; });
  return found == std::end(kFormats) ? kFormats[0] : *found;
}

int wrap_code(Wrap wrap) {
  switch (wrap) {
    case Wrap::clamp:
      return 33071;
    case Wrap::mirror:
      return 33648;
    case Wrap::repeat:
      break;
  }
  return 10497;
}

// GL_NEAREST and GL_LINEAR; with mip levels …_MIPMAP_NEAREST and, two further on, …_MIPMAP_LINEAR.
int minify_code(const Sampler& sampler) {
  const int base = sampler.mip == MipFilter::none ? 9728 : sampler.mip == MipFilter::nearest ? 9984 : 9986;
  return base + (sampler.minify == Filter::linear ? 1 : 0);
}

}  // namespace

Surroundings::Surroundings(const std::filesystem::path& file, bool embeds)
    : folder_(resolved(file).parent_path()), stem_(file.stem().string()), embeds_(embeds) {
  names_ = {file.filename().string()};
}

std::string Surroundings::uri_of(const std::filesystem::path& file) const {
  return percent_encoded(resolved(file).lexically_relative(folder_).generic_string());
}

bool Surroundings::holds(const std::filesystem::path& file) const {
  const std::filesystem::path relative = resolved(file).lexically_relative(folder_);
  return !relative.empty() && *relative.begin() != "..";
}

std::string Surroundings::add(const std::string& name, std::vector<std::byte> bytes) {
  const std::filesystem::path wanted = fmt::format("{}.{}", stem_, name);
  std::string unique = wanted.string();
  for (int next = 2; !names_.insert(unique).second; ++next)
    unique = fmt::format("{}.{}{}", wanted.stem().string(), next, wanted.extension().string());
  files_.push_back({folder_ / unique, std::move(bytes)});
  return percent_encoded(unique);
}

std::string PictureWriter::place(int picture) const { return fmt::format("pictures[{}]", picture); }

// Not what is linear in files, too: roughness, normals, occlusion.
bool PictureWriter::is_color(int picture) const {
  const auto shows = [&](const Material& material) {
    const MaterialLobes* lobes = material.lobes.get();
    return material.base_color_texture.picture == picture || material.emissive_texture.picture == picture ||
           (lobes != nullptr && (lobes->specular.color_texture.picture == picture ||
                                 lobes->sheen.color_texture.picture == picture));
  };
  return std::ranges::any_of(scene_.materials, shows) ||
         std::ranges::any_of(scene_.lights, [&](const Light& light) {
           return light.slide == picture && !light.slide_is_intensity;
         });
}

Result<PictureWriter::Encoded> PictureWriter::encoded(int picture) const {
  const Picture& source = at(picture);
  Encoded result;
  if (source.pixels != nullptr) {
    const Image& pixels = *source.pixels;
    if (pixels.type() != PixelType::f32 && pixels.transfer() == Transfer::linear && is_color(picture))
      document_.warn(place(picture), "of 8 or 16 bits and linear, and read as a colour: files hold sRGB");
    if (pixels.type() == PixelType::f32 && pixels.has_alpha())
      document_.warn(place(picture), "its colours are multiplied by alpha in a file: they come back rounded");
    if (pixels.type() != PixelType::f32) {
      result.owned = image::encode_png(pixels, 1);
    } else {
      WriteOptions options;
      options.depth = WriteOptions::Depth::single;
      Result<image::EncodedBytes> bytes =
          image::encode_exr(image::layers_from_image(pixels, ChannelValues::linear), options, source.name);
      if (!bytes) return tl::unexpected(std::move(bytes.error()));
      result.owned = std::move(*bytes);
    }
  } else if (!source.file.empty()) {
    Result<std::vector<std::byte>> bytes = read_file(source.file);
    if (!bytes) return tl::unexpected(std::move(bytes.error()));
    result.owned = std::move(*bytes);
  }
  result.bytes = result.owned.empty() ? source.encoded : std::span<const std::byte>(result.owned);
  const Result<ImageHeader> header = read_image_header(result.bytes, source.name);
  if (!header) return tl::unexpected(header.error());
  result.format = header->format;
  result.type = header->type;
  return result;
}

Result<PictureWriter::Encoded> PictureWriter::as_png(int picture, Encoded file) {
  if (is_image_of_gltf(file.format)) return file;
  Result<Image> pixels = decode_image(file.bytes, at(picture).name);
  if (!pixels) return tl::unexpected(std::move(pixels.error()));
  Encoded png;
  png.format = "PNG";
  if (pixels->type() != PixelType::f32) {
    png.owned = image::encode_png(*pixels, 1);
  } else {
    document_.warn(place(picture),
                   fmt::format("glTF has no {} textures: it becomes a PNG of 16 bits", file.format));
    WriteOptions options;
    options.depth = WriteOptions::Depth::bits16;
    Result<image::EncodedBytes> bytes = image::encode_png(
        image::layers_from_image(*pixels, ChannelValues::linear), options, at(picture).name);
    if (!bytes) return tl::unexpected(std::move(bytes.error()));
    png.owned = std::move(*bytes);
  }
  png.bytes = png.owned;
  return png;
}

Json PictureWriter::image_json(int picture, Encoded file) {
  const Picture& source = at(picture);
  const Format& format = format_named(file.format);
  const std::string name =
      source.file.empty() ? fmt::format("image{}", picture) : source.file.stem().string();
  Json image;
  image["name"] = name;
  if (surroundings_.embeds()) {
    image["mimeType"] = format.mime_type;
    image["bufferView"] = document_.add_view(file.bytes);
    return image;
  }
  const bool is_own_file =
      file.owned.data() == file.bytes.data() && !source.file.empty() && source.pixels == nullptr;
  if (is_own_file && surroundings_.holds(source.file)) {
    image["uri"] = surroundings_.uri_of(source.file);
  } else {
    image["uri"] =
        surroundings_.add(fmt::format("{}{}", name, format.ending), {file.bytes.begin(), file.bytes.end()});
  }
  return image;
}

Result<int> PictureWriter::image(int picture) {
  if (const auto known = image_of_picture_.find(picture); known != image_of_picture_.end())
    return known->second;
  Result<Encoded> file = encoded(picture);
  if (!file) return tl::unexpected(std::move(file.error()));
  Result<Encoded> png = as_png(picture, std::move(*file));
  if (!png) return tl::unexpected(std::move(png.error()));
  const int index = document_.add("images", image_json(picture, std::move(*png)));
  image_of_picture_.emplace(picture, index);
  return index;
}

int PictureWriter::sampler(const Sampler& sampler) {
  const auto known = std::find(samplers_.begin(), samplers_.end(), sampler);
  if (known != samplers_.end()) return static_cast<int>(known - samplers_.begin());
  samplers_.push_back(sampler);
  return document_.add("samplers", {{"magFilter", sampler.magnify == Filter::linear ? 9729 : 9728},
                                    {"minFilter", minify_code(sampler)},
                                    {"wrapS", wrap_code(sampler.wrap_u)},
                                    {"wrapT", wrap_code(sampler.wrap_v)}});
}

int PictureWriter::texture_of(int image, std::optional<int> sampler) {
  const auto [entry, is_new] = texture_of_.try_emplace({image, sampler.value_or(-1)}, -1);
  if (is_new) {
    Json json;
    if (sampler) json["sampler"] = *sampler;
    json["source"] = image;
    entry->second = document_.add("textures", std::move(json));
  }
  return entry->second;
}

Result<int> PictureWriter::texture(const Texture& texture) {
  const Result<int> source = image(texture.picture);
  if (!source) return tl::unexpected(source.error());
  return texture_of(*source, sampler(texture.sampler));
}

Result<Json> PictureWriter::slide(int picture) {
  if (const auto known = slide_of_picture_.find(picture); known != slide_of_picture_.end())
    return known->second;
  Result<Encoded> file = encoded(picture);
  if (!file) return tl::unexpected(std::move(file.error()));
  Json json;
  if (file->type != PixelType::f32) {
    const Result<int> source = image(picture);
    if (!source) return tl::unexpected(source.error());
    json["index"] = texture_of(*source, std::nullopt);
  } else {
    json = image_json(picture, std::move(*file));
  }
  slide_of_picture_.emplace(picture, json);
  return json;
}

std::string PictureWriter::film(int picture) const { return surroundings_.uri_of(at(picture).file); }

PictureWriter::Size PictureWriter::size(int picture) const {
  const Picture& source = at(picture);
  const auto size_of = [](const auto& header) { return Size{header.width, header.height}; };
  if (source.film) {
    const Result<FilmHeader> film = read_film_header(source.file, source.film->frames_per_second);
    return film ? size_of(*film) : Size();
  }
  if (source.pixels != nullptr) return {source.pixels->width(), source.pixels->height()};
  const Result<ImageHeader> header =
      source.file.empty() ? read_image_header(source.encoded, source.name) : read_image_header(source.file);
  return header ? size_of(*header) : Size();
}

double PictureWriter::aspect(int picture) const {
  const Size pixels = size(picture);
  return static_cast<double>(pixels.width) / pixels.height;
}

}  // namespace laterna::gltf
