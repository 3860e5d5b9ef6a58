/* The interface compiles as C11 without Vulkan's headers. */
#define SWARD_NO_VULKAN
#include "c/sward.h"

#ifdef VULKAN_H_
#error "the functions of field files need no Vulkan"
#endif

sward_status open_without_vulkan(const char* path, sward_field** field);

sward_status open_without_vulkan(const char* path, sward_field** field)
{
    return sward_field_open(path, field);
}
