#include "scene/rig_environment.h"

#include "base/elementary.h"
#include "scene/json_object.h"
#include "scene/rig_ranges.h"
#include "scene/uri.h"

namespace laterna {
namespace {

// Stops, either way: 2^±40 is as far as amounts of light go.
constexpr NumberRange kStops{-40, 40, false, false};
// Degrees: what the library's sine takes.
constexpr NumberRange kTurn{-1e6, 1e6, false, false};

glm::dmat3 about_y(double degrees) {
  const double c = cosine(degrees * kPi / 180), s = sine(degrees * kPi / 180);
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
}

class EnvironmentReader {
 public:
  EnvironmentReader(const JsonDocument& json, const JsonValue& value, const std::filesystem::path& folder,
                    FaultList& faults)
      : json_(json), object_(json, value, faults), folder_(folder), faults_(faults) {}

  std::optional<Environment> read(std::vector<Picture>& pictures) {
    const std::size_t errors_before = faults_.error_count();
    if (!object_.value().is_object()) return std::nullopt;
    const std::optional<Picture> picture = read_picture();
    read_chart();
    read_brightness();
    environment_.world_from_environment = about_y(object_.number("rotation_deg", kTurn).value_or(0));
    environment_.visible = object_.boolean("visible").value_or(true);
    read_distance();
    object_.report_unknown_members("an environment");
    if (!picture || faults_.error_count() != errors_before) return std::nullopt;
    environment_.picture = static_cast<int>(pictures.size());
    pictures.push_back(*picture);
    return environment_;
  }

 private:
  std::optional<Picture> read_picture() {
    object_.require("image");
    const std::optional<std::string> name = object_.string("image");
    if (!name) return std::nullopt;
    const auto path = resolve_typed_file(folder_, *name);
    if (!path) {
      object_.error("image", path.error());
      return std::nullopt;
    }
    Picture picture;
    picture.file = *path;
    picture.name = picture.file.string();
    return picture;
  }

  void read_chart() {
    using NamedChart = std::pair<std::string_view, EnvironmentChart>;
    std::vector<NamedChart> charts;
    for (const EnvironmentChartDescription& known : list_environment_charts())
      charts.emplace_back(known.name, known.chart);
    environment_.chart = object_.choice<EnvironmentChart>("chart", std::span<const NamedChart>(charts));
  }

  void read_brightness() {
    if (object_.has("intensity") && object_.has("exposure"))
      object_.error("exposure", "give either intensity or exposure, not both");
    environment_.intensity = object_.number("intensity", kAmountOfLight).value_or(1);
    if (const auto stops = object_.number("exposure", kStops)) environment_.intensity = exponential2(*stops);
  }

  void read_distance() {
    const JsonValue *box = object_.object("box"), *sphere = object_.object("sphere");
    if (box != nullptr && sphere != nullptr) object_.error("sphere", "give either box or sphere, not both");
    const auto center = object_.numbers<3>("center", kCoordinate);
    if (center) environment_.center_ws = {(*center)[0], (*center)[1], (*center)[2]};
    if (box == nullptr && sphere == nullptr) {
      if (object_.has("center")) object_.error("center", "has no effect without a box or a sphere");
      return;
    }
    object_.require("center");
    if (box != nullptr) return read_box(*box, center.has_value());
    environment_.distance = EnvironmentDistance::sphere;
    JsonObject ball(json_, *sphere, faults_);
    ball.require("radius");
    environment_.radius = ball.number("radius", kPositiveLength).value_or(1);
    ball.report_unknown_members("a sphere");
  }

  void read_box(const JsonValue& value, bool has_center) {
    environment_.distance = EnvironmentDistance::box;
    JsonObject box(json_, value, faults_);
    box.require_all({"low", "high"});
    const auto low = box.numbers<3>("low", kCoordinate), high = box.numbers<3>("high", kCoordinate);
    box.report_unknown_members("a box");
    if (!low || !high) return;
    environment_.box_low_ws = {(*low)[0], (*low)[1], (*low)[2]};
    environment_.box_high_ws = {(*high)[0], (*high)[1], (*high)[2]};
    for (int i = 0; i < 3; ++i) {
      const double center = environment_.center_ws[i];
      if (environment_.box_low_ws[i] >= environment_.box_high_ws[i])
        return box.error("high", "expected corners greater than those of low");
      if (has_center && (center <= environment_.box_low_ws[i] || center >= environment_.box_high_ws[i]))
        return object_.error("center", "must lie within the box");
    }
  }

  const JsonDocument& json_;
  JsonObject object_;
  const std::filesystem::path& folder_;
  FaultList& faults_;
  Environment environment_;
};

}  // namespace

std::optional<Environment> read_rig_environment(const JsonDocument& json, const JsonValue& value,
                                                const std::filesystem::path& folder,
                                                std::vector<Picture>& pictures, FaultList& faults) {
  return EnvironmentReader(json, value, folder, faults).read(pictures);
}

}  // namespace laterna
