#ifndef SPLOTCHCL_SPLOTCHCL_H
#define SPLOTCHCL_SPLOTCHCL_H

/* The name that the C interface had first. Programs that include it go on as they are; new ones
 * include splotchcl/splotchcl_c.h. */
#include "splotchcl_c.h"

#endif
