#include "vulkan/device/loader.h"

#if defined(_WIN32)
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace probegi::vulkan {

PFN_vkGetInstanceProcAddr systemLoader() noexcept {
#if defined(_WIN32)
    HMODULE library = LoadLibraryA("vulkan-1.dll");
    return library ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(GetProcAddress(library, "vkGetInstanceProcAddr"))
                   : nullptr;
#else
    void* library = nullptr;
    for (const char* name : {"libvulkan.so.1", "libvulkan.so", "libvulkan.1.dylib"})
        if ((library = dlopen(name, RTLD_NOW | RTLD_LOCAL))) break;
    return library ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr")) : nullptr;
#endif
}

}  // namespace probegi::vulkan
