#include "scene/assimp_reader.h"

#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <exception>
#include <map>
#include <system_error>

#include "base/elementary.h"
#include "base/file_io.h"
#include "base/lower_case.h"
#include "scene/assimp_files.h"
#include "scene/assimp_materials.h"
#include "scene/fault_list.h"
#include "scene/md2_frames.h"
#include "scene/ply_header.h"
#include "scene/spelling.h"
#include "scene/surface_attributes.h"
#include "scene/vertex_joining.h"

namespace laterna {
namespace {

std::string lower_case_ending(const std::filesystem::path& file) {
  return lower_case(file.extension().string());
}

glm::dmat4 to_matrix(const aiMatrix4x4& m) {
  return {glm::dvec4(m.a1, m.b1, m.c1, 0), glm::dvec4(m.a2, m.b2, m.c2, 0), glm::dvec4(m.a3, m.b3, m.c3, 0),
          glm::dvec4(m.a4, m.b4, m.c4, 1)};
}

// Y-up metres from the file's own axes and units.
glm::dmat4 scene_from_file(const std::filesystem::path& file, const LoadOptions& options) {
  const std::string ending = lower_case_ending(file);
  glm::dmat4 matrix(1.0);
  if (ending == ".dae" || ending == ".fbx") return matrix;
  if (options.up == LoadOptions::Up::z && ending != ".md2") {
    matrix[1] = glm::dvec4(0, 0, -1, 0);
    matrix[2] = glm::dvec4(0, 1, 0, 0);
  }
  for (int i = 0; i < 3; ++i) matrix[i] = matrix[i] * options.metres_per_unit;
  return matrix;
}

class SceneConverter {
 public:
  SceneConverter(const aiScene& source, const std::filesystem::path& file, bool library_is_missing,
                 FaultList& faults)
      : source_(source), file_(file), faults_(faults), materials_(source, file, library_is_missing, faults) {
    for (std::size_t i = 0; i < srgb_.size(); ++i)
      srgb_[i] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / 255));
  }

  Scene convert(const glm::dmat4& root_matrix) {
    add_nodes(root_matrix);
    report_left_out();
    scene_.materials = materials_.take_materials();
    scene_.pictures = materials_.take_pictures();
    return std::move(scene_);
  }

 private:
  void add_nodes(const glm::dmat4& root_matrix) {
    struct Pending {
      const aiNode* node;
      int parent;
    };
    Node top;
    top.name = file_.filename().string();
    top.parent_from_node = root_matrix;
    scene_.nodes.push_back(std::move(top));
    std::vector<Pending> pending;
    if (source_.mRootNode != nullptr) pending.push_back({source_.mRootNode, 0});
    while (!pending.empty()) {  // files may nest deeper than a stack
      const Pending next = pending.back();
      pending.pop_back();
      Node node;
      node.name = next.node->mName.C_Str();
      node.parent = next.parent;
      node.parent_from_node = to_matrix(next.node->mTransformation);
      node.mesh = mesh_of(*next.node);
      const auto index = static_cast<int>(scene_.nodes.size());
      scene_.nodes.push_back(std::move(node));
      for (unsigned i = next.node->mNumChildren; i > 0; --i)
        pending.push_back({next.node->mChildren[i - 1], index});
    }
  }

  int mesh_of(const aiNode& node) {
    if (node.mNumMeshes == 0) return -1;
    const std::vector<unsigned> parts(node.mMeshes, node.mMeshes + node.mNumMeshes);
    const auto [known, is_new] = mesh_of_parts_.try_emplace(parts, -1);
    if (!is_new) return known->second;
    Mesh mesh;
    for (const unsigned part : parts) {
      if (part >= source_.mNumMeshes) continue;
      const aiMesh& source = *source_.mMeshes[part];
      if (mesh.name.empty()) mesh.name = source.mName.C_Str();
      if (std::optional<Primitive> primitive = convert_mesh(source, part))
        mesh.primitives.push_back(std::move(*primitive));
    }
    if (mesh.primitives.empty()) return -1;
    known->second = static_cast<int>(scene_.meshes.size());
    scene_.meshes.push_back(std::move(mesh));
    return known->second;
  }

