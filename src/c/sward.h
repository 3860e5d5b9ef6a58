/* Sward's C interface: reading field files, and drawing their grass in a host's Vulkan device.
 *
 * Compiles as C11 and as C++. Handles are opaque. No function throws or aborts for a fault of its
 * input; each that can fail returns a status, and sward_last_error() has the message of the last
 * failed call of the calling thread. Output parameters are left alone by a call that fails. Calls
 * without a status that cannot do their work do nothing, and leave their message there, too.
 * A handle is used by one thread at a time. sward_*_destroy(NULL) does nothing.
 *
 * Define SWARD_NO_VULKAN before including it to have the functions of field files alone. */
#ifndef SWARD_C_SWARD_H
#define SWARD_C_SWARD_H

#include "c/field.h"

#ifndef SWARD_NO_VULKAN
#include "c/device.h"
#include "c/grass.h"
#endif

#endif
