#include "scene/md2_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include "scene/unique_names.h"

namespace laterna {
namespace {

constexpr std::uint32_t kMagic = 0x32504449;  // "IDP2"
constexpr std::size_t kHeaderBytes = 68, kNameBytes = 16, kNameAt = 24, kVertexBytes = 4;
// Places of numbers in the header.
constexpr std::size_t kFrameSizeAt = 16, kVertexCountAt = 24, kFrameCountAt = 40, kFramesAt = 56;

std::uint32_t number_at(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof(value));
  return value;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

struct NumberedFrame {
  std::string letters, digits;
  std::size_t number = 0;
};

NumberedFrame split(const std::string& name) {
  std::size_t end = name.size();
  while (end > 0 && is_digit(name[end - 1])) --end;
  NumberedFrame split{name.substr(0, end), name.substr(end), 0};
  for (const char c : split.digits) split.number = split.number * 10 + static_cast<std::size_t>(c - '0');
  return split;
}

// "death" of death_1, "swim" of swim-01.
std::string without_separators(std::string letters) {
  while (!letters.empty() && (letters.back() == '_' || letters.back() == '-' || letters.back() == ' '))
    letters.pop_back();
  return letters;
}

std::vector<glm::vec3> differences(const std::vector<glm::vec3>& to, const std::vector<glm::vec3>& from) {
  std::vector<glm::vec3> all(to.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = to[i] - from[i];
  return all;
}

// A frame's weight is 1 at its key; the first frame's is 1 where all others are 0.
Clip make_clip(const FrameRun& run, std::size_t frame_count, std::span<const int> nodes) {
  Clip clip;
  clip.name = run.name;
  KeyFrames keys;
  const std::size_t targets = frame_count - 1;
  for (std::size_t i = 0; i <= run.count; ++i) {
    const std::size_t frame = run.first + (i == run.count ? 0 : i);
    keys.times.push_back(static_cast<double>(i) / kMd2FramesPerSecond);
    for (std::size_t t = 0; t < targets; ++t) keys.values.push_back(t + 1 == frame ? 1 : 0);
  }
  clip.keys.push_back(std::move(keys));
  for (const int node : nodes) {
    ClipChannel channel;
    channel.property = AnimatedProperty::weights;
    channel.target = node;
    channel.keys = 0;
    clip.channels.push_back(channel);
  }
  return clip;
}

}  // namespace

Result<std::vector<std::string>> read_md2_frame_names(std::span<const std::byte> bytes,
                                                      const std::string& file) {
  const auto fault = [&](std::size_t at, std::string message) {
    return tl::unexpected(
        Error(Failure::bad_input, Diagnostic{file, fmt::format("byte {}", at), std::move(message)}));
  };
  std::vector<std::string> names;
  if (bytes.size() < 4 || number_at(bytes, 0) != kMagic) return names;
  if (bytes.size() < kHeaderBytes) return fault(bytes.size(), "the file ends here, inside its header");
  const std::uint64_t frame_size = number_at(bytes, kFrameSizeAt),
                      vertices = number_at(bytes, kVertexCountAt);
  const std::uint64_t count = number_at(bytes, kFrameCountAt), first = number_at(bytes, kFramesAt);
  const std::uint64_t least = kNameAt + kNameBytes + kVertexBytes * vertices;
  if (frame_size < least) {
    return fault(kFrameSizeAt, fmt::format("a frame of {} vertices takes {} bytes, but the header says {}",
                                           vertices, least, frame_size));
  }
  if (first > bytes.size() || (bytes.size() - first) / frame_size < count) {
    const std::uint64_t whole = first > bytes.size() ? 0 : (bytes.size() - first) / frame_size;
    return fault(bytes.size(), fmt::format("the file ends here, inside frame {} of {}", whole + 1, count));
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto* name = reinterpret_cast<const char*>(bytes.data() + first + i * frame_size + kNameAt);
    names.emplace_back(name, std::find(name, name + kNameBytes, '\0'));
  }
  return names;
}

std::vector<FrameRun> find_frame_runs(std::span<const std::string> names) {
  struct Run {
    NumberedFrame first;
    std::size_t begin, count;
  };
  std::vector<Run> runs;
  std::map<std::string, int> runs_of_letters;
  for (std::size_t i = 0; i < names.size(); ++i) {
    NumberedFrame frame = split(names[i]);
    frame.letters = without_separators(frame.letters);
    if (!runs.empty() && runs.back().first.letters == frame.letters &&
        runs.back().first.number + runs.back().count == frame.number) {
      ++runs.back().count;
      continue;
    }
    ++runs_of_letters[frame.letters];
    runs.push_back({std::move(frame), i, 1});
  }
  std::vector<FrameRun> found;
  UniqueNames taken;
  for (const Run& run : runs) {
    std::string name = run.first.letters.empty() ? "clip" : run.first.letters;
    const std::string& digits = run.first.digits;
    if (runs_of_letters[run.first.letters] > 1 && digits.size() > 2)
      name += digits.substr(0, digits.size() - 2);
    found.push_back({taken.take(name), run.begin, run.count});
  }
  return found;
}

void add_vertex_frames(Scene& scene, int mesh, std::span<const VertexFrame> frames,
                       std::span<const FrameRun> runs) {
  if (frames.size() < 2) return;
  Primitive& primitive = scene.meshes[static_cast<std::size_t>(mesh)].primitives.front();
  for (const VertexFrame& frame : frames.subspan(1)) {
    MorphTarget& target = primitive.targets.emplace_back();
    target.positions = differences(frame.positions, frames.front().positions);
    if (!primitive.normals.empty()) target.normals = differences(frame.normals, primitive.normals);
  }
  std::vector<int> nodes;
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (scene.nodes[n].mesh == mesh) nodes.push_back(static_cast<int>(n));
  }
  for (const FrameRun& run : runs) {
    Clip clip = make_clip(run, frames.size(), nodes);
    clip.plays = scene.clips.empty();
    scene.clips.push_back(std::move(clip));
  }
}

}  // namespace laterna