  std::optional<Primitive> convert_mesh(const aiMesh& source, unsigned index) {
    const std::string place = fmt::format(
        "mesh {}{}", index, source.mName.length == 0 ? "" : " " + in_quotes(source.mName.C_Str()));
    if ((source.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) {
      points_and_lines_ += source.mNumFaces > 0 ? source.mNumFaces : source.mNumVertices;
      return std::nullopt;
    }
    Primitive primitive;
    if (!copy_triangles(source, primitive, place) || !copy_vertices(source, primitive, place))
      return std::nullopt;
    primitive.material = materials_.use(source.mMaterialIndex);
    // The frames of an MD2 would each join differently; its vertices keep their order for blending.
    if (lower_case_ending(file_) != ".md2") join_identical_vertices(primitive);
    const Material* material = primitive.material < 0 ? nullptr : &materials_[primitive.material];
    complete_attributes(primitive, material, Angle::degrees(kCreaseDegrees), place, faults_);
    return primitive;
  }

  bool copy_triangles(const aiMesh& source, Primitive& primitive, const std::string& place) {
    primitive.indices.reserve(std::size_t{source.mNumFaces} * 3);
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
      const aiFace& face = source.mFaces[f];
      if (face.mNumIndices != 3) continue;  // Assimp leaves what it cannot cut into triangles
      for (unsigned corner = 0; corner < 3; ++corner) {
        if (face.mIndices[corner] >= source.mNumVertices) {
          faults_.error(place, fmt::format("face {} refers to vertex {} of {}", f, face.mIndices[corner],
                                           source.mNumVertices));
          return false;
        }
        primitive.indices.push_back(face.mIndices[corner]);
      }
    }
    return !primitive.indices.empty();
  }

  bool copy_vertices(const aiMesh& source, Primitive& primitive, const std::string& place) {
    const unsigned count = source.mNumVertices;
    const auto to_vec3 = [](const aiVector3D& v) { return glm::vec3(v.x, v.y, v.z); };
    primitive.positions.reserve(count);
    for (unsigned i = 0; i < count; ++i) primitive.positions.push_back(to_vec3(source.mVertices[i]));
    if (source.HasNormals()) {
      primitive.normals.reserve(count);
      for (unsigned i = 0; i < count; ++i)
        primitive.normals.push_back(finite_or_zero(to_vec3(source.mNormals[i])));
    }
    for (unsigned set = 0; set < 2; ++set) {
      if (!source.HasTextureCoords(set)) continue;
      primitive.uv[set].reserve(count);
      for (unsigned i = 0; i < count; ++i) {
        primitive.uv[set].emplace_back(source.mTextureCoords[set][i].x, source.mTextureCoords[set][i].y);
      }
    }
    if (source.HasVertexColors(0)) {
      primitive.colors.reserve(count);
      for (unsigned i = 0; i < count; ++i) primitive.colors.push_back(linear_color(source.mColors[0][i]));
    }
    return positions_are_finite(primitive, place);
  }

