#include "scene/gltf_document.h"

#include <array>
#include <charconv>

namespace laterna::gltf {
namespace {

constexpr int kFloat = 5126;

// The order in which people look for things.
constexpr std::array<std::string_view, 11> kLists = {"nodes",      "cameras",   "meshes",     "skins",
                                                     "materials",  "textures",  "images",     "samplers",
                                                     "animations", "accessors", "bufferViews"};

}  // namespace

double shortest(float value) {
  std::array<char, 32> text{};
  const char* end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double number = 0;
  std::from_chars(text.data(), end, number);
  return number;
}

int Document::add(std::string_view list, Json value) {
  Json& all = lists_.try_emplace(std::string(list), Json::array()).first->second;
  all.push_back(std::move(value));
  return static_cast<int>(all.size()) - 1;
}

std::size_t Document::count(std::string_view list) const {
  const auto found = lists_.find(list);
  return found == lists_.end() ? 0 : found->second.size();
}

Json& Document::at(std::string_view list, int index) {
  return lists_.find(list)->second[static_cast<std::size_t>(index)];
}

Json& Document::extension(std::string_view name) {
  use(name);
  return extensions_[std::string(name)];
}

void Document::extend(Json& object, std::string_view name, Json value) {
  use(name);
  object["extensions"][std::string(name)] = std::move(value);
}

int Document::add_view(std::span<const std::byte> bytes, Target target) {
  binary_.resize((binary_.size() + 3) / 4 * 4);
  Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
  if (target != Target::none) view["target"] = static_cast<int>(target);
  binary_.insert(binary_.end(), bytes.begin(), bytes.end());
  return add("bufferViews", std::move(view));
}

int Document::add_accessor(std::span<const std::byte> bytes, Target target, int component_type,
                           std::string_view type, std::size_t count) {
  const int view = add_view(bytes, target);
  return add("accessors",
             {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
}

int Document::add_floats(std::span<const float> values, std::string_view type, std::size_t count) {
  return add_accessor(std::as_bytes(values), Target::attributes, kFloat, type, count);
}

std::string Document::text(const std::string& buffer_uri) const {
  Json root;
  root["asset"] = {{"version", "2.0"}, {"generator", "Laterna"}};
  if (!used_.empty()) root["extensionsUsed"] = used_;
  if (!extensions_.empty()) root["extensions"] = extensions_;
  root["scene"] = 0;
  root["scenes"] = lists_.find("scenes")->second;
  for (const std::string_view name : kLists) {
    if (const auto list = lists_.find(name); list != lists_.end()) root[std::string(name)] = list->second;
  }
  if (!binary_.empty()) {
    Json buffer;
    if (!buffer_uri.empty()) buffer["uri"] = buffer_uri;
    buffer["byteLength"] = binary_.size();
    root["buffers"] = Json::array({buffer});
  }
  // Names come from files of any age: what is no UTF-8 is replaced.
  return root.dump(buffer_uri.empty() ? -1 : 1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace laterna::gltf
