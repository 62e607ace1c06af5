#include "reference/animated_gltf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

namespace laterna::reference {
namespace {

using nlohmann::json;
using Matrix = std::array<double, 16>;  // columns
using Numbers = std::vector<double>;

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t k = 0; k < 4; ++k) c[column * 4 + row] += a[k * 4 + row] * b[column * 4 + k];
    }
  }
  return c;
}

Matrix place(const Numbers& t, const Numbers& q, const Numbers& s) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return {(1 - 2 * y * y - 2 * z * z) * s[0],
          (2 * x * y + 2 * z * w) * s[0],
          (2 * x * z - 2 * y * w) * s[0],
          0,
          (2 * x * y - 2 * z * w) * s[1],
          (1 - 2 * x * x - 2 * z * z) * s[1],
          (2 * y * z + 2 * x * w) * s[1],
          0,
          (2 * x * z + 2 * y * w) * s[2],
          (2 * y * z - 2 * x * w) * s[2],
          (1 - 2 * x * x - 2 * y * y) * s[2],
          0,
          t[0],
          t[1],
          t[2],
          1};
}

class File {
 public:
  explicit File(const std::filesystem::path& file) {
    std::string bytes = content(file);
    if (bytes.compare(0, 4, "glTF") == 0) {
      std::uint32_t length = 0;
      std::memcpy(&length, bytes.data() + 12, 4);
      document = json::parse(bytes.substr(20, length));
      buffers_.push_back(bytes.substr(28 + length));
      return;
    }
    document = json::parse(bytes);
    for (const json& buffer : document["buffers"])
      buffers_.push_back(content(file.parent_path() / buffer["uri"].get<std::string>()));
  }

  [[nodiscard]] Numbers numbers(const json& index) const {
    const json& accessor = document["accessors"][index.get<std::size_t>()];
    const std::map<std::string, std::size_t> widths = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const std::size_t width = widths.at(accessor["type"]), count = accessor["count"];
    const int type = accessor["componentType"];
    Numbers values(width * count, 0);
    if (accessor.contains("bufferView"))
      values = read(accessor["bufferView"], accessor.value("byteOffset", 0), type, width, count);
    if (accessor.value("normalized", false)) {
      for (double& v : values) v /= type == 5121 ? 255 : 65535;
    }
    if (!accessor.contains("sparse")) return values;
    const json& sparse = accessor["sparse"];
    const std::size_t changed = sparse["count"];
    const Numbers at = read(sparse["indices"]["bufferView"], sparse["indices"].value("byteOffset", 0),
                            sparse["indices"]["componentType"], 1, changed);
    const Numbers to =
        read(sparse["values"]["bufferView"], sparse["values"].value("byteOffset", 0), type, width, changed);
    for (std::size_t i = 0; i < changed; ++i) {
      for (std::size_t k = 0; k < width; ++k)
        values[static_cast<std::size_t>(at[i]) * width + k] = to[i * width + k];
    }
    return values;
  }

  json document;

 private:
  [[nodiscard]] Numbers read(const json& view_index, std::size_t offset, int type, std::size_t width,
                             std::size_t count) const {
    const json& view = document["bufferViews"][view_index.get<std::size_t>()];
    const std::size_t size = type == 5121 ? 1 : type == 5123 ? 2 : 4;
    const std::size_t stride = view.value("byteStride", size * width);
    const char* from = buffers_[view["buffer"].get<std::size_t>()].data() +
                       view.value("byteOffset", std::size_t{0}) + offset;
    Numbers values;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < width; ++k) {
        const char* at = from + i * stride + k * size;
        if (type == 5126) {
          float value = 0;
          std::memcpy(&value, at, 4);
          values.push_back(value);
        } else {
          std::uint32_t value = 0;
          std::memcpy(&value, at, size);
          values.push_back(value);
        }
      }
    }
    return values;
  }

  std::vector<std::string> buffers_;
};

