#version 460
#include "ode/layout.h"
#include "ode/methods.glsl"

// Some steps of one system; one thread a system. State and time carry what rounding cuts off, so
// that many small steps add up. Sources: notes 10.1; Kahan 1965; Gustafsson 1991 (PI control).
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { OdeArgs args; };

void add_change(inout OdeRecord record, vec2 change) {
  precise const vec2 whole = change + record.carry;
  precise const vec2 sum = record.state + whole;
  record.carry = whole - (sum - record.state);
  record.state = sum;
}

void fixed_step(inout OdeRecord record) {
  precise const float t = float(record.steps) * args.step;
  const vec2 change =
      fixed_change(record.state, t, args.step, record.parameters, record.evaluations);
  add_change(record, change);
  record.steps += 1u;
}

/// Error in units of the tolerance, relative above 1 and absolute below.
float error_in_tolerances(vec2 error, vec2 before, vec2 after) {
  precise const vec2 scaled =
      error / (args.tolerance * (1.0 + max(abs(before), abs(after))));
  precise const float result = sqrt(0.5 * (scaled.x * scaled.x + scaled.y * scaled.y));
  return result;
}

/// The control's powers are eighths and sixteenths, by square roots alone: 0.9 error^(-1/8)
/// old^(1/16) after a step that is accepted, 0.9 error^(-1/4) after one that is not.
void adaptive_step(inout OdeRecord record) {
  precise const float left = (args.end - record.time) - record.time_carry;
  const bool last = record.step >= left;
  const float h = last ? left : record.step;
  const EmbeddedChange trial =
      dormand_prince_change(record.state, record.time, h, record.parameters);
  record.evaluations += 7u;
  record.steps += 1u;
  precise const float error =
      max(error_in_tolerances(trial.error, record.state, record.state + trial.change), 1e-8);
  const float fourth = sqrt(sqrt(error));
  if (!(error <= 1.0)) {
    record.step = h * clamp(0.9 / fourth, 0.2, 1.0);
    if (!(record.step > 0.0)) record.step = 0.2 * h;
    return;
  }
  const float old = sqrt(sqrt(sqrt(sqrt(record.old_error))));
  precise const float factor = clamp(0.9 / sqrt(fourth) * old, 0.2, 5.0);
  add_change(record, trial.change);
  record.old_error = max(error, 1e-4);
  if (last) {
    record.time = args.end;
    record.time_carry = 0.0;
    return;
  }
  precise const float whole = h + record.time_carry;
  precise const float sum = record.time + whole;
  record.time_carry = whole - (sum - record.time);
  record.time = sum;
  record.step = h * factor;
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  OdeRecord record = args.records.at[i];
  for (uint k = 0u; k < args.steps; ++k) {
    if (ode_method == 6u) {
      if (!(record.time < args.end)) break;
      adaptive_step(record);
    } else {
      if (record.steps >= args.last_step) break;
      fixed_step(record);
    }
  }
  args.records.at[i] = record;
}
