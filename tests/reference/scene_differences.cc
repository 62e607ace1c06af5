#include "reference/scene_differences.h"

#include <algorithm>
#include <cstring>

#include "laterna/lamps.h"
#include "scene/lobe_factors.h"

namespace laterna::reference {
namespace {

class Comparison {
 public:
  Comparison(const Scene& a, const Scene& b) : a_(a), b_(b) {}

  std::vector<std::string> run() {
    compare_all("materials", a_.materials, b_.materials, &Comparison::compare_materials);
    compare_all("meshes", a_.meshes, b_.meshes, &Comparison::compare_meshes);
    compare_all("cameras", a_.cameras, b_.cameras, &Comparison::compare_cameras);
    compare_all("lights", a_.lights, b_.lights, &Comparison::compare_lights);
    compare_all("nodes", a_.nodes, b_.nodes, &Comparison::compare_nodes);
    check("ambient", a_.ambient == b_.ambient && a_.ambient_is_set == b_.ambient_is_set);
    check("background", a_.background == b_.background);
    check("phong", a_.phong.has_value() == b_.phong.has_value() &&
                       (!a_.phong || (a_.phong->specular == b_.phong->specular &&
                                      a_.phong->shininess == b_.phong->shininess)));
    return std::move(found_);
  }

 private:
  void check(const std::string& place, bool is_same) {
    if (!is_same) found_.push_back(place);
  }

  template <class Thing>
  void compare_all(const std::string& list, const std::vector<Thing>& a, const std::vector<Thing>& b,
                   void (Comparison::*compare)(const std::string&, const Thing&, const Thing&)) {
    check(list + ".size()", a.size() == b.size());
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      (this->*compare)(list + "[" + std::to_string(i) + "]", a[i], b[i]);
  }

  [[nodiscard]] bool same_picture(int a, int b) const {
    if (a < 0 || b < 0) return a < 0 && b < 0;
    const Picture& p = a_.pictures[static_cast<std::size_t>(a)];
    const Picture& q = b_.pictures[static_cast<std::size_t>(b)];
    if (p.film || q.film)
      return p.film == q.film &&
             std::filesystem::weakly_canonical(p.file) == std::filesystem::weakly_canonical(q.file);
    const Image one = pixels(p), other = pixels(q);
    return one.width() == other.width() && one.height() == other.height() && one.type() == other.type() &&
           one.channels() == other.channels() && std::ranges::equal(one.bytes(), other.bytes());
  }

  static Image pixels(const Picture& picture) {
    if (picture.pixels != nullptr) return *picture.pixels;
    const Result<Image> image =
        picture.file.empty() ? decode_image(picture.encoded, picture.name) : read_image(picture.file);
    return image ? *image : Image();
  }

  void compare_texture(const std::string& place, const Texture& a, const Texture& b) {
    check(place, same_picture(a.picture, b.picture) && a.sampler == b.sampler && a.uv_set == b.uv_set &&
                     a.uv_from_mesh_uv == b.uv_from_mesh_uv);
  }

  void compare_materials(const std::string& at, const Material& a, const Material& b) {
    check(at + ".name", a.name == b.name);
    check(at + ".base_color", a.base_color == b.base_color);
    compare_texture(at + ".base_color_texture", a.base_color_texture, b.base_color_texture);
    check(at + ".metallic", a.metallic == b.metallic && a.roughness == b.roughness);
    compare_texture(at + ".metallic_roughness_texture", a.metallic_roughness_texture,
                    b.metallic_roughness_texture);
    compare_texture(at + ".normal_texture", a.normal_texture, b.normal_texture);
    check(at + ".normal_scale", !a.normal_texture.is_set() || a.normal_scale == b.normal_scale);
    compare_texture(at + ".occlusion_texture", a.occlusion_texture, b.occlusion_texture);
    check(at + ".occlusion_strength",
          !a.occlusion_texture.is_set() || a.occlusion_strength == b.occlusion_strength);
    check(at + ".emissive", a.emissive == b.emissive);
    compare_texture(at + ".emissive_texture", a.emissive_texture, b.emissive_texture);
    check(at + ".alpha_mode", a.alpha_mode == b.alpha_mode);
    check(at + ".alpha_cutoff", a.alpha_mode != AlphaMode::mask || a.alpha_cutoff == b.alpha_cutoff);
    check(at + ".double_sided", a.double_sided == b.double_sided && a.unlit == b.unlit);
    compare_lobes(at + ".lobes.", a.lobes == nullptr ? MaterialLobes() : *a.lobes,
                  b.lobes == nullptr ? MaterialLobes() : *b.lobes);
  }

  void compare_lobes(const std::string& at, const MaterialLobes& a, const MaterialLobes& b) {
    for (const LobeFactor& factor : lobe_factors())
      check(at + std::string(factor.field), std::ranges::equal(factor.of(a), factor.of(b)));
    for (std::size_t i = 0; i < kLobeTextures; ++i)
      compare_texture(at + std::string(lobe_textures()[i].field), *textures_of(a)[i], *textures_of(b)[i]);
  }