// glTF 2.0, appendix C, word for word.
Numbers sample(const Numbers& times, const Numbers& values, const std::string& how, bool is_rotation,
               double t) {
  const std::size_t keys = times.size(), per_key = values.size() / keys;
  const std::size_t width = how == "CUBICSPLINE" ? per_key / 3 : per_key;
  const auto value = [&](std::size_t key, std::size_t k) {
    return values[key * per_key + (how == "CUBICSPLINE" ? width : 0) + k];
  };
  Numbers out(width);
  std::size_t k = 0;
  while (k + 1 < keys && times[k + 1] <= t) ++k;
  const bool is_outside = t <= times.front() || k + 1 == keys;
  if (is_outside || how == "STEP") {
    for (std::size_t i = 0; i < width; ++i) out[i] = value(t <= times.front() ? 0 : k, i);
    return out;
  }
  const double length = times[k + 1] - times[k], u = (t - times[k]) / length;
  if (how == "CUBICSPLINE") {
    for (std::size_t i = 0; i < width; ++i) {
      const double leaving = values[k * per_key + 2 * width + i], arriving = values[(k + 1) * per_key + i];
      out[i] = (2 * u * u * u - 3 * u * u + 1) * value(k, i) +
               length * (u * u * u - 2 * u * u + u) * leaving +
               (-2 * u * u * u + 3 * u * u) * value(k + 1, i) + length * (u * u * u - u * u) * arriving;
    }
  } else if (is_rotation) {
    double dot = 0;
    for (std::size_t i = 0; i < 4; ++i) dot += value(k, i) * value(k + 1, i);
    const double a = std::acos(std::min(1.0, std::abs(dot))), side = dot < 0 ? -1 : 1;
    for (std::size_t i = 0; i < 4; ++i) {
      out[i] = a < 1e-5 ? (1 - u) * value(k, i) + u * side * value(k + 1, i)
                        : std::sin(a * (1 - u)) / std::sin(a) * value(k, i) +
                              side * std::sin(a * u) / std::sin(a) * value(k + 1, i);
    }
  } else {
    for (std::size_t i = 0; i < width; ++i) out[i] = (1 - u) * value(k, i) + u * value(k + 1, i);
  }
  if (is_rotation) {
    const double n = std::sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2] + out[3] * out[3]);
    for (double& v : out) v /= n;
  }
  return out;
}

double length_of(const File& file, const json& animation) {
  double last = 0;
  for (const json& sampler : animation["samplers"])
    last = std::max(last, file.numbers(sampler["input"]).back());
  return last;
}

