#include "sim/scene_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>

#include "geometry/atomic_file.h"
#include "geometry/gltf_guard.h"
#include "geometry/input_error.h"

namespace parity {
namespace {

using Json = nlohmann::json;

/// A value as it stands in the file, short enough for a message.
std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  const std::string text = value.dump(-1, ' ', true);
  return text.size() > 80 ? text.substr(0, 77) + "..." : text;
}

std::string shown(double value) { return Json(value).dump(); }

/// Numbers from low to high.
struct Range {
  double low, high;
};
constexpr Range any_number{-1e9, 1e9};
constexpr Range positive{1e-9, 1e9};

/// A value and its place in the file.
class Node {
 public:
  Node(const std::string& file, const Json& value, std::string path)
      : file_(file), value_(value), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file_, (path_.empty() ? "the scene" : path_) + what);
  }

  /// Makes sure of an object with no other keys than these.
  void expect_keys(std::initializer_list<const char*> keys) const {
    if (!value_.is_object()) fail(" is " + shown(value_) + ", must be an object");
    for (const auto& item : value_.items()) {
      if (std::ranges::count(keys, item.key()) != 0) continue;
      std::string list;
      for (const char* key : keys) list += (list.empty() ? "" : ", ") + std::string(key);
      fail(" has the unknown key " + shown(Json(item.key())) + ", may have " + list);
    }
  }

  bool has(const char* key) const { return value_.contains(key); }
  bool is_text() const { return value_.is_string(); }
  Node at(const char* key) const {
    const std::string path = path_.empty() ? key : path_ + "." + key;
    if (!value_.contains(key)) throw InputError(file_, path + " is missing");
    return {file_, value_[key], path};
  }

  double number(Range range) const {
    if (!value_.is_number()) fail(" is " + shown(value_) + ", must be a number");
    const double number = value_.get<double>();
    if (!(number >= range.low && number <= range.high))
      fail(" is " + shown(value_) + ", must be from " + shown(range.low) + " to " +
           shown(range.high));
    return number;
  }
  int whole(int low, int high) const {
    const double number = this->number({double(low), double(high)});
    if (number != std::floor(number)) fail(" is " + shown(value_) + ", must be a whole number");
    return int(number);
  }
  bool boolean() const {
    if (!value_.is_boolean()) fail(" is " + shown(value_) + ", must be true or false");
    return value_.get<bool>();
  }
  std::string text() const {
    if (!value_.is_string()) fail(" is " + shown(value_) + ", must be a string");
    return value_.get<std::string>();
  }
  /// As many numbers as `count`; the rest of the three are 0.
  dvec3 vector(int count, Range range) const {
    if (!value_.is_array() || int(value_.size()) != count)
      fail(" is " + shown(value_) + ", must be an array of " + std::to_string(count) + " numbers");
    dvec3 result{0};
    const std::vector<Node> parts = items();
    for (int i = 0; i < count; ++i) result[i] = parts[std::size_t(i)].number(range);
    return result;
  }
  std::size_t size() const { return value_.is_array() ? value_.size() : 0; }
  std::vector<Node> items() const {
    if (!value_.is_array()) fail(" is " + shown(value_) + ", must be an array");
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < value_.size(); ++i)
      nodes.push_back({file_, value_[i], path_ + "[" + std::to_string(i) + "]"});
    return nodes;
  }
  /// The number of the name among `names`.
  template <typename Enum>
  Enum choice(std::initializer_list<const char*> names) const {
    const std::string name = text();
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return Enum(found - names.begin());
    std::string list;
    for (const char* n : names) list += (list.empty() ? "" : ", ") + std::string(n);
    fail(" is " + shown(value_) + ", must be one of " + list);
  }

  // Puts a value in its place if the key is there.
  void read(const char* key, double& target, Range range) const {
    if (has(key)) target = at(key).number(range);
  }
  void read(const char* key, std::optional<double>& target, Range range) const {
    if (has(key)) target = at(key).number(range);
  }
  void read(const char* key, dvec3& target, int count) const {
    if (has(key)) target = at(key).vector(count, any_number);
  }
  void read(const char* key, std::optional<dvec3>& target, int count) const {
    if (has(key)) target = at(key).vector(count, any_number);
  }

 private:
  const std::string& file_;
  const Json& value_;
  std::string path_;
};

