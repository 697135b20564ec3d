#include <p4est_to_p8est.h>
#include <p8est_bits.h>
#include <p8est_extended.h>

#define SEAWAY_DIM 3
#include "core/mesh/forest_p4est.inc"
