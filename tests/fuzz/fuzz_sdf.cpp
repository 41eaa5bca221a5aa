// Any bytes as a scene of primitives: one that loads again from what it is saved as, or an error message, never a
// crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "io/sdf_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace probegi;
    const auto loaded = io::loadSdfFromMemory("scene", {data, size});
    if (!loaded) return 0;
    const std::string text = io::sdfText(*loaded);
    if (!io::loadSdfFromMemory("again", {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}))
        std::abort();
    return 0;
}