  bool positions_are_finite(const Primitive& primitive, const std::string& place) {
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
      const glm::vec3 p = primitive.positions[i];
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
      faults_.error(place, fmt::format("vertex {} is not finite: ({}, {}, {})", i, p.x, p.y, p.z));
      return false;
    }
    return true;
  }

  // Files with NaN for the normals of degenerate faces are common; the surface's own replace them later.
  static glm::vec3 finite_or_zero(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) ? v : glm::vec3(0);
  }

  // Most colours are bytes, for which the curve is tabulated.
  [[nodiscard]] float linear(float srgb) const {
    const float level = srgb * 255;
    const float nearest = std::nearbyint(level);
    if (nearest >= 0 && nearest <= 255 && std::abs(level - nearest) < 1e-3F)
      return srgb_[static_cast<std::size_t>(nearest)];
    return static_cast<float>(linear_from_srgb(std::max(0.0F, srgb)));
  }

  [[nodiscard]] glm::vec4 linear_color(const aiColor4D& c) const {
    return {linear(c.r), linear(c.g), linear(c.b), c.a};
  }

  void report_left_out() {
    if (points_and_lines_ > 0) {
      faults_.warning({}, fmt::format("{} points and lines are not drawn: left out", points_and_lines_));
    }
    if (source_.mNumLights > 0 || source_.mNumCameras > 0) {
      faults_.warning({}, fmt::format("{} lights and {} cameras are left out: only glTF's are read",
                                      source_.mNumLights, source_.mNumCameras));
    }
    if (scene_.meshes.empty() && !faults_.has_errors()) {
      faults_.error({}, points_and_lines_ == 0
                            ? "holds no triangles"
                            : fmt::format("holds no triangles, only {} points and lines", points_and_lines_));
    }
  }

  const aiScene& source_;
  const std::filesystem::path& file_;
  FaultList& faults_;
  AssimpMaterials materials_;
  std::map<std::vector<unsigned>, int> mesh_of_parts_;
  std::size_t points_and_lines_ = 0;
  std::array<float, 256> srgb_{};
  Scene scene_;
};

// What Assimp's later steps take for granted, and what cut files break: every face has its indices, and they name
// vertices. An empty string where it holds.
std::string find_fault(const aiScene& source) {
  for (unsigned m = 0; m < source.mNumMeshes; ++m) {
    const aiMesh& mesh = *source.mMeshes[m];
    if ((mesh.mNumVertices > 0 && mesh.mVertices == nullptr) ||
        (mesh.mNumFaces > 0 && mesh.mFaces == nullptr))
      return fmt::format("mesh {} lacks its vertices or faces", m);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices > 0 && face.mIndices == nullptr)
        return fmt::format("face {} lacks its indices", f);
      for (unsigned corner = 0; corner < face.mNumIndices; ++corner) {
        if (face.mIndices[corner] < mesh.mNumVertices) continue;
        return fmt::format("face {} refers to vertex {} of {}", f, face.mIndices[corner], mesh.mNumVertices);
      }
    }
  }
  return {};
}

// The vertices of an MD2's frame, in the order of faces that all frames share. Empty where it cannot be read, which is told.
VertexFrame read_vertex_frame(const std::filesystem::path& file, std::size_t frame, std::size_t vertices,
                              FaultList& faults) {
  Assimp::Importer importer;
  MaterialLibraries libraries;
  importer.SetIOHandler(new AssimpFiles(libraries));  // the importer owns it
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_MD2_KEYFRAME, static_cast<int>(frame));
  const aiScene* source = importer.ReadFile(file.string(), 0);
  const std::string place = fmt::format("frame {}", frame + 1);
  if (source == nullptr || source->mNumMeshes != 1 || source->mMeshes[0]->mNumVertices != vertices) {
    faults.error(place, source == nullptr ? fmt::format("cannot be read: {}", importer.GetErrorString())
                                          : std::string("has not the vertices of the first frame"));
    return {};
  }
  const aiMesh& mesh = *source->mMeshes[0];
  VertexFrame read;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D p = mesh.mVertices[i], n = mesh.HasNormals() ? mesh.mNormals[i] : aiVector3D(0, 0, 1);
    read.positions.emplace_back(p.x, p.y, p.z);
    read.normals.emplace_back(n.x, n.y, n.z);
    if (!std::isfinite(p.x + p.y + p.z + n.x + n.y + n.z)) {
      faults.error(place, fmt::format("vertex {} is not finite: ({}, {}, {})", i, p.x, p.y, p.z));
      return {};
    }
  }
  return read;
}

