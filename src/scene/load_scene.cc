#include <fmt/format.h>

#include <exception>
#include <string>
#include <system_error>

#include "base/file_io.h"
#include "base/lower_case.h"
#include "laterna/scene.h"
#include "scene/assimp_reader.h"
#include "scene/gltf_reader.h"
#include "scene/merge.h"
#include "scene/rig_reader.h"

namespace laterna {
namespace {

bool has_ending(const std::filesystem::path& file, std::string_view ending) {
  return lower_case(file.extension().string()) == ending;
}

bool is_rig(const std::filesystem::path& file) { return has_ending(file, ".json"); }

bool is_gltf(const std::filesystem::path& file) {
  return has_ending(file, ".gltf") || has_ending(file, ".glb");
}

tl::unexpected<Error> fault(const std::filesystem::path& file, std::string message) {
  return tl::unexpected(Error(Failure::bad_input, Diagnostic{file.string(), {}, std::move(message)}));
}

class SceneLoader {
 public:
  explicit SceneLoader(const LoadOptions& options) : options_(options) {}

  void add(const std::filesystem::path& file) { keep_faults(is_rig(file) ? try_rig(file) : try_scene(file)); }
  void add_rig(const std::filesystem::path& file) { keep_faults(try_rig(file)); }

  // What rigs change is changed once every file is there, in whatever order they were named.
  Result<Scene> finish(const std::string& file) {
    if (faults_.empty()) merger_.apply(overrides_, faults_);
    if (faults_.empty()) merger_.apply(surfaces_, faults_);
    if (!faults_.empty()) return tl::unexpected(Error(Failure::bad_input, std::move(faults_)));
    Scene scene = merger_.take();
    std::vector<Diagnostic> faults = validate(scene);
    if (faults.empty()) return scene;
    for (Diagnostic& diagnostic : faults) diagnostic.file = file;
    return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  }

 private:
  void keep_faults(const Result<void>& added) {
    if (added) return;
    const std::vector<Diagnostic>& found = added.error().diagnostics;
    faults_.insert(faults_.end(), found.begin(), found.end());
  }

  Result<void> try_rig(const std::filesystem::path& file) {
    const Result<std::vector<std::byte>> bytes = read_file(file);
    if (!bytes) return tl::unexpected(bytes.error());
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    Result<Rig> rig = read_rig(text, file.string(), file.parent_path());
    if (!rig) return tl::unexpected(std::move(rig.error()));
    keep_surfaces(std::move(rig->surfaces), merger_.add(std::move(rig->scene), file.string()));
    overrides_.insert(overrides_.end(), rig->overrides.begin(), rig->overrides.end());
    return {};
  }

  void keep_surfaces(std::vector<SurfaceOverride> surfaces, const MergedIndices& merged) {
    for (SurfaceOverride& surface : surfaces) {
      for (auto& [layer, slide, slide_place, texture_place] : surface.layers) {
        if (layer.texture.is_set())
          layer.texture.picture = merged.pictures[static_cast<std::size_t>(layer.texture.picture)];
        if (layer.projector >= 0) layer.projector += merged.first_light;
      }
      if (surface.relief) {
        int& picture = surface.relief->texture.picture;
        picture = merged.pictures[static_cast<std::size_t>(picture)];
      }
      surfaces_.push_back(std::move(surface));
    }
  }

  Result<void> try_scene(const std::filesystem::path& file) {
    Result<Scene> scene = read(file);
    if (!scene) return tl::unexpected(std::move(scene.error()));
    merger_.add(std::move(*scene), file.string());
    return {};
  }

  Result<Scene> read(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return fault(file, "no such file");
    if (!std::filesystem::is_regular_file(file, ignored)) return fault(file, "is no regular file");
    if (is_gltf(file)) {
      const auto source = ByteSource::open(file);
      if (!source) return fault(file, source.error());
      return read_gltf(*source, file.string(), file.parent_path());
    }
    if (can_read_mesh_file(file)) return read_mesh_file(file, options_);
    return fault(file, fmt::format("files ending in \"{}\" are not read; expected .gltf, .glb, .obj, .ply, "
                                   ".stl, .md2, or .json for a rig",
                                   file.extension().string()));
  }

  const LoadOptions& options_;
  SceneMerger merger_;
  std::vector<NodeOverride> overrides_;
  std::vector<SurfaceOverride> surfaces_;
  std::vector<Diagnostic> faults_;
};

Result<Scene> load(const std::vector<std::filesystem::path>& files, const LoadOptions& options) {
  if (files.empty() && options.rigs.empty()) {
    return tl::unexpected(Error(Failure::bad_usage, Diagnostic{{}, {}, "no scene file was given"}));
  }
  if (!(options.metres_per_unit > 0) || options.metres_per_unit > kMaxCoordinate) {
    return tl::unexpected(Error(
        Failure::bad_usage,
        Diagnostic{{}, {}, fmt::format("a unit must be longer than 0 m, got {}", options.metres_per_unit)}));
  }
  SceneLoader loader(options);
  for (const std::filesystem::path& file : files) loader.add(file);
  for (const std::filesystem::path& rig : options.rigs) loader.add_rig(rig);
  return loader.finish(files.size() == 1 ? files.front().string() : std::string());
}

}  // namespace

Result<Scene> load_scene(const std::vector<std::filesystem::path>& files, const LoadOptions& options) {
  try {
    return load(files, options);
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error(Failure::bad_input, Diagnostic{{}, {}, "not enough memory for the scene"}));
  } catch (const std::exception& exception) {
    return tl::unexpected(Error(Failure::bad_input, Diagnostic{{}, {}, exception.what()}));
  }
}

}  // namespace laterna
