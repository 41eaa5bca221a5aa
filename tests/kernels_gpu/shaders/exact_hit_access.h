// The cubes for exact_hit.h.
#include "kernels_gpu/shaders/few_solids.h"
