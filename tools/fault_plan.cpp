#include "tools/fault_plan.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "geometry/atomic_file.h"
#include "geometry/input_error.h"

namespace parity::tools {
namespace {

constexpr std::size_t max_file_bytes = std::size_t{1} << 24;

Fault fault_of(const nlohmann::json& json) {
  const auto get = [&](const char* key) { return json.at(key).get<std::string>(); };
  Fault fault{.name = get("name"),
              .file = get("file"),
              .text = get("text"),
              .replacement = get("replacement"),
              .tests = json.value("tests", std::string()),
              .checks = json.value("checks", std::string())};
  if (fault.tests.empty() == fault.checks.empty())
    throw std::invalid_argument("fault '" + fault.name + "' needs either tests or checks");
  return fault;
}

}  // namespace

std::vector<Fault> read_faults(const std::filesystem::path& file) {
  const std::vector<std::byte> bytes = read_file(file, max_file_bytes);
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  std::vector<Fault> faults;
  try {
    for (const nlohmann::json& json : nlohmann::json::parse(text, text + bytes.size())) {
      Fault fault = fault_of(json);
      if (std::ranges::find(faults, fault.name, &Fault::name) != faults.end())
        throw InputError(file.string(), "fault '" + fault.name + "' occurs twice");
      faults.push_back(std::move(fault));
    }
  } catch (const std::invalid_argument& error) {
    throw InputError(file.string(), error.what());
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file.string(), error.what());
  }
  return faults;
}

std::string planted(const Fault& fault, const std::string& text) {
  const std::size_t first = text.find(fault.text);
  if (fault.text.empty() || first == std::string::npos)
    throw std::invalid_argument(fault.file + " does not hold: " + fault.text);
  if (text.find(fault.text, first + 1) != std::string::npos)
    throw std::invalid_argument(fault.file + " holds more than once: " + fault.text);
  return text.substr(0, first) + fault.replacement + text.substr(first + fault.text.size());
}

std::vector<std::string> failed_tests(const std::string& output) {
  std::vector<std::string> names;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);)
    for (const std::string mark : {"[  FAILED  ] ", "FAIL  "}) {
      if (!line.starts_with(mark)) continue;
      const std::string name =
          line.substr(mark.size(), line.find_first_of(" ,", mark.size()) - mark.size());
      const bool is_test = name.find_first_of("./") != std::string::npos;
      if (is_test && std::ranges::count(names, name) == 0) names.push_back(name);
    }
  return names;
}

}  // namespace parity::tools
