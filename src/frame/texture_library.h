// Every picture of a scene, decoded once and prepared for look-ups.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "base/task_pool.h"
#include "frame/relief_field.h"
#include "image/mip_chain.h"
#include "laterna/relief.h"
#include "laterna/scene.h"

namespace laterna::image {
class Film;
struct FilmFrame;
}  // namespace laterna::image

namespace laterna::frame {

/// Whether it is more than flat.
bool has_relief(const Material& material);

class TextureLibrary {
 public:
  /// Decodes the pictures that materials and lights use, in parallel, each once however often it is used.
  /// Errors of all pictures are collected.
  static Result<TextureLibrary> load(const Scene& scene, const TaskPool& pool,
                                     InstructionSet set = best_instruction_set());

  /// Null where `picture` is −1 or was not asked for with this use. Of a film: the frame shown now, until the next show().
  [[nodiscard]] const image::MipChain* find(int picture, image::MipUse use) const;

  /// The heights of a material's relief that is not flat.
  [[nodiscard]] const ReliefField* find_relief(const Relief& relief) const;

  /// Every film's frame at a scene time. Returns how many films show another than before. After an error, collected from all
  /// films, all show what they did.
  Result<int> show(double scene_time);
  /// Of films that end early.
  [[nodiscard]] const std::vector<Diagnostic>& warnings() const { return warnings_; }

 private:
  friend class TextureLoading;
  struct ShownFilm {
    std::shared_ptr<image::Film> film;
    std::shared_ptr<const image::FilmFrame> frame;
  };
  std::map<std::pair<int, image::MipUse>, std::unique_ptr<image::MipChain>> chains_;  // of stills
  std::map<int, ShownFilm> films_;                                                    // by picture
  // What a picture is made into for a relief.
  struct ReliefUse {
    ReliefKind kind;
    Wrap wrap_u, wrap_v;
    auto operator<=>(const ReliefUse&) const = default;
  };
  std::map<std::pair<int, ReliefUse>, std::shared_ptr<const ReliefField>> reliefs_;
  std::vector<Diagnostic> warnings_;
};

/// The same as tasks, for whoever has others to do at the same time.
class TextureLoading {
 public:
  /// The scene must outlive this. Films show their frame of `scene_time`.
  TextureLoading(const Scene& scene, InstructionSet set, double scene_time = 0);

  /// One per picture, those that take longest first.
  [[nodiscard]] std::size_t task_count() const { return pictures_.size(); }
  /// Tasks do not depend on one another, and each is run once.
  void run(std::size_t task);
  /// After all tasks.
  Result<TextureLibrary> finish();

 private:
  // With all its uses: decoded once, then made into as many chains as there are uses.
  struct UsedPicture {
    int index;
    std::vector<image::MipUse> uses;
    std::vector<TextureLibrary::ReliefUse> relief_uses;
    std::uintmax_t encoded_bytes;
    std::vector<Diagnostic> faults;
  };

  void add_reliefs();
  UsedPicture& picture_at(int index);
  void make_reliefs(UsedPicture& used, const Image& picture);
  void open_film(UsedPicture& used, const Picture& picture);

  const Scene& scene_;
  InstructionSet set_;
  double scene_time_;
  std::vector<UsedPicture> pictures_;
  TextureLibrary library_;
};

/// How a material's base colour is kept: with alpha only where alpha is looked at.
image::MipUse base_color_use(const Material& material);
/// Textures and slides that layers of surfaces show.
inline constexpr image::MipUse kLayerUse = image::MipUse::colour_with_alpha;
/// A slide is colour; an intensity map is numbers.
image::MipUse slide_use(const Light& light);

}  // namespace laterna::frame
