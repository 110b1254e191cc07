// Workgroups of the dispatches of a solver's rounds: over particles, over blocks of them, and of one.
// None of them once the solver has stopped: its rounds are recorded before anyone knows how many it
// takes, and an empty dispatch costs next to nothing.

const uint rounds_group = 64u;

void set_rounds(ref_uint groups, bool running, uint count, uint block) {
  const uint blocks = (count + block - 1u) / block;
  const uint numbers[3] = {(count + rounds_group - 1u) / rounds_group,
                           (blocks + rounds_group - 1u) / rounds_group, 1u};
  for (int k = 0; k < 3; ++k) {
    groups.at[3 * k] = running ? numbers[k] : 0u;
    groups.at[3 * k + 1] = 1u;
    groups.at[3 * k + 2] = 1u;
  }
}

void stop_rounds(ref_uint groups) {
  for (int k = 0; k < 3; ++k) groups.at[3 * k] = 0u;
}
