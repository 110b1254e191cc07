#pragma once

#include <string>

namespace parity::tools {

/// Text with <, >, &, quotes and control characters replaced, fit for XML.
std::string xml_escaped(const std::string& text);

}  // namespace parity::tools