constexpr std::initializer_list<const char*> method_names{"grid", "flip", "apic", "wcsph", "dfsph"};
constexpr std::initializer_list<const char*> side_kinds{"slip", "no_slip", "open", "periodic"};
constexpr std::size_t max_bodies = 64;

SimShape read_sphere(const Node& node, int dimensions) {
  node.expect_keys({"center", "radius"});
  return {.kind = SimShape::Kind::sphere,
          .center = node.at("center").vector(dimensions, any_number),
          .radius = node.at("radius").number(positive)};
}

SimShape read_box(const Node& node, int dimensions) {
  node.expect_keys({"min", "max"});
  const SimShape box{.low = node.at("min").vector(dimensions, any_number),
                     .high = node.at("max").vector(dimensions, any_number)};
  for (int a = 0; a < dimensions; ++a)
    if (!(box.high[a] > box.low[a]))
      node.at("max").fail(" must be larger than min along every axis");
  return box;
}

/// Exactly one of "box" and "sphere".
SimShape read_shape(const Node& node, int dimensions) {
  if (node.has("box") == node.has("sphere")) node.fail(" must have either a box or a sphere");
  return node.has("box") ? read_box(node.at("box"), dimensions)
                         : read_sphere(node.at("sphere"), dimensions);
}

std::vector<SimBody> read_bodies(const Node& root, const char* key, int dimensions) {
  std::vector<SimBody> bodies;
  if (!root.has(key)) return bodies;
  for (const Node& node : root.at(key).items()) {
    node.expect_keys({"box", "sphere", "velocity"});
    SimBody body{.shape = read_shape(node, dimensions)};
    node.read("velocity", body.velocity, dimensions);
    if (bodies.size() == max_bodies) node.fail(": there may be at most 64");
    bodies.push_back(body);
  }
  return bodies;
}

std::vector<SimSource> read_sources(const Node& root, int dimensions) {
  std::vector<SimSource> sources;
  if (!root.has("sources")) return sources;
  for (const Node& node : root.at("sources").items()) {
    node.expect_keys({"sphere", "velocity", "smoke", "temperature"});
    const SimShape ball = read_sphere(node.at("sphere"), dimensions);
    SimSource source{.center = ball.center, .radius = ball.radius};
    node.read("velocity", source.velocity, dimensions);
    node.read("smoke", source.smoke, {0, 1});
    node.read("temperature", source.temperature, {-1e4, 1e4});
    if (sources.size() == max_bodies) node.fail(": there may be at most 64");
    sources.push_back(source);
  }
  return sources;
}

SimSide read_side(const Node& node, int dimensions) {
  SimSide side;
  if (node.is_text()) {
    side.kind = node.choice<SimSideKind>(side_kinds);
    return side;
  }
  node.expect_keys({"velocity"});
  side.kind = SimSideKind::no_slip;
  side.velocity = node.at("velocity").vector(dimensions, any_number);
  return side;
}

void read_domain(const Node& node, SimScene& scene) {
  node.expect_keys({"size", "sides"});
  const std::size_t count = node.at("size").size();
  if (count != 2 && count != 3) node.at("size").fail(" must be an array of 2 or 3 numbers");
  scene.dimensions = int(count);
  scene.size = node.at("size").vector(scene.dimensions, {1e-6, 1e6});
  if (!node.has("sides")) return;
  const Node sides = node.at("sides");
  constexpr std::array<const char*, 6> names{"left", "right", "bottom", "top", "back", "front"};
  if (scene.dimensions == 2)
    sides.expect_keys({"left", "right", "bottom", "top"});
  else
    sides.expect_keys({"left", "right", "bottom", "top", "back", "front"});
  for (std::size_t s = 0; s < names.size(); ++s)
    if (sides.has(names[s])) scene.sides[s] = read_side(sides.at(names[s]), scene.dimensions);
}

