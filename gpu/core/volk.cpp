// The one definition of Vulkan's entry points: pointers that volk fills from the loader at run
// time.
#define VOLK_IMPLEMENTATION
#include <volk.h>
