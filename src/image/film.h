// A film, frame by frame at scene times, each made ready for look-ups.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "image/frame_reader.h"
#include "image/mip_chain.h"

namespace laterna::image {

/// A frame in every form that it is used in.
struct FilmFrame {
  std::optional<std::size_t> number;  ///< nothing: it is dark
  std::map<MipUse, MipChain> chains;

  [[nodiscard]] std::size_t memory_bytes() const;
};

/// What a film may hold beside the frame that is shown.
struct FilmLimits {
  std::size_t frames_ahead = kMaxFramesAhead;
  std::size_t bytes = kMaxFilmMemory;  ///< of all frames held; the one that is shown is there in any case
};

class Film {
 public:
  /// `file`: see read_film_header(). `uses`: at least one. Errors name the file.
  static Result<std::unique_ptr<Film>> open(const std::filesystem::path& file, const FilmTiming& timing,
                                            std::vector<MipUse> uses, InstructionSet set,
                                            const FilmLimits& limits = {});
  Film(std::unique_ptr<FrameReader> reader, std::string name, const FilmTiming& timing,
       std::vector<MipUse> uses, InstructionSet set, const FilmLimits& limits = {});
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  [[nodiscard]] const FilmHeader& header() const { return reader_->header(); }
  [[nodiscard]] const std::vector<Diagnostic>& warnings() const { return reader_->warnings(); }

  /// The frame at a scene time. Frames at the times that come next, going on as far again as from the last call to this one,
  /// are decoded and made ready on the film's own thread meanwhile. To be called by one thread at a time.
  Result<std::shared_ptr<const FilmFrame>> at(double scene_time);

  /// What is held now.
  struct Holding {
    std::size_t frames = 0, bytes = 0;
  };
  [[nodiscard]] Holding holding() const;

 private:
  using Prepared = Result<std::shared_ptr<const FilmFrame>>;

  Prepared prepare(std::size_t number);
  Prepared prepare_pixels(std::optional<std::size_t> number, const Image& pixels) const;
  Prepared dark();
  [[nodiscard]] std::vector<std::size_t> numbers_to_come(std::size_t shown, double scene_time) const;
  [[nodiscard]] std::optional<std::size_t> next_missing() const;
  [[nodiscard]] Holding held() const;
  void work();

  std::unique_ptr<FrameReader> reader_;  // the thread's own, once that runs
  std::string name_;
  FilmTiming timing_;
  std::vector<MipUse> uses_;
  InstructionSet set_;
  FilmLimits limits_;
  std::optional<double> last_time_;
  std::shared_ptr<const FilmFrame> dark_;

  mutable std::mutex mutex_;  // of what follows
  std::condition_variable wanted_changed_, frame_ready_;
  std::vector<std::size_t> wanted_;        // the frame that is shown, then those to come, the next one first
  std::map<std::size_t, Prepared> ready_;  // of these
  bool is_closing_ = false;
  std::thread thread_;
};

}  // namespace laterna::image
