#include "tools/xml.h"

namespace parity::tools {
namespace {

std::string escaped(char c) {
  switch (c) {
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '&':
      return "&amp;";
    case '"':
      return "&quot;";
    case '\n':
    case '\t':
      return std::string(1, c);
    default:
      return std::string(1, static_cast<unsigned char>(c) < 0x20 ? '?' : c);
  }
}

}  // namespace

std::string xml_escaped(const std::string& text) {
  std::string result;
  for (char c : text) result += escaped(c);
  return result;
}

}  // namespace parity::tools
