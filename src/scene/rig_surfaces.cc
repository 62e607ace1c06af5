#include "scene/rig_surfaces.h"

#include "base/elementary.h"
#include "laterna/blend.h"
#include "scene/mirror_settings.h"
#include "scene/relief_settings.h"
#include "scene/rig_ranges.h"
#include "scene/uri.h"

namespace laterna {
namespace {

// Placed as KHR_texture_transform has it: coordinates of the mesh, scaled, turned and moved, are the picture's.
void place_texture(JsonObject& object, Texture& texture) {
  constexpr NumberRange kTurns{-36000, 36000, false, false};
  texture.uv_set = static_cast<int>(object.whole("uv_set", 0, 1).value_or(0));
  const auto offset = object.numbers<2>("offset", kCoordinate).value_or(std::array<double, 2>{0, 0});
  const auto scale = object.numbers<2>("scale", kCoordinate).value_or(std::array<double, 2>{1, 1});
  const double turn = Angle::degrees(object.number("rotation_deg", kTurns).value_or(0)).in_radians();
  const double c = cosine(turn), s = sine(turn);
  const double rows[6] = {c * scale[0], s * scale[1], offset[0], -s * scale[0], c * scale[1], offset[1]};
  for (std::size_t i = 0; i < 6; ++i) texture.uv_from_mesh_uv[i] = static_cast<float>(rows[i]);
}

class LayerReader {
 public:
  LayerReader(const JsonDocument& json, const JsonValue& value, const std::filesystem::path& folder,
              std::vector<Picture>& pictures, FaultList& faults)
      : json_(json), object_(json, value, faults), folder_(folder), pictures_(pictures) {}

  SurfaceOverride::Layer read() {
    if (!object_.value().is_object()) return {};
    read_picture();
    read_texture();
    read_slide();
    SurfaceLayer& layer = read_.layer;
    using NamedMode = std::pair<std::string_view, BlendMode>;
    std::vector<NamedMode> modes;
    for (const BlendModeDescription& known : list_blend_modes()) modes.emplace_back(known.name, known.mode);
    layer.blend = object_.choice<BlendMode>("blend", std::span<const NamedMode>(modes)).value_or(layer.blend);
    if (const auto color = object_.numbers<3>("color", kAmountOfLight))
      layer.color = glm::vec3((*color)[0], (*color)[1], (*color)[2]);
    layer.opacity = static_cast<float>(object_.number("opacity", kZeroToOne).value_or(1));
    object_.report_unknown_members("a layer");
    return std::move(read_);
  }

 private:
  void read_picture() {
    if (object_.has("texture") && object_.has("slide"))
      object_.error("slide", "give either texture or slide, not both");
    if (!object_.has("texture") && !object_.has("slide") && !object_.has("color"))
      object_.error({}, "shows nothing: give a texture, the slide of a projector, or a color");
    read_.layer.texture.picture = add_rig_picture(object_, "texture", folder_, pictures_);
  }

  void read_texture() {
    Texture& texture = read_.layer.texture;
    read_.texture_place = json_.place(object_.value(), object_.has("uv_set") ? "uv_set" : "texture");
    place_texture(object_, texture);
    read_sampler(texture.sampler);
    if (object_.has("texture")) return;
    for (const std::string_view name : {"uv_set", "offset", "scale", "rotation_deg", "wrap", "filter"}) {
      if (object_.has(name)) object_.error(name, "belongs to a \"texture\", and there is none");
    }
  }

  void read_sampler(Sampler& sampler) {
    enum class Beyond { repeat, mirror, clamp, once };
    const Beyond beyond = object_
                              .choice<Beyond>("wrap", {{"repeat", Beyond::repeat},
                                                       {"mirror", Beyond::mirror},
                                                       {"clamp", Beyond::clamp},
                                                       {"once", Beyond::once}})
                              .value_or(Beyond::repeat);
    read_.layer.once = beyond == Beyond::once;
    sampler.wrap_u = sampler.wrap_v = beyond == Beyond::repeat   ? Wrap::repeat
                                      : beyond == Beyond::mirror ? Wrap::mirror
                                                                 : Wrap::clamp;
    const auto filter =
        object_.choice<Filter>("filter", {{"linear", Filter::linear}, {"nearest", Filter::nearest}});
    if (filter == Filter::nearest) sampler.magnify = Filter::nearest;
  }

  void read_slide() {
    read_.slide = object_.string("slide");
    read_.slide_place = json_.place(object_.value(), "slide");
    read_.layer.occluded = object_.boolean("occluded").value_or(true);
    if (object_.has("occluded") && !object_.has("slide"))
      object_.error("occluded", "belongs to a \"slide\", and there is none");
  }

  const JsonDocument& json_;
  JsonObject object_;
  const std::filesystem::path& folder_;
  std::vector<Picture>& pictures_;
  SurfaceOverride::Layer read_;
};

Relief read_relief(JsonObject& object, const std::filesystem::path& folder, std::vector<Picture>& pictures) {
  Relief relief;
  object.require("picture");
  relief.texture.picture = add_rig_picture(object, "picture", folder, pictures);
  place_texture(object, relief.texture);
  const auto wrap = object.choice<Wrap>(
      "wrap", {{"repeat", Wrap::repeat}, {"mirror", Wrap::mirror}, {"clamp", Wrap::clamp}});
  relief.texture.sampler.wrap_u = relief.texture.sampler.wrap_v = wrap.value_or(Wrap::repeat);
  read_relief_settings(object, relief);
  object.report_unknown_members("a relief");
  return relief;
}

}  // namespace

int add_rig_picture(JsonObject& object, std::string_view member, const std::filesystem::path& folder,
                    std::vector<Picture>& pictures) {
  const std::optional<std::string> name = object.string(member);
  if (!name) return -1;
  auto path = resolve_typed_file(folder, *name);
  if (!path) {
    object.error(member, path.error());
    return -1;
  }
  Picture picture;
  picture.file = std::move(*path);
  picture.name = picture.file.string();
  pictures.push_back(std::move(picture));
  return static_cast<int>(pictures.size()) - 1;
}

std::optional<SurfaceOverride> read_rig_surface(const JsonDocument& json, const JsonValue& value,
                                                const std::filesystem::path& folder,
                                                std::vector<Picture>& pictures, FaultList& faults) {
  const std::size_t errors_before = faults.error_count();
  JsonObject object(json, value, faults);
  SurfaceOverride surface;
  surface.material = object.string("material");
  surface.node = object.string("node");
  if (object.has("material") && object.has("node"))
    object.error("node", "give either material or node, not both");
  if (const JsonValue* mirror = object.object("mirror"))
    surface.mirror = read_mirror_settings(json, *mirror, faults, kRigNames);
  if (!object.has("relief") && !object.has("mirror")) object.require("layers");
  if (const JsonValue* layers = object.array("layers")) {
    for (const JsonValue& layer : layers->children)
      surface.layers.push_back(LayerReader(json, layer, folder, pictures, faults).read());
  }
  if (const JsonValue* relief = object.object("relief")) {
    JsonObject of_relief(json, *relief, faults);
    surface.relief = read_relief(of_relief, folder, pictures);
    surface.relief_place = json.place(value, "relief");
  }
  object.report_unknown_members("a surface");
  surface.file = faults.file();
  surface.place = json.place(value);
  if (faults.error_count() != errors_before) return std::nullopt;
  return surface;
}

}  // namespace laterna
