#ifndef PARITY_CORE_LAYOUT_H
#define PARITY_CORE_LAYOUT_H

#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

struct CanaryArgs {
  REF(uint) results;  // 2
  uint single_count;
  uint nested_count;
};

// The shaders named test_* are those of tests/gpu_core_test.cpp.

struct TestAddArgs {
  REF(float) values;
  REF(float) results;
  uint count;
  float addend;
};

struct TestPokeArgs {
  REF(uint) values;
  int at;  // may lie outside
  uint value;
};

struct TestTriangleArgs {
  REF(vec4) positions;  // clip space
  REF(vec4) colors;
};

struct TestSamplesArgs {
  REF(vec4) results;  // sample-minor
  uint width;
  uint height;
  uint sample_count;
};

#ifdef __cplusplus
}
#endif
#endif
