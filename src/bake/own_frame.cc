#include "bake/own_frame.h"

#include "frame/cluster_builder.h"
#include "frame/texture_library.h"

namespace laterna::bake {

Result<std::unique_ptr<OwnFrame>> make_frame(const Scene& scene, double time, InstructionSet set,
                                             const TaskPool& pool) {
  frame::TextureLoading pictures(scene, set, time);
  pool.for_each(pictures.task_count(), [&](std::size_t task, int) { pictures.run(task); });
  Result<frame::TextureLibrary> library = pictures.finish();
  if (!library) return tl::unexpected(std::move(library.error()));
  auto own = std::make_unique<OwnFrame>();
  own->meshes = frame::build_clusters(scene, pool);
  Result<frame::Frame> built = frame::Frame::build(
      scene, std::make_shared<const frame::TextureLibrary>(std::move(*library)), own->meshes, pool);
  if (!built) return tl::unexpected(std::move(built.error()));
  own->frame = std::move(*built);
  return own;
}

}  // namespace laterna::bake
