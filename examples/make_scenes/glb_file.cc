#include "glb_file.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <glm/common.hpp>

namespace laterna::examples {
namespace {

// Numbers of the glTF 2.0 specification, sections 4 and 5.
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kRepeat = 10497;
constexpr int kLinear = 9729;
constexpr int kLinearMipmapLinear = 9987;

void append(std::vector<std::byte>& bytes, const void* data, std::size_t size) {
  const auto* first = static_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), first, first + size);
}
void append_word(std::vector<std::byte>& bytes, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  append(bytes, &word, sizeof word);
}

/// The picture's PNG, by way of a file: the library writes files only.
std::vector<char> encode_png(const Image& picture) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "laterna_make_scenes.png";
  if (!write_image(picture, file)) return {};
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
  std::filesystem::remove(file);
  return bytes;
}

}  // namespace

GlbFile::GlbFile() {
  json_["asset"] = {{"version", "2.0"}, {"generator", "laterna make_scenes"}};
  json_["scene"] = 0;
  json_["scenes"] = nlohmann::ordered_json::array();
  json_["scenes"].push_back({{"nodes", nlohmann::ordered_json::array()}});
}

int GlbFile::add_view(std::span<const std::byte> bytes) {
  buffer_.resize((buffer_.size() + 3) / 4 * 4);
  json_["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}});
  append(buffer_, bytes.data(), bytes.size());
  return static_cast<int>(json_["bufferViews"].size()) - 1;
}

template <class Element>
int GlbFile::add_accessor(const std::vector<Element>& elements, int component_type, const char* type) {
  const int view = add_view(std::as_bytes(std::span(elements)));
  json_["accessors"].push_back(
      {{"bufferView", view}, {"componentType", component_type}, {"count", elements.size()}, {"type", type}});
  return static_cast<int>(json_["accessors"].size()) - 1;
}

int GlbFile::add_picture(const std::string& name, const Image& picture) {
  const std::vector<char> png = encode_png(picture);
  const int view = add_view(std::as_bytes(std::span(png)));
  if (!json_.contains("samplers")) {
    json_["samplers"].push_back(
        {{"magFilter", kLinear}, {"minFilter", kLinearMipmapLinear}, {"wrapS", kRepeat}, {"wrapT", kRepeat}});
  }
  json_["images"].push_back({{"name", name}, {"bufferView", view}, {"mimeType", "image/png"}});
  json_["textures"].push_back({{"sampler", 0}, {"source", json_["images"].size() - 1}});
  return static_cast<int>(json_["textures"].size()) - 1;
}

int GlbFile::add_material(const Surface& surface, const Image& picture) {
  nlohmann::ordered_json pbr = {{"baseColorFactor", {surface.color.r, surface.color.g, surface.color.b, 1}},
                                {"metallicFactor", 0},
                                {"roughnessFactor", surface.roughness}};
  if (!picture.empty()) pbr["baseColorTexture"] = {{"index", add_picture(surface.name, picture)}};
  nlohmann::ordered_json material = {{"name", surface.name}, {"pbrMetallicRoughness", pbr}};
  if (surface.is_cut_by_alpha) {
    material["alphaMode"] = "MASK";
    material["doubleSided"] = true;
  }
  json_["materials"].push_back(material);
  return static_cast<int>(json_["materials"].size()) - 1;
}

void GlbFile::add_object(const std::string& name, const Primitive& p, int material) {
  const int position = add_accessor(p.positions, kFloat, "VEC3");
  glm::vec3 low = p.positions[0];
  glm::vec3 high = low;
  for (const glm::vec3& v : p.positions) {
    low = glm::min(low, v);
    high = glm::max(high, v);
  }
  json_["accessors"].back()["min"] = {low.x, low.y, low.z};
  json_["accessors"].back()["max"] = {high.x, high.y, high.z};
  nlohmann::ordered_json attributes = {{"POSITION", position}};
  attributes["NORMAL"] = add_accessor(p.normals, kFloat, "VEC3");
  attributes["TEXCOORD_0"] = add_accessor(p.uv[0], kFloat, "VEC2");
  const int indices = add_accessor(p.indices, kUnsignedInt, "SCALAR");
  nlohmann::ordered_json mesh = {{"name", name}};
  mesh["primitives"].push_back({{"attributes", attributes}, {"indices", indices}, {"material", material}});
  json_["meshes"].push_back(mesh);
  json_["nodes"].push_back({{"name", name}, {"mesh", json_["meshes"].size() - 1}});
  json_["scenes"][0]["nodes"].push_back(json_["nodes"].size() - 1);
}

Result<void> GlbFile::write(const std::filesystem::path& file) const {
  std::vector<std::byte> buffer = buffer_;
  buffer.resize((buffer.size() + 3) / 4 * 4);
  nlohmann::ordered_json json = json_;
  json["buffers"].push_back({{"byteLength", buffer.size()}});
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');

  std::vector<std::byte> glb;
  append(glb, "glTF", 4);
  append_word(glb, 2);
  append_word(glb, 12 + 8 + text.size() + 8 + buffer.size());
  append_word(glb, text.size());
  append(glb, "JSON", 4);
  append(glb, text.data(), text.size());
  append_word(glb, buffer.size());
  append(glb, "BIN\0", 4);
  append(glb, buffer.data(), buffer.size());
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
  stream.close();
  if (stream) return {};
  return tl::unexpected(Error(Failure::cannot_write, Diagnostic{file.string(), {}, "cannot be written"}));
}

}  // namespace laterna::examples