  void compare_meshes(const std::string& at, const Mesh& a, const Mesh& b) {
    check(at + ".name", a.name == b.name);
    compare_all(at + ".primitives", a.primitives, b.primitives, &Comparison::compare_primitives);
  }

  void compare_primitives(const std::string& at, const Primitive& a, const Primitive& b) {
    check(at + ".positions", a.positions == b.positions);
    check(at + ".normals", a.normals == b.normals);
    check(at + ".tangents", a.tangents == b.tangents);
    check(at + ".uv", a.uv == b.uv);
    check(at + ".colors", a.colors == b.colors);
    check(at + ".indices", a.indices == b.indices);
    check(at + ".material", a.material == b.material);
  }

  void compare_projections(const std::string& at, const Projection& a, const Projection& b) {
    check(at + ".projection", a.is_orthographic == b.is_orthographic && a.left == b.left &&
                                  a.right == b.right && a.bottom == b.bottom && a.top == b.top &&
                                  a.near == b.near && a.far == b.far);
  }

  void compare_cameras(const std::string& at, const Camera& a, const Camera& b) {
    check(at + ".name", a.name == b.name);
    compare_projections(at, a.projection, b.projection);
    check(at + ".aspect_from_picture", a.aspect_from_picture == b.aspect_from_picture);
  }

  static bool same_lamp(const LightDistribution* a, const LightDistribution* b) {
    if (a == nullptr || b == nullptr) return a == b;
    return a->type == b->type && a->vertical_deg == b->vertical_deg &&
           a->horizontal_deg == b->horizontal_deg && a->candela == b->candela &&
           a->rated_lumens == b->rated_lumens && a->opening_m == b->opening_m && a->watts == b->watts &&
           a->tilt == b->tilt && a->luminaire == b->luminaire;
  }

  void compare_lights(const std::string& at, const Light& a, const Light& b) {
    check(at + ".name", a.name == b.name);
    check(at + ".type", a.type == b.type);
    check(at + ".enabled", a.enabled == b.enabled);
    check(at + ".color", a.color == b.color);
    check(at + ".intensity", a.intensity == b.intensity);
    check(at + ".lumens", a.lumens == b.lumens);
    check(at + ".distribution", same_lamp(a.distribution.get(), b.distribution.get()));
    check(at + ".attenuation", a.attenuation == b.attenuation);
    check(at + ".range", a.range == b.range);
    check(at + ".cones", a.inner_cone == b.inner_cone && a.outer_cone == b.outer_cone);
    if (has_frustum(a)) compare_projections(at, a.projection, b.projection);
    check(at + ".aspect_from_slide", a.aspect_from_slide == b.aspect_from_slide);
    check(at + ".slide", same_picture(a.slide, b.slide) && a.slide_is_intensity == b.slide_is_intensity);
    check(at + ".profile", a.profile == b.profile);
    check(at + ".outside", a.outside == b.outside);
    check(at + ".blend", a.blend == b.blend);
    check(at + ".black_level", a.black_level == b.black_level);
    check(at + ".panel", a.panel_width == b.panel_width && a.panel_height == b.panel_height);
    check(at + ".distortion", a.distortion == b.distortion);
    check(at + ".aperture",
          a.aperture.radius == b.aperture.radius && a.aperture.focal_distance == b.aperture.focal_distance);
    check(at + ".fit", a.fit == b.fit);
    check(at + ".source", a.source.radius == b.source.radius && a.source.width == b.source.width &&
                              a.source.height == b.source.height &&
                              a.source.angular_diameter == b.source.angular_diameter);
    check(at + ".shadow", a.shadow == b.shadow);
  }

  // Signs of zeros, too, but in the last row, which is 0 0 0 1 whatever a file says.
  static bool same_place(const glm::dmat4& a, const glm::dmat4& b) {
    bool is_same = a == b;
    for (int column = 0; column < 4; ++column)
      is_same &= std::memcmp(&a[column], &b[column], sizeof(glm::dvec3)) == 0;
    return is_same;
  }

  void compare_nodes(const std::string& at, const Node& a, const Node& b) {
    check(at + ".name", a.name == b.name);
    check(at + ".parent", a.parent == b.parent);
    check(at + ".parent_from_node", same_place(a.parent_from_node, b.parent_from_node));
    check(at + ".refers to", a.mesh == b.mesh && a.camera == b.camera && a.light == b.light);
    check(at + ".node_from_instance", a.node_from_instance == b.node_from_instance);
    check(at + ".flags", a.casts_shadow == b.casts_shadow && a.receives_shadow == b.receives_shadow &&
                             a.visible == b.visible);
  }

  const Scene& a_;
  const Scene& b_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> differences(const Scene& a, const Scene& b) { return Comparison(a, b).run(); }

}  // namespace laterna::reference
