#include "image/film.h"

#include <algorithm>

#include "base/without_exceptions.h"
#include "image/finite_values.h"

namespace laterna::image {
namespace {

// Times looked at for frames to come: a scene may show each frame many times.
constexpr int kTimesAhead = 64;

}  // namespace

std::size_t FilmFrame::memory_bytes() const {
  std::size_t bytes = 0;
  for (const auto& [use, chain] : chains) bytes += chain.memory_bytes();
  return bytes;
}

Result<std::unique_ptr<Film>> Film::open(const std::filesystem::path& file, const FilmTiming& timing,
                                         std::vector<MipUse> uses, InstructionSet set,
                                         const FilmLimits& limits) {
  OpenedFilm reader = open_film(file, timing.frames_per_second);
  if (!reader) return tl::unexpected(std::move(reader.error()));
  return std::make_unique<Film>(std::move(*reader), file.string(), timing, std::move(uses), set, limits);
}

Film::Film(std::unique_ptr<FrameReader> reader, std::string name, const FilmTiming& timing,
           std::vector<MipUse> uses, InstructionSet set, const FilmLimits& limits)
    : reader_(std::move(reader)),
      name_(std::move(name)),
      timing_(timing),
      uses_(std::move(uses)),
      set_(set),
      limits_(limits) {}

Film::~Film() {
  {
    const std::lock_guard lock(mutex_);
    is_closing_ = true;
  }
  wanted_changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

Film::Prepared Film::prepare_pixels(std::optional<std::size_t> number, const Image& pixels) const {
  if (auto fault = find_not_finite(pixels, name_))
    return tl::unexpected(Error(Failure::bad_input, std::move(*fault)));
  auto frame = std::make_shared<FilmFrame>();
  frame->number = number;
  for (const MipUse use : uses_) frame->chains.emplace(use, make_mip_chain(pixels, use, set_));
  return frame;
}

Film::Prepared Film::prepare(std::size_t number) {
  Error exhausted(Failure::bad_input, Diagnostic{name_, {}, "not enough memory for a frame of the film"});
  return without_exceptions(std::move(exhausted), [&]() -> Prepared {
    const Result<Image> pixels = reader_->read(number);
    if (!pixels) return tl::unexpected(pixels.error());
    return prepare_pixels(number, *pixels);
  });
}

// As large as the film's frames, for a projector's frame is as wide as its slide.
Film::Prepared Film::dark() {
  if (dark_ == nullptr) {
    Prepared made = prepare_pixels(std::nullopt,
                                   Image(header().width, header().height, 3, PixelType::u8, Transfer::srgb));
    if (!made) return made;
    dark_ = std::move(*made);
  }
  return dark_;
}

std::vector<std::size_t> Film::numbers_to_come(std::size_t shown, double scene_time) const {
  std::vector<std::size_t> numbers = {shown};
  const double step = last_time_ ? scene_time - *last_time_ : 0;
  if (step == 0) return numbers;
  for (int i = 1; i <= kTimesAhead && numbers.size() <= limits_.frames_ahead; ++i) {
    const std::optional<std::size_t> number = frame_at(reader_->times(), timing_, scene_time + i * step);
    if (number && std::find(numbers.begin(), numbers.end(), *number) == numbers.end())
      numbers.push_back(*number);
  }
  return numbers;
}

Result<std::shared_ptr<const FilmFrame>> Film::at(double scene_time) {
  const std::optional<std::size_t> number = frame_at(reader_->times(), timing_, scene_time);
  if (!number) {
    last_time_ = scene_time;
    return dark();
  }
  std::unique_lock lock(mutex_);
  wanted_ = numbers_to_come(*number, scene_time);
  last_time_ = scene_time;
  std::erase_if(ready_, [&](const auto& frame) {
    return std::find(wanted_.begin(), wanted_.end(), frame.first) == wanted_.end();
  });
  // Not foreseen, and what was foreseen in its place would be held beside it.
  if (!ready_.contains(*number)) ready_.clear();
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  wanted_changed_.notify_all();
  frame_ready_.wait(lock, [&] { return ready_.contains(*number); });
  return ready_.at(*number);
}

Film::Holding Film::held() const {
  Holding sum;
  for (const auto& [number, frame] : ready_) {
    ++sum.frames;
    if (frame) sum.bytes += (*frame)->memory_bytes();
  }
  return sum;
}

Film::Holding Film::holding() const {
  const std::lock_guard lock(mutex_);
  return held();
}

// The frame that is shown first; those to come as far as memory goes, if they are no larger than those held.
std::optional<std::size_t> Film::next_missing() const {
  if (wanted_.empty()) return std::nullopt;
  if (!ready_.contains(wanted_.front())) return wanted_.front();
  const Holding now = held();
  std::size_t each = 0;
  for (const auto& [number, frame] : ready_) each = std::max(each, frame ? (*frame)->memory_bytes() : 0);
  for (const std::size_t number : wanted_) {
    if (!ready_.contains(number))
      return now.bytes + each <= limits_.bytes ? std::optional(number) : std::nullopt;
  }
  return std::nullopt;
}

void Film::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wanted_changed_.wait(lock, [&] { return is_closing_ || next_missing(); });
    if (is_closing_) return;
    const std::size_t number = *next_missing();
    lock.unlock();
    Prepared frame = prepare(number);
    lock.lock();
    if (std::find(wanted_.begin(), wanted_.end(), number) == wanted_.end()) continue;
    ready_.emplace(number, std::move(frame));
    frame_ready_.notify_all();
  }
}

}  // namespace laterna::image
