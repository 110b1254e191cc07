// What the kernel of the ode chapter and its host share. Fields only.
#ifndef PARITY_ODE_LAYOUT_H
#define PARITY_ODE_LAYOUT_H

#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

/// One system on its way.
struct OdeRecord {
  vec2 state;
  vec2 carry;       ///< what rounding has cut from the state so far
  vec2 parameters;
  float time;
  float time_carry;
  float step;       ///< adaptive: the next
  float old_error;  ///< adaptive: of the last accepted step, in tolerances
  uint steps;       ///< done; rejected ones too
  uint evaluations;
};
REF_TYPE(OdeRecord, 4)

struct OdeArgs {
  REF(OdeRecord) records;
  uint count;
  uint steps;      ///< in this dispatch
  uint last_step;  ///< of all, where the step is fixed
  float step;
  float end;
  float tolerance;
};

#ifdef __cplusplus
}  // namespace parity
#endif
#endif