void add_md2_frames(Scene& scene, const std::filesystem::path& file, std::span<const std::string> names,
                    FaultList& faults) {
  if (names.size() < 2 || scene.meshes.size() != 1 || scene.meshes[0].primitives.size() != 1) return;
  const std::size_t vertices = scene.meshes[0].primitives[0].positions.size();
  if (names.size() > kMaxMorphTargets || names.size() * vertices > kMaxMorphedVertices) {
    faults.error({}, fmt::format("{} frames of {} vertices are more than {} frames or {} vertices in all",
                                 names.size(), vertices, kMaxMorphTargets, kMaxMorphedVertices));
    return;
  }
  std::vector<VertexFrame> frames;
  for (std::size_t i = 0; i < names.size() && !faults.has_errors(); ++i)
    frames.push_back(read_vertex_frame(file, i, vertices, faults));
  if (!faults.has_errors()) add_vertex_frames(scene, 0, frames, find_frame_runs(names));
}

Result<Scene> import(Assimp::Importer& importer, const std::filesystem::path& file,
                     const LoadOptions& options) {
  FaultList faults(file.string());
  std::vector<std::string> frame_names;
  if (lower_case_ending(file) == ".md2") {
    const Result<std::vector<std::byte>> bytes = read_file(file);
    if (!bytes) return tl::unexpected(bytes.error());
    Result<std::vector<std::string>> names = read_md2_frame_names(*bytes, file.string());
    if (!names) return tl::unexpected(std::move(names.error()));
    frame_names = std::move(*names);
  }
  MaterialLibraries libraries;
  importer.SetIOHandler(new AssimpFiles(libraries));  // the importer owns it
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_GLOBAL_KEYFRAME, 0);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                                                          aiComponent_TANGENTS_AND_BITANGENTS);
  const unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_RemoveComponent |
                         aiProcess_FlipUVs | (lower_case_ending(file) == ".fbx" ? aiProcess_GlobalScale : 0U);
  const aiScene* source = importer.ReadFile(file.string(), 0);
  std::string fault = source == nullptr ? importer.GetErrorString() : find_fault(*source);
  if (fault.empty()) {
    source = importer.ApplyPostProcessing(steps);
    if (source == nullptr) fault = importer.GetErrorString();
  }
  if (!fault.empty()) {
    faults.error({}, fmt::format("cannot be read: {}", fault));
    return tl::unexpected(Error(Failure::bad_input, faults.errors()));
  }
  // Where the named library is missing Assimp also tries one called like the model: that one was never asked
  // for.
  std::filesystem::path guessed = file;
  guessed.replace_extension(".mtl");
  if (libraries.missing.size() > 1 || libraries.any_was_read) libraries.missing.erase(guessed.string());
  for (const std::string& library : libraries.missing) {
    faults.warning({}, fmt::format("material library not found (tried {}): its surfaces are white",
                                   path_in_quotes(library)));
  }
  SceneConverter converter(*source, file, !libraries.missing.empty() && !libraries.any_was_read, faults);
  Scene scene = converter.convert(scene_from_file(file, options));
  if (!faults.has_errors()) add_md2_frames(scene, file, frame_names, faults);
  if (faults.has_errors()) return tl::unexpected(Error(Failure::bad_input, faults.errors()));
  scene.warnings = faults.warnings();
  return scene;
}

}  // namespace

bool can_read_mesh_file(const std::filesystem::path& file) {
  const std::string ending = lower_case_ending(file);
  return !ending.empty() && Assimp::Importer().IsExtensionSupported(ending);
}

Result<Scene> read_mesh_file(const std::filesystem::path& file, const LoadOptions& options) {
  const auto fault = [&](std::string message) {
    return tl::unexpected(Error(Failure::bad_input, Diagnostic{file.string(), {}, std::move(message)}));
  };
  std::error_code problem;
  const std::uintmax_t size = std::filesystem::file_size(file, problem);
  if (problem) return fault("cannot be read: " + problem.message());
  if (size > kMaxMeshFileBytes)
    return fault(fmt::format("{} bytes are more than {}", size, kMaxMeshFileBytes));
  if (lower_case_ending(file) == ".ply") {
    if (Result<void> checked = check_ply_header(file, size); !checked)
      return tl::unexpected(std::move(checked.error()));
  }
  try {
    Assimp::Importer importer;
    return import(importer, file, options);
  } catch (const std::exception& exception) {
    return fault(fmt::format("cannot be read: {}", exception.what()));
  }
}

}  // namespace laterna
