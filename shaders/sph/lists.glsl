// Where neighbours stand: blocks of 64 particles, so that all of a workgroup's lists lie together,
// and inside them neighbour by neighbour, so that its threads read side by side. The last place of a
// list is a spare one: what turns out to be no neighbour was written there or is written over.

/// Place of the first neighbour of particle i; the next stands list_stride further.
uint list_first(uint capacity, uint i) { return (i & ~63u) * (capacity + 1u) + (i & 63u); }

const uint list_stride = 64u;
