/* Sward's C interface: reading field files, and drawing their grass in a host's Vulkan device.
 *
 * Compiles as C11 and as C++. Handles are opaque. No function throws or aborts for a fault of its
 * input; each that can fail returns a status. sward_last_error() has the message if the last one of
 * the calling thread failed, and is empty if it succeeded. A call that fails does nothing: it leaves
 * output parameters alone, and records nothing.
 * A handle is used by one thread at a time. sward_*_destroy(NULL) does nothing.
 *
 * Define SWARD_NO_VULKAN before including it to have the functions of field files alone. These are
 * in a library of their own, sward_c_field, which needs no Vulkan. */
#ifndef SWARD_C_SWARD_H
#define SWARD_C_SWARD_H

#include "c/field.h"

#ifndef SWARD_NO_VULKAN
#include "c/device.h"
#include "c/grass.h"
#endif

#endif
