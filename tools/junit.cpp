#include "tools/junit.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/xml.h"

namespace parity::tools {
namespace {

std::string test_case(const CheckReport& report) {
  const std::size_t slash = report.name.rfind('/');
  const std::string begin = fmt::format(R"(  <testcase classname="{}" name="{}" time="{:.6f}")",
                                        xml_escaped(report.name.substr(0, slash)),
                                        xml_escaped(report.name.substr(slash + 1)), report.seconds);
  const std::string message = xml_escaped(report.message);
  if (report.outcome == "failed")
    return fmt::format("{}>\n    <failure message=\"{}\">reproduce: {}</failure>\n  </testcase>\n",
                       begin, message, xml_escaped(report.reproduce));
  if (report.outcome == "skipped")
    return fmt::format("{}>\n    <skipped message=\"{}\"/>\n  </testcase>\n", begin, message);
  return begin + "/>\n";
}

}  // namespace

std::string junit_xml(const std::vector<CheckReport>& reports) {
  double seconds = 0;
  for (const CheckReport& report : reports) seconds += report.seconds;
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuite name=\"parity check\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" "
      "errors=\"0\" time=\"{:.6f}\">\n",
      reports.size(), std::ranges::count(reports, "failed", &CheckReport::outcome),
      std::ranges::count(reports, "skipped", &CheckReport::outcome), seconds);
  for (const CheckReport& report : reports) xml += test_case(report);
  return xml + "</testsuite>\n";
}

}  // namespace parity::tools