void read_resolution(const Node& root, SimScene& scene) {
  if (root.has("resolution") == root.has("spacing"))
    root.fail(" must have either a resolution or a spacing");
  const double longest = std::max({scene.size.x, scene.size.y, scene.size.z});
  scene.spacing = root.has("resolution") ? longest / root.at("resolution").whole(2, 4096)
                                         : root.at("spacing").number({longest / 4096, longest / 2});
}

void read_fluid(const Node& root, SimFluid& fluid) {
  if (!root.has("fluid")) return;
  const Node node = root.at("fluid");
  node.expect_keys({"density", "viscosity", "surface_tension", "expansion", "smoke_weight",
                    "cooling", "vorticity_confinement"});
  node.read("density", fluid.density, {1e-3, 1e6});
  node.read("viscosity", fluid.viscosity, {0, 1e4});
  node.read("surface_tension", fluid.surface_tension, {0, 1e4});
  node.read("expansion", fluid.expansion, {0, 1});
  node.read("smoke_weight", fluid.smoke_weight, {0, 1000});
  node.read("cooling", fluid.cooling, {0, 1000});
  node.read("vorticity_confinement", fluid.vorticity_confinement, {0, 100});
}

void read_solver(const Node& root, SimSolver& solver) {
  if (!root.has("solver")) return;
  const Node node = root.at("solver");
  node.expect_keys({"advection", "divergence", "density_error", "courant", "max_step", "error",
                    "sound_speed", "artificial_viscosity", "implicit_viscosity", "flip_ratio",
                    "sparse"});
  if (node.has("advection"))
    solver.advection =
        node.at("advection")
            .choice<SimAdvection>({"upwind", "central", "semi_lagrangian", "maccormack"});
  node.read("divergence", solver.divergence, {1e-9, 1e3});
  node.read("density_error", solver.density_error, {1e-6, 0.1});
  node.read("courant", solver.courant, {1e-3, 20});
  node.read("max_step", solver.max_step, {1e-7, 10});
  node.read("error", solver.error, {1e-6, 0.1});
  node.read("sound_speed", solver.sound_speed, {1e-3, 1e5});
  node.read("artificial_viscosity", solver.artificial_viscosity, {0, 10});
  if (node.has("implicit_viscosity"))
    solver.implicit_viscosity = node.at("implicit_viscosity").boolean();
  node.read("flip_ratio", solver.flip_ratio, {0, 1});
  if (node.has("sparse")) solver.sparse = node.at("sparse").boolean();
}

void read_picture(const Node& root, int dimensions, SimPicture& picture) {
  if (!root.has("picture")) return;
  const Node node = root.at("picture");
  node.expect_keys(
      {"size", "view", "color", "range", "eye", "target", "fov_degrees", "sun", "samples"});
  if (node.has("size")) picture.size = ivec2(node.at("size").vector(2, {16, 8192}));
  if (node.has("view"))
    picture.view = node.at("view").choice<SimView>({"automatic", "spheres", "smoke", "field"});
  if (node.has("color"))
    picture.color = node.at("color").choice<SimColor>(
        {"automatic", "speed", "vorticity", "pressure", "smoke", "height"});
  if (node.has("range")) {
    picture.range = dvec2(node.at("range").vector(2, any_number));
    if (!(picture.range->y > picture.range->x)) node.at("range").fail(" must rise");
  }
  if (dimensions == 2 && (node.has("eye") || node.has("target")))
    node.fail(" has an eye or a target, which scenes in 2 dimensions do not");
  if (node.has("eye") != node.has("target"))
    node.fail(" must have both an eye and a target, or none");
  node.read("eye", picture.eye, 3);
  node.read("target", picture.target, 3);
  if (picture.eye && glm::length(*picture.eye - *picture.target) < 1e-6)
    node.at("eye").fail(" is its target");
  node.read("fov_degrees", picture.fov_degrees, {1, 120});
  node.read("sun", picture.sun, 3);
  if (!(picture.sun.y > 0.2 * glm::length(picture.sun)))
    node.at("sun").fail(" must stand higher: its y must be above a fifth of its length");
  if (node.has("samples")) picture.samples = node.at("samples").whole(1, 4);
}

