#include "tools/provenance.h"

#include <cstdlib>
#include <ctime>
#include <fstream>

namespace parity::tools {
namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name") && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown processor";
}

}  // namespace

std::string date_of(const char* epoch) {
  std::time_t time = std::time(nullptr);
  if (epoch != nullptr && *epoch != '\0') {
    char* end = nullptr;
    const long long seconds = std::strtoll(epoch, &end, 10);
    if (*end == '\0') time = static_cast<std::time_t>(seconds);
  }
  std::tm parts{};
  char text[32] = "unknown";
  if (gmtime_r(&time, &parts) != nullptr) std::strftime(text, sizeof text, "%Y-%m-%d", &parts);
  return text;
}

Provenance provenance_of(const gpu::Context& context) {
  return {.device = context.info().name,
          .driver = context.info().driver,
          .host = processor_name(),
          .commit = PARITY_COMMIT,
          .date = date_of(std::getenv("SOURCE_DATE_EPOCH"))};
}

std::string text_of(const Provenance& provenance) {
  return provenance.device + ", " + provenance.driver + "; " + provenance.host + "; commit " +
         provenance.commit + "; " + provenance.date;
}

nlohmann::json json_of(const Provenance& provenance) {
  return {{"device", provenance.device},
          {"driver", provenance.driver},
          {"host", provenance.host},
          {"commit", provenance.commit},
          {"date", provenance.date}};
}

}  // namespace parity::tools
