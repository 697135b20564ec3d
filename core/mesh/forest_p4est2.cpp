#include <p4est_bits.h>
#include <p4est_extended.h>

#define SEAWAY_DIM 2
#include "core/mesh/forest_p4est.inc"
