#include "tests/architecture.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <regex>
#include <span>
#include <sstream>
#include <string_view>

namespace parity {
namespace {

constexpr std::array<std::string_view, 27> chapters{
    "transform", "raster",       "sampling",   "shading",        "texture",      "curve",
    "surface",   "subdivision",  "mesh",       "simplification", "shape",        "parameterization",
    "ray",       "acceleration", "radiometry", "monte_carlo",    "path_tracing", "numerics",
    "ode",       "cloth",        "rigid",      "collision",      "fluid",        "sph",
    "fem",       "light_field",  "core"};

constexpr std::array<std::string_view, 8> folders{"geometry", "sim",   "cpu_reference", "gpu",
                                                  "shaders",  "tests", "tools",         "docs"};

/// Who may include what of ours: patterns of the includer, patterns of the included. The first row
/// that fits the includer decides.
struct Rule {
  const char* includer;
  const char* included;
};
constexpr std::array<Rule, 11> own_rules{{
    {R"(geometry/.*)", R"(geometry/.*)"},
    {R"(sim/.*)", R"((sim|geometry)/.*)"},
    {R"(shaders/shared\.h)", R"(geometry/math\.h)"},
    {R"(shaders/.*layout\.h)", R"((\.\./shared|shaders/shared|(\.\./|\w+/)?\w*layout)\.h)"},
    {R"(shaders/.*)", R"(\w+/(\w*layout\.h|\w+\.glsl))"},
    {R"(cpu_reference/.*)", R"((cpu_reference|geometry|sim)/.*|shaders/\w+/\w*layout\.h)"},
    {R"(gpu/core/.*\.cpp)",
     R"(gpu/core/.*|geometry/(math|grid)\.h|shaders/(shared|core/layout)\.h|shaders\.h)"},
    {R"(gpu/core/.*)", R"(gpu/core/.*|geometry/(math|grid)\.h|shaders/(shared|core/layout)\.h)"},
    {R"(gpu/.*)", R"((gpu|geometry|sim)/.*|shaders/\w+/\w*layout\.h|shaders\.h)"},
    {R"(tests/.*)", R"((geometry|sim|cpu_reference|gpu|shaders|tests|tools)/.*|shaders\.h)"},
    {R"(tools/.*)", R"((geometry|sim|cpu_reference|gpu|shaders|tests|tools)/.*|shaders\.h)"},
}};

/// Libraries that only some files may include; the standard library and the system are free.
constexpr std::array<Rule, 6> library_rules{{
    {R"(geometry/math\.h|tests/.*)", R"(glm/.*)"},
    {R"(gpu/core/(.*\.cpp|vulkan_handles\.h))", R"(volk\.h|vulkan/.*)"},
    {R"((geometry|sim)/\w+_io\.(cpp|h)|tests/.*|tools/.*)",
     R"(tiny_gltf\.h|tiny_obj_loader\.h|stb.*|nlohmann/.*|png\.h|jpeglib\.h|jerror\.h|Imf.*|meshoptimizer\.h|draco/.*|fmt/.*)"},
    {R"(tests/.*)", R"(gtest/.*|gmock/.*|Eigen/.*)"},
    {R"(tools/.*)", R"(CLI/.*)"},
    {R"(tools/viewer.*)", R"(GLFW/.*|imgui.*)"},
}};

bool fits(const std::string& text, const char* pattern) {
  return std::regex_match(text, std::regex(pattern));
}

bool may_include_own(const std::string& path, const std::string& included) {
  for (const Rule& rule : own_rules)
    if (fits(path, rule.includer)) return fits(included, rule.included);
  return true;
}

bool may_include_library(const std::string& path, const std::string& included) {
  return std::ranges::none_of(library_rules, [&](const Rule& rule) {
    return fits(included, rule.included) && !fits(path, rule.includer);
  });
}

void check_include(const std::string& path, const std::string& line,
                   std::vector<std::string>& faults) {
  static const std::regex include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
  std::smatch match;
  if (!std::regex_match(line, match, include)) return;
  const std::string included = match[2];
  const bool own = match[1] == "\"";
  if (own ? !may_include_own(path, included) : !may_include_library(path, included))
    faults.push_back("may not include " + included);
}

/// Words that must not stand in the tree, put together here so that this file may be checked too.
std::vector<std::string> forbidden_words() {
  const auto joined = [](const char* a, const char* b) { return std::string(a) + b; };
  return {joined("TO", "DO"),        joined("FIX", "ME"),  joined("#if", " 0"),
          joined("/wo", "rk/"),      joined("/ro", "ot/"), joined("/ho", "me/"),
          joined("golden", " image")};
}

void check_line(const std::string& path, const std::string& line,
                std::vector<std::string>& faults) {
  static const std::vector<std::string> words = forbidden_words();
  if (line.find('\t') != std::string::npos) faults.push_back("has a tab");
  if (!line.empty() && (line.back() == ' ' || line.back() == '\r'))
    faults.push_back("has a space or carriage return at the end of a line");
  for (const std::string& word : words)
    if (line.find(word) != std::string::npos) faults.push_back("says " + word);
  check_include(path, line, faults);
}

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  std::istringstream stream(path);
  for (std::string part; std::getline(stream, part, '/');) parts.push_back(part);
  return parts;
}

void check_names(const std::string& path, std::vector<std::string>& faults) {
  const std::vector<std::string> parts = parts_of(path);
  if (!fits(parts.back(), R"([a-z0-9_]+(\.[a-z0-9_]+)*|CMakeLists\.txt|README\.md)"))
    faults.push_back("is not named in snake_case");
  const bool has_chapter =
      parts.size() == 3 &&
      std::ranges::count(
          std::array<std::string_view, 4>{"cpu_reference", "gpu", "shaders", "tests"}, parts[0]) >
          0;
  const bool is_source = fits(path, R"(.*\.(h|cpp|glsl|comp|vert|frag))");
  const bool is_fuzz_target = has_chapter && parts[0] == "tests" && parts[1] == "fuzz";
  if (has_chapter && is_source && !is_fuzz_target && std::ranges::count(chapters, parts[1]) == 0)
    faults.push_back("is in " + parts[1] + ", which is no chapter");
  if (parts[0] == "cpu_reference" && has_chapter && parts[1] == "core")
    faults.push_back("is in core: the reference has none");
}

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::vector<std::string> architecture_faults(const std::string& path, const std::string& text) {
  std::vector<std::string> faults;
  check_names(path, faults);
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) check_line(path, line, faults);
  if (fits(path, R"((?!shaders/).*\.h)") && text.find("#pragma once") == std::string::npos)
    faults.push_back("has no #pragma once");
  return faults;
}

std::vector<std::string> tree_faults(const std::filesystem::path& root) {
  std::vector<std::string> faults;
  for (std::string_view folder : folders) {
    if (!std::filesystem::is_directory(root / folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file()) continue;
      const std::string path = entry.path().lexically_relative(root).generic_string();
      if (!fits(path, R"(.*\.(h|cpp|glsl|comp|vert|frag|cmake|json|md|txt))")) continue;
      for (const std::string& fault : architecture_faults(path, read(entry.path())))
        faults.push_back(path + " " + fault);
    }
  }
  std::ranges::sort(faults);
  return faults;
}

}  // namespace parity