void read_output(const Node& root, SimOutput& output) {
  if (!root.has("output")) return;
  output = {.png = false};
  for (const Node& node : root.at("output").items()) {
    enum class Format { png, ply, vtk };
    switch (node.choice<Format>({"png", "ply", "vtk"})) {
      case Format::png:
        output.png = true;
        break;
      case Format::ply:
        output.ply = true;
        break;
      case Format::vtk:
        output.vtk = true;
        break;
    }
  }
}

SimScene read_scene(const Node& root) {
  root.expect_keys({"parity_sim", "title", "method", "domain", "resolution", "spacing", "duration",
                    "frames_per_second", "gravity", "fluid", "solver", "start", "liquid", "solids",
                    "sources", "picture", "output"});
  root.at("parity_sim").whole(1, 1);
  SimScene scene;
  if (root.has("title")) scene.title = root.at("title").text();
  scene.method = root.at("method").choice<SimMethod>(method_names);
  read_domain(root.at("domain"), scene);
  read_resolution(root, scene);
  scene.duration = root.at("duration").number({1e-6, 1e6});
  root.read("frames_per_second", scene.frames_per_second, {1e-3, 1e6});
  root.read("gravity", scene.gravity, scene.dimensions);
  read_fluid(root, scene.fluid);
  read_solver(root, scene.solver);
  if (root.has("start")) scene.start = root.at("start").choice<SimStart>({"rest", "taylor_green"});
  scene.liquid = read_bodies(root, "liquid", scene.dimensions);
  scene.solids = read_bodies(root, "solids", scene.dimensions);
  scene.sources = read_sources(root, scene.dimensions);
  read_picture(root, scene.dimensions, scene.picture);
  read_output(root, scene.output);
  return scene;
}

Json numbers(const dvec3& v) { return {v.x, v.y, v.z}; }

Json shape_json(const SimShape& s) {
  return {int(s.kind), numbers(s.low), numbers(s.high), numbers(s.center), s.radius};
}

Json bodies_json(const std::vector<SimBody>& bodies) {
  Json list = Json::array();
  for (const SimBody& b : bodies) list.push_back({shape_json(b.shape), numbers(b.velocity)});
  return list;
}

Json optional_json(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json sources_json(const std::vector<SimSource>& sources) {
  Json list = Json::array();
  for (const SimSource& s : sources)
    list.push_back({numbers(s.center), s.radius, numbers(s.velocity), s.smoke, s.temperature});
  return list;
}

}  // namespace

SimScene decode_sim_scene(std::string_view text, const std::string& name) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  gltf::check_json_text(text, name);
  const Json json = Json::parse(text);
  const SimScene scene = read_scene(Node(name, json, ""));
  if (const std::string fault = scene_fault(scene); !fault.empty()) throw InputError(name, fault);
  return scene;
}

SimScene load_sim_scene(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path, std::size_t(1) << 20);
  return decode_sim_scene({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                          path.string());
}

std::string physics_text(const SimScene& scene) {
  Json sides = Json::array();
  for (const SimSide& side : scene.sides) sides.push_back({int(side.kind), numbers(side.velocity)});
  const SimFluid& f = scene.fluid;
  const SimSolver& s = scene.solver;
  return Json{{"method", name_of(scene.method)},
              {"dimensions", scene.dimensions},
              {"size", numbers(scene.size)},
              {"spacing", scene.spacing},
              {"frames_per_second", scene.frames_per_second},
              {"sides", sides},
              {"gravity", numbers(scene.gravity)},
              {"fluid",
               {f.density, f.viscosity, f.surface_tension, f.expansion, f.smoke_weight, f.cooling,
                f.vorticity_confinement}},
              {"solver",
               {int(s.advection), s.divergence, s.density_error, optional_json(s.courant),
                optional_json(s.max_step), optional_json(s.error), optional_json(s.sound_speed),
                s.artificial_viscosity, s.implicit_viscosity, s.flip_ratio, s.sparse}},
              {"start", int(scene.start)},
              {"liquid", bodies_json(scene.liquid)},
              {"solids", bodies_json(scene.solids)},
              {"sources", sources_json(scene.sources)}}
      .dump();
}

}  // namespace parity