class Posed {
 public:
  Posed(const File& file, std::size_t clip, double time)
      : file_(file), moved_(file.document["nodes"].size()) {
    const json& animation = file.document["animations"][clip];
    const double local = std::fmod(time, length_of(file, animation));
    for (const json& channel : animation["channels"]) {
      const json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
      const std::string path = channel["target"]["path"];
      moved_[channel["target"]["node"].get<std::size_t>()][path] =
          sample(file.numbers(sampler["input"]), file.numbers(sampler["output"]),
                 sampler.value("interpolation", "LINEAR"), path == "rotation", local);
    }
    const json& nodes = file.document["nodes"];
    parent_.assign(nodes.size(), -1);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      for (const json& child : nodes[n].value("children", json::array()))
        parent_[child.get<std::size_t>()] = static_cast<int>(n);
    }
  }

  [[nodiscard]] Matrix world(std::size_t n) const {
    const json& node = file_.document["nodes"][n];
    Matrix own{};
    if (node.contains("matrix")) {
      own = node["matrix"].get<Matrix>();
    } else {
      own = place(part(n, "translation", {0, 0, 0}), part(n, "rotation", {0, 0, 0, 1}),
                  part(n, "scale", {1, 1, 1}));
    }
    return parent_[n] < 0 ? own : product(world(static_cast<std::size_t>(parent_[n])), own);
  }

  [[nodiscard]] Numbers part(std::size_t n, const std::string& name, Numbers otherwise) const {
    const auto found = moved_[n].find(name);
    if (found != moved_[n].end()) return found->second;
    const json& node = file_.document["nodes"][n];
    return node.contains(name) ? node[name].get<Numbers>() : otherwise;
  }

  // A node and all below it, parents first.
  void add(std::size_t n, std::vector<AnimatedNode>& shown) const {
    const json& node = file_.document["nodes"][n];
    if (node.contains("mesh")) {
      const json& mesh = file_.document["meshes"][node["mesh"].get<std::size_t>()];
      AnimatedNode& here = shown.emplace_back();
      here.node = static_cast<int>(n);
      for (const json& primitive : mesh["primitives"]) here.corners.push_back(corners(n, mesh, primitive));
    }
    for (const json& child : node.value("children", json::array())) add(child, shown);
  }

  [[nodiscard]] std::vector<glm::dvec3> corners(std::size_t n, const json& mesh,
                                                const json& primitive) const {
    Numbers positions = file_.numbers(primitive["attributes"]["POSITION"]);
    const Numbers weights =
        part(n, "weights", mesh.contains("weights") ? mesh["weights"].get<Numbers>() : Numbers());
    for (std::size_t t = 0; t < weights.size(); ++t) {
      const json& target = primitive["targets"][t];
      if (!target.contains("POSITION")) continue;
      const Numbers by = file_.numbers(target["POSITION"]);
      for (std::size_t i = 0; i < positions.size(); ++i) positions[i] += weights[t] * by[i];
    }
    const std::vector<glm::dvec3> vertices = to_world(n, primitive, positions);
    if (!primitive.contains("indices")) return vertices;
    std::vector<glm::dvec3> corners;
    for (const double index : file_.numbers(primitive["indices"]))
      corners.push_back(vertices[static_cast<std::size_t>(index)]);
    return corners;
  }

 private:
  [[nodiscard]] std::vector<glm::dvec3> to_world(std::size_t n, const json& primitive,
                                                 const Numbers& positions) const {
    const json& node = file_.document["nodes"][n];
    std::vector<Matrix> joints;
    Numbers of_vertex, weights;
    if (node.contains("skin")) {
      const json& skin = file_.document["skins"][node["skin"].get<std::size_t>()];
      const Numbers bind = file_.numbers(skin["inverseBindMatrices"]);
      for (std::size_t j = 0; j < skin["joints"].size(); ++j) {
        Matrix inverse{};
        std::copy_n(bind.begin() + static_cast<std::ptrdiff_t>(16 * j), 16, inverse.begin());
        joints.push_back(product(world(skin["joints"][j].get<std::size_t>()), inverse));
      }
      of_vertex = file_.numbers(primitive["attributes"]["JOINTS_0"]);
      weights = file_.numbers(primitive["attributes"]["WEIGHTS_0"]);
    }
    const Matrix own = world(n);
    std::vector<glm::dvec3> vertices;
    for (std::size_t v = 0; v * 3 < positions.size(); ++v) {
      glm::dvec3 sum(0);
      double total = 0;
      for (std::size_t k = 0; k < (joints.empty() ? 1U : 4U); ++k) {
        const Matrix& m = joints.empty() ? own : joints[static_cast<std::size_t>(of_vertex[4 * v + k])];
        const double weight = joints.empty() ? 1 : weights[4 * v + k];
        total += weight;
        for (int row = 0; row < 3; ++row) {
          const auto r = static_cast<std::size_t>(row);
          sum[row] += weight * (m[r] * positions[3 * v] + m[4 + r] * positions[3 * v + 1] +
                                m[8 + r] * positions[3 * v + 2] + m[12 + r]);
        }
      }
      // But for rounding the file's weights add up to 1.
      vertices.push_back(std::abs(total - 1) < 1e-6 ? sum : sum / total);
    }
    return vertices;
  }

  const File& file_;
  std::vector<std::map<std::string, Numbers>> moved_;
  std::vector<int> parent_;
};

}  // namespace

std::vector<AnimatedNode> pose_gltf(const std::filesystem::path& path, std::size_t clip, double time) {
  const File file(path);
  const Posed posed(file, clip, time);
  std::vector<AnimatedNode> shown;
  const json& scene = file.document["scenes"][file.document.value("scene", std::size_t{0})];
  for (const json& root : scene["nodes"]) posed.add(root, shown);
  return shown;
}

std::vector<double> clip_lengths(const std::filesystem::path& path) {
  const File file(path);
  std::vector<double> lengths;
  for (const json& animation : file.document["animations"]) lengths.push_back(length_of(file, animation));
  return lengths;
}

}  // namespace laterna::reference
