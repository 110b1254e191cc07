#include "tools/fault_plan.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace parity::tools {
namespace {

const Fault fault{"sign", "a.cpp", "x + y", "x - y", "*", ""};

TEST(Faults, ReplaceOnePlace) { EXPECT_EQ(planted(fault, "f(x + y);"), "f(x - y);"); }

TEST(Faults, RefuseAPlaceThatIsNotThereOrNotAlone) {
  EXPECT_THROW(planted(fault, "f(x);"), std::invalid_argument);
  EXPECT_THROW(planted(fault, "x + y, x + y"), std::invalid_argument);
}

TEST(Faults, NamesOfRedTestsAreReadOnce) {
  const std::string output =
      "[       OK ] A.Passes (0 ms)\n[  FAILED  ] B.Fails (1 ms)\n"
      "[  FAILED  ] C/D.Fails/0, where GetParam() = 3 (1 ms)\n[  FAILED  ] 2 tests, listed below:\n"
      "[  FAILED  ] B.Fails\nok    e/f  1 ms\nFAIL  g/h/standard  2 ms\n";
  EXPECT_EQ(failed_tests(output),
            (std::vector<std::string>{"B.Fails", "C/D.Fails/0", "g/h/standard"}));
}

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The list itself is exercised by `parity faults`; here it is only held to fit the source.
TEST(Faults, EverySeededFaultStillFitsTheSource) {
  const std::filesystem::path root = PARITY_SOURCE_DIR;
  for (const Fault& seeded : read_faults(root / "tests/faults/faults.json"))
    EXPECT_NO_THROW(planted(seeded, read(root / seeded.file))) << seeded.name;
}

}  // namespace
}  // namespace parity::tools
