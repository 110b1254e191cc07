#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "geometry/input_error.h"
#include "sim/scene_io.h"
#include "tests/temporary_folder.h"

namespace parity {
namespace {

using nlohmann::json;

json good() {
  return json::parse(R"({
    "parity_sim": 1, "method": "wcsph", "resolution": 40, "duration": 2,
    "domain": {"size": [2, 1, 0.5], "sides": {"top": "open"}},
    "liquid": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.8, 0.5]}}],
    "solids": [{"sphere": {"center": [1.2, 0.1, 0.25], "radius": 0.1}}],
    "picture": {"size": [320, 180], "color": "speed"}, "output": ["png", "vtk"]})");
}

json smoke() {
  return json::parse(R"({
    "parity_sim": 1, "method": "grid", "spacing": 0.05, "duration": 1,
    "domain": {"size": [1, 2], "sides": {"left": "periodic", "right": "periodic",
                                        "bottom": {"velocity": [1, 0]}}},
    "sources": [{"sphere": {"center": [0.5, 0.2], "radius": 0.1}, "temperature": 20}]})");
}

/// The message of the refusal; empty: it was taken.
std::string refusal(const std::string& text) {
  try {
    decode_sim_scene(text, "scene.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SimScene, SaysWhatTheFileSays) {
  const SimScene scene = decode_sim_scene(good().dump(), "scene.json");
  EXPECT_EQ(scene.method, SimMethod::wcsph);
  EXPECT_EQ(scene.dimensions, 3);
  EXPECT_DOUBLE_EQ(scene.spacing, 0.05);
  EXPECT_EQ(cells_of(scene), ivec3(40, 20, 10));
  EXPECT_EQ(scene.sides[3].kind, SimSideKind::open);
  EXPECT_EQ(scene.sides[0].kind, SimSideKind::slip);
  ASSERT_EQ(scene.liquid.size(), 1u);
  EXPECT_EQ(scene.liquid[0].shape.high, dvec3(0.5, 0.8, 0.5));
  EXPECT_EQ(scene.solids[0].shape.kind, SimShape::Kind::sphere);
  EXPECT_TRUE(scene.output.vtk);
  EXPECT_FALSE(scene.output.ply);
  EXPECT_EQ(frame_count(scene), 60);
}

TEST(SimScene, KnowsFlatScenesAndSources) {
  const SimScene scene = decode_sim_scene(smoke().dump(), "scene.json");
  EXPECT_EQ(scene.dimensions, 2);
  EXPECT_EQ(cells_of(scene), ivec3(20, 40, 1));
  EXPECT_EQ(scene.sides[2].kind, SimSideKind::no_slip);
  EXPECT_EQ(scene.sides[2].velocity, dvec3(1, 0, 0));
  EXPECT_DOUBLE_EQ(scene.sources[0].temperature, 20);
}

struct Fault {
  const char* pointer;  ///< where the good scene is changed
  json value;           ///< null: the key is taken away
  const char* message;  ///< part of the refusal, beside the name of the file
};

TEST(SimScene, RefusesEachFaultInOneLineWithItsPlace) {
  const std::vector<Fault> faults{
      {"/parity_sim", nullptr, "parity_sim is missing"},
      {"/parity_sim", 2, "parity_sim is 2, must be from 1.0 to 1.0"},
      {"/method", "lbm", "method is \"lbm\", must be one of grid, flip"},
      {"/method", 3, "method is 3, must be a string"},
      {"/methode", 3, "has the unknown key \"methode\""},
      {"/domain/size", json{2, 1, -1}, "domain.size[2] is -1, must be from"},
      {"/domain/size", json{2}, "domain.size must be an array of 2 or 3 numbers"},
      {"/domain/size", json{2, "1", 1}, "domain.size[1] is \"1\", must be a number"},
      {"/domain/sides/top", "wet", "domain.sides.top is \"wet\""},
      {"/domain/sides/lid", "open", "domain.sides has the unknown key \"lid\""},
      {"/domain/sides/top", "periodic", "domain.sides.bottom: a side is periodic if and only if"},
      {"/domain/sides/left", "open", "domain.sides.left: method wcsph may be open at the top"},
      {"/resolution", 0, "resolution is 0, must be from 2.0 to 4096.0"},
      {"/resolution", 3.5, "resolution is 3.5, must be a whole number"},
      {"/resolution", 1e300, "resolution is 1e+300, must be from"},
      {"/resolution", 4096, "million cells"},
      {"/spacing", 0.1, "the scene must have either a resolution or a spacing"},
      {"/duration", 0, "duration is 0, must be from"},
      {"/duration", 1e6, "duration: gives"},
      {"/fluid/viscosity", -1, "fluid.viscosity is -1, must be from 0.0"},
      {"/fluid/density", json(), "fluid.density is null, must be a number"},
      {"/solver/courant", 1e6, "solver.courant is 1000000.0, must be from"},
      {"/solver/error", 0, "solver.error is 0, must be from"},
      {"/solver/error", 0.2, "solver.error is 0.2, must be from"},
      {"/solver/error", 0.01, "solver.error: method wcsph chooses its steps by speed alone"},
      {"/solver/sparse", 1, "solver.sparse is 1, must be true or false"},
      {"/solver/sparse", true, "solver.sparse: method wcsph has no cells"},
      {"/gravity", json{0, -9.81}, "gravity is an array of 2, must be an array of 3 numbers"},
      {"/liquid", json::array(), "liquid: is missing"},
      {"/liquid/0/box/max", json{0.5, 1.2, 0.5}, "liquid[0]: sticks out of the domain"},
      {"/liquid/0/box/max", json{0, 0.8, 0.5}, "liquid[0].box.max must be larger than min"},
      {"/liquid/0/sphere", json::object(), "liquid[0] must have either a box or a sphere"},
      {"/liquid/0/colour", 1, "liquid[0] has the unknown key \"colour\""},
      {"/solids/0/sphere/radius", -0.1, "solids[0].sphere.radius is -0.1, must be from"},
      {"/solids/0/sphere/radius", 10, "solids: leave no room for the fluid"},
      {"/solids/0/sphere/center", json{9, 9, 9}, "solids[0]: lies outside the domain"},
      {"/sources", json::parse(R"([{"sphere": {"center": [1, 0.5, 0.2], "radius": 0.1}}])"),
       "sources: method wcsph has none"},
      {"/start", "taylor_green", "start: method wcsph begins at rest"},
      {"/picture/size", json{0, 100}, "picture.size[0] is 0, must be from 16.0"},
      {"/picture/eye", json{1, 1, 1}, "picture must have both an eye and a target"},
      {"/picture/sun", json{1, -1, 0}, "picture.sun must stand higher"},
      {"/output", "png", "output is \"png\", must be an array"},
      {"/output", json{"gif"}, "output[0] is \"gif\", must be one of png, ply, vtk"},
  };
  for (const Fault& fault : faults) {
    json scene = good();
    const json::json_pointer place(fault.pointer);
    if (fault.value.is_null() && scene.contains(place))
      scene = scene.patch({{{"op", "remove"}, {"path", fault.pointer}}});
    else
      scene[place] = fault.value;
    const std::string message = refusal(scene.dump());
    EXPECT_NE(message.find(fault.message), std::string::npos)
        << fault.pointer << " = " << fault.value << ": " << message;
    EXPECT_TRUE(message.starts_with("scene.json: ")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(SimScene, SparseScenesAreWhatTheDeviceCanDo) {
  const auto refused = [](const char* pointer, const json& value) {
    json scene = smoke();
    scene["domain"].erase("sides");
    scene["solver"] = {{"sparse", true}};
    EXPECT_EQ(refusal(scene.dump()), "");
    scene[json::json_pointer(pointer)] = value;
    return refusal(scene.dump());
  };
  const auto says = [](const std::string& message, const char* part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  says(refused("/solver/advection", "central"), "solver.sparse: needs advection");
  says(refused("/solver/courant", 4), "solver.courant is 4.0");
  says(refused("/solver/error", 0.01), "solver.error: is not for sparse scenes");
  says(refused("/domain/sides", json{{"left", "periodic"}, {"right", "periodic"}}),
       "solver.sparse: domain.sides.left is periodic");
  says(refused("/solids", json::parse(R"([{"sphere": {"center": [0.5, 1], "radius": 0.1},
                                "velocity": [1, 0]}])")),
       "solver.sparse: solids[0] moves");
  says(refused("/spacing", 0.0009), "tiles of 8 x 4 x 4 cells, at most 65535");
}

TEST(SimScene, RefusesTextThatIsNoScene) {
  EXPECT_NE(refusal("").find("JSON"), std::string::npos);
  EXPECT_NE(refusal("[]").find("the root is an array"), std::string::npos);
  EXPECT_NE(refusal(R"({"duration": NaN})").find("byte"), std::string::npos);
  EXPECT_NE(refusal(R"({"duration": 1e999})").find("JSON"), std::string::npos);
  EXPECT_NE(refusal(R"({"duration": 1, "duration": 2})").find("twice"), std::string::npos);
  EXPECT_NE(refusal(std::string(100000, '[')).find("JSON"), std::string::npos);
  std::string cut = good().dump();
  for (std::size_t length = 0; length < cut.size(); ++length)
    EXPECT_NE(refusal(cut.substr(0, length)), "") << length;
}

TEST(SimScene, FilesAreBounded) {
  const TemporaryFolder folder;
  EXPECT_THROW(load_sim_scene(folder.path() / "none.json"), InputError);
  EXPECT_THROW(load_sim_scene(folder.path()), InputError);
  const std::string large(std::size_t(2) << 20, ' ');
  EXPECT_THROW(load_sim_scene(folder.write("large.json", large)), InputError);
  EXPECT_EQ(load_sim_scene(folder.write("good.json", good().dump())),
            decode_sim_scene(good().dump(), "x"));
}

TEST(SimScene, ShippedScenesAreGood) {
  const std::filesystem::path folder = std::filesystem::path(PARITY_SOURCE_DIR) / "assets/sim";
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    EXPECT_NO_THROW(load_sim_scene(entry.path())) << entry.path();
}

TEST(SimScene, PhysicsTextLeavesOutWhatIsShown) {
  const SimScene scene = decode_sim_scene(good().dump(), "x");
  SimScene other = scene;
  other.picture.samples = 4;
  other.duration = 9;
  other.title = "else";
  EXPECT_EQ(physics_text(scene), physics_text(other));
  other.fluid.viscosity = 1e-3;
  EXPECT_NE(physics_text(scene), physics_text(other));
}

TEST(SimScene, ResolutionSetsTheSpacingOfTheLongestSide) {
  SimScene scene = decode_sim_scene(good().dump(), "x");
  set_resolution(scene, 80);
  EXPECT_DOUBLE_EQ(scene.spacing, 0.025);
  EXPECT_THROW(set_resolution(scene, 1), std::invalid_argument);
  EXPECT_THROW(set_resolution(scene, 4096), std::invalid_argument);
}

}  // namespace
}  // namespace parity
