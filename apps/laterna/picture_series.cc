#include "picture_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "laterna/turntable.h"
#include "layer_pictures.h"
#include "outcome.h"
#include "progress_line.h"
#include "render_remarks.h"
#include "resumed_frames.h"

namespace laterna::app {

int PictureSeries::draw(Renderer& renderer, const View& view, double load_ms) {
  load_ms_ = load_ms;
  threads_ = renderer.threads();
  drawer_.emplace(options_, request_, threads_);
  course_.first = view;
  const Renderer::Box box = renderer.bounds();
  turntable_centre_ws_ = 0.5 * (box.low_ws + box.high_ws);
  const bool is_series = options_.frames.is_series();
  const Interruption interruption(is_series);
  interruption_ = &interruption;
  if (options_.makes_film()) {
    const RenderSettings& settings = request_.settings;
    Result<VideoWriter> film =
        VideoWriter::create(options_.output, settings.width, settings.height, film_options_);
    if (!film) return report(film.error());
    film_ = std::move(*film);
  }
  told_.resize(outputs_.size());
  if (const Result<void> resumed = skip_finished(renderer); !resumed) return report(resumed.error());
  const Result<void> drawn = draw_frames(renderer);
  if (const int outcome = close(drawn); outcome != kOk) return outcome;
  if (!options_.json) return kOk;
  nlohmann::json pictures = nlohmann::json::array();
  for (FrameReport& frame : told_) {
    if (!frame.is_skipped) frame.json["write_ms"] = frame.write_ms;
    pictures.push_back(std::move(frame.json));
  }
  fmt::print("{}\n", is_series ? pictures.dump(2) : pictures[0].dump(2));
  return kOk;
}

// Frames of --resume. The last of them is drawn once more, where others are to be added.
Result<void> PictureSeries::skip_finished(Renderer& renderer) {
  if (!options_.resume) return {};
  const std::vector<bool> is_finished = find_finished(outputs_);
  const auto count = static_cast<std::size_t>(std::ranges::count(is_finished, true));
  std::size_t last = 0;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (!is_finished[i]) continue;
    last = i;
    told_[i].is_skipped = true;
    told_[i].json = {{"output", outputs_[i].file}, {"time_s", outputs_[i].seconds}, {"skipped", true}};
  }
  if (count > 0) {
    fmt::print(stderr, "laterna: note: {} of {} frames are there already\n", count, outputs_.size());
  }
  if (count == 0 || count == outputs_.size()) return {};
  return check_finished(outputs_[last], [&](const std::filesystem::path& file) -> Result<void> {
    FrameReport ignored;
    Result<FinishedPicture> picture = draw_frame(renderer, last, {}, ignored);
    if (!picture) return tl::unexpected(std::move(picture.error()));
    return drawer_->write(std::move(picture->image), file, picture->exposure);
  });
}

Result<void> PictureSeries::draw_frames(Renderer& renderer) {
  WriteQueue queue([&](FinishedPicture picture) { return write(std::move(picture)); });
  const auto to_draw = static_cast<double>(std::ranges::count(told_, false, &FrameReport::is_skipped));
  const Progress line = progress_line(
      options_.frames.is_series() ? fmt::format("rendering {} frames", to_draw) : std::string("rendering"));
  double done = 0;
  const Progress progress = [&](double fraction) {
    return (!line || line((done + fraction) / to_draw)) && interruption_->signal() == 0 &&
           !queue.has_failed();
  };
  Result<void> outcome;
  for (std::size_t i = 0; i < outputs_.size() && outcome && interruption_->signal() == 0; ++i) {
    if (told_[i].is_skipped) continue;
    Result<FinishedPicture> picture = draw_frame(renderer, i, progress, told_[i]);
    if (picture) {
      queue.add(std::move(*picture));
      told_[i].is_drawn = true;
    } else {
      outcome = tl::unexpected(std::move(picture.error()));
    }
    ++done;
  }
  const Result<void> written = queue.finish();
  return written ? outcome : written;
}

// What a series leaves behind, however it ended.
int PictureSeries::close(const Result<void>& drawn) {
  const auto missing =
      std::ranges::count_if(told_, [](const FrameReport& f) { return !f.is_skipped && !f.is_drawn; });
  Result<void> outcome = drawn;
  if (film_ && drawn && missing == 0) outcome = film_->finish();
  if (outcome && missing == 0) return kOk;
  const int signal = interruption_->signal();
  if (!outcome && outcome.error().failure != Failure::cancelled) report(outcome.error());
  if (film_) keep_incomplete_film();
  if (signal == 0) return static_cast<int>(outcome.error().failure);
  if (!film_)
    fmt::print(stderr, "laterna: stopped; {} of {} frames are still to be drawn: --resume goes on\n", missing,
               told_.size());
  film_.reset();
  end_by_signal(signal);
}

void PictureSeries::keep_incomplete_film() {
  const std::int64_t written = film_->frames();
  const Result<std::filesystem::path> kept = film_->keep_incomplete();
  if (kept) {
    fmt::print(stderr, "laterna: note: {} holds the film as far as it got: {} of {} frames were drawn\n",
               kept->string(), written, told_.size());
  } else {
    report(kept.error());
  }
}

// The view at the renderer's time.
Result<View> PictureSeries::view_now(const Renderer& renderer) const {
  if (renderer.time() == course_.first_time) return course_.first;
  const Result<View> view =
      options_.view.follow(renderer, {request_.settings.width, request_.settings.height}, course_.first);
  if (!view || !options_.turntable) return view;
  const double beside = (renderer.time() - course_.frame_time) / course_.duration;
  return turned_about(*view, turntable_centre_ws_, course_.turned + beside);
}

// `told` gets what there is to tell in JSON, but for what writing costs.
Result<FinishedPicture> PictureSeries::draw_frame(Renderer& renderer, std::size_t index,
                                                  const Progress& progress, FrameReport& told) {
  const TimedOutput& output = outputs_[index];
  const Result<int> changed = renderer.set_time(output.seconds);
  if (!changed) return tl::unexpected(changed.error());
  const auto count = static_cast<double>(outputs_.size());
  const double first_time = outputs_.front().seconds;
  const double duration = outputs_.size() > 1 ? (outputs_[1].seconds - first_time) * count
                                              : std::numeric_limits<double>::infinity();
  course_ = {course_.first, first_time, duration, output.seconds, static_cast<double>(index) / count};
  RenderStatistics statistics;
  Result<StillDrawer::Picture> picture = drawer_->draw(
      renderer, [this](const Renderer& posed) { return view_now(posed); }, output.file, progress, statistics);
  if (!picture) return tl::unexpected(std::move(picture.error()));
  if (options_.json) {
    told.json = statistics_json(statistics, load_ms_);
    told.json.update({{"output", output.file}, {"time_s", output.seconds}, {"films_changed", *changed}});
    told.json["size"] = {picture->image.width, picture->image.height};
    told.json["exposure"] = picture->exposure;
  }
  return FinishedPicture{std::move(picture->image), output.file, picture->exposure, &told.write_ms};
}

// Called by the thread that writes.
Result<void> PictureSeries::write(FinishedPicture picture) {
  if (film_) return film_->write(picture.image, picture.exposure, threads_);
  if (!options_.layer_pictures.empty()) {
    Result<void> written = write_layer_pictures(picture.image, options_.layer_pictures, picture.exposure);
    if (!written) return written;
  }
  return drawer_->write(std::move(picture.image), picture.file, picture.exposure);
}

}  // namespace laterna::app
